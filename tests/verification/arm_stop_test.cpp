// Owns the verification of an arm's stops and of damping by sense: bounce, rest, decrement, loop areas, statics.
#include <gtest/gtest.h>

#include "drives.h"
#include "sim/energy.h"
#include "sim/statics/quasi_static.h"
#include "sim/statics/take_up.h"

namespace beltlife {
namespace {

using drives::pi;
constexpr double degree = pi / 180;

/// The arm without a belt on its pulley, swinging about angle 0 on its spring alone.
struct LoneArm {
  Model model;
  SpeedProfile profile;
  State state;
  Work work;
  std::vector<Kernel> program;

  explicit LoneArm(const std::vector<std::string>& settings)
      : model(compile(read_scene(BELTLIFE_SCENES "/accessory_drive.toml", settings).scene)),
        state(model.initial),
        work(make_work(model)) {
    std::erase_if(program = force_program(model),
                  [](const Kernel& k) { return std::string(k.name).find("arm") == std::string::npos; });
    model.tensioner.spring_torque = 0;
    state.q.arm_angle = 0;
  }

  void step(double h) {
    Coordinates& q = state.q;
    Evaluation e{model, profile, q, state, work, {0, 0, h, true}};
    for (const Kernel& k : program) k.apply(e);
    q.arm_rate += h * work.arm_torque / model.tensioner.inertia;
    q.arm_angle += h * q.arm_rate;
  }
};

/// Runs to the next turning point and returns the arm's angle there.
double next_turn(LoneArm& arm, double h) {
  const double sense = arm.state.q.arm_angle > 0 ? -1 : 1;
  double last = 0;
  do {
    last = arm.state.q.arm_angle;
    arm.step(h);
  } while (sense * arm.state.q.arm_rate > 0);
  return last;
}

TEST(DirectionalTensioner, LosesEachHalfSwingByTheDampingOfItsOwnSense) {
  LoneArm arm({"tensioner.friction_torque_n_m=0", "tensioner.damping_n_m_s_per_rad=0.02",
               "tensioner.damping_shortening_n_m_s_per_rad=0.1"});
  const TensionerModel& t = arm.model.tensioner;
  const double w = std::sqrt(t.spring_rate / t.inertia), h = 1e-4 / w;
  const auto shrinks_by = [&](double damping) {
    const double zeta = damping / (2 * std::sqrt(t.spring_rate * t.inertia));
    return std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta));
  };
  double angle = arm.state.q.arm_angle = 0.2, lost = 0;
  for (int half = 0; half < 6; ++half) {
    const bool shortens = t.lengthening * -angle < 0;  // it swings towards 0 and beyond
    const double closed = shrinks_by(shortens ? 0.1 : 0.02), from = angle;
    angle = next_turn(arm, h);
    drives::report(shortens ? "half swing that shortens" : "half swing that lengthens", -angle / from, closed);
    EXPECT_NEAR(-angle / from / closed, 1, 1e-3);  // symplectic Euler: first order, h w = 1e-4
    lost += 0.5 * t.spring_rate * (from * from - angle * angle);
  }
  // What the spring holds less at each turn is what both dampings took, as a whole.
  EXPECT_NEAR(lost, 0.5 * t.spring_rate * (0.04 - angle * angle), 1e-12);
}

TEST(DirectionalTensioner, LosesTheAreaOfALopsidedFrictionLoop) {
  LoneArm arm({"tensioner.friction_torque_n_m=2", "tensioner.friction_torque_shortening_n_m=6"});
  const TensionerModel& t = arm.model.tensioner;
  constexpr int steps = 100000;
  const double h = 1.0 / steps, amplitude = 0.05;
  double lost = 0, least = 0, most = 0;
  for (int i = 0; i < 2 * steps; ++i) {
    arm.state.q.arm_angle = 0;
    arm.state.q.arm_rate = amplitude * 2 * pi * std::cos(2 * pi * (i + 0.5) * h);
    Evaluation e{arm.model, arm.profile, arm.state.q, arm.state, arm.work, {0, 0, h, true}};
    tensioner_arm_directional(e);
    if (i < steps) continue;
    lost -= h * arm.state.q.arm_rate * arm.work.arm_friction;
    least = std::min(least, t.lengthening * arm.work.arm_friction);
    most = std::max(most, t.lengthening * arm.work.arm_friction);
  }
  EXPECT_DOUBLE_EQ(least, -2);  // against a path that lengthens
  EXPECT_DOUBLE_EQ(most, 6);
  // A parallelogram as high as both torques, as wide as the stroke less what the anchor spring gives way.
  const double area = 8 * (2 * amplitude - 8 / t.friction_stiffness);
  drives::report("loss of a cycle, J", lost, area);
  EXPECT_NEAR(lost / area, 1, 1e-4);  // the torque turns within one step: h w = 6e-5
}

