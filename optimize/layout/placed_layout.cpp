// The loop at rest: see placed_layout.h.
#include "optimize/layout/placed_layout.h"

#include <algorithm>
#include <cmath>

#include "sim/route/layout.h"
#include "sim/scene/pitch_line.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

// Both ways round count alike where both or neither can be built and lack the same: then the scene's own.
std::vector<Circle> oriented(const SceneSpec& scene, PlacedLayout& p) {
  std::vector<Circle> circles = circles_of(scene, 1, 0), reverse = circles;
  make_loop_shape(circles, p.shape);
  if (p.shape.can_be_built()) return circles;
  for (Circle& c : reverse) c.turn = -c.turn;
  LoopShape other;
  make_loop_shape(reverse, other);
  if (!other.can_be_built() && other.violation() >= p.shape.violation()) return circles;
  p.orientation = -1;
  p.shape = std::move(other);
  return reverse;
}

ArmOfLayout arm_of(const SceneSpec& scene, const LoopShape& shape, std::vector<Circle> circles) {
  const TensionerSpec& t = *scene.tensioner;
  ArmOfLayout arm;
  arm.circles = std::move(circles);
  for (std::size_t i = 0; i < scene.pulley.size(); ++i)
    if (scene.pulley[i].name == t.pulley) arm.pulley = i;
  arm.pivot = {1e-3 * t.pivot_x_mm, 1e-3 * t.pivot_y_mm};
  arm.stops = arm_stops_of(t, arm.leverage(shape) < 0 ? -1 : 1);
  arm.spring_rate = t.spring_rate_n_m_per_rad;
  return arm;
}

// How far the belt's path lies outside what the arm can reach, at least 1 mm: some distance is missing, or there would
// be a rest.
double missing_belt(const SceneSpec& scene, const PlacedLayout& p) {
  const ArmReach reach = arm_reach(*p.arm, 0);
  const double shortest = std::min(reach.low.length, reach.high.length);
  const double longest = std::max(reach.low.length, reach.high.length);
  const auto length = unstretched_length_mm(scene.belt);
  if (!length) return 1e-3;
  const double path = 1e-3 * *length * (1 + scene.belt.pretension_n.value_or(0) / scene.belt.axial_stiffness_n);
  return std::max({1e-3, path - longest, shortest - path});
}

void search_rest(const SceneSpec& scene, PlacedLayout& p) {
  try {
    const StaticState s = solve_statics(scene);
    p.rest = s.balance.arm_angle;
    p.tension = s.balance.tension;
    p.unstretched_length = s.unstretched_length;
    p.arm->spring_torque = s.placed.length_per_arm_angle > 0 ? s.spring_torque : -s.spring_torque;
    std::vector<Circle> turned;
    p.arm->turn(p.rest, turned);
    make_loop_shape(turned, p.shape);
  } catch (const BadInput&) {
    p.missing = missing_belt(scene, p);
    p.tension = scene.belt.pretension_n.value_or(0);
    p.unstretched_length = p.shape.length / (1 + p.tension / scene.belt.axial_stiffness_n);
  }
}

}  // namespace

bool rests_as_placed(const SceneSpec& scene) {
  return !scene.tensioner || scene.belt.balanced_as_placed.value_or(false);
}

PlacedLayout place_layout(const SceneSpec& scene) {
  PlacedLayout p;
  std::vector<Circle> circles = oriented(scene, p);
  const double ea = scene.belt.axial_stiffness_n;
  if (!scene.tensioner) {
    if (const auto length = unstretched_length_mm(scene.belt)) {
      p.unstretched_length = 1e-3 * *length;
      p.tension = ea * (p.shape.length / p.unstretched_length - 1);
      return p;
    }
  } else {
    p.arm = arm_of(scene, p.shape, std::move(circles));
    if (!rests_as_placed(scene)) {
      search_rest(scene, p);
      return p;
    }
  }
  p.tension = scene.belt.pretension_n.value_or(0);
  if (p.arm) {
    const double leverage = p.arm->leverage(p.shape);
    const auto& torque = scene.tensioner->spring_torque_n_m;
    p.arm->spring_torque = torque ? std::copysign(*torque, leverage) : p.tension * leverage;
    if (torque) p.tension = leverage == 0 ? 0 : *torque / std::abs(leverage);
  }
  p.unstretched_length = p.shape.length / (1 + p.tension / ea);
  return p;
}

}  // namespace beltlife
