// Owns the verification of the settled drive: tension against tensioner torque, friction band, hub loads.
#include <vector>

#include "drives.h"
#include "sim/route/layout.h"

namespace beltlife {
namespace {

using drives::Drive;

// Means over the end of a run at rest. The spans swing on undamped, so a single instant would not do.
struct Settled {
  Route route;  ///< at the mean arm angle
  double length_per_arm_angle = 0, spring_torque = 0;
  std::vector<drives::Mean> tension, hub_x, hub_y;  ///< elements; pulleys
  double mean_tension = 0, arm_travel = 0;
};

Settled settle(Drive& d, double from, double to) {
  const Model& m = d.model;
  Settled s;
  s.tension.resize(m.belt.nodes);
  s.hub_x.resize(m.pulleys);
  s.hub_y.resize(m.pulleys);
  drives::Mean angle;
  d.run_to(from);
  double low = 1e300, high = -1e300;
  d.run_to(to, 8, [&] {
    angle.add(d.q().arm_angle);
    low = std::min(low, d.q().arm_angle);
    high = std::max(high, d.q().arm_angle);
    for (int i = 0; i < m.belt.nodes; ++i) s.tension[i].add(d.work().tension[i]);
    for (int p = 0; p < m.pulleys; ++p) {
      s.hub_x[p].add(d.work().hub_x[p]);
      s.hub_y[p].add(d.work().hub_y[p]);
    }
  });
  s.arm_travel = high - low;
  for (const drives::Mean& t : s.tension) s.mean_tension += t.value() / m.belt.nodes;
  EXPECT_TRUE(make_route(circles_of(m.scene, m.statics.orientation, angle.value()), s.route));
  const auto& c = s.route.circles[m.tensioner.pulley];
  const Vec2 g = length_gradient(s.route, m.tensioner.pulley);
  s.length_per_arm_angle = -(c.y - m.tensioner.pivot_y) * g.x + (c.x - m.tensioner.pivot_x) * g.y;
  s.spring_torque = m.tensioner.spring_torque - m.tensioner.spring_rate * angle.value();
  return s;
}

SceneSpec at_rest(const char* name) {
  SceneSpec scene = drives::shipped(name);
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
    Drive d(without_friction(at_rest(name)));
    const Settled s = settle(d, 0.1, 0.25);
    const double expected = s.spring_torque / s.length_per_arm_angle;
    drives::report(std::string(name) + " settled tension, N", s.mean_tension, expected);
    // Nodes sink by 0.1 mm and chords cut arcs by as much: a lever arm of 70 mm is that uncertain.
    EXPECT_NEAR(s.mean_tension / expected, 1, 0.005) << name;
    // Nothing holds a difference of tension along the belt.
    for (const drives::Mean& t : s.tension) ASSERT_NEAR(t.value() / expected, 1, 0.01) << name;
  }
}

TEST(BeltStatics, SettledHubLoadsAreTwiceTensionTimesTheSineOfHalfTheWrap) {
  Drive d(without_friction(at_rest("baseline")));
  const Settled s = settle(d, 0.1, 0.25);
  for (int p = 0; p < d.model.pulleys; ++p) {
    const double x = s.hub_x[p].value(), y = s.hub_y[p].value(), load = std::hypot(x, y);
    const double expected = 2 * s.mean_tension * std::sin(0.5 * s.route.wrap[p]);
    drives::report("hub load of " + d.model.body_name[p] + ", N", load, expected);
    // Where nodes sink and chords cut, a tangent turns by up to 0.15 mm over the 75 mm of the shortest span: 0.2 % of
    // T.
    EXPECT_NEAR(load, expected, 0.005 * expected + 0.002 * s.mean_tension) << d.model.body_name[p];
    const Vec2 pull = length_gradient(s.route, p);  // the hub load points against it, by the same uncertainty
    EXPECT_NEAR(-(pull.x * x + pull.y * y) / (std::hypot(pull.x, pull.y) * load), 1, 1e-3) << d.model.body_name[p];
  }
}

TEST(BeltStatics, WithFrictionTheArmSticksInsideItsFrictionBand) {
  for (const double turned : {-0.1, 0.0, 0.1}) {
    SceneSpec scene = at_rest("baseline");
    scene.belt.elements = 256;
    scene.belt.friction_front = scene.belt.friction_back = 0;
    Drive d(scene);
    d.q().arm_angle += turned;  // the belt is then 8 mm too tight or too slack
    const Settled s = settle(d, 0.4, 0.5);
    const double belt_torque = s.mean_tension * s.length_per_arm_angle, friction = scene.tensioner->friction_torque_n_m;
    std::printf("    released %.2f rad off: spring %.3f N m, belt %.3f N m, friction %.2f N m, arm moves %.1e rad\n",
                turned, s.spring_torque, belt_torque, friction, s.arm_travel);
    EXPECT_LT(std::abs(s.spring_torque - belt_torque), friction + 0.005 * s.spring_torque);  // 0.5 % as above
    // Stuck, it turns by what its anchor spring of 3e4 N m/rad gives, 1e-4 rad to either side, and creeps while the
    // spans still swing; free, it would swing by 0.1 rad.
    EXPECT_LT(s.arm_travel, 1e-3);
  }
}

}  // namespace
}  // namespace beltlife
