// The tensioner arm in the implicit scheme, without a belt: swing, damping by sense, friction that sticks, stops.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/lanes/implicit_train.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;

/// The arm swinging about angle 0 on its spring alone: angle at t_n, rate half a step earlier.
struct LoneArm {
  LoneArm(const std::vector<std::string>& settings, double step, double spring_torque = 0)
      : model(model_of(settings, spring_torque)), state(model.initial), train(model, profile, step), h(step) {
    state.q.arm_angle = 0;
  }
  LoneArm(const LoneArm&) = delete;
  LoneArm& operator=(const LoneArm&) = delete;

  static Model model_of(const std::vector<std::string>& settings, double spring_torque) {
    Model m = compile(read_scene(BELTLIFE_SCENES "/accessory_drive.toml", settings).scene);
    m.tensioner.spring_torque = spring_torque;
    m.torques.clear();
    return m;
  }
  void step() {
    train.expect(state, 0);
    const std::vector<double> none(static_cast<std::size_t>(model.pulleys), 0.0);
    train.advance(state, 0, none.data(), none.data(), none.data());
  }
  double angle() const { return state.q.arm_angle; }
  double rate() const { return state.q.arm_rate; }

  Model model;
  SpeedProfile profile;
  State state;
  ImplicitTrain train;
  double h;
};

/// Runs to the next turning point: the top of the parabola through the three angles around it.
double next_turn(LoneArm& arm) {
  const double sense = arm.angle() > 0 ? -1 : 1;
  double before = 0, last = arm.angle();
  do {
    before = last;
    last = arm.angle();
    arm.step();
  } while (sense * arm.rate() > 0);
  const double now = arm.angle(), bend = 2 * last - before - now, slope = now - before;
  return last + 0.125 * slope * slope / bend;
}

TEST(ImplicitArm, SwingsAtItsFrequencyToSecondOrder) {
  std::vector<double> errors;
  for (const double h : {2e-4, 1e-4, 5e-5}) {
    LoneArm arm({"tensioner.friction_torque_n_m=0", "tensioner.damping_n_m_s_per_rad=0"}, h);
    const TensionerModel& t = arm.model.tensioner;
    const double w = std::sqrt(t.spring_rate / t.inertia);
    arm.state.q.arm_angle = 0.2;
    arm.state.q.arm_rate = 0.2 * w * std::sin(0.5 * w * h);  // half a step before it turns
    double worst = 0;
    for (int i = 1; i * h < 0.2; ++i) {
      arm.step();
      worst = std::max(worst, std::abs(arm.angle() - 0.2 * std::cos(w * i * h)));
    }
    errors.push_back(worst);
    // The implicit swing is slow by (h w)^2/12 and starts off by its square.
    EXPECT_NEAR(worst, 0.2 * w * 0.2 * h * h * w * w / 12, 0.3 * 0.2 * w * 0.2 * h * h * w * w / 12);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05);  // h w = 0.03
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
}

TEST(ImplicitArm, LosesEachHalfSwingByTheDampingOfItsOwnSense) {
  LoneArm arm({"tensioner.friction_torque_n_m=0", "tensioner.damping_n_m_s_per_rad=0.02",
               "tensioner.damping_shortening_n_m_s_per_rad=0.1"},
              2e-5);
  const TensionerModel& t = arm.model.tensioner;
  const auto shrinks_by = [&](double damping) {
    const double zeta = damping / (2 * std::sqrt(t.spring_rate * t.inertia));
    return std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta));
  };
  double angle = arm.state.q.arm_angle = 0.2;
  for (int half = 0; half < 6; ++half) {
    const bool shortens = t.lengthening * -angle < 0;
    const double from = angle;
    angle = next_turn(arm);
    // The step in which it turns takes the other sense's damping: first order there, h w = 3e-3 of the loss. The first
    // half swing also begins half a step into it.
    EXPECT_NEAR(-angle / from / shrinks_by(shortens ? 0.1 : 0.02), 1, 1e-4) << half;
  }
}

