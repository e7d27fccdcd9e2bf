// Early end of a range: what counts as a change, which window is kept, and what stopping early costs.
#include "sim/eval/settling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/eval/evaluator.h"
#include "sim/eval/run_ranges.h"
#include "sim/plan.h"
#include "sim/run.h"

namespace beltlife {
namespace {

using Settings = std::vector<std::string>;

SceneSpec scene_of(const Settings& more = {}) {
  Settings settings{"solver.scheme=linearly_implicit", "solver.step_s=2e-5", "belt.elements=128",
                    "profile.settle_s=0.05",           "profile.ramp_s=0.1", "profile.hold_s=0.9",
                    "profile.evaluate_s=0.15"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(BELTLIFE_SCENES "/two_pulley.toml", settings).scene;
}

RangeSummary summary() {
  RangeSummary s;
  s.spans = {{"a-b", 100, 90, 110, 0, 0}, {"b-a", 200, 150, 250, 0, 0}};
  s.pulleys.resize(2);
  s.pulleys[1].slip_percent = 0.5;
  s.output.emplace();
  s.output->speed_rpm_mean = 1000;
  s.output->torque_n_m_mean = 10;
  s.output->orders = {{1, 10, 2, 0.1}, {2, 20, 30, 5}, {3, 30, std::nan(""), std::nan("")}};
  return s;
}

TEST(Settling, TheLargestChangeIsThatOfTheWorstNumberLookedAt) {
  const RangeSummary before = summary();
  const auto changed = [&](auto change) {
    RangeSummary after = before;
    change(after);
    return largest_change(before, after);
  };
  EXPECT_EQ(largest_change(before, before), 0);
  const double rounding = 1e-14;
  EXPECT_NEAR(changed([](RangeSummary& s) { s.spans[1].tension_n_mean = 202; }), 2.0 / 202, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.spans[0].tension_n_min = 81; }), 0.1, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.spans[0].tension_n_max = 121; }), 11.0 / 121, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.pulleys[1].slip_percent = 0.53; }), 0.03, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.output->speed_rpm_mean = 990; }), 0.01, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.output->orders[1].speed_rpm = 27; }), 0.1, rounding);
  EXPECT_NEAR(changed([](RangeSummary& s) { s.output->orders[1].torque_n_m = 4.5; }), 0.1, rounding);
  EXPECT_EQ(changed([](RangeSummary& s) { s.output->orders[0].speed_rpm = 1; }), 0);  // not the largest order
  EXPECT_NEAR(changed([](RangeSummary& s) {
                s.spans[0].tension_n_mean = 101;
                s.output->speed_rpm_mean = 900;
              }),
              0.1, rounding);
}

TEST(Settling, TheMeanTorqueOfTheOutputIsLookedAt) {
  const RangeSummary before = summary();
  RangeSummary after = before;
  after.output->torque_n_m_mean = 9;
  EXPECT_NEAR(largest_change(before, after), 0.1, 1e-14);
}

/// A run over blocks, to its end.
struct Blocks {
  explicit Blocks(const SceneSpec& scene) : model(compile(scene)), plan(plan_blocks(scene, scene.range[1])) {}
  Model model;
  RunPlan plan;
};

TEST(Settling, KeepsTheLastCompleteWindowAndItsChange) {
  const Blocks b(scene_of({"belt.elements=64", "profile.hold_s=0.2", "profile.evaluate_s=0.06"}));
  ASSERT_EQ(b.plan.windows.size(), 3u);
  const RunRecord whole = run(b.model, b.plan).record;
  ASSERT_TRUE(whole.status.ok());
  for (const WindowRecord& w : whole.windows) ASSERT_TRUE(w.complete);
  const double expected =
      largest_change(summarise(b.model, whole, whole.windows[1]), summarise(b.model, whole, whole.windows[2]));
  EXPECT_GT(expected, 0);
  RunRecord kept = whole;
  keep_last_window(b.model, kept);
  EXPECT_EQ(kept.settling_change, expected);
  ASSERT_EQ(kept.windows.size(), 1u);
  EXPECT_EQ(kept.windows[0].begin_s, whole.windows[2].begin_s);
  EXPECT_EQ(kept.windows[0].first_sample, whole.windows[2].first_sample);
  EXPECT_EQ(kept.windows[0].passes[0].normal_resolved, whole.windows[2].passes[0].normal_resolved);

  kept = whole;
  kept.windows[2].complete = false;  // ended early: never opened
  keep_last_window(b.model, kept);
  EXPECT_EQ(kept.settling_change,
            largest_change(summarise(b.model, whole, whole.windows[0]), summarise(b.model, whole, whole.windows[1])));
  EXPECT_EQ(kept.windows.at(0).begin_s, whole.windows[1].begin_s);

  kept = whole;
  kept.windows[1].complete = kept.windows[2].complete = false;
  keep_last_window(b.model, kept);
  EXPECT_FALSE(kept.settling_change);
  EXPECT_EQ(kept.windows.at(0).begin_s, whole.windows[0].begin_s);
}