TEST(DirectionalTensioner, EqualToBothWaysIsTheSymmetricOneBitForBit) {
  const auto angle_after = [](const std::vector<std::string>& more) {
    std::vector<std::string> settings{"belt.elements=128", "tensioner.damping_n_m_s_per_rad=0.3"};
    settings.insert(settings.end(), more.begin(), more.end());
    drives::Drive d(read_scene(BELTLIFE_SCENES "/accessory_drive.toml", settings).scene, drives::ramp(100, 0.05));
    d.run_to(0.05);
    return d.q().arm_angle;
  };
  EXPECT_EQ(angle_after({}), angle_after({"tensioner.damping_shortening_n_m_s_per_rad=0.3",
                                          "tensioner.friction_torque_shortening_n_m=3"}));
}

TEST(ArmStop, ThrowsTheArmBackAtTheRateOfItsOwnDamping) {
  LoneArm arm({"tensioner.friction_torque_n_m=0", "tensioner.spring_rate_n_m_per_rad=0",
               "tensioner.stop_lengthening_deg=0.2", "tensioner.stop_shortening_deg=0.2",
               "tensioner.stop_stiffness_n_m_per_rad=20000", "tensioner.stop_damping_n_m_s_per_rad=4"});
  const TensionerModel& t = arm.model.tensioner;
  const double zeta = 4 / (2 * std::sqrt(20000 * t.inertia)), w = std::sqrt(20000 / t.inertia), h = 1e-4 / w;
  // A spring and damper that may not pull lets go when k d + c d' = 0, at the phase acos(2 zeta^2 - 1) of the damped
  // swing: the speed back is exp(-zeta w t) of the one before.
  const double root = std::sqrt(1 - zeta * zeta),
               closed = std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
  double speed = arm.state.q.arm_rate = 3;
  for (int hit = 0; hit < 4; ++hit) {
    while (arm.work.arm_stop_torque == 0) arm.step(h);
    while (arm.work.arm_stop_torque != 0) arm.step(h);
    drives::report("speed after a bounce over speed before", -arm.state.q.arm_rate / speed, closed);
    EXPECT_NEAR(-arm.state.q.arm_rate / speed / closed, 1, 1e-3);  // h w = 1e-4
    speed = arm.state.q.arm_rate;
    EXPECT_LT(std::abs(arm.state.q.arm_angle), 0.2 * degree + 3 / w);
  }
}

SceneSpec held(double lengthening_deg, double shortening_deg) {
  SceneSpec scene = drives::shipped("accessory_drive");
  scene.tensioner->stop_lengthening_deg = lengthening_deg;
  scene.tensioner->stop_shortening_deg = shortening_deg;
  return scene;
}

TEST(ArmStop, HoldsTheArmWhereTheStaticBalanceWouldPassIt) {
  const Model open = compile(drives::shipped("accessory_drive"));
  const double ea = open.belt.axial_stiffness;
  for (const double longer_mm : {8.0, -8.0}) {
    SceneSpec scene = held(3, 3);
    scene.belt.balanced_as_placed.reset();
    scene.belt.unstretched_length_mm = 1e3 * open.statics.unstretched_length + longer_mm;
    const Model m = compile(scene);
    const Layout& rest = m.statics.balance;
    EXPECT_EQ(rest.stop, longer_mm > 0 ? ArmStop::lengthening : ArmStop::shortening);
    const double stop = m.tensioner.lengthening * (longer_mm > 0 ? 3 : -3) * degree;
    // The tension is that of the belt stretched over the path at the stop; the arm turns into it by what remains of
    // its torque over the stop's stiffness.
    Route route;
    ASSERT_TRUE(make_route(circles_of(scene, m.statics.orientation, rest.arm_angle), route));
    EXPECT_NEAR(rest.tension, ea * (route.length / m.statics.unstretched_length - 1), 1e-6);
    const double left =
        m.tensioner.spring_torque - m.tensioner.spring_rate * rest.arm_angle - rest.tension * rest.length_per_arm_angle;
    EXPECT_NEAR(rest.arm_angle - stop, left / m.tensioner.stops.stiffness, 1e-9);
    const double at_stop = [&] {
      EXPECT_TRUE(make_route(circles_of(scene, m.statics.orientation, stop), route));
      return ea * (route.length / m.statics.unstretched_length - 1);
    }();
    drives::report("tension at rest, N, beside that of a rigid stop", rest.tension, at_stop);
    // The stop gives way by 24 N m over 3e4, 8e-4 rad; a radian is 64 mm of path and a millimetre 64 N.
    EXPECT_NEAR(rest.tension, at_stop, 3.5);
  }
}

