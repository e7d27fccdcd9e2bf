// Owns the verification of natural frequencies: closed forms, bounds, and the ring-down of simulated drives.
#include <algorithm>
#include <numeric>

#include "sim/modes/campbell.h"
#include "sim/modes/linear_drive.h"
#include "sim/statics/quasi_static.h"
#include "tests/verification/drives.h"

namespace beltlife {
namespace {

using drives::pi;

constexpr double massless = 1e-5;  // kg/m: the closed forms know no belt mass

ModesOptions rigid_grip() {
  ModesOptions options;
  options.highest_hz = 1e5;
  options.linear.contact_compliance = false;
  return options;
}

std::vector<double> frequencies(const Model& model, ArmState arm, const ModesOptions& options = {}) {
  std::vector<double> hz;
  for (const ArmModes& a : solve_modes(model, {"rest", 0, 0}, options).arms)
    if (a.arm == arm)
      for (const Mode& mode : a.modes) hz.push_back(mode.frequency_hz);
  return hz;
}

BodySpec body(std::string name, double inertia) { return {std::move(name), inertia}; }

// Both spans resist a turn: f = sqrt((k1 + k2) R^2 / J) / 2 pi with k = EA / unstretched span.
TEST(Modes, OfAPulleyOnTwoSpansIsThatOfTwoParallelSprings) {
  SceneSpec scene = drives::two_pulleys(128, 400, 100, 100, 500);
  scene.belt.mass_kg_per_m = massless;
  const auto hz = frequencies(compile(scene), ArmState::none, rigid_grip());
  const double k = scene.belt.axial_stiffness_n / (0.4 / (1 + 500 / scene.belt.axial_stiffness_n));
  const double closed = std::sqrt(2 * k * 0.05 * 0.05 / 0.003) / (2 * pi);
  drives::report("pulley on two spans, Hz", hz.at(0), closed);
  EXPECT_NEAR(hz[0] / closed, 1, 1e-5);  // the belt weighs 1e-5 of the pulley
}

// Two inertias on a shaft turn against each other at sqrt(k (1/J1 + 1/J2)).
TEST(Modes, OfAShaftAndOfAGearedPairAreThoseOfTwoInertias) {
  SceneSpec scene = drives::two_pulleys(128, 400, 100, 100, 500);
  scene.belt.mass_kg_per_m = massless;
  scene.body = {body("left", 0.002), body("right", 0.005), body("pinion", 0.0004), body("gear", 0.02)};
  scene.torsional_spring = {{"shaft", "left", "right", 1500, 0}};
  scene.gear_pair = {{"mesh", "pinion", "gear", 20, 60, 2, 1e6, 0, 0}};
  const auto hz = frequencies(compile(scene), ArmState::none, rigid_grip());
  const double shaft = std::sqrt(1500 * (1 / 0.002 + 1 / 0.005)) / (2 * pi);
  const double mesh = std::sqrt(1e6 * (0.02 * 0.02 / 0.0004 + 0.06 * 0.06 / 0.02)) / (2 * pi);
  for (const double closed : {shaft, mesh}) {
    const double nearest = *std::min_element(
        hz.begin(), hz.end(), [&](double a, double b) { return std::abs(a - closed) < std::abs(b - closed); });
    drives::report("two inertias, Hz", nearest, closed);
    EXPECT_NEAR(nearest / closed, 1, 1e-6);
  }
  EXPECT_EQ(std::count_if(hz.begin(), hz.end(), [](double f) { return f < 0.05; }), 2);  // each pair turns as a whole
}

TEST(Modes, OfTeethWithBacklashThatCarryNothingAreThoseOfLooseBodies) {
  SceneSpec scene = drives::two_pulleys(128, 400, 100, 100, 500);
  scene.body = {body("wheel", 0.0004)};
  scene.gear_pair = {{"mesh", "wheel", "driven", 20, 60, 2, 1e6, 0, 0.05}};
  EXPECT_FALSE(solve_modes(compile(scene), {"rest", 0, 0}).loop.gear_engaged.at(0));
  EXPECT_LT(frequencies(compile(scene), ArmState::none).at(0), 0.05);
  scene.torque = {{"brake", "wheel", {100, 1000}, {-1, -1}, {}}};
  EXPECT_TRUE(solve_modes(compile(scene), {"running", 500, 0}).loop.gear_engaged.at(0));
}

TEST(Modes, OfADriveThatNothingHoldsBeginWithOneThatTurnsFreely) {
  SceneSpec scene = drives::two_pulleys(128, 400, 100, 60, 500);
  scene.driver.reset();
  const auto modes = solve_modes(compile(scene), {"rest", 0, 0}).arms.at(0).modes;
  ASSERT_GE(modes.size(), 2u);
  EXPECT_LT(modes[0].frequency_hz, 0.05);
  EXPECT_GT(modes[1].frequency_hz, 10);
  // All of it runs together: equal travel at the belt.
  for (const double shape : modes[0].body_shape) EXPECT_NEAR(shape, 1, 1e-4);
}

/// Two pulleys of which one hangs on an arm at right angles to the line of centres, so that the arm stretches both
/// spans alike; the other is driven. The arm's spring pulls it tight.
SceneSpec symmetric_arm(double spring_rate) {
  SceneSpec scene = drives::two_pulleys(256, 400, 100, 100, 500);
  scene.belt.pretension_n.reset();
  scene.belt.balanced_as_placed = true;
  scene.tensioner.emplace();
  TensionerSpec& t = *scene.tensioner;
  t.pulley = "driven";
  t.pivot_x_mm = 400;
  t.pivot_y_mm = -200;
  t.inertia_kg_m2 = 0.02;
  t.mass_kg = 1;
  t.spring_torque_n_m = 2 * 500 * 0.2;
  t.spring_rate_n_m_per_rad = spring_rate;
  return scene;
}

// The arm of length a stretches both spans by a dphi: k = rate + 2 (EA/l0) a^2, plus the geometric part: the spans keep
// their direction (n c' = 0), and t r = 0. The pulley's turn is a mode of its own.
TEST(Modes, OfAnArmOnASymmetricDriveIsItsSpringAndBothSpans) {
  SceneSpec scene = symmetric_arm(300);
  scene.belt.mass_kg_per_m = massless;
  const auto hz = frequencies(compile(scene), ArmState::free, rigid_grip());
  const double l0 = 0.4 / (1 + 500 / scene.belt.axial_stiffness_n), k = scene.belt.axial_stiffness_n / l0;
  const double arm = std::sqrt((300 + 2 * k * 0.2 * 0.2) / 0.02) / (2 * pi);
  const double turn = std::sqrt(2 * k * 0.05 * 0.05 / 0.003) / (2 * pi);
  ASSERT_GE(hz.size(), 2u);
  drives::report("pulley's turn, Hz", hz[0], turn);
  drives::report("arm, Hz", hz[1], arm);
  EXPECT_NEAR(hz[0] / turn, 1, 1e-5);
  EXPECT_NEAR(hz[1] / arm, 1, 1e-5);
}

// With a belt that hardly stretches less than its path does, only T d2L/dphi2 is left to compare: the stiffness entry
// of the arm against a difference of the path's own derivative.
TEST(Modes, GeometricStiffnessOfTheArmIsTensionTimesTheCurvatureOfThePath) {
  for (const char* name : {"baseline", "accessory_drive"}) {
    SceneSpec scene = drives::shipped(name);
    const auto entry = [&](double ea_scale) {
      SceneSpec s = scene;
      s.tensioner->spring_rate_n_m_per_rad = 0;
      const Model m = compile(s);
      OperatingPoint loop = operating_point(m, 0);
      for (double& t : loop.tension) t *= ea_scale;
      const LinearDrive d = linearise(m, loop, ArmState::free);
      return std::pair{d.stiffness(d.arm_row, d.arm_row), loop};
    };
    const auto [with, loop] = entry(1);
    const auto [without, slack] = entry(1e-9);
    const Model m = compile(scene);
    const auto gradient = [&](double angle) {
      Route route;
      EXPECT_TRUE(make_route(circles_of(m.scene, m.statics.orientation, angle), route));
      const Vec2 g = length_gradient(route, m.tensioner.pulley);
      const Circle& c = route.circles[m.tensioner.pulley];
      return (c.x - m.tensioner.pivot_x) * g.y - (c.y - m.tensioner.pivot_y) * g.x;
    };
    const double h = 1e-5, angle = loop.arm_angle;
    const double curvature = (gradient(angle + h) - gradient(angle - h)) / (2 * h);
    // The spans' EA / l0 rises with the stretch that is part of their length: that much is no geometric stiffness.
    double elastic = 0;
    const LinearDrive bare = linearise(m, slack, ArmState::free);
    elastic = bare.stiffness(bare.arm_row, bare.arm_row) - m.tensioner.spring_rate;
    const double strain = loop.tension[0] / m.belt.axial_stiffness;
    drives::report(std::string(name) + ", T d2L/dphi2", with - without - elastic * strain, loop.tension[0] * curvature);
    EXPECT_NEAR(with - without - elastic * strain, loop.tension[0] * curvature,
                1e-3 * std::abs(loop.tension[0] * curvature));
  }
}

// Rayleigh: a drive with one more spring has no lower frequency.
TEST(Modes, WithTheArmHeldByFrictionAreNeverLowerThanWithItFree) {
  for (const char* name : {"baseline", "alternative_2", "accessory_drive"})
    for (const double rpm : {0.0, 1500.0}) {
      const Modes modes = solve_modes(compile(drives::shipped(name)), {"", rpm, 0});
      ASSERT_EQ(modes.arms.size(), 2u);
      const auto &free = modes.arms[0].modes, &stuck = modes.arms[1].modes;
      for (std::size_t k = 0; k < std::min(free.size(), stuck.size()); ++k)
        EXPECT_GE(stuck[k].frequency_hz, free[k].frequency_hz * (1 - 1e-9)) << name << " " << k;
    }
}

TEST(SpanModes, AreThoseOfATravellingString) {
  SceneSpec scene = drives::two_pulleys(1024, 400, 100, 100, 500);
  scene.contact.stiffness_n_per_m3 = 1e13;  // a belt that sinks into its pulleys would hang slacker
  const double ea = scene.belt.axial_stiffness_n;
  const SpanModes rest = solve_modes(compile(scene), {"", 0, 0}).spans.at(0);
  const double c = std::sqrt(500 * (1 + 500 / ea) / 0.4);
  EXPECT_NEAR(rest.frequency_hz[0], c / (2 * 0.4), 1e-6 * rest.frequency_hz[0]);
  EXPECT_NEAR(rest.frequency_hz[1], 2 * rest.frequency_hz[0], 1e-9);
  // On fixed centres the belt's length keeps the tension; the centrifugal part is only taken off what presses. Chords
  // of 1 mm are 2e-5 shorter than their arcs, which takes a newton off.
  const double rpm = 3000, v = rpm * pi / 30 * 0.05;
  const SpanModes running = solve_modes(compile(scene), {"", rpm, 0}).spans.at(0);
  drives::report("running span, tension N", running.tension, 500);
  drives::report("running span, Hz", running.frequency_hz[0], (c * c - v * v) / (2 * 0.4 * c));
  EXPECT_NEAR(running.tension, 500, 2);
  EXPECT_NEAR(running.frequency_hz[0], (c * c - v * v) / (2 * 0.4 * c), 0.003 * running.frequency_hz[0]);
  EXPECT_EQ(solve_modes(compile(scene), {"", 10000, 0}).spans.at(0).frequency_hz[0], 0);  // 52 m/s > c = 35 m/s
}

TEST(OperatingPoint, AtRestIsTheStaticBalance) {
  const Model m = compile(drives::shipped("baseline"));
  const OperatingPoint rest = operating_point(m, 0);
  for (const double tension : rest.tension) EXPECT_EQ(tension, m.statics.balance.tension);
  EXPECT_EQ(rest.arm_angle, m.statics.balance.arm_angle);
  EXPECT_TRUE(rest.balanced);
  EXPECT_NE(rest.instead.find("stands still"), rest.instead.npos) << rest.instead;
}

TEST(OperatingPoint, OfARunningDriveIsItsQuasiStaticSolution) {
  const Model m = compile(drives::shipped("baseline"));
  const OperatingPoint p = operating_point(m, 1500);
  const QuasiStaticRange solution = solve_quasi_static(m, {"B100", 1500, 0});
  ASSERT_FALSE(solution.error);
  for (std::size_t k = 0; k < p.tension.size(); ++k) EXPECT_EQ(p.tension[k], solution.spans[k].tension);
  EXPECT_EQ(p.arm_angle, solution.arm_angle.value());
  EXPECT_EQ(p.centrifugal, solution.centrifugal);
  EXPECT_TRUE(p.gear_engaged.at(0));
  EXPECT_TRUE(p.balanced);
  EXPECT_EQ(p.instead, "");
}

// Two pulleys on one shaft share its load by slip, which the quasi-static solution refuses.
TEST(OperatingPoint, WithoutAQuasiStaticSolutionIsRestAndSaysSo) {
  SceneSpec scene = drives::two_pulleys(128, 500, 140, 80, 900);
  scene.pulley.push_back(drives::pulley("third", 200, 350, 100));
  scene.torsional_spring = {{"shaft", "driven", "third", 1500, 0}};
  const OperatingPoint p = operating_point(compile(scene), 1000);
  for (const double tension : p.tension) EXPECT_NEAR(tension, 900, 1e-6);
  EXPECT_FALSE(p.balanced);
  EXPECT_FALSE(p.slack);
  EXPECT_NE(p.instead.find("joined by shafts"), p.instead.npos) << p.instead;
  EXPECT_NE(p.instead.find("900 N"), p.instead.npos) << p.instead;
}

// One damped oscillator: the frequency falls by sqrt(1 - zeta^2), zeta = c / (2 sqrt(k J)).
TEST(DampedModes, OfAShaftWithADamperIsTheDampedOscillator) {
  SceneSpec scene = drives::two_pulleys(128, 400, 100, 100, 500);
  scene.belt.axial_damping_n_s = 0;
  scene.body = {body("rotor", 0.002)};
  scene.torsional_spring = {{"shaft", "rotor", "driver", 1500, 0.6}};  // the driver stands
  const double zeta = 0.6 / (2 * std::sqrt(1500 * 0.002));
  const double closed = std::sqrt((1 - zeta * zeta) * 1500 / 0.002) / (2 * pi);
  for (const DampedMode& mode : solve_modes(compile(scene), {"rest", 0, 0}).arms.at(0).damped)
    if (std::abs(mode.frequency_hz - closed) < 1e-4 * closed) {
      EXPECT_NEAR(mode.damping_ratio, zeta, 1e-6);
      return;
    }
  ADD_FAILURE() << "no vibration at " << closed << " Hz";
}

TEST(Crossings, LieOnTheirOrderAndFlagTheRangesTheyAreNear) {
  const Model m = compile(drives::shipped("baseline"));
  const auto found = crossings(campbell(m), m.scene.range);
  ASSERT_FALSE(found.empty());
  int flagged = 0;
  for (const Crossing& c : found) {
    EXPECT_NEAR(c.frequency_hz, c.order * c.crank_rpm / 60, 1e-9);
    EXPECT_GE(c.crank_rpm, 0.95 * 700 - 1e-9);
    EXPECT_LE(c.crank_rpm, 1.05 * 2100 + 1e-9);
    bool near = false;
    for (const RangeSpec& r : m.scene.range) near = near || std::abs(c.crank_rpm / r.crank_rpm - 1) <= 0.05;
    EXPECT_EQ(near, c.near.has_value()) << c.mode << " " << c.crank_rpm;
    flagged += near;
  }
  EXPECT_GT(flagged, 0);
}

// Ring-down ------------------------------------------------------------------------------------------------------

/// Frequencies of the highest peaks, lowest first, of a windowed signal between two frequencies, found on a fine grid:
/// lines of at least `share` of the tallest.
std::vector<double> peaks(const std::vector<double>& signal, double dt, double from, double to, double share) {
  const double step = 0.05, n = static_cast<double>(signal.size());
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / n;
  std::vector<double> height;
  for (double f = from; f <= to; f += step) {
    double re = 0, im = 0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
      // Blackman-Harris: side lobes below 1e-4 would not be taken for modes.
      const double phase = 2 * pi * (i + 0.5) / n;
      const double window =
          0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) - 0.01168 * std::cos(3 * phase);
      const double x = window * (signal[i] - mean);
      re += x * std::cos(2 * pi * f * dt * i);
      im += x * std::sin(2 * pi * f * dt * i);
    }
    height.push_back(std::hypot(re, im));
  }
  const double tallest = *std::max_element(height.begin(), height.end());
  std::vector<double> found;
  for (std::size_t k = 1; k + 1 < height.size(); ++k)
    if (height[k] > height[k - 1] && height[k] > height[k + 1] && height[k] > share * tallest)
      found.push_back(from + step * k);
  return found;
}