TEST(ImplicitArm, SticksBelowItsFrictionAndSlidesAboveIt) {
  const double h = 2e-5;
  for (const double load : {1.5, -1.5}) {  // of 3 N m; a sudden load swings to twice itself and just does not slide
    LoneArm arm({"tensioner.friction_torque_n_m=3.3", "tensioner.damping_n_m_s_per_rad=0.3",
                 "tensioner.spring_rate_n_m_per_rad=0"},
                h, load);
    const double k = arm.model.tensioner.friction_stiffness;
    for (int i = 0; i < 20000; ++i) {
      arm.step();
      ASSERT_LE(std::abs(arm.angle()), 3.3 / k);
    }
    // At rest on its anchor spring, and it stays there.
    EXPECT_NEAR(arm.angle(), load / k, 1e-6 * std::abs(load) / k);
    EXPECT_NEAR(arm.state.arm_anchor, load / k, 1e-6 * std::abs(load) / k);
    const double still = arm.angle();
    for (int i = 0; i < 50000; ++i) arm.step();
    EXPECT_NEAR(arm.angle(), still, 1e-12);
  }
  LoneArm arm(
      {"tensioner.friction_torque_n_m=3", "tensioner.damping_n_m_s_per_rad=0", "tensioner.spring_rate_n_m_per_rad=0"},
      h, 4.5);
  for (int i = 0; i < 500; ++i) arm.step();
  // (4.5 - 3)/J once the anchor slides; the anchor spring is passed within sqrt(J/k) = 3e-4 s of 0.01.
  EXPECT_NEAR(arm.rate() / (1.5 / arm.model.tensioner.inertia * 0.01), 1, 0.06);
  EXPECT_NEAR(arm.state.arm_anchor, 3 / arm.model.tensioner.friction_stiffness, 1e-12);
}

TEST(ImplicitArm, SlidesAgainstTheFrictionOfItsOwnSense) {
  for (const double load : {9.0, -9.0}) {
    LoneArm arm({"tensioner.friction_torque_n_m=2", "tensioner.friction_torque_shortening_n_m=6",
                 "tensioner.damping_n_m_s_per_rad=0", "tensioner.spring_rate_n_m_per_rad=0"},
                2e-5, load);
    const TensionerModel& t = arm.model.tensioner;
    const double friction = t.lengthening * load > 0 ? 2 : 6;
    for (int i = 0; i < 100; ++i) arm.step();
    const double from = arm.rate();
    for (int i = 0; i < 100; ++i) arm.step();
    EXPECT_NEAR((arm.rate() - from) / 2e-3, (load > 0 ? 1 : -1) * (9 - friction) / t.inertia, 1e-6 / t.inertia);
  }
}

TEST(ImplicitArm, AStopThrowsItBackAtTheRateOfItsOwnDampingAndNeverPulls) {
  for (const double damping : {0.0, 4.0}) {
    const double h = 2e-5;
    LoneArm arm({"tensioner.friction_torque_n_m=0", "tensioner.spring_rate_n_m_per_rad=0",
                 "tensioner.damping_n_m_s_per_rad=0", "tensioner.stop_lengthening_deg=0.2",
                 "tensioner.stop_shortening_deg=0.2", "tensioner.stop_stiffness_n_m_per_rad=20000",
                 "tensioner.stop_damping_n_m_s_per_rad=" + std::to_string(damping)},
                h);
    const TensionerModel& t = arm.model.tensioner;
    const double zeta = damping / (2 * std::sqrt(20000 * t.inertia)), w = std::sqrt(20000 / t.inertia);
    const double root = std::sqrt(1 - zeta * zeta);
    const double closed = zeta == 0 ? 1 : std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
    double speed = arm.state.q.arm_rate = 3;
    for (int hit = 0; hit < 6; ++hit) {
      const double sense = arm.rate() > 0 ? 1 : -1;
      while (std::abs(arm.angle()) < 0.2 * degree || sense * arm.rate() > 0) {
        const double before = arm.rate();
        arm.step();
        ASSERT_LE(sense * (arm.rate() - before), 1e-12);  // it pushes back or not at all
      }
      while (std::abs(arm.angle()) > 0.2 * degree) arm.step();
      const double back = std::abs(arm.rate());
      std::printf("    c %g: speed back over speed before %.5f, closed form %.5f\n", damping, back / speed, closed);
      // A stop met within a step of h w = 0.1 takes hold up to a step late and lets go up to a step early: (h w)^2/2 of
      // the energy either way, and of the damper's push, which jumps, 2 zeta h w.
      EXPECT_NEAR(back / speed, closed, 0.5 * h * h * w * w + 2 * zeta * h * w) << hit;
      speed = back;
      arm.step();
    }
  }
}

}  // namespace
}  // namespace beltlife
