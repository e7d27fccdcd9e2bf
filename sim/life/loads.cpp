// Owns the reduction of a recorded window to loads: tensions beside each pulley, contact forces over its passes.
#include "sim/life/loads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>

#include "sim/scene/pitch_line.h"

namespace beltlife {

namespace {

constexpr double nothing_recorded = std::numeric_limits<double>::quiet_NaN();

/// What one sampled channel did inside the window.
struct Extent {
  double mean = nothing_recorded;
  double low = nothing_recorded;
  double high = nothing_recorded;
};

Extent extent(const Trace& trace, const WindowRecord& window, const std::string& channel_name) {
  const Channel* channel = trace.find(channel_name);
  if (!channel) throw std::logic_error("the run recorded no channel " + channel_name);
  const std::size_t end = std::min(window.last_sample, channel->values.size());
  if (window.first_sample >= end) return {};
  const auto values = std::span(channel->values).subspan(window.first_sample, end - window.first_sample);
  const auto [low, high] = std::ranges::minmax(values);
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {.mean = sum / static_cast<double>(values.size()), .low = low, .high = high};
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return nothing_recorded;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The 99th percentile, interpolated linearly between order statistics.
double percentile_99(std::vector<double> values) {
  if (values.empty()) return nothing_recorded;
  std::ranges::sort(values);
  const double rank = 0.99 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

void summarise(const std::vector<double>& sampled, const std::vector<double>& resolved, double (&by_pass_force)[3]) {
  by_pass_force[static_cast<int>(PassForce::sampled)] = mean(sampled);
  by_pass_force[static_cast<int>(PassForce::resolved)] = mean(resolved);
  by_pass_force[static_cast<int>(PassForce::percentile_99)] = percentile_99(resolved);
}

/// The pulley whose surface speed is taken for the belt's (D and RPM of thesis 6.12): the driven one, or the first
/// that can turn, with its recorded speed, where what is driven is no pulley.
void set_belt_speed(const SceneSpec& scene, const RunRecord& run, const WindowRecord& window, RangeLoad& load) {
  if (scene.pulley.empty()) return;
  const auto driven =
      scene.driver ? std::ranges::find(scene.pulley, scene.driver->body, &PulleySpec::name) : scene.pulley.end();
  const bool driver_is_pulley = driven != scene.pulley.end();
  const auto turning = std::ranges::find(scene.pulley, false, &PulleySpec::locked);
  if (!driver_is_pulley && turning == scene.pulley.end()) return;
  const PulleySpec& pulley = driver_is_pulley ? *driven : *turning;
  load.driver_radius_m = pitch_diameter_mm(scene, pulley) * 0.5e-3;
  load.driver_rpm =
      std::abs(driver_is_pulley ? window.crank_rpm : extent(run.trace, window, pulley.name + ".speed_rpm").mean);
  load.belt_speed_m_s = std::numbers::pi * 2 * load.driver_radius_m * load.driver_rpm / 60;
}

}  // namespace

RangeLoad range_load(const SceneSpec& scene, double unstretched_length_m, const RunRecord& run,
                     const WindowRecord& window) {
  const std::size_t count = scene.pulley.size();
  if (window.passes.size() != count)
    throw std::logic_error("range " + window.range + ": contact forces of " + std::to_string(window.passes.size()) +
                           " pulleys, but the scene has " + std::to_string(count));
  RangeLoad load;
  load.name = window.range;
  load.duty_share = window.duty_share;
  load.unstretched_length_m = unstretched_length_m;
  load.element_length_m = unstretched_length_m / scene.belt.elements;
  load.axial_stiffness_n = scene.belt.axial_stiffness_n;
  load.ribs = scene.belt.ribs;
  set_belt_speed(scene, run, window, load);

  // Span i joins pulley i and the next one; pulley i lies between spans i - 1 and i.
  std::vector<Extent> tension(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& next = scene.pulley[(i + 1) % count].name;
    tension[i] = extent(run.trace, window, "span." + scene.pulley[i].name + "-" + next + ".tension_n");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const PulleySpec& spec = scene.pulley[i];
    const PassForces& passes = window.passes[i];
    const Extent& before = tension[(i + count - 1) % count];
    const Extent& after = tension[i];
    const bool before_is_high = before.mean >= after.mean;
    PulleyLoad& pulley = load.pulleys.emplace_back();
    pulley.name = spec.name;
    pulley.side = spec.side;
    pulley.radius_m = pitch_diameter_mm(scene, spec) * 0.5e-3;
    pulley.tension_high_n = before_is_high ? before.high : after.high;
    pulley.tension_low_n = before_is_high ? after.low : before.low;
    summarise(passes.normal_sampled, passes.normal_resolved, pulley.normal_n);
    summarise(passes.tangential_sampled, passes.tangential_resolved, pulley.tangential_n);
    pulley.passes = passes.normal_resolved.size();
    pulley.passes_unsampled = passes.unsampled;
  }
  return load;
}

}  // namespace beltlife
