// Limits of the arm's reach and of running: see limits_of_running.h.
#include "optimize/layout/limits_of_running.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimize/layout/order_distance.h"
#include "sim/statics/take_up.h"

namespace beltlife {
namespace {

constexpr double degree = std::numbers::pi / 180, mm = 1e-3;

/// The ends of the arm's reach, within which the belt is tight and stretched by no more than take_up() allows.
ArmReach reach_of(const SceneSpec& scene, const PlacedLayout& layout) {
  ArmOfLayout tight = *layout.arm;
  tight.tension_limit = take_up_strain * scene.belt.axial_stiffness_n;
  return arm_reach(tight, layout.rest);
}

void take_up_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, const PlacedLayout& layout,
                    LimitList& limits) {
  const bool reaches = layout.shape.can_be_built() && layout.missing == 0;
  const ArmReach reach = reaches ? reach_of(scene, layout) : ArmReach{};
  const auto unstretched = [&](const ReachEnd& end) {
    const double tension = std::isfinite(end.tension) ? end.tension : 0;  // no leverage: no reach either
    return end.length / (1 + std::max(tension, 0.0) / scene.belt.axial_stiffness_n);
  };
  const bool can_turn = layout.shape.can_be_built() && layout.missing == 0;
  const double low = can_turn ? unstretched(reach.low) : 0, high = can_turn ? unstretched(reach.high) : 0;
  const double longer = can_turn ? (std::max(low, high) - layout.unstretched_length) / mm : 0;
  const double shorter = can_turn ? (layout.unstretched_length - std::min(low, high)) / mm : 0;
  limits.at_least("take-up longer", longer, spec.take_up->longer_mm, "mm", "tensioner.pivot_x_mm", [&] {
    return fmt::format("the arm holds belts up to {:.1f} mm longer, not {:g} mm", longer, spec.take_up->longer_mm);
  });
  limits.at_least("take-up shorter", shorter, spec.take_up->shorter_mm, "mm", "tensioner.pivot_x_mm", [&] {
    return fmt::format("the arm holds belts up to {:.1f} mm shorter, not {:g} mm", shorter, spec.take_up->shorter_mm);
  });
}

void travel_limits(const LayoutLimitsSpec& spec, const std::vector<RunningLimits>& ranges, LimitList& limits) {
  const auto least = [&](double RunningLimits::*side) {
    double travel = std::numbers::pi;
    for (const RunningLimits& r : ranges) travel = std::min(travel, r.solved ? r.*side : 0);
    return travel / degree;
  };
  for (const auto& [name, side] :
       {std::pair{"lengthening", &RunningLimits::lengthening}, {"shortening", &RunningLimits::shortening}}) {
    const double travel = least(side);
    limits.at_least(fmt::format("travel {}", name), travel, *spec.travel_deg, "deg", "tensioner.pivot_x_mm", [&] {
      return fmt::format("the arm has {:.1f} degrees of travel left that are {} the belt path, less than {:g}", travel,
                         name, *spec.travel_deg);
    });
  }
}

void load_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, const std::vector<RunningLimits>& ranges,
                 LimitList& limits) {
  const auto cannot = [](const std::string& range) { return "the drive has no steady running in range " + range; };
  for (std::size_t r = 0; r < ranges.size() && spec.min_slip_safety; ++r) {
    const double safety = ranges[r].solved ? ranges[r].slip_safety : 0;
    const std::string& name = scene.range[r].name;
    limits.at_least("slip safety in " + name, safety, *spec.min_slip_safety, "", "belt.friction_front", [&] {
      return ranges[r].solved ? fmt::format("the slip safety in range {} is {:.2f}, less than {:g}", name, safety,
                                            *spec.min_slip_safety)
                              : cannot(name);
    });
  }
  for (std::size_t r = 0; r < ranges.size() && spec.max_hub_load_n; ++r) {
    const double load = ranges[r].solved ? ranges[r].hub_load : 2 * *spec.max_hub_load_n;
    const std::string& name = scene.range[r].name;
    limits.at_most("hub load in " + name, load, *spec.max_hub_load_n, "N", "belt.pretension_n", [&] {
      return ranges[r].solved
                 ? fmt::format("a hub carries {:.0f} N in range {}, more than {:g} N", load, name, *spec.max_hub_load_n)
                 : cannot(name);
    });
  }
}

void mode_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, const PlacedLayout& layout, LimitList& limits) {
  const bool can_run = layout.shape.can_be_built() && layout.missing == 0;
  const auto distances = order_distances(scene, spec.modes->orders, can_run);
  for (std::size_t r = 0; r < distances.size(); ++r) {
    const OrderDistance& d = distances[r];
    const std::string& name = scene.range[r].name;
    limits.at_least(
        "modes in " + name, d.percent, spec.modes->min_distance_percent, "%", "belt.axial_stiffness_n", [&] {
          return d.frequency_hz > 0 ? fmt::format(
                                          "a natural frequency of {:.1f} Hz is {:.1f} % away from order {:g} in range "
                                          "{}, less than {:g} %",
                                          d.frequency_hz, d.percent, d.order, name, spec.modes->min_distance_percent)
                                    : "the drive has no steady running in range " + name;
        });
  }
}

}  // namespace

void add_limits_of_running(const SceneSpec& scene, const LayoutLimitsSpec& spec, const PlacedLayout& layout,
                           RunningDetail detail, LimitList& limits) {
  if (layout.arm && spec.take_up) take_up_limits(scene, spec, layout, limits);
  if (spec.wants_quasi_static()) {
    const bool travels = layout.arm && spec.travel_deg;
    const std::vector<RunningLimits> ranges = running_limits(
        scene, layout, travels ? reach_of(scene, layout) : ArmReach{}, spec.travel_deg || spec.max_hub_load_n, detail);
    if (travels) travel_limits(spec, ranges, limits);
    load_limits(scene, spec, ranges, limits);
  }
  if (spec.modes) mode_limits(scene, spec, layout, limits);
}

}  // namespace beltlife
