// Named numbers of a window: see summary.h.
#include "sim/eval/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

struct Extent {
  double mean = 0, low = 0, high = 0;
};

std::span<const double> stretch(const RunRecord& run, const WindowRecord& window, const std::string& name) {
  const Channel* channel = run.trace.find(name);
  if (!channel) throw std::logic_error("no channel " + name);
  return std::span(channel->values).subspan(window.first_sample, window.last_sample - window.first_sample);
}

Extent extent(std::span<const double> v) {
  if (v.empty()) return {};
  Extent e{0, v[0], v[0]};
  for (double x : v) {
    e.mean += x;
    e.low = std::min(e.low, x);
    e.high = std::max(e.high, x);
  }
  e.mean /= static_cast<double>(v.size());
  return e;
}

/// Every band stands here, whatever the window could tell, so that names depend on the scene alone.
std::vector<BandLine> band_lines(const std::vector<double>& of_speed, const std::vector<double>& of_torque) {
  std::vector<BandLine> lines;
  for (std::size_t b = 0; b < octave_bands.size(); ++b) lines.push_back({octave_bands[b], of_speed[b], of_torque[b]});
  return lines;
}

OutputSummary output_of(const Model& m, const RunRecord& run, const WindowRecord& window) {
  OutputSummary out;
  out.body = m.scene.output->body;
  const auto speed = stretch(run, window, out.body + ".speed_rpm"),
             torque = stretch(run, window, out.body + ".torque_n_m");
  const Extent of_speeds = extent(speed), of_torques = extent(torque);
  out.speed_rpm_mean = of_speeds.mean;
  out.speed_rpm_min = of_speeds.low;
  out.speed_rpm_max = of_speeds.high;
  out.torque_n_m_mean = of_torques.mean;
  out.torque_n_m_min = of_torques.low;
  out.torque_n_m_max = of_torques.high;
  out.speed_peak_hz = peak_frequency(speed, m.scene.solver.sample_rate_hz);
  out.torque_peak_hz = peak_frequency(torque, m.scene.solver.sample_rate_hz);
  if (m.driver.body < 0) {
    const std::vector<double> unknown(octave_bands.size(), std::nan(""));
    out.bands = band_lines(unknown, unknown);
    return out;
  }
  const auto angle = stretch(run, window, "driver.angle_rad");
  const auto orders = default_orders();
  const auto of_speed = track_orders(speed, angle, orders), of_torque = track_orders(torque, angle, orders);
  // Every order stands here, whatever the window could tell apart, so that names depend on the scene alone.
  const auto amplitude = [](const std::vector<OrderAmplitude>& tracked, double order) {
    for (const OrderAmplitude& o : tracked)
      if (o.order == order) return o.amplitude;
    return std::nan("");
  };
  for (double order : orders)
    out.orders.push_back(
        {order, order * window.crank_rpm / 60, amplitude(of_speed, order), amplitude(of_torque, order)});
  const double rate = m.scene.solver.sample_rate_hz;
  out.bands =
      band_lines(remainder_bands(speed, angle, of_speed, rate), remainder_bands(torque, angle, of_torque, rate));
  return out;
}

PulleySummary pulley_of(const Model& m, const RunRecord& run, const WindowRecord& window, int p) {
  PulleySummary s;
  s.name = m.body_name[p];
  const std::string prefix = "pulley." + s.name;
  s.speed_rpm_mean = extent(stretch(run, window, s.name + ".speed_rpm")).mean;
  if (run.trace.find(prefix + ".slip_percent"))
    s.slip_percent = extent(stretch(run, window, prefix + ".slip_percent")).mean;
  s.torque_n_m_mean = extent(stretch(run, window, prefix + ".torque_n_m")).mean;
  const auto x = stretch(run, window, prefix + ".hub_load_x_n"), y = stretch(run, window, prefix + ".hub_load_y_n");
  std::vector<double> magnitude(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) magnitude[i] = std::hypot(x[i], y[i]);
  const Extent e = extent(magnitude);
  s.hub_load_n = e.mean;
  s.hub_load_n_max = e.high;
  s.hub_direction_deg = std::atan2(extent(y).mean, extent(x).mean) * 180 / std::numbers::pi;
  return s;
}

}  // namespace

RangeSummary summarise(const Model& m, const RunRecord& run, const WindowRecord& window) {
  RangeSummary s;
  s.name = window.range;
  s.crank_rpm = window.crank_rpm;
  s.complete = window.complete;
  if (m.scene.output) s.output = output_of(m, run, window);
  for (int p = 0; p < m.pulleys; ++p) {
    const std::string name = span_name(m.scene, static_cast<std::size_t>(p));
    const auto tension = stretch(run, window, "span." + name + ".tension_n");
    const Extent t = extent(tension);
    const std::size_t half = tension.size() / 2;
    const double change = extent(tension.subspan(half)).mean - extent(tension.first(half)).mean;
    if (t.mean > 0) s.drift = std::max(s.drift, std::abs(change) / t.mean);
    const Extent d = extent(stretch(run, window, "span." + name + ".deflection_mm"));
    s.spans.push_back({name, t.mean, t.low, t.high, d.low, d.high});
    s.pulleys.push_back(pulley_of(m, run, window, p));
  }
  const double observed = std::min(window.end_s, run.simulated_s) - window.begin_s;
  for (double joule : window.energy.joule) s.power_w.push_back(joule / observed);
  s.energy_residual = window.energy.relative_residual();
  if (m.tensioner.pulley >= 0) {
    const Extent a = extent(stretch(run, window, "tensioner.arm_angle_rad"));
    s.arm_angle_mean = a.mean;
    s.arm_angle_min = a.low;
    s.arm_angle_max = a.high;
  }
  return s;
}

}  // namespace beltlife
