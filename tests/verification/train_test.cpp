// Owns the verification of the drive train: torsional chain, damping, gear rattle, torque tables, controlled driver.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "sim/scene/scene_io.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

constexpr double rpm = 30 / std::numbers::pi;

// A belt that touches nothing, so that only the bodies move.
const std::string free_belt = R"(format = 1
rotation = "counterclockwise"
[belt]
elements = 48
unstretched_length_mm = 1000
axial_stiffness_n = 1000
mass_kg_per_m = 0.1
ribs = 6
friction_front = 0.6
friction_back = 0.6
[ring]
speed_rad_s = 0
)";

std::string bodies(const std::vector<double>& inertias) {
  std::string text;
  for (std::size_t i = 0; i < inertias.size(); ++i)
    text += "[[body]]\nname = \"b" + std::to_string(i) + "\"\ninertia_kg_m2 = " + std::to_string(inertias[i]) + "\n";
  return text;
}

std::string spring(int from, double stiffness, double damping = 0) {
  return "[[torsional_spring]]\nname = \"s" + std::to_string(from) + "\"\nfrom = \"b" + std::to_string(from) +
         "\"\nto = \"b" + std::to_string(from + 1) + "\"\nstiffness_n_m_per_rad = " + std::to_string(stiffness) +
         "\ndamping_n_m_s_per_rad = " + std::to_string(damping) + "\n";
}

class TorsionalChain : public testing::TestWithParam<Scheme> {};

TEST_P(TorsionalChain, VibratesInItsModesAtItsEigenfrequencies) {
  const Eigen::Vector4d inertia(2e-3, 5e-4, 1e-3, 4e-3);
  const Eigen::Vector3d stiffness(100, 400, 50);
  Eigen::Matrix4d mass = inertia.asDiagonal(), k = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 3; ++i) {
    k(i, i) += stiffness[i];
    k(i + 1, i + 1) += stiffness[i];
    k(i, i + 1) -= stiffness[i];
    k(i + 1, i) -= stiffness[i];
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> modes(k, mass);
  const Model model = compile(parse_scene(
      free_belt + bodies({2e-3, 5e-4, 1e-3, 4e-3}) + spring(0, 100) + spring(1, 400) + spring(2, 50), "chain"));
  const double h = 2e-6;
  for (int mode = 1; mode < 4; ++mode) {  // mode 0 is the free rotation
    const SpeedProfile rest;
    Simulator s(model, rest, GetParam(), h);
    const Eigen::Vector4d shape = modes.eigenvectors().col(mode);
    for (int b = 0; b < 4; ++b) s.state().q.angle[b] = 1e-3 * shape[b];
    const auto coordinate = [&] {
      return shape.dot(mass * Eigen::Map<const Eigen::Vector4d>(s.state().q.angle.data()));
    };
    std::vector<double> crossings;
    double before = coordinate(), others = 0;
    while (crossings.size() < 21) {
      s.advance();
      const double now = coordinate();
      if ((now < 0) != (before < 0)) crossings.push_back(s.time() - h * now / (now - before));
      before = now;
      for (int other = 0; other < 4; ++other)
        if (other != mode)
          others = std::max(others, std::abs(modes.eigenvectors().col(other).dot(
                                        mass * Eigen::Map<const Eigen::Vector4d>(s.state().q.angle.data()))));
    }
    const double omega = 20 * std::numbers::pi / (crossings.back() - crossings.front());
    // Phase error (h w)^2/6 (thesis) or /24 (Euler) with h w <= 2.6e-3: 1.1e-6; interpolated crossings add less.
    EXPECT_NEAR(omega / std::sqrt(modes.eigenvalues()[mode]), 1, 2e-6) << "mode " << mode;
    EXPECT_LT(others, 1e-3 * 1e-9) << "mode " << mode;  // rounding of the eigenvectors
  }
}

TEST_P(TorsionalChain, LosesAModeAtTheRateOfItsDamping) {
  const double ja = 2e-3, jb = 5e-4, k = 100, c = 0.02;
  const Model model = compile(parse_scene(free_belt + bodies({ja, jb}) + spring(0, k, c), "pair"));
  const double mobility = 1 / ja + 1 / jb, omega2 = k * mobility, decay = 0.5 * c * mobility;
  const double damped = std::sqrt(omega2 - decay * decay), h = 1e-6;
  const SpeedProfile rest;
  Simulator s(model, rest, GetParam(), h);
  s.state().q.angle = {1e-3, 0};
  double worst = 0;
  while (s.time() < 0.05) {
    s.advance();
    const double t = s.time();
    const double exact = std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
    worst = std::max(worst, std::abs((s.state().q.angle[0] - s.state().q.angle[1]) / 1e-3 - exact));
  }
  // Ten decays (e^-1.25) and 3.9 periods. Thesis: (h w)^2/6 x w t = 1e-6. Euler: first order, h w/2 = 2.5e-4.
  EXPECT_LT(worst, GetParam() == Scheme::thesis ? 2e-6 : 4e-4);
}