TEST(ArmStop, HoldsARunningArmWhereItsStaticsSay) {
  // The same drive in time, without friction, damped: at rest on the stop, then running.
  SceneSpec scene = held(0.5, 3);
  scene.belt.elements = 256;
  scene.belt.balanced_as_placed.reset();
  scene.belt.unstretched_length_mm = 1e3 * compile(drives::shipped("accessory_drive")).statics.unstretched_length + 1.5;
  scene.tensioner->friction_torque_n_m = 0;
  for (TorqueSpec& t : scene.torque)  // a fixed arm does not keep the slack span tight: a quarter of the loads
    for (double& x : t.torques_n_m) x *= 0.25;
  scene.driver->ripple_scale = 0;
  scene.profile = {.settle_s = 0.1, .ramp_s = 0.2, .hold_s = 0.3, .transition_s = 0.2, .evaluate_s = 0.15};
  const Model m = compile(scene);
  ASSERT_EQ(m.statics.balance.stop, ArmStop::lengthening);
  const QuasiStaticRange q = solve_quasi_static(m, scene.range[1]);
  ASSERT_FALSE(q.error) << *q.error;
  EXPECT_EQ(q.arm_stop, ArmStop::lengthening);
  EXPECT_EQ(q.remarks.at(0), "the arm rests on its lengthening stop");
  const RunRecord record = run(m, plan_range(scene, scene.range[1])).record;
  ASSERT_TRUE(record.status.ok()) << record.status.cause;
  drives::Mean angle, torque;
  const auto& window = record.windows[0];
  for (std::size_t i = window.first_sample; i < window.last_sample; ++i) {
    angle.add(record.trace.find("tensioner.arm_angle_rad")->values[i]);
    torque.add(record.trace.find("tensioner.stop_torque_n_m")->values[i]);
  }
  drives::report("arm angle, rad", angle.value(), *q.arm_angle);
  EXPECT_NEAR(angle.value(), *q.arm_angle, 2e-5);
  drives::report("torque of the stop, N m", torque.value(), m.tensioner.stops.elastic_torque(*q.arm_angle));
  EXPECT_NEAR(torque.value(), m.tensioner.stops.elastic_torque(*q.arm_angle), 0.4);  // 2 % of the belt's torque
  EXPECT_LT(std::abs(window.energy.relative_residual()), 5e-3);
}

TEST(ArmStop, EndsTheTakeUp) {
  const Model open = compile(drives::shipped("accessory_drive")), m = compile(held(10, 6));
  const auto rows = take_up(m);
  ASSERT_EQ(rows.size(), 4u);
  for (const TakeUpRow* row : {&rows.front(), &rows.back()}) {
    EXPECT_EQ(row->reason, "the arm meets its stop");
    EXPECT_NEAR(std::abs(row->arm_angle), (row == &rows.front() ? 10 : 6) * degree, 1e-12);
  }
  EXPECT_LT(rows.front().path_length, take_up(open).front().path_length);
  EXPECT_GT(rows.back().path_length, take_up(open).back().path_length);
}

TEST(ArmStop, BoundsTheStableStep) {
  SceneSpec scene = held(10, 6);
  scene.tensioner->stop_stiffness_n_m_per_rad = 1e9;
  scene.tensioner->stop_damping_n_m_s_per_rad = 0;
  const Model m = compile(scene);
  for (const StepLimit& limit : step_limits(m, Scheme::thesis))
    if (limit.name == "tensioner arm on a stop") {
      // Beside the stop's 1e9 the friction anchor's 3e4 is 3e-5.
      EXPECT_NEAR(limit.limit_s / (2 / std::sqrt(1e9 / m.tensioner.inertia)), 1, 2e-5);
      return;
    }
  FAIL() << "no such limit";
}

}  // namespace
}  // namespace beltlife
