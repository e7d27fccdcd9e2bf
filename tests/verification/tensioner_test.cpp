// Owns the verification of the tensioner: dry friction's loop, sticking and sliding, damping, the spring's sense.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/scene/scene_io.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

Model baseline(const std::vector<std::string>& settings = {}) {
  return compile(read_scene(BELTLIFE_SCENES "/baseline.toml", settings).scene);
}

/// The arm alone, without a belt on its pulley: the test moves or integrates it.
struct Arm {
  const Model& model;
  SpeedProfile profile;
  State state;
  Work work;

  explicit Arm(const Model& m) : model(m), state(m.initial), work(make_work(m)) {}

  /// Evaluates at this angle and rate, the anchor following the rate for `seconds`.
  double torque(double angle, double rate, double seconds = 0) {
    state.q.arm_angle = angle;
    state.q.arm_rate = rate;
    Evaluation e{model, profile, state.q, state, work, {0, 0, seconds, true}};
    tensioner_arm(e);
    return work.arm_torque;
  }

  /// Lets the arm go for `seconds` in steps of h.
  void run(double seconds, double h) {
    double angle = state.q.arm_angle, rate = state.q.arm_rate;
    for (int i = 0, n = static_cast<int>(std::lround(seconds / h)); i < n; ++i) {
      rate += h * torque(angle, rate, h) / model.tensioner.inertia;
      angle += h * rate;
    }
    state.q.arm_angle = angle;
    state.q.arm_rate = rate;
  }
};

TEST(TensionerFriction, LosesTheAreaOfItsLoopEveryCycle) {
  const Model model = baseline();
  const double t_f = model.tensioner.friction_torque, anchor = model.tensioner.friction_stiffness;
  for (const double amplitude : {0.002, 0.02, 0.1}) {
    Arm arm(model);
    constexpr int steps = 100000;
    const double h = 1.0 / steps, omega = 2 * std::numbers::pi;
    double lost = 0;
    for (int i = 0; i < 2 * steps; ++i) {  // the first cycle closes the loop, the second is measured
      const double rate = amplitude * omega * std::cos(omega * (i + 0.5) * h);
      arm.torque(0, rate, h);
      if (i >= steps) lost -= h * rate * arm.work.arm_friction;
    }
    // Four times torque x amplitude, less what the anchor spring takes up at each reversal. The torque turns within
    // the one step in which the anchor begins to slide: h w = 6e-5.
    EXPECT_NEAR(lost / (4 * t_f * (amplitude - t_f / anchor)), 1, 1e-4) << amplitude;
  }
}

TEST(TensionerFriction, LosesNothingWhileTheArmOnlyTwistsItsAnchor) {
  const Model model = baseline();
  const double t_f = model.tensioner.friction_torque, anchor = model.tensioner.friction_stiffness;
  Arm arm(model);
  constexpr int steps = 100000;
  const double h = 1.0 / steps, omega = 2 * std::numbers::pi, amplitude = 0.9 * t_f / anchor;
  double lost = 0;
  for (int i = 0; i < steps; ++i) {
    const double rate = amplitude * omega * std::cos(omega * (i + 0.5) * h);
    arm.torque(0, rate, h);
    lost -= h * rate * arm.work.arm_friction;
  }
  EXPECT_NEAR(lost / (t_f * amplitude), 0, 2e-4);  // the sum takes the torque at the end of each step: h w
}

TEST(TensionerFriction, HoldsAnArmOnItsBeltThatIsLoadedBelowIt) {
  const Model model = baseline({"belt.elements=256"});
  const double t_f = model.tensioner.friction_torque;
  const SpeedProfile rest;
  for (const double load : {-0.8, 0.8}) {
    // A belt of chords that sinks into its pulleys is a little slacker than the static balance: a damped arm without
    // friction finds its place first. Then friction takes hold and the load grows, smoothly, for a sudden one of 0.8
    // would swing to 1.6 and slide.
    Model loaded = model;
    loaded.tensioner.friction_torque = 0;
    loaded.tensioner.damping = 3;
    Simulator s(loaded, rest, Scheme::thesis, 9e-7);
    while (s.time() < 0.15) s.advance();
    loaded.tensioner.friction_torque = t_f;
    loaded.tensioner.damping = 0;
    const double start = s.state().q.arm_angle;
    while (s.time() < 0.25) {
      const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * (s.time() - 0.15) / 0.1);
      loaded.tensioner.spring_torque = model.tensioner.spring_torque + load * t_f * share;
      s.advance();
    }
    const auto mean_angle = [&](double until) {
      double sum = 0;
      int n = 0;
      for (; s.time() < until; ++n) {
        s.advance();
        sum += s.state().q.arm_angle;
      }
      return sum / n;
    };
    const double first = mean_angle(0.35), second = mean_angle(0.45);
    EXPECT_LT(std::abs(second - first) / 0.1, 1e-6) << load;  // rad/s
    // The anchor spring gives way no further than the whole friction torque twists it.
    EXPECT_LT(std::abs(second - start), t_f / model.tensioner.friction_stiffness) << load;
    EXPECT_LT(std::abs(s.state().arm_anchor), t_f / model.tensioner.friction_stiffness) << load;
  }
}