TEST_P(TorsionalChain, KeepsItsAngularMomentum) {
  const Model model = compile(
      parse_scene(free_belt + bodies({2e-3, 5e-4, 1e-3}) + spring(0, 100, 0.02) + spring(1, 400, 0.01), "chain"));
  const SpeedProfile rest;
  Simulator s(model, rest, GetParam(), 1e-6);
  s.state().q.speed = {100, -20, 5};
  const auto momentum = [&] {
    return 2e-3 * s.state().q.speed[0] + 5e-4 * s.state().q.speed[1] + 1e-3 * s.state().q.speed[2];
  };
  const double before = momentum();
  for (int i = 0; i < 50000; ++i) s.advance();
  EXPECT_NEAR(momentum(), before, 1e-12 * before);  // 5e4 roundings of random sign
}

INSTANTIATE_TEST_SUITE_P(EitherScheme, TorsionalChain, testing::Values(Scheme::thesis, Scheme::symplectic_euler),
                         [](const auto& info) { return std::string(enum_name(info.param)); });

// A pinion in mesh with a pulley whose speed is given, dragged by a constant torque.
Model rattling_pinion() {
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/two_pulley.toml",
                               {"belt.elements=48", "belt.axial_damping_n_s=0", "belt.bending_damping_n_m2_s=0"})
                        .scene;
  scene.body = {{.name = "pinion", .inertia_kg_m2 = 1e-4}};
  scene.gear_pair = {{.name = "mesh",
                      .pinion = "pinion",
                      .gear = "driver",
                      .pinion_teeth = 20,
                      .gear_teeth = 60,
                      .module_mm = 2,
                      .stiffness_n_per_m = 1e6,
                      .damping_n_s_per_m = 1000,
                      .backlash_mm = 0.2}};
  scene.torque.clear();
  return compile(scene);
}

TEST(GearPair, RattlesThroughItsBacklashAsTheEquationOfThePinionAloneSays) {
  const Model model = rattling_pinion();
  // The gear's speed swings about standstill, 30 Hz and 2 rad/s: 0.64 mm at the pitch circle, three times the gap.
  std::vector<double> times, speeds;
  for (int i = 0; i <= 3000; ++i) {
    times.push_back(1e-4 * i);
    speeds.push_back(2 * std::sin(2 * std::numbers::pi * 30 * times.back()));
  }
  const SpeedProfile profile(times, speeds);
  const double h = 5e-7, r1 = 0.02, r2 = 0.06, k = 1e6, c = 1000, half = 1e-4, inertia = 1e-4;

  // State of the reference: pinion angle and speed, gear angle; each positive in its own running sense.
  using State3 = Eigen::Vector3d;
  const auto force = [&](const State3& y, double t) {
    const double gap = r1 * y[0] - r2 * y[2], rate = r1 * y[1] - r2 * profile.speed(t);
    if (gap > half) return std::max(k * (gap - half) + c * rate, 0.0);
    if (gap < -half) return std::min(k * (gap + half) + c * rate, 0.0);
    return 0.0;
  };
  const auto slope = [&](const State3& y, double t) {
    return State3(y[1], -r1 * force(y, t) / inertia, profile.speed(t));
  };

  Simulator s(model, profile, Scheme::thesis, h);
  const int pinion = body_index(model, "pinion"), gear = body_index(model, "driver");
  State3 y = State3::Zero();
  double worst = 0, largest = 0;
  int impacts = 0;
  bool touching = false;
  for (int i = 0; i < 600000; ++i) {
    s.advance();
    const double t = i * h;
    const State3 k1 = slope(y, t), k2 = slope(y + 0.5 * h * k1, t + 0.5 * h), k3 = slope(y + 0.5 * h * k2, t + 0.5 * h),
                 k4 = slope(y + h * k3, t + h);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    const bool now = std::abs(r1 * y[0] - r2 * y[2]) > half;
    impacts += now && !touching;
    touching = now;
    const auto& q = s.state().q;
    worst = std::max(worst, std::abs(model.sense[pinion] * q.speed[pinion] - y[1]));
    largest = std::max(largest, std::abs(y[1]));
    worst = std::max(worst, std::abs(model.sense[gear] * q.angle[gear] - y[2]));
  }
  EXPECT_GT(impacts, 15);
  // Where teeth meet either method is wrong by up to a step of damper force, h c r1^2/J = 0.2 % of the speed; halving
  // the step halves what is measured, 5e-4.
  EXPECT_LT(worst, 1e-3 * largest);
}