// A whole stretch before the failure would otherwise pass for the range's result.
TEST(Settling, AFailedRunKeepsTheWindowInWhichItFailed) {
  const Blocks b(scene_of({"belt.elements=64", "profile.hold_s=0.2", "profile.evaluate_s=0.06"}));
  RunRecord whole = run(b.model, b.plan).record;
  whole.status.state = RunState::diverged;
  for (const std::size_t failed : {2u, 1u, 0u}) {
    whole.windows[failed].complete = false;
    RunRecord kept = whole;
    keep_last_window(b.model, kept);
    ASSERT_EQ(kept.windows.size(), 1u);
    EXPECT_FALSE(kept.windows[0].complete);
    EXPECT_EQ(kept.windows[0].begin_s, whole.windows[failed].begin_s);
    EXPECT_FALSE(kept.settling_change);
  }
}

TEST(Settling, IsSettledOnceTwoWindowsAgree) {
  const Blocks b(scene_of({"belt.elements=64", "profile.hold_s=0.2", "profile.evaluate_s=0.06"}));
  RunRecord record = run(b.model, b.plan).record;
  const double change =
      largest_change(summarise(b.model, record, record.windows[1]), summarise(b.model, record, record.windows[2]));
  EXPECT_TRUE(settled(b.model, record, change));
  EXPECT_FALSE(settled(b.model, record, 0.999 * change));
  record.windows[1].complete = record.windows[2].complete = false;
  EXPECT_FALSE(settled(b.model, record, 1e9));
}

/// The range "fast" alone.
EvaluatorOptions options() {
  EvaluatorOptions o;
  o.threads = 1;
  o.ranges = {"fast"};
  return o;
}

SceneSpec within(double tolerance, SceneSpec scene = scene_of()) {
  scene.profile.settled_within = tolerance;
  return scene;
}

