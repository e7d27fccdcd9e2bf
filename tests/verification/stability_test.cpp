// Owns the verification of stability: the predicted step limits, and how a run that diverges is reported.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/run.h"
#include "sim/scene/scene_io.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

/// Growth a step (logarithm) of x'' + c x' + w2 x = 0 under the scheme's own formulas, over many steps.
double growth(Scheme scheme, double w2, double c, double h) {
  const double w = std::sqrt(w2);
  double x = 1, v = 0.3 * w, logarithm = 0;
  constexpr int warm = 2000, counted = 20000;
  for (int i = 0; i < warm + counted; ++i) {
    if (i == warm) logarithm = 0;
    if (scheme == Scheme::symplectic_euler) {
      v += h * (-w2 * x - c * v);
      x += h * v;
    } else {
      const double a0 = -w2 * x - c * v, v1 = v + h * a0, x1 = x + 0.5 * h * (v + v1);
      const double next = v + 0.5 * h * (a0 - w2 * x1 - c * v1);
      x += 0.5 * h * (v + next);
      v = next;
    }
    if (i % 8 == 0) {
      const double size = std::hypot(w * x, v);
      logarithm += std::log(size);
      x /= size;
      v /= size;
    }
  }
  return logarithm / counted;
}

TEST(ModeLimit, IsWhereTheSchemesOwnIterationBeginsToGrow) {
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Scheme scheme : {Scheme::thesis, Scheme::symplectic_euler})
    for (int i = 0; i < 60; ++i) {
      const double w = std::pow(10, 1 + 5 * unit(random)), ratio = std::pow(10, -2 + 4 * unit(random)),
                   c = 2 * ratio * w;
      const double limit = mode_limit(w * w, c);
      // 1e-3 a step is above what a bounded swing of the norm leaves after 20000 steps, ln(100)/20000, and below the
      // growth 2 % past a limit, 0.02 and more.
      const auto grows = [&](double h) { return growth(scheme, w * w, c, h) > 1e-3; };
      EXPECT_FALSE(grows(0.98 * limit)) << enum_name(scheme) << " w " << w << " c " << c;
      EXPECT_TRUE(grows(1.02 * limit)) << enum_name(scheme) << " w " << w << " c " << c;
    }
}

TEST(ModeLimit, OfADamperAloneIsTwoOverItsRateAndOfASpringAloneTwoOverItsFrequency) {
  // A closed form: rounding only.
  EXPECT_NEAR(mode_limit(0, 1e6), 2e-6, 1e-15);
  EXPECT_NEAR(mode_limit(1e10, 0), 2e-5, 1e-15);
}

TEST(StepLimits, AreSortedAndTheStableStepIsBelowAllOfThem) {
  for (const char* name : {"baseline.toml", "two_pulley.toml", "accessory_drive.toml", "spinning_ring.toml"})
    for (const Scheme scheme : {Scheme::thesis, Scheme::symplectic_euler}) {
      const Model model = compile(read_scene(std::string(BELTLIFE_SCENES "/") + name).scene);
      const auto limits = step_limits(model, scheme);
      for (std::size_t i = 1; i < limits.size(); ++i) EXPECT_LE(limits[i - 1].limit_s, limits[i].limit_s) << name;
      EXPECT_LT(stable_step(model, scheme), limits.front().limit_s) << name;
      EXPECT_GT(stable_step(model, scheme), 0.5 * limits.front().limit_s) << name;
    }
}

TEST(StepLimits, OfTheThesisDriveAreThoseOfItsDampers) {
  const Model model =
      compile(read_scene(BELTLIFE_SCENES "/baseline.toml", {"belt.elements=513", "solver.scheme=thesis"}).scene);
  const auto limit = [&](const char* name) {
    for (const auto& l : step_limits(model, Scheme::thesis))
      if (l.name == name) return l.limit_s;
    return 0.0;
  };
  const double l0 = 2.578 / 513, m = 0.4 * l0;
  // 2 / rate: axial damping alone (the anchor's frequency adds little), bending damping, the turbine shaft.
  EXPECT_NEAR(limit("friction anchor"), 2 / (4 * 10 / (l0 * m)), 0.02 * 5e-7);
  EXPECT_NEAR(limit("bending"), 2 / (16 * 5e-5 / (l0 * l0 * l0 * m)), 0.02 * 6e-7);
  EXPECT_NEAR(limit("torsional spring turbine_shaft"), 2 / (4 * (1 / 3e-6 + 1 / 6.56e-5)), 0.02 * 1.4e-6);
  EXPECT_GT(limit("axial belt wave and damping, friction slope"), 3e-7);  // the step that the thesis took
}

