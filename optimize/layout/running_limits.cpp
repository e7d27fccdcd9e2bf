// Quasi-static limits: see running_limits.h.
#include "optimize/layout/running_limits.h"

#include <algorithm>

#include "sim/range_models.h"
#include "sim/scene/scene_io.h"
#include "sim/statics/quasi_static.h"

namespace beltlife {
namespace {

SceneSpec with_detail(SceneSpec scene, bool friction_band, RunningDetail detail) {
  if (detail == RunningDetail::without_bending_loss) scene.belt.bending_damping_n_m2_s = 0;
  // The friction at the arm makes the band alone, and is not looked at elsewhere.
  if (!friction_band && scene.tensioner) {
    scene.tensioner->friction_torque_n_m = 0;
    scene.tensioner->friction_torque_shortening_n_m.reset();
  }
  return scene;
}

}  // namespace

std::vector<RunningLimits> running_limits(const SceneSpec& scene, const PlacedLayout& layout, const ArmReach& reach,
                                          bool friction_band, RunningDetail detail) {
  constexpr double most_safety = 100;
  std::vector<RunningLimits> all(scene.range.size());
  if (!layout.shape.can_be_built() || layout.missing > 0) return all;
  try {
    const Model drive = compile(with_detail(scene, friction_band, detail));
    const RangeModels models(drive);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const RangeSpec& range = scene.range[i];
      const auto same = std::find_if(
          scene.range.begin(), scene.range.begin() + static_cast<std::ptrdiff_t>(i),
          [&](const RangeSpec& r) { return r.crank_rpm == range.crank_rpm && r.condition == range.condition; });
      if (const auto k = static_cast<std::size_t>(same - scene.range.begin()); k < i) {
        all[i] = all[k];
        continue;
      }
      const Model& model = models.of(range.condition);
      const QuasiStaticRange q = solve_quasi_static(model, range);
      RunningLimits& out = all[i];
      out.solved = !q.error;
      if (!out.solved) continue;
      if (q.arm_angle_low && layout.arm) {
        const double low = *q.arm_angle_low - reach.low.angle, high = reach.high.angle - *q.arm_angle_high;
        out.lengthening = model.tensioner.lengthening > 0 ? high : low;
        out.shortening = model.tensioner.lengthening > 0 ? low : high;
      }
      out.slip_safety = most_safety;
      for (const QuasiStaticPulley& p : q.pulleys) {
        if (p.slip_safety && p.speed > 0) out.slip_safety = std::min(out.slip_safety, *p.slip_safety);
        out.hub_load = std::max(out.hub_load, p.hub_load_high);
      }
    }
  } catch (const BadInput&) {
    // A layout that compile() refuses for a reason of its own is one that cannot run.
    return std::vector<RunningLimits>(scene.range.size());
  }
  return all;
}

}  // namespace beltlife
