// Owns the verification of the time integrators: order in the step, restart, threads, agreement with each other.
#include "sim/schemes/scheme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "sim/run.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

class EitherScheme : public testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, EitherScheme, testing::Values(Scheme::thesis, Scheme::symplectic_euler),
                         [](const auto& info) { return std::string(enum_name(info.param)); });

SceneSpec scene_of(const char* name, std::vector<std::string> settings, Scheme scheme) {
  settings.push_back("solver.scheme=" + std::string(enum_name(scheme)));
  return read_scene(std::string(BELTLIFE_SCENES "/") + name, settings).scene;
}

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

/// Where the nodes are at 5 ms after a spinning ring of a coarse, soft belt was pressed oval.
std::vector<double> oval_ring(Scheme scheme, double step) {
  const Model model = compile(scene_of(
      "spinning_ring.toml", {"belt.elements=24", "belt.axial_stiffness_n=20000", "belt.axial_damping_n_s=5"}, scheme));
  const SpeedProfile rest;
  Simulator s(model, rest, scheme, step);
  Coordinates& q = s.state().q;
  for (int i = 0; i < model.belt.nodes; ++i) {
    const double oval = 1 + 0.02 * std::cos(4 * std::numbers::pi * i / model.belt.nodes);
    q.x[i] *= oval;
    q.y[i] *= oval;
  }
  const auto steps = std::llround(5e-3 / step);
  for (long long i = 0; i < steps; ++i) s.advance();
  std::vector<double> places;
  for (int i = 0; i < model.belt.nodes; ++i) places.insert(places.end(), {q.x[i], q.y[i]});
  return places;
}

double order_on_the_ring(Scheme scheme) {
  const std::vector<double> exact = oval_ring(Scheme::thesis, 2.5e-7);  // its own error is (1/8)^2 of the least below
  std::vector<double> steps{8e-6, 4e-6, 2e-6}, errors;
  for (const double h : steps) {
    const std::vector<double> places = oval_ring(scheme, h);
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) sum += (places[i] - exact[i]) * (places[i] - exact[i]);
    errors.push_back(std::sqrt(sum));
  }
  return order_of(steps, errors);
}

// The next order of the error bends the slope: h w = 0.1 for the fastest wave that the oval excites.
constexpr double bend = 0.1;

TEST(ThesisScheme, ConvergesWithTheSquareOfTheStep) { EXPECT_NEAR(order_on_the_ring(Scheme::thesis), 2, bend); }

TEST(SymplecticEuler, ConvergesWithTheStep) { EXPECT_NEAR(order_on_the_ring(Scheme::symplectic_euler), 1, bend); }

/// The baseline on its way up, so that contacts, friction, gears and tensioner are all at work.
struct Climb {
  Model model;
  SpeedProfile profile{{0, 0.005, 0.05}, {0, 0, 150}};
  Scheme scheme;
  double step;

  explicit Climb(Scheme chosen)
      : model(compile(scene_of("baseline.toml", {"belt.elements=256"}, chosen))),
        scheme(chosen),
        step(run_step(model)) {}
  Simulator simulator() const { return {model, profile, scheme, step}; }
};

State after(Simulator& s, double until) {
  while (s.time() < until) s.advance();
  return s.state();
}

TEST_P(EitherScheme, GoesOnFromASavedStateBitForBit) {
  const Climb climb(GetParam());
  Simulator through = climb.simulator();
  const State saved = after(through, 0.0301);
  const State end = after(through, 0.045);
  Simulator restarted = climb.simulator();
  restarted.restore(saved);
  EXPECT_TRUE(restarted.state() == saved);
  EXPECT_TRUE(after(restarted, 0.045) == end);
  EXPECT_FALSE(saved == end);
}

TEST_P(EitherScheme, GivesTheSameBitsInParallelThreadsAsOneAfterTheOther) {
  const Climb climb(GetParam());
  Simulator alone = climb.simulator();
  const State expected = after(alone, 0.03);
  State states[2];
  {
    std::jthread first([&] {
      Simulator s = climb.simulator();
      states[0] = after(s, 0.03);
    });
    std::jthread second([&] {
      Simulator s = climb.simulator();
      states[1] = after(s, 0.03);
    });
  }
  EXPECT_TRUE(states[0] == expected);
  EXPECT_TRUE(states[1] == expected);
}

TEST_P(EitherScheme, LeavesADriveAtRestAtRest) {
  const Climb climb(GetParam());
  const SpeedProfile rest;
  Simulator s(climb.model, rest, climb.scheme, climb.step);
  after(s, 0.1);
  const Coordinates& q = s.state().q;
  for (int b = 0; b < climb.model.bodies; ++b) EXPECT_LT(std::abs(q.speed[b]), 0.5) << climb.model.body_name[b];
  for (int i = 0; i < climb.model.belt.nodes; ++i) EXPECT_LT(std::hypot(q.vx[i], q.vy[i]), 0.1) << i;
}

double mean(const RunRecord& record, const char* name) {
  const Channel* channel = record.trace.find(name);
  const WindowRecord& w = record.windows.at(0);
  double sum = 0;
  for (std::size_t i = w.first_sample; i < w.last_sample; ++i) sum += channel->values[i];
  return sum / static_cast<double>(w.last_sample - w.first_sample);
}

TEST(Schemes, AgreeOnTheBaselineAtB100) {
  RunRecord records[2];
  const auto simulate = [&](int i, Scheme scheme) {
    const SceneSpec scene = scene_of("baseline.toml",
                                     {"belt.elements=256", "profile.settle_s=0.1", "profile.ramp_s=0.4",
                                      "profile.hold_s=0.6", "profile.evaluate_s=0.4"},
                                     scheme);
    records[i] = run(compile(scene), plan_range(scene, scene.range[2])).record;
  };
  simulate(0, Scheme::thesis);
  simulate(1, Scheme::symplectic_euler);
  ASSERT_TRUE(records[0].status.ok() && records[1].status.ok());
  // 0.5 %: the forces of symplectic Euler are first order in a step that is chosen for stability.
  for (const char* name :
       {"drive_shaft.speed_rpm", "drive_shaft.torque_n_m", "belt.tension_mean_n", "span.drive-idler_2.tension_n",
        "span.idler_7-drive.tension_n", "pulley.drive.normal_force_n", "pulley.crank.torque_n_m",
        "tensioner.arm_angle_rad", "driver.torque_n_m"})
    EXPECT_NEAR(mean(records[1], name) / mean(records[0], name), 1, 5e-3) << name;
}

}  // namespace
}  // namespace beltlife
