// From the trace of a sweep to its orders: see sweep.h.
#include "sim/eval/sweep.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "sim/signal/order_map.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

// A resonance of a belt that slips and lifts off lies up to a tenth below the linear frequency.
constexpr double near_share = 0.1;
constexpr double damped_away = 0.3;  // a mode beyond has no peak worth the name

Campbell modes_over(const Model& model, const SweepSpec& sweep) {
  Model over = model;
  over.scene.range = {{"from", sweep.from_rpm, 0}, {"to", sweep.to_rpm, 0}};
  return campbell(over);
}

}  // namespace

double shortest_sweep_s(double from_rpm, double to_rpm) {
  const double slowest = std::min(from_rpm, to_rpm), window_s = 60 * order_window_revolutions / slowest;
  return std::abs(to_rpm - from_rpm) * window_s / (largest_sweep_change * slowest);
}

Sweep sweep_of(const Model& m, const SweepSpec& asked, const RunRecord& run, const WindowRecord& window) {
  Sweep s;
  s.asked = asked;
  s.begin_s = window.begin_s;
  s.end_s = window.end_s;
  s.complete = window.complete;
  s.window_revolutions = order_window_revolutions;
  s.energy = window.energy;
  s.modes = modes_over(m, asked);
  s.crossings = crossings(s.modes, {});
  const double highest = default_orders().back();
  s.orders = map_orders(highest);
  const auto stretch = [&](const std::vector<double>& values) {
    return std::span(values).subspan(window.first_sample, window.last_sample - window.first_sample);
  };
  const auto channel = [&](const std::string& name) -> const Channel& {
    const Channel* found = run.trace.find(name);
    if (!found) throw std::logic_error("no channel " + name);
    return *found;
  };
  const auto angle = stretch(channel("driver.angle_rad").values);
  const auto windows = order_windows(stretch(run.trace.time_s), angle);
  for (const OrderWindow& w : windows) {
    s.time_s.push_back(w.time_s);
    s.crank_rpm.push_back(w.speed_rpm);
  }
  for (const char* what : {".speed_rpm", ".torque_n_m"}) {
    const Channel& c = channel(m.scene.output->body + what);
    s.channels.push_back({c.name, c.unit, order_amplitudes(stretch(c.values), angle, windows, highest)});
  }
  return s;
}

std::vector<SweepPeak> peaks_of(const Sweep& s, const SweepChannel& channel) {
  std::vector<SweepPeak> peaks;
  for (const double order : default_orders()) {
    const auto at = std::find(s.orders.begin(), s.orders.end(), order);  // both are multiples of 1/8: exact
    if (at == s.orders.end()) continue;
    const auto& cut = channel.amplitude[static_cast<std::size_t>(at - s.orders.begin())];
    SweepPeak peak{order, -1, 0, 0, {}};
    for (std::size_t i = 0; i < cut.size(); ++i)
      if (cut[i] > peak.amplitude) {
        peak.amplitude = cut[i];
        peak.crank_rpm = s.crank_rpm[i];
      }
    if (peak.amplitude < 0) continue;
    peak.frequency_hz = order * peak.crank_rpm / 60;
    // What turns is moved by rotational modes first, by those of a span only at second hand.
    const auto rank = [&](const Crossing& c) {
      return std::pair(!c.mode.starts_with("rotational"), std::abs(c.crank_rpm - peak.crank_rpm));
    };
    for (const Crossing& c : s.crossings)
      if (c.order == order && c.damping_ratio <= damped_away && rank(c).second <= near_share * peak.crank_rpm &&
          (!peak.near || rank(c) < rank(*peak.near)))
        peak.near = c;
    peaks.push_back(std::move(peak));
  }
  return peaks;
}

}  // namespace beltlife