TEST(TensionerFriction, LetsAnArmOnItsBeltSlideThatIsLoadedAboveIt) {
  const Model model = baseline({"belt.elements=256"});
  const double t_f = model.tensioner.friction_torque;
  Model loaded = model;
  loaded.tensioner.spring_torque += 2 * t_f;
  const SpeedProfile rest;
  Simulator s(loaded, rest, Scheme::symplectic_euler, 9e-7);
  while (s.time() < 0.1) s.advance();
  const double moved = std::abs(s.state().q.arm_angle - model.initial.q.arm_angle);
  EXPECT_GT(moved, 10 * t_f / model.tensioner.friction_stiffness);
}

TEST(TensionerFriction, LeavesTheExcessToAccelerateAFreeArm) {
  Model model = baseline({"tensioner.spring_rate_n_m_per_rad=0", "belt.unstretched_length_mm=2600"});
  const double t_f = model.tensioner.friction_torque, load = 1.5 * t_f;
  model.tensioner.spring_torque = load;
  Arm arm(model);
  const double h = 1e-6, start = arm.state.q.arm_angle;
  arm.run(0.05, h);
  // load - t_f once the anchor slides; until then the anchor spring is softer: 1.5 t_f / anchor and 4e-4 s early.
  const double acceleration = (load - t_f) / model.tensioner.inertia;
  EXPECT_NEAR(arm.state.q.arm_rate, acceleration * 0.05, 0.05 * acceleration * 0.05);
  EXPECT_GT(std::abs(arm.state.q.arm_angle - start), 0.1);
  EXPECT_EQ(arm.work.arm_friction, -t_f);
}

TEST(TensionerDamping, SlowsAFreeArmExponentially) {
  Model model = baseline({"tensioner.friction_torque_n_m=0", "tensioner.damping_n_m_s_per_rad=0.5"});
  model.tensioner.spring_torque = model.tensioner.spring_rate = 0;
  Arm arm(model);
  arm.state.q.arm_rate = 2;
  const double h = 1e-6, rate = 0.5 / model.tensioner.inertia;
  arm.run(0.05, h);
  EXPECT_NEAR(arm.state.q.arm_rate / (2 * std::exp(-rate * 0.05)), 1, h * rate * rate * 0.05);  // first order in h
  EXPECT_EQ(arm.work.arm_friction, 0);
}

class TensionerSpring : public testing::TestWithParam<const char*> {};

TEST_P(TensionerSpring, TightensTheBeltAndMoreSoWhereThePathIsShorter) {
  const SceneSpec scene = read_scene(std::string(BELTLIFE_SCENES "/") + GetParam() + ".toml").scene;
  const Model model = compile(scene);
  const auto length_at = [&](double angle) {
    Route route;
    EXPECT_TRUE(make_route(circles_of(scene, model.statics.orientation, angle), route));
    return route.length;
  };
  constexpr double turn = 0.01;
  const double lengthening = length_at(turn) > length_at(-turn) ? 1 : -1;
  Arm arm(model);
  const auto torque = [&](double angle) { return lengthening * arm.torque(angle, 0); };
  EXPECT_NEAR(torque(0), *scene.tensioner->spring_torque_n_m, 1e-12);
  EXPECT_NEAR(torque(-lengthening * turn),
              *scene.tensioner->spring_torque_n_m + turn * scene.tensioner->spring_rate_n_m_per_rad, 1e-12);
}

TEST_P(TensionerSpring, BalancesTheBeltAtRest) {
  const SceneSpec scene = read_scene(std::string(BELTLIFE_SCENES "/") + GetParam() + ".toml").scene;
  const Model model = compile(scene);
  const auto length_at = [&](double angle) {
    Route route;
    EXPECT_TRUE(make_route(circles_of(scene, model.statics.orientation, angle), route));
    return route.length;
  };
  constexpr double turn = 1e-4;
  const double angle = model.initial.q.arm_angle;
  const double lever = (length_at(angle + turn) - length_at(angle - turn)) / (2 * turn);
  Arm arm(model);
  // Virtual work; the central difference errs by turn^2 of the lever, 1e-8.
  EXPECT_NEAR(arm.torque(angle, 0), model.statics.balance.tension * lever, 1e-6 * std::abs(arm.torque(angle, 0)));
}

INSTANTIATE_TEST_SUITE_P(OnEveryLayout, TensionerSpring,
                         testing::Values("baseline", "alternative_1", "alternative_2", "alternative_3"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace beltlife
