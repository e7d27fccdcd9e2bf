// The implicit scheme's drive train alone: springs, dampers, gears, clutches, drivers and arm against closed forms.
#include "sim/lanes/implicit_train.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "sim/scene/scene_io.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

constexpr double pi = std::numbers::pi, rpm = 30 / pi;

/// Bodies beside a belt that touches nothing; all turn counterclockwise.
SceneSpec bodies(std::vector<BodySpec> list) {
  SceneSpec scene;
  scene.rotation = Rotation::counterclockwise;
  scene.belt.elements = 16;
  scene.belt.unstretched_length_mm = 1000;
  scene.belt.axial_stiffness_n = 1000;
  scene.belt.mass_kg_per_m = 0.1;
  scene.belt.ribs = 6;
  scene.belt.friction_front = scene.belt.friction_back = 0.6;
  scene.ring.emplace();
  scene.body = std::move(list);
  return scene;
}

TorsionalSpringSpec spring(const char* name, const char* from, const char* to, double stiffness, double damping) {
  return {.name = name,
          .from = from,
          .to = to,
          .stiffness_n_m_per_rad = stiffness,
          .damping_n_m_s_per_rad = damping,
          .one_way = false};
}

/// The train of a model alone, as LaneSimulator steps it; bodies and arm feel no belt.
struct Train {
  Train(const Model& m, SpeedProfile given, double step)
      : model(m), profile(std::move(given)), h(step), state(m.initial), train(model, profile, step) {}
  Train(const Train&) = delete;
  Train& operator=(const Train&) = delete;

  void advance() {
    train.expect(state, now());
    const std::vector<double> none(static_cast<std::size_t>(model.pulleys), 0.0);
    train.advance(state, now(), none.data(), none.data(), none.data());
    ++steps;
  }
  /// t_n of the step that comes next.
  double now() const { return h * static_cast<double>(steps); }
  /// Bodies stand half a step earlier than t_n.
  double time() const { return now() - 0.5 * h; }

  const Model& model;
  SpeedProfile profile;
  double h;
  State state;
  ImplicitTrain train;
  std::int64_t steps = 0;
};

