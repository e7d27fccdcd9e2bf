// Solving a drive without running it: see solved_drive.h.
#include "sim/eval/solved_drive.h"

#include <algorithm>
#include <cmath>

#include "sim/range_models.h"

namespace beltlife {

DriveStatics drive_statics(const Model& m) {
  DriveStatics s;
  if (m.pulleys == 0) return s;
  s.take_up = take_up(m);
  const RangeModels models(m);
  std::vector<RangeLoad> loads;
  for (const RangeSpec& range : m.scene.range) {
    const Model& of_range = models.of(range.condition);
    s.ranges.push_back(solve_quasi_static(of_range, range));
    if (!s.ranges.back().error) loads.push_back(estimated_load(of_range, range, s.ranges.back()));
  }
  if (s.ranges.empty()) return s;
  s.estimate = duty_cycle_life(loads, m.scene.fatigue);
  if (loads.size() < s.ranges.size() && !s.estimate.error) {
    s.estimate.error = "not every range has a quasi-static solution";
    s.estimate.life_h = s.estimate.log10_life_h = std::nan("");
  }
  return s;
}

DriveModes drive_modes(const Model& m) {
  DriveModes d;
  if (m.pulleys == 0) return d;
  const RangeModels models(m);
  const Model& base = models.of({});
  for (const RangeSpec& range : m.scene.range) d.points.push_back(solve_modes(models.of(range.condition), range));
  if (d.points.empty()) d.points.push_back(solve_modes(base, {"rest", 0, 0}));
  d.map = campbell(base);
  d.crossings = crossings(d.map, m.scene.range);
  return d;
}

SolvedDrive solve_drive(const Model& m) { return {m, drive_statics(m), drive_modes(m)}; }

bool has_order(const SceneSpec& scene, double order) {
  if (!scene.driver || scene.driver->speed_csv || scene.driver->harmonic.empty()) return true;
  return std::any_of(scene.driver->harmonic.begin(), scene.driver->harmonic.end(),
                     [&](const HarmonicSpec& h) { return h.order == order; });
}

bool can_resonate(const Crossing& c, const SceneSpec& scene) {
  constexpr double damped_away = 0.3;
  return c.near && c.damping_ratio <= damped_away && has_order(scene, c.order);
}

}  // namespace beltlife
