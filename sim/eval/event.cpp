// From the trace of an event to its extremes: see event.h.
#include "sim/eval/event.h"

#include <cmath>
#include <span>
#include <stdexcept>

namespace beltlife {
namespace {

/// The samples of the event.
class Samples {
 public:
  Samples(const RunRecord& run, const WindowRecord& window) : run_(run), window_(window) {
    time_ = stretch(run.trace.time_s);
  }

  std::span<const double> of(const std::string& name) const {
    const Channel* channel = run_.trace.find(name);
    if (!channel) throw std::logic_error("no channel " + name);
    return stretch(channel->values);
  }
  double time(std::size_t i) const { return time_[i] - window_.begin_s; }

  TimedExtent extent(std::span<const double> v) const {
    if (v.empty()) return {};
    std::size_t high = 0, low = 0;
    for (std::size_t i = 1; i < v.size(); ++i) {
      if (v[i] > v[high]) high = i;
      if (v[i] < v[low]) low = i;
    }
    return {{v[high], time(high)}, {v[low], time(low)}};
  }
  TimedExtent extent(const std::string& name) const { return extent(of(name)); }
  /// Of the largest absolute value, with its sign.
  Timed largest(std::span<const double> v) const {
    const TimedExtent e = extent(v);
    return std::abs(e.low.value) > std::abs(e.high.value) ? e.low : e.high;
  }
  /// Integral over time, by trapezoids.
  double integral(std::span<const double> v) const {
    double sum = 0;
    for (std::size_t i = 1; i < v.size(); ++i) sum += 0.5 * (v[i] + v[i - 1]) * (time_[i] - time_[i - 1]);
    return sum;
  }
  /// How long a condition on the samples held.
  template <class Holds>
  double duration(std::span<const double> v, Holds holds) const {
    double sum = 0;
    for (std::size_t i = 1; i < v.size(); ++i)
      if (holds(v[i])) sum += time_[i] - time_[i - 1];
    return sum;
  }

 private:
  std::span<const double> stretch(const std::vector<double>& values) const {
    return std::span(values).subspan(window_.first_sample, window_.last_sample - window_.first_sample);
  }
  const RunRecord& run_;
  const WindowRecord& window_;
  std::span<const double> time_;
};

EventPulley pulley_of(const Samples& samples, const std::string& name) {
  EventPulley p;
  p.name = name;
  p.speed_rpm = samples.extent(name + ".speed_rpm");
  const std::string prefix = "pulley." + name;
  const auto slip = samples.of(prefix + ".slip_speed_m_s");
  p.slip_m_s = samples.largest(slip);
  p.sliding_s = samples.duration(slip, [](double v) { return std::abs(v) > sliding_m_s; });
  p.slip_energy_j = samples.integral(samples.of(prefix + ".slip_power_w"));
  const auto x = samples.of(prefix + ".hub_load_x_n"), y = samples.of(prefix + ".hub_load_y_n");
  std::vector<double> magnitude(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) magnitude[i] = std::hypot(x[i], y[i]);
  p.hub_load_n = samples.extent(magnitude).high;
  return p;
}

EventArm arm_of(const Model& m, const Samples& samples) {
  EventArm arm;
  arm.angle_rad = samples.extent("tensioner.arm_angle_rad");
  arm.rate_rad_s = samples.largest(samples.of("tensioner.arm_rate_rad_s"));
  if (!m.tensioner.stops.any()) return arm;
  const auto stop = samples.of("tensioner.stop_torque_n_m");
  arm.stop_n_m = samples.largest(stop);
  arm.on_stop_s = samples.duration(stop, [](double torque) { return torque != 0; });
  return arm;
}

}  // namespace

EventSummary summarise_event(const Model& m, const RunRecord& run, const WindowRecord& window) {
  const Samples samples(run, window);
  EventSummary s;
  s.complete = window.complete;
  s.energy_residual = window.energy.relative_residual();
  if (window.last_sample <= window.first_sample) return s;  // it failed before the event began
  s.duration_s = samples.time(window.last_sample - window.first_sample - 1);
  s.driver_rpm = samples.extent(m.scene.driver->body + ".speed_rpm");
  s.driver_torque_n_m = samples.extent("driver.torque_n_m");
  if (m.scene.output) {
    s.output_rpm = samples.extent(m.scene.output->body + ".speed_rpm");
    s.output_torque_n_m = samples.extent(m.scene.output->body + ".torque_n_m");
  }
  for (int p = 0; p < m.pulleys; ++p) {
    const std::string span = span_name(m.scene, static_cast<std::size_t>(p));
    const auto tension = samples.of("span." + span + ".tension_n");
    const double slack = slack_share * m.statics.balance.tension;
    s.spans.push_back(
        {span, samples.extent(tension), samples.duration(tension, [&](double t) { return !(t >= slack); })});
    s.pulleys.push_back(pulley_of(samples, m.body_name[static_cast<std::size_t>(p)]));
  }
  for (const auto& k : m.scene.torsional_spring)
    s.springs.push_back({k.name, samples.extent("spring." + k.name + ".torque_n_m")});
  for (const auto& g : m.scene.gear_pair)
    s.gears.push_back({g.name, samples.extent("gear_pair." + g.name + ".force_n")});
  if (m.tensioner.pulley >= 0) s.arm = arm_of(m, samples);
  return s;
}

}  // namespace beltlife