/// A drive at rest without losses in the belt, gripped so hard that nothing slips.
SceneSpec quiet(SceneSpec scene) {
  scene.belt.axial_damping_n_s = 1;
  scene.belt.bending_damping_n_m2_s = 0;
  scene.belt.friction_front = scene.belt.friction_back = 2;
  for (PulleySpec& p : scene.pulley) p.friction.reset();
  scene.contact.anchor_share = 1;  // the velocity element would damp the anchors
  return scene;
}

/// Settles, taps a body, and returns its speed every 0.2 ms for `seconds`.
std::vector<double> tap(const SceneSpec& scene, const std::string& name, double rad_s, double seconds) {
  drives::Drive drive(scene);
  const int b = body_index(drive.model, name);
  drive.run_to(0.1);
  drive.q().speed[b] += rad_s;
  const double begin = drive.simulator.time(), dt = 2e-4;
  std::vector<double> speed;
  while (drive.simulator.time() < begin + seconds) {
    drive.simulator.advance();
    if (drive.simulator.time() >= begin + dt * static_cast<double>(speed.size())) speed.push_back(drive.q().speed[b]);
  }
  return speed;
}

/// The first `count` predicted modes against the peaks nearest to them, 2 %.
void expect_peaks(const std::string& what, const std::vector<double>& found, const std::vector<double>& predicted,
                  std::size_t count) {
  ASSERT_GE(predicted.size(), count) << what;
  ASSERT_GE(found.size(), count) << what;
  for (std::size_t k = 0; k < count; ++k) {
    drives::report(what + ", mode " + std::to_string(k + 1) + " Hz", found[k], predicted[k]);
    EXPECT_NEAR(found[k] / predicted[k], 1, 0.02) << what;
  }
}