double value(const PointResult& p, const std::string& name) {
  for (const Quantity& q : p.quantities)
    if (q.name == name) return q.value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

// 150 ms are 12 periods of the second order at 2500 r/min. 5 %: what the order of the torque still wanders from block
// to block, read from 150 samples.
TEST(Settling, ASteadyRangeStopsEarlyWithWhatTheFullRunGives) {
  const auto both = Evaluator(options()).evaluate({scene_of(), within(0.05)});  // one memo: two runs
  const PointResult &a = both[0], &b = both[1];
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(a.ranges[0]->simulated_s, 1.05, 1e-9);
  EXPECT_LT(b.ranges[0]->simulated_s, 0.8);
  EXPECT_LE(b.ranges[0]->settling_change, 0.05);
  EXPECT_GT(b.ranges[0]->settling_change, 0.0);
  EXPECT_FALSE(a.ranges[0]->settling_change);
  double worst = 0;
  for (const char* name :
       {"fast.driven.speed_rpm.mean", "fast.driven.torque_n_m.mean", "fast.span.driver-driven.tension_n.mean",
        "fast.span.driver-driven.tension_n.max", "fast.span.driven-driver.tension_n.mean",
        "fast.span.driven-driver.tension_n.min", "fast.pulley.driven.hub_load_n.mean"}) {
    worst = std::max(worst, std::abs(value(b, name) / value(a, name) - 1));
    EXPECT_NEAR(value(b, name) / value(a, name), 1, 0.05) << name;  // the tolerance asked for
  }
  std::printf("    stopped at %.3f of %.3f s, last change %.2g, off the full run by %.2g, log10 life by %.2g\n",
              b.ranges[0]->simulated_s, a.ranges[0]->simulated_s, *b.ranges[0]->settling_change, worst,
              value(b, "log10_life_h") - value(a, "log10_life_h"));
}

TEST(Settling, AnUnsteadyRangeRunsToItsEnd) {
  // A slow swell of 185 ms, so that blocks of 150 ms never agree.
  SceneSpec scene = scene_of();
  scene.driver->harmonic.push_back({"swell", 0.13, 0, {2500}, {300}});
  const PointResult p = Evaluator(options()).evaluate({within(0.005, scene)}).front();
  ASSERT_TRUE(p.ok());
  EXPECT_NEAR(p.ranges[0]->simulated_s, 1.05, 1e-9);
  EXPECT_GT(p.ranges[0]->settling_change, 0.005);
}

TEST(Settling, EarlyEndsAreEachPointsOwn) {
  const SceneSpec steady = within(0.05);
  SceneSpec swelling = steady;
  swelling.driver->harmonic.push_back({"swell", 0.13, 0, {2500}, {300}});
  const auto together = Evaluator(options()).evaluate({steady, swelling});
  const PointResult alone = Evaluator(options()).evaluate({steady}).front();
  EXPECT_LT(together[0].ranges[0]->simulated_s, together[1].ranges[0]->simulated_s);
  ASSERT_EQ(together[0].quantities.size(), alone.quantities.size());
  for (std::size_t i = 0; i < alone.quantities.size(); ++i)
    EXPECT_TRUE(together[0].quantities[i].value == alone.quantities[i].value || std::isnan(alone.quantities[i].value))
        << alone.quantities[i].name;
}

// Packs keep to one tolerance; a point's own is what counts.
TEST(Settling, TolerancesOfOneBatchAreEachPointsOwn) {
  const std::vector<SceneSpec> batch{scene_of(), within(0.05), within(1e-6), within(0.5)};
  const auto p = Evaluator(options()).evaluate(batch);
  EXPECT_NEAR(p[0].ranges[0]->simulated_s, 1.05, 1e-9);
  EXPECT_NEAR(p[2].ranges[0]->simulated_s, 1.05, 1e-9);
  EXPECT_NEAR(p[3].ranges[0]->simulated_s, 0.45, 1e-9);  // two stretches agree within a half whatever they hold
  EXPECT_GT(p[1].ranges[0]->simulated_s, 0.44);
  ASSERT_EQ(p[0].quantities.size(), p[2].quantities.size());
  for (std::size_t i = 0; i < p[0].quantities.size(); ++i)  // run to its end, it is the full run to the bit
    EXPECT_TRUE(p[0].quantities[i].value == p[2].quantities[i].value || std::isnan(p[0].quantities[i].value))
        << p[0].quantities[i].name;
}

TEST(Settling, RangesRunAloneEndEarlyAndLeaveOneWindow) {
  for (const char* scheme : {"linearly_implicit", "symplectic_euler"}) {
    const bool implicit = scheme[0] == 'l';
    SceneSpec scene = scene_of(
        {"belt.elements=64", "profile.hold_s=0.4", "profile.evaluate_s=0.06", std::string("solver.scheme=") + scheme});
    if (!implicit) scene.solver.step_s.reset();
    const Model full_model = compile(scene);
    const auto full_plans = plans_of(scene, {"fast"}, nullptr);
    EXPECT_EQ(full_plans[0].windows.size(), 1u);
    const RunRecord full = run_plans(full_model, full_plans, 1)[0].record;
    EXPECT_FALSE(full.settling_change);
    scene.profile.settled_within = 0.2;
    const Model model = compile(scene);
    double done = 0;
    const auto plans = plans_of(scene, {"fast"}, nullptr);
    const RunRecord early = run_plans(model, plans, 1, [&](double s) { done = s; })[0].record;
    ASSERT_TRUE(early.status.ok());
    EXPECT_LT(early.simulated_s, 0.5) << scheme;
    EXPECT_NEAR(done, 0.55, 1e-9);
    ASSERT_EQ(early.windows.size(), 1u);
    EXPECT_TRUE(early.windows[0].complete);
    EXPECT_NEAR(early.windows[0].end_s, early.simulated_s, 1e-4);
    EXPECT_LE(early.settling_change.value(), 0.2);
    // Up to there it is the same run, to the bit: the sampled speeds are its first ones.
    for (std::size_t i = 0; i < early.trace.time_s.size(); ++i)
      ASSERT_EQ(early.trace.channels[1].values[i], full.trace.channels[1].values[i]) << scheme << " " << i;

    scene.profile.settled_within = 1e-6;
    const Model strict = compile(scene);
    const RunRecord to_the_end = run_plans(strict, plans_of(scene, {"fast"}, nullptr), 1)[0].record;
    EXPECT_EQ(to_the_end.steps, full.steps);
    EXPECT_GT(to_the_end.settling_change.value(), 1e-6);
    EXPECT_EQ(to_the_end.windows[0].first_sample, full.windows[0].first_sample);
    EXPECT_EQ(to_the_end.windows[0].passes[0].normal_sampled, full.windows[0].passes[0].normal_sampled);
  }
}

TEST(Settling, TheWholeProfileAndADriveWithoutRangesGoOn) {
  const SceneSpec scene = within(0.05);
  EXPECT_FALSE(plan_profile(scene).settled_within);
  EXPECT_EQ(plan_profile(scene).windows.size(), scene.range.size());
  EXPECT_FALSE(plan_rest(scene).settled_within);
}

TEST(Settling, StretchesOfAMeasuredSpeedHaveTheirOwnMeanSpeeds) {
  const SceneSpec scene = within(0.05);
  const MeasuredSpeed measured{{0, 3}, {0, 3000}};
  const RunPlan blocks = plan_blocks(scene, scene.range[0], &measured);
  ASSERT_EQ(blocks.windows.size(), 6u);
  EXPECT_EQ(blocks.windows.back().crank_rpm, plan_range(scene, scene.range[0], &measured).windows[0].crank_rpm);
  for (std::size_t i = 1; i < blocks.windows.size(); ++i)
    EXPECT_NEAR(blocks.windows[i].crank_rpm - blocks.windows[i - 1].crank_rpm, 150, 1e-6);
}

}  // namespace
}  // namespace beltlife