struct Overstep {
  Model model;
  RunPlan plan;
  double step;

  explicit Overstep(const std::vector<std::string>& further = {}) {
    // At 512 elements the belt is what limits the step: 1.6 of its limits are still half of the turbine shaft's.
    std::vector<std::string> settings{"profile.settle_s=0.005", "profile.ramp_s=0.05", "profile.hold_s=0.05",
                                      "profile.evaluate_s=0.05", "solver.scheme=symplectic_euler"};
    settings.insert(settings.end(), further.begin(), further.end());
    SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml", settings).scene;
    const double limit = step_limits(compile(scene), scene.solver.scheme).front().limit_s;
    scene.solver.step_s = 1.6 * limit;
    model = compile(scene);
    plan = plan_range(scene, scene.range[2]);
    step = run_step(model);
  }
};

TEST(Divergence, OfTheBaselineAtSixTenthsPastTheLimitIsReportedWithTimePlaceCauseAndAdvice) {
  const Overstep o;
  const RunRecord record = run(o.model, o.plan).record;
  EXPECT_EQ(record.status.state, RunState::diverged);
  EXPECT_GT(record.status.time_s, 0);
  EXPECT_LT(record.status.time_s, o.plan.end_s);
  EXPECT_FALSE(record.status.where.empty());
  EXPECT_NE(record.status.cause.find("step"), std::string::npos) << record.status.cause;
  EXPECT_NE(record.status.advice.find("solver.step_s"), std::string::npos) << record.status.advice;
}

TEST(Divergence, KeepsWhatWasRecordedAndMarksItIncomplete) {
  // Sampled so often, with its window open from the start, that it has recorded something when it blows up.
  Overstep o({"solver.sample_rate_hz=1e5"});
  o.plan.windows[0].begin_s = 0;
  const RunRecord record = run(o.model, o.plan).record;
  ASSERT_EQ(record.status.state, RunState::diverged);
  ASSERT_EQ(record.windows.size(), 1u);
  EXPECT_FALSE(record.windows[0].complete);
  EXPECT_GT(record.windows[0].last_sample, record.windows[0].first_sample);
  EXPECT_EQ(record.windows[0].last_sample, record.trace.time_s.size());
  for (const Channel& c : record.trace.channels) EXPECT_EQ(c.values.size(), record.trace.time_s.size()) << c.name;
  ASSERT_FALSE(record.trace.time_s.empty());
  EXPECT_LE(record.trace.time_s.back(), record.status.time_s);
  EXPECT_EQ(record.simulated_s, record.status.time_s);
}

TEST(Divergence, IsReportedWithinAMillisecondOfTheFirstElementAtHalfStrain) {
  const Overstep o;
  Simulator s(o.model, o.plan.profile, o.model.scene.solver.scheme, o.step);
  const BeltModel& belt = o.model.belt;
  const auto stretched = [&] {  // or pressed together: a belt that blows up does both
    for (int i = 0; i < belt.nodes; ++i)
      if (!(std::abs(1 / (s.work().inverse_length[i] * belt.element_length) - 1) < 0.5)) return true;
    return false;
  };
  do s.advance();
  while (!stretched() && s.time() < o.plan.end_s);
  const RunRecord record = run(o.model, o.plan).record;
  EXPECT_GE(record.status.time_s, s.time() - o.step);
  EXPECT_LT(record.status.time_s - s.time(), 1e-3);
}

TEST(StableStep, CarriesTheBaselineThroughAColdStart) {
  for (const Scheme scheme : {Scheme::thesis, Scheme::symplectic_euler}) {
    SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml",
                                 {"belt.elements=256", "profile.settle_s=0.005", "profile.ramp_s=0.05",
                                  "profile.hold_s=0.1", "profile.evaluate_s=0.05"})
                          .scene;
    scene.solver.scheme = scheme;
    const RunRecord record = run(compile(scene), plan_range(scene, scene.range[4])).record;
    EXPECT_TRUE(record.status.ok()) << record.status.cause;
    EXPECT_EQ(record.friction_overdamped_s, 0);
  }
}

}  // namespace
}  // namespace beltlife
