// A drive stated for varying its layout: see layout_base.h.
#include "optimize/layout/layout_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/route/layout.h"
#include "sim/scene/pulley_place.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

[[noreturn]] void refuse(std::string key, std::string what, std::string allowed) {
  throw BadInput({Problem{"scene", 0, std::move(key), std::move(what), std::move(allowed)}});
}

// Turns the placed arm to where it rests.
void place_at_rest(SceneSpec& scene, const StaticState& s) {
  TensionerSpec& t = *scene.tensioner;
  const double angle = s.balance.arm_angle;
  const double degrees = angle / (std::numbers::pi / 180);
  if (t.arm_angle_deg) *t.arm_angle_deg += degrees;
  for (std::size_t i = 0; i < scene.pulley.size(); ++i) {
    PulleySpec& p = scene.pulley[i];
    if (p.name != t.pulley || angle == 0) continue;
    const Circle& at_rest = s.balance.route.circles[i];
    p.x_mm = 1e3 * at_rest.x;
    p.y_mm = 1e3 * at_rest.y;
  }
  // The sense that lengthens the path may be another where the arm rests.
  const double before = s.placed.length_per_arm_angle, after = s.balance.length_per_arm_angle;
  const double toward_lengthening = before > 0 ? degrees : -degrees;
  if (t.stop_lengthening_deg) t.stop_lengthening_deg = std::max(*t.stop_lengthening_deg - toward_lengthening, 0.0);
  if (t.stop_shortening_deg) t.stop_shortening_deg = std::max(*t.stop_shortening_deg + toward_lengthening, 0.0);
  if (before * after < 0) std::swap(t.stop_lengthening_deg, t.stop_shortening_deg);
}

}  // namespace

SceneSpec layout_base(const SceneSpec& scene) {
  const StaticState s = solve_statics(scene);
  if (!(s.balance.tension > 0))
    refuse("belt", fmt::format("the belt carries {:g} N at rest", s.balance.tension), "a belt that is tight at rest");
  if (s.balance.stop != ArmStop::none)
    refuse(std::string("tensioner.stop_") +
               (s.balance.stop == ArmStop::lengthening ? "lengthening_deg" : "shortening_deg"),
           "the arm rests on this stop, so that the spring alone does not hold the belt's tension",
           "a belt with which the arm rests between its stops");
  SceneSpec base = scene;
  base.belt.unstretched_length_mm.reset();
  base.belt.effective_length_mm.reset();
  base.belt.measuring_tension_n.reset();
  base.belt.length_catalogue_mm.reset();
  base.belt.balanced_as_placed.reset();
  base.belt.pretension_n = s.balance.tension;
  if (!base.tensioner) return base;
  base.belt.balanced_as_placed = true;
  base.tensioner->spring_torque_n_m.reset();
  place_at_rest(base, s);
  return base;
}

}  // namespace beltlife