TEST(GearPair, PushesOnEitherFlankIsFreeBetweenAndNeverPulls) {
  const Model model = rattling_pinion();
  const SpeedProfile rest;
  Simulator s(model, rest, Scheme::thesis, 1e-6);
  const int pinion = body_index(model, "pinion"), gear = body_index(model, "driver");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    Coordinates& q = s.state().q;
    q.angle[pinion] = 0.02 * unit(random);
    q.speed[pinion] = 10 * unit(random);
    q.speed[gear] = 3 * unit(random);
    s.evaluate(q, {});
    const double delta = 0.02 * model.sense[pinion] * q.angle[pinion];
    const double force = s.work().gear_force[0];
    if (delta > 1e-4)
      EXPECT_GE(force, 0);
    else if (delta < -1e-4)
      EXPECT_LE(force, 0);
    else
      EXPECT_EQ(force, 0);
    EXPECT_NEAR(s.work().torque[pinion], -0.02 * model.sense[pinion] * force, 1e-12 * std::abs(force));  // one product
  }
}

TEST(TorqueTable, ReferredToTheDriveShaftReachesTheTurbineThroughTheGears) {
  const Model model = compile(read_scene(BELTLIFE_SCENES "/baseline.toml").scene);
  const Model literal =
      compile(read_scene(BELTLIFE_SCENES "/baseline.toml", {"torque.turbine_torque.referred_to=turbine"}).scene);
  EXPECT_NEAR(model.torques[0].factor, 19.0 / 191, 1e-15);  // rounding of two quotients
  EXPECT_NEAR(literal.torques[0].factor, 1, 1e-15);
  EXPECT_EQ(model.body_name[model.torques[0].body], "turbine");
}

TEST(TorqueTable, PushesInTheRunningSenseOnlyAndIsHeldAboveItsEnd) {
  const Model model = compile(read_scene(BELTLIFE_SCENES "/baseline.toml").scene);
  const SpeedProfile rest;
  Simulator s(model, rest, Scheme::thesis, 1e-7);
  const int turbine = body_index(model, "turbine");
  ASSERT_EQ(model.sense[turbine], 1);  // the gears turn it against the clockwise drive
  const auto torque_at = [&](double speed_rpm) {
    s.state().q.speed.assign(model.bodies, 0.0);
    s.state().q.speed[turbine] = speed_rpm / rpm;
    // Its shaft's damper also acts at a speed difference; the table alone is what remains.
    s.evaluate(s.state().q, {});
    return (s.work().torque[turbine] + s.work().spring_torque[0]) * 191 / 19;
  };
  const double rounding = 1e-14 * 4 * 7250;  // of the damper's torque, which is added and taken off again
  EXPECT_NEAR(torque_at(22802), 3, 11 * rounding);
  EXPECT_NEAR(torque_at(43000), 30, 11 * rounding);
  EXPECT_NEAR(torque_at(0.5 * (32575 + 35832)), 17.5, 11 * rounding);
  EXPECT_NEAR(torque_at(69227), 1, 11 * rounding);
  EXPECT_NEAR(torque_at(90000), 1, 11 * rounding);
  EXPECT_NEAR(torque_at(0), 0, 11 * rounding);
  EXPECT_NEAR(torque_at(-40000), 0, 11 * rounding);
}

TEST(ControlledDriver, FollowsItsProfileAsItsTransferFunctionSays) {
  const double inertia = 0.1269, kd = 335, kp = 4.5e5;
  const Model model = compile(parse_scene(free_belt + bodies({inertia}) + R"([driver]
body = "b0"
control = "pid"
[[driver.harmonic]]
name = "third"
order = 3
speeds_rpm = [1500]
amplitudes_rpm = [20]
[[range]]
name = "hold"
crank_rpm = 1500
duty_share = 1
)",
                                          "controlled"));
  const double mean = 1500 / rpm, order = 3 * mean, h = 5e-6;
  const SpeedProfile profile({0, 0.1, 0.3}, {0, 0, mean}, harmonics_of(*model.scene.driver));
  Simulator s(model, profile, Scheme::thesis, h);
  while (s.time() < 0.5) s.advance();
  std::complex<double> wave = 0;
  double sum = 0, worst = 0;
  const int samples = static_cast<int>(std::lround(0.2 / h));  // 15 periods of the ripple
  for (int i = 0; i < samples; ++i) {
    s.advance();
    const double speed = s.state().q.speed[0], angle = 3 * profile.at(s.time()).angle;
    sum += speed;
    wave += speed * std::polar(2.0 / samples, -angle);
    worst = std::max(worst, std::abs(speed - profile.speed(s.time())));
  }
  const std::complex<double> jw(0, order), gain = (kd * jw + kp) / (inertia * jw * jw + kd * jw + kp);
  // The explicit step errs by (h w)^2 = 6e-6; 0.2 s after the ramp the transient is e^(-1320 x 0.2).
  EXPECT_NEAR(sum / samples / mean, 1, 1e-6);
  EXPECT_NEAR(std::abs(wave) * rpm, 20 * std::abs(gain), 20 * 1e-4);
  EXPECT_NEAR(std::arg(wave), std::arg(gain), 1e-4);
  EXPECT_LT(worst * rpm, 20 * std::abs(gain - 1.0) * 1.001);
}

}  // namespace
}  // namespace beltlife