TEST(RingDown, OfThreePulleysHasTheFirstTwoModes) {
  SceneSpec scene = quiet(drives::two_pulleys(320, 500, 140, 80, 900));
  scene.pulley.push_back(drives::pulley("third", 200, 350, 100));
  scene.pulley.back().inertia_kg_m2 = 0.006;
  const Model model = compile(scene);
  const auto predicted = frequencies(model, ArmState::none), stiff = frequencies(model, ArmState::none, rigid_grip());
  const auto found = peaks(tap(scene, "driven", 0.3, 0.8), 2e-4, 10, 400, 0.01);
  expect_peaks("three pulleys", found, predicted, 2);
  std::printf("    a belt that cannot creep on its pulleys would have %.2f and %.2f Hz\n", stiff.at(0), stiff.at(1));
}

TEST(RingDown, OfTheThesisDriveHasTheFirstTwoModesWithTheArmFreeAndStuck) {
  SceneSpec scene = quiet(drives::shipped("baseline"));
  scene.gear_pair.at(0).backlash_mm = 0;  // at rest the teeth carry nothing
  for (TorsionalSpringSpec& s : scene.torsional_spring)
    s.damping_n_m_s_per_rad = std::min(s.damping_n_m_s_per_rad, 0.1);
  for (const ArmState arm : {ArmState::stuck, ArmState::free}) {
    if (arm == ArmState::free) scene.tensioner->friction_torque_n_m = 0;
    const auto predicted = frequencies(compile(scene), arm);
    const auto found = peaks(tap(scene, "drive", 0.3, 1.2), 2e-4, 5, 150, 0.01);
    expect_peaks(arm == ArmState::free ? "arm free" : "arm stuck", found, predicted, 2);
  }
}

}  // namespace
}  // namespace beltlife
