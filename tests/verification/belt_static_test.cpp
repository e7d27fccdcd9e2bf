// Owns the verification of the settled drive: tension against tensioner torque, friction band, hub loads.
#include "drives.h"
#include "sim/route/layout.h"

namespace beltlife {
namespace {

using drives::Drive;

// The drive at rest: its arm angle, the path there, the spring's torque, and the mean tension of the belt's elements.
struct Settled {
  Route route;
  double length_per_arm_angle = 0, spring_torque = 0, tension = 0, lowest = 0, highest = 0;
};

Settled measure(const Drive& d) {
  const Model& m = d.model;
  const double angle = d.simulator.state().q.arm_angle;
  Settled s;
  EXPECT_TRUE(make_route(circles_of(m.scene, m.statics.orientation, angle), s.route));
  const auto& c = s.route.circles[m.tensioner.pulley];
  const Vec2 g = length_gradient(s.route, m.tensioner.pulley);
  s.length_per_arm_angle = -(c.y - m.tensioner.pivot_y) * g.x + (c.x - m.tensioner.pivot_x) * g.y;
  s.spring_torque = m.tensioner.spring_torque - m.tensioner.spring_rate * angle;
  s.lowest = 1e300;
  for (int i = 0; i < m.belt.nodes; ++i) {
    const double t = d.work().tension[i];
    s.tension += t / m.belt.nodes;
    s.lowest = std::min(s.lowest, t);
    s.highest = std::max(s.highest, t);
  }
  return s;
}

SceneSpec baseline_at_rest(const char* name) {
  SceneSpec scene = drives::shipped(name);
  scene.belt.elements = 256;
  scene.belt.bending_damping_n_m2_s = 0;  // it limits the step and moves nothing at rest
  scene.range.clear();
  return scene;
}

SceneSpec without_friction(SceneSpec scene) {
  scene.belt.friction_front = scene.belt.friction_back = 0;
  scene.tensioner->friction_torque_n_m = 0;
  scene.tensioner->damping_n_m_s_per_rad = 3;  // brings the arm to rest, wherever that is
  return scene;
}

TEST(BeltStatics, WithoutFrictionTensionSettlesAtSpringTorqueOverLeverArm) {
  for (const char* name : {"baseline", "alternative_1", "alternative_2", "alternative_3"}) {
    Drive d(without_friction(baseline_at_rest(name)));
    d.run_to(0.25);
    EXPECT_LT(std::abs(d.q().arm_rate), 1e-3) << name << " is still moving";
    const Settled s = measure(d);
    const double expected = s.spring_torque / s.length_per_arm_angle;
    drives::report(std::string(name) + " settled tension, N", s.tension, expected);
    // Nodes sink by 0.2 mm, which shortens the lever arm of 70 mm.
    EXPECT_NEAR(s.tension / expected, 1, 0.005) << name;
    // Nothing holds a difference of tension; what swings on is smaller.
    EXPECT_NEAR(s.lowest / expected, 1, 0.01) << name;
    EXPECT_NEAR(s.highest / expected, 1, 0.01) << name;
  }
}

TEST(BeltStatics, SettledHubLoadsAreTwiceTensionTimesTheSineOfHalfTheWrap) {
  Drive d(without_friction(baseline_at_rest("baseline")));
  d.run_to(0.25);
  const Settled s = measure(d);
  for (int p = 0; p < d.model.pulleys; ++p) {
    const double load = std::hypot(d.work().hub_x[p], d.work().hub_y[p]);
    const double expected = 2 * s.tension * std::sin(0.5 * s.route.wrap[p]);
    drives::report("hub load of " + d.model.body_name[p] + ", N", load, expected);
    // Sunk nodes lower a wrap by up to 0.2 mm / 70 mm of span at either end: 0.3 degrees, 3 % of idler_7's 10.
    EXPECT_NEAR(load, expected, 0.005 * expected + 0.004 * s.tension) << d.model.body_name[p];
    const Vec2 pull = length_gradient(s.route, p);
    EXPECT_NEAR(-pull.x * d.work().hub_x[p] - pull.y * d.work().hub_y[p], std::hypot(pull.x, pull.y) * load,
                1e-3 * load);
  }
}

TEST(BeltStatics, WithFrictionTheArmRestsInsideItsFrictionBand) {
  for (const double turned : {-0.15, 0.0, 0.1}) {
    SceneSpec scene = baseline_at_rest("baseline");
    Drive d(scene);
    d.q().arm_angle += turned;
    d.run_to(0.2);
    EXPECT_LT(std::abs(d.q().arm_rate), 0.02) << turned;
    const Settled s = measure(d);
    const double belt_torque = s.tension * s.length_per_arm_angle, friction = scene.tensioner->friction_torque_n_m;
    std::printf("    released %.2f rad off: spring %.3f N m, belt %.3f N m, friction %.2f N m\n", turned,
                s.spring_torque, belt_torque, friction);
    // 0.5 % of the torques as above.
    EXPECT_LT(std::abs(s.spring_torque - belt_torque), friction + 0.005 * std::abs(s.spring_torque)) << turned;
  }
}

}  // namespace
}  // namespace beltlife