// Slope of log(error) over log(step) by least squares.
double order_of(const std::vector<double>& steps, const std::vector<double>& errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double x = std::log(steps[i]), y = std::log(errors[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double n = static_cast<double>(steps.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(ImplicitTrain, TwoInertiasOnASpringRingAtTheirFrequencyToSecondOrder) {
  const double ja = 2e-3, jb = 5e-4, k = 2e5, mobility = 1 / ja + 1 / jb, w = std::sqrt(k * mobility);
  SceneSpec scene = bodies({{"a", ja}, {"b", jb}});
  scene.torsional_spring = {spring("s", "a", "b", k, 0)};
  const Model model = compile(scene);
  std::vector<double> steps, errors;
  // Up to 5e-6 s a step is one substep.
  for (const double h : {4e-6, 2e-6, 1e-6}) {
    Train t(model, {}, h);
    t.state.q.angle = {1e-3, 0};
    double worst = 0;
    for (const double start = t.time(); t.time() < 0.002;) {
      t.advance();
      const double twist = t.state.q.angle[0] - t.state.q.angle[1];
      worst = std::max(worst, std::abs(twist / 1e-3 - std::cos(w * (t.time() - start))));
    }
    steps.push_back(h);
    errors.push_back(worst);
  }
  // The trapezoidal rule is slow by (h w)^2/12: after 0.002 s (45 rad) at h w = 0.09, 45 x 6.7e-4 = 0.03.
  const double hw = 4e-6 * w;
  EXPECT_NEAR(errors[0], hw * hw / 12 * w * 0.002, 0.1 * hw * hw / 12 * w * 0.002);
  EXPECT_NEAR(order_of(steps, errors), 2, 0.02);  // the next order is (h w)^2 = 1 % of it
}

TEST(ImplicitTrain, NeitherGainsNorLosesEnergyOnASpring) {
  SceneSpec scene = bodies({{"a", 2e-3}, {"b", 5e-4}});
  scene.torsional_spring = {spring("s", "a", "b", 1e5, 0)};
  const Model model = compile(scene);
  Train t(model, {}, 2e-5);
  t.state.q.speed = {100, -20};
  const auto energy = [&] {
    const double twist = t.state.q.angle[0] - t.state.q.angle[1];
    return 0.5 * 2e-3 * std::pow(t.state.q.speed[0], 2) + 0.5 * 5e-4 * std::pow(t.state.q.speed[1], 2) +
           0.5 * 1e5 * twist * twist;
  };
  const double before = energy(), momentum = 2e-3 * 100 - 5e-4 * 20;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    t.advance();
    worst = std::max(worst, std::abs(energy() / before - 1));
  }
  EXPECT_LT(worst, 1e-9);  // the trapezoidal rule keeps a quadratic energy: 8e4 substeps of rounding, twist by twist
  EXPECT_NEAR(2e-3 * t.state.q.speed[0] + 5e-4 * t.state.q.speed[1], momentum, 1e-11 * momentum);
}

// The thesis' turbine shaft: 4 N m s/rad on 3e-6 kg m^2, a rate of 1.4e6 1/s, 28 steps' worth in each.
TEST(ImplicitTrain, AStiffDamperIsStableAndCarriesTheTorqueThroughIt) {
  const double jt = 6.56e-5, jp = 3e-6, k = 1442, c = 4, rate = c * (1 / jt + 1 / jp);
  SceneSpec scene = bodies({{"turbine", jt}, {"pinion", jp}});
  scene.torsional_spring = {spring("shaft", "turbine", "pinion", k, c)};
  scene.torque = {{"drag", "turbine", {1, 1e5}, {0.5, 0.5}, {}}};
  const Model model = compile(scene);
  const double h = 2e-5;
  Train t(model, {}, h);
  t.state.q.speed = {1000, 900};
  // What is left of the difference after a substep s is 1/(1 + s rate), an eighth, where the exact damper leaves
  // e^(-7): after four of them 2e-4 of it, and what the twist of the first substeps, 100 x s, springs back at k/c = 360
  // 1/s.
  t.advance();
  EXPECT_LT(std::abs(t.state.q.speed[0] - t.state.q.speed[1]),
            100 * (std::pow(1 + 0.25 * h * rate, -4) + 2 * 0.25 * h * k / c));
  for (int i = 0; i < 5000; ++i) {
    t.advance();
    ASSERT_LT(std::abs(t.state.q.speed[0] - t.state.q.speed[1]), 100) << i;
  }
  // Both together under the constant torque, from the momentum they began with.
  const double elapsed = t.time() + 0.5 * h, mean = (jt * 1000 + jp * 900 + 0.5 * elapsed) / (jt + jp);
  EXPECT_NEAR(t.state.q.speed[0] / mean, 1, 1e-10);  // momentum is kept: rounding
  EXPECT_NEAR(t.state.q.speed[1] / mean, 1, 1e-6);   // the overdamped twist still creeps back at k/c = 360 1/s
  // The shaft carries what accelerates the pinion: k x twist + c x twist rate = jp x acceleration.
  const double torque = k * (t.state.q.angle[0] - t.state.q.angle[1]) + c * (t.state.q.speed[0] - t.state.q.speed[1]);
  EXPECT_NEAR(torque / (jp * 0.5 / (jt + jp)), 1, 1e-3);  // of angles that have run up to 500 rad
}

TEST(ImplicitTrain, ADampedPairLosesItsSwingAtItsRateToSecondOrder) {
  const double ja = 2e-3, jb = 5e-4, k = 1e5, c = 5, mobility = 1 / ja + 1 / jb, decay = 0.5 * c * mobility;
  const double damped = std::sqrt(k * mobility - decay * decay);
  SceneSpec scene = bodies({{"a", ja}, {"b", jb}});
  scene.torsional_spring = {spring("s", "a", "b", k, c)};
  const Model model = compile(scene);
  std::vector<double> steps, errors;
  for (const double h : {4e-6, 2e-6, 1e-6}) {
    Train t(model, {}, h);
    t.state.q.angle = {1e-3, 0};
    double worst = 0;
    for (const double start = t.time(); t.time() < 5e-4;) {
      t.advance();
      const double at = t.time() - start, twist = t.state.q.angle[0] - t.state.q.angle[1];
      const double exact = std::exp(-decay * at) * (std::cos(damped * at) + decay / damped * std::sin(damped * at));
      worst = std::max(worst, std::abs(twist / 1e-3 - exact));
    }
    steps.push_back(h);
    errors.push_back(worst);
  }
  EXPECT_LT(errors[0], 3e-4);                     // (h w)^2/12 x (w t = 5 before it is damped away) = 3e-4
  EXPECT_NEAR(order_of(steps, errors), 2, 0.05);  // h w = 0.06
}

// A pinion thrown against a heavy gear through its backlash: every impact reverses the speed of approach and leaves
// what the damper does.
TEST(ImplicitTrain, TeethThatRattleBounceAtTheSpeedOfTheImpactAndCreateNoEnergy) {
  const double jp = 1e-4, r = 0.02, k = 1e6, half = 1e-4;
  for (const double c : {0.0, 100.0}) {
    SceneSpec scene = bodies({{"pinion", jp}, {"gear", 1e3}});
    scene.body[1].inertia_kg_m2 = 1e3;
    scene.gear_pair = {{"mesh", "pinion", "gear", 20, 20, 2, k, c, 0.2}};
    const Model model = compile(scene);
    Train t(model, {}, 2e-5);
    const double speed = 20, w = r * std::sqrt(k / jp), zeta = c * r * r / (2 * std::sqrt(k * r * r * jp));
    const double root = std::sqrt(1 - zeta * zeta);
    const double bounce = zeta == 0 ? 1 : std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
    ASSERT_NEAR(w, 2000, 1);
    const double sense = model.sense[0];
    t.state.q.speed = {sense * speed, 0};
    const auto energy = [&] {
      const double delta = r * sense * t.state.q.angle[0];
      const double depth = std::max(std::abs(delta) - half, 0.0);
      return 0.5 * jp * std::pow(t.state.q.speed[0], 2) + 0.5 * k * depth * depth;
    };
    const double start = energy();
    double most = 0, free_speed = speed, before = energy();
    std::vector<double> after;
    bool touching = false;
    for (int i = 0; i < 6000 && after.size() < 10; ++i) {
      t.advance();
      most = std::max(most, energy() - before);
      before = energy();
      const bool now = r * std::abs(t.state.q.angle[0]) > half;
      if (touching && !now) {
        after.push_back(std::abs(t.state.q.speed[0]) / free_speed);
        free_speed = std::abs(t.state.q.speed[0]);
      }
      touching = now;
    }
    ASSERT_EQ(after.size(), 10u);
    // Contact begins and ends within substeps of s w = 0.01: (s w)^2/2 = 5e-5 of the energy at either end, undamped;
    // with the damper, the torque that jumps at touch-down is off by part of a substep, 2 zeta s w = 2e-3 of the speed.
    double product = 1;
    for (const double ratio : after) {
      EXPECT_NEAR(ratio, bounce, zeta == 0 ? 2e-4 : 2 * zeta * 0.01 * 1.5);
      product *= ratio;
    }
    std::printf("    c %g: ten bounces leave %.6f of the speed, closed form %.6f\n", c, product, std::pow(bounce, 10));
    EXPECT_LT(most, 2e-4 * start);
    EXPECT_LT(energy(), start * (1 + 2e-4));
  }
}

TEST(ImplicitTrain, ATorqueTableActsInTheRunningSenseAtTheSpeedReached) {
  for (const bool mirrored : {false, true}) {
    SceneSpec scene = bodies({{"rotor", 1e-3}});
    scene.rotation = mirrored ? Rotation::clockwise : Rotation::counterclockwise;
    scene.torque = {{"load", "rotor", {1000, 2000}, {-1, -2}, {}}};
    const Model model = compile(scene);
    Train t(model, {}, 2e-5);
    const double sense = model.sense[0], start = 1800 / rpm;
    t.state.q.speed = {sense * start};
    // T = -(w / (1000 rpm)): exponential decay, held linear to zero below.
    const double rate = 1 / (1000 / rpm) / 1e-3;
    const double from = t.time();
    for (int i = 0; i < 2500; ++i) t.advance();
    // Explicit in the table's slope: first order in the substep of 5e-6 s, s rate/2 x rate t = 2.4e-5 x 0.48.
    EXPECT_NEAR(sense * t.state.q.speed[0] / (start * std::exp(-rate * (t.time() - from))), 1, 2e-5);
  }
}

TEST(ImplicitTrain, APrescribedBodyFollowsItsProfileAndDragsWhatHangsOnIt) {
  SceneSpec scene = bodies({{"crank", 1e-2}, {"load", 1e-3}});
  scene.torsional_spring = {spring("s", "crank", "load", 500, 0.5)};
  scene.driver.emplace();
  scene.driver->body = "crank";
  scene.driver->harmonic = {{"second", 2, 0.3, {500}, {30}}};
  const Model model = compile(scene);
  const SpeedProfile profile({0, 0.05}, {0, 100}, harmonics_of(*scene.driver));
  const double h = 2e-5;
  Train t(model, profile, h);
  double worst = 0, angle = t.state.q.angle[0];
  while (t.now() < 0.2) {
    t.advance();
    worst = std::max(worst, std::abs(t.state.q.speed[0] - profile.speed(t.time())));
    angle += h * profile.speed(t.time() - 0.5 * h);
  }
  EXPECT_LT(worst, 1e-11);
  // The trapezoid against the midpoint rule, h^2/8 of the speed's whole change of slope.
  EXPECT_NEAR(t.state.q.angle[0], angle, 1e-6);
  // The load follows as its transfer function says: mean over the last turns of the crank.
  double mean = 0;
  std::complex<double> wave = 0, given = 0;
  int n = 0;
  const double turn = 2 * pi / 100;
  for (const double from = t.now(); t.now() < from + turn - 0.5 * h; ++n) {
    t.advance();
    const double a = 2 * profile.at(t.time()).angle;
    mean += t.state.q.speed[1];
    wave += t.state.q.speed[1] * std::polar(1.0, -a);
    given += t.state.q.speed[0] * std::polar(1.0, -a);
  }
  EXPECT_NEAR(mean / n, 100, 1e-2);
  const std::complex<double> jw(0, 200), gain = (0.5 * jw + 500.0) / (1e-3 * jw * jw + 0.5 * jw + 500.0);
  // Two whole waves of 3142 samples each but for the step by which a turn is no whole number of them: 3e-4.
  EXPECT_NEAR(std::abs(wave / given - gain), 0, 2e-3);
}

TEST(ImplicitTrain, AControlledDriverFollowsAsItsTransferFunctionSays) {
  const double inertia = 0.1269, kd = 335, kp = 4.5e5;
  SceneSpec scene = bodies({{"crank", inertia}});
  scene.driver.emplace();
  scene.driver->body = "crank";
  scene.driver->control = Control::pid;
  scene.driver->harmonic = {{"third", 3, 0, {1500}, {20}}};
  const Model model = compile(scene);
  const double mean = 1500 / rpm, order = 3 * mean, h = 2e-5;
  const SpeedProfile profile({0, 0.1, 0.3}, {0, 0, mean}, harmonics_of(*scene.driver));
  Train t(model, profile, h);
  while (t.now() < 0.5 - 0.5 * h) t.advance();
  std::complex<double> wave = 0;
  double sum = 0;
  const int samples = static_cast<int>(std::lround(0.2 / h));  // 15 periods of the ripple
  for (int i = 0; i < samples; ++i) {
    t.advance();
    sum += t.state.q.speed[0];
    wave += t.state.q.speed[0] * std::polar(2.0 / samples, -3 * profile.at(t.time()).angle);
  }
  const std::complex<double> jw(0, order), gain = (kd * jw + kp) / (inertia * jw * jw + kd * jw + kp);
  // (h w)^2/12 with substeps of 5e-6 s: 5e-7, where w is the order's.
  EXPECT_NEAR(sum / samples / mean, 1, 1e-6);
  EXPECT_NEAR(std::abs(wave) * rpm, 20 * std::abs(gain), 20 * 1e-5);
  EXPECT_NEAR(std::arg(wave), std::arg(gain), 1e-5);
}

TEST(ImplicitTrain, ALockedPulleyStaysAndALoadedSpringLeavesItThere) {
  SceneSpec scene =
      read_scene(BELTLIFE_SCENES "/two_pulley.toml", {"belt.elements=48", "pulley.driven.locked=true"}).scene;
  scene.torque.clear();
  scene.body = {{"rotor", 1e-3}};
  scene.torsional_spring = {spring("s", "driven", "rotor", 50, 0)};
  const Model model = compile(scene);
  Train t(model, {}, 2e-5);
  const int locked = body_index(model, "driven"), rotor = body_index(model, "rotor");
  t.state.q.angle[rotor] = 0.1;
  const double w = std::sqrt(50 / 1e-3), from = t.time();
  for (int i = 0; i < 2000; ++i) {
    t.advance();
    ASSERT_EQ(t.state.q.speed[locked], 0);
    ASSERT_EQ(t.state.q.angle[locked], 0);
  }
  EXPECT_NEAR(t.state.q.angle[rotor], 0.1 * std::cos(w * (t.time() - from)), 1e-6);  // s w = 1e-3: 1e-7 x 9 rad x 0.1
}

TEST(ImplicitTrain, AChainOfManyBodiesKeepsItsMomentumAndEnergy) {
  SceneSpec scene = bodies({});
  for (int i = 0; i < 80; ++i) scene.body.push_back({"b" + std::to_string(i), 1e-3});
  for (int i = 0; i < 79; ++i) {
    const std::string from = "b" + std::to_string(i), to = "b" + std::to_string(i + 1);
    scene.torsional_spring.push_back(spring(("s" + from).c_str(), from.c_str(), to.c_str(), 1000, 0));
  }
  const Model model = compile(scene);
  Train t(model, {}, 2e-5);
  t.state.q.speed[0] = 100;
  for (int i = 0; i < 500; ++i) t.advance();
  double momentum = 0, energy = 0;
  for (int i = 0; i < 80; ++i) {
    momentum += 1e-3 * t.state.q.speed[i];
    energy += 0.5e-3 * std::pow(t.state.q.speed[i], 2);
    if (i < 79) energy += 500 * std::pow(t.state.q.angle[i] - t.state.q.angle[i + 1], 2);
  }
  EXPECT_NEAR(momentum, 0.1, 1e-12);
  EXPECT_NEAR(energy, 5, 1e-10);  // rounding of 2000 substeps
}

// As one_way_test.cpp with the explicit schemes; here a step of 2e-5 s of four substeps.
TEST(ImplicitTrain, AOneWaySpringOverrunsAtConstantSpeedAndIsDrivenAgain) {
  const double k = 100, c = 0.4, j = 5e-4, w = std::sqrt(k / j), zeta = c / (2 * std::sqrt(k * j)), s = 5e-6;
  SceneSpec scene = bodies({{"first", 2e-3}, {"second", j}});
  scene.torsional_spring = {spring("clutch", "first", "second", k, c)};
  scene.torsional_spring[0].one_way = true;
  scene.driver.emplace();
  scene.driver->body = "first";
  const Model model = compile(scene);
  const SpeedProfile up_down_up({0, 0.1, 0.2, 0.25, 0.3, 0.4}, {0, 100, 100, 60, 60, 120});
  Train t(model, up_down_up, 2e-5);
  const double root = std::sqrt(1 - zeta * zeta), phase = std::atan2(root, zeta), left = std::exp(-zeta / root * phase);
  const double free_speed = 100 + j * 1000 / k * w * left, overtaken = 0.3 + (free_speed - 60) / 600;
  double speed = 0, engaged_at = 0, before = 0;
  while (t.now() < 0.4) {
    t.advance();
    if (t.time() < 0.12) {
      speed = t.state.q.speed[1];
      continue;
    }
    if (engaged_at == 0 && t.state.q.speed[1] != speed) engaged_at = t.time();
    if (engaged_at == 0) {
      ASSERT_EQ(t.state.q.speed[1], speed);  // nothing acts on it: not a bit changes
    }
    before = t.state.free_wheel[0];
  }
  std::printf("    overruns at %.8g rad/s, closed form %.8g; driven again at %.6g s, closed form %.6g\n", speed,
              free_speed, engaged_at, overtaken);
  EXPECT_NEAR(speed, free_speed, 2 * zeta * w * s * (free_speed - 100));  // let go within a substep: the damper's share
  EXPECT_NEAR(engaged_at, overtaken, 2e-5 + 2 * s);
  EXPECT_LT(before, -1);
  EXPECT_NEAR((t.state.q.speed[1] - up_down_up.speed(t.time())) / 120, 0, 0.02);  // it follows the ramp again
}

}  // namespace
}  // namespace beltlife
