// Batches of points: equal to single runs, independent of threads and company, memo, refusals, retry, names.
#include "sim/eval/evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/eval/run_ranges.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

using Settings = std::vector<std::string>;

SceneSpec point(const Settings& more = {}) {
  Settings settings{"solver.scheme=linearly_implicit", "solver.step_s=2e-5",  "belt.elements=64",
                    "profile.settle_s=0.01",           "profile.ramp_s=0.05", "profile.hold_s=0.12",
                    "profile.evaluate_s=0.06"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(BELTLIFE_SCENES "/two_pulley.toml", settings).scene;
}

EvaluatorOptions options(LaneUse use = LaneUse::drives, int threads = 1) {
  EvaluatorOptions o;
  o.threads = threads;
  o.use = use;
  return o;
}

PointResult fresh(const SceneSpec& scene, const EvaluatorOptions& o = options()) {
  return Evaluator(o).evaluate({scene}).front();
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// The first quantity in which two points differ, empty if they are equal to the bit.
std::string difference(const PointResult& a, const PointResult& b) {
  if (a.ok() != b.ok()) return "ok";
  if (a.quantities.size() != b.quantities.size()) return "number of quantities";
  for (std::size_t i = 0; i < a.quantities.size(); ++i)
    if (a.quantities[i].name != b.quantities[i].name || !same(a.quantities[i].value, b.quantities[i].value))
      return a.quantities[i].name;
  return "";
}

double value(const PointResult& p, const std::string& name) {
  for (const Quantity& q : p.quantities)
    if (q.name == name) return q.value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

std::vector<std::string> names(const PointResult& p) {
  std::vector<std::string> list;
  for (const Quantity& q : p.quantities) list.push_back(q.name);
  return list;
}

TEST(Evaluator, GivesWhatRunsOneByOneGive) {
  const SceneSpec scene = point();
  const Model model = compile(scene);
  const auto plans = plans_of(scene, {}, nullptr);
  const auto outcomes = run_plans(model, plans, 1);
  for (const LaneUse use : {LaneUse::arcs, LaneUse::drives}) {
    const PointResult p = fresh(scene, options(use));
    ASSERT_TRUE(p.ok());
    double worst = 0;
    for (std::size_t r = 0; r < plans.size(); ++r)
      for (const Quantity& q : quantities_of(summarise(model, outcomes[r].record, outcomes[r].record.windows[0]))) {
        EXPECT_TRUE(use == LaneUse::drives || same(value(p, q.name), q.value)) << q.name;
        if (q.name.ends_with("tension_n.mean") || q.name.ends_with("torque_n_m.mean") ||
            q.name.ends_with("speed_rpm.mean") || q.name.ends_with("hub_load_n.mean"))
          worst = std::max(worst, std::abs(value(p, q.name) / q.value - 1));
      }
    std::printf("    %s differ from single runs by %.2g at most\n", use == LaneUse::arcs ? "arcs" : "drives", worst);
    EXPECT_LT(worst, 5e-4);  // the noise floor of the thesis' drive
  }
}

TEST(Evaluator, ResultsDependNeitherOnThreadsNorOnTheBatchToTheBit) {
  std::vector<SceneSpec> batch;
  for (int i = 0; i < 5; ++i)
    batch.push_back(point({"belt.axial_damping_n_s=" + std::to_string(2 + 5 * i), "profile.hold_s=0.08",
                           "profile.evaluate_s=0.05", "pulley.driven.pitch_diameter_mm=" + std::to_string(80 + i)}));
  for (const LaneUse use : {LaneUse::drives, LaneUse::arcs}) {
    const auto one = Evaluator(options(use, 1)).evaluate(batch), two = Evaluator(options(use, 2)).evaluate(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      ASSERT_TRUE(one[i].ok());
      EXPECT_EQ(difference(one[i], two[i]), "") << i;
      EXPECT_EQ(difference(one[i], fresh(batch[i], options(use))), "") << i;
    }
  }
}

TEST(Evaluator, PointsThatDifferInFatigueDataOrSharesShareTheirRuns) {
  const SceneSpec base = point();
  const std::vector<SceneSpec> variants{
      point({"fatigue.strength_mpa=12", "fatigue.flank_angle_deg=18", "fatigue.pass_force=percentile_99"}),
      point({"range.slow.duty_share=0.9", "range.fast.duty_share=0.1"}), point({"title=another"})};
  Evaluator e(options());
  const PointResult first = e.evaluate({base}).front();
  EXPECT_EQ(e.simulations(), 2u);
  const auto rest = e.evaluate(variants);
  EXPECT_EQ(e.simulations(), 2u);
  EXPECT_EQ(e.reused(), 6u);
  for (std::size_t i = 0; i < variants.size(); ++i) EXPECT_EQ(difference(rest[i], fresh(variants[i])), "") << i;
  EXPECT_NE(value(rest[0], "life_h"), value(first, "life_h"));
  EXPECT_NE(value(rest[1], "life_h"), value(first, "life_h"));
  EXPECT_EQ(rest[1].life.ranges[0].duty_share, 0.9);
  // Within one batch too, where nothing is in the memo yet.
  Evaluator together(options());
  const auto all = together.evaluate({base, variants[0], variants[1], base});
  EXPECT_EQ(together.simulations(), 2u);
  EXPECT_EQ(difference(all[1], rest[0]), "");
  EXPECT_EQ(difference(all[2], rest[1]), "");
  EXPECT_EQ(difference(all[3], first), "");
}

TEST(Evaluator, PointsThatDifferInAnythingElseAreRun) {
  const SceneSpec base = point();
  std::set<std::string> keys{simulation_key(base, "slow"), simulation_key(base, "fast")};
  std::size_t expected = 2;
  SceneSpec other = base;
  for (const std::string& path : number_paths(base)) {
    if (path.starts_with("fatigue.") || path.ends_with("duty_share") || path == "format") continue;
    other = base;
    const double old = get_number(base, path);
    // One bit is enough; counts change by one.
    set_number(other, path, old == std::floor(old) && std::abs(old) < 1e4 ? old + 1 : std::nextafter(old, 2 * old));
    keys.insert(simulation_key(other, "fast"));
    const bool elsewhere = path == "range.slow.crank_rpm";  // what another range runs at is no matter of this one
    EXPECT_EQ(keys.size(), expected += !elsewhere) << path;
  }
  for (const char* setting : {"profile.settled_within=0.01", "rotation=counterclockwise", "solver.scheme=thesis",
                              "pulley.driven.locked=true", "driver.control=pid", "pulley.driven.side=back"})
    EXPECT_TRUE(keys.insert(simulation_key(point({setting}), "fast")).second) << setting;
}

// The predicted stable step looks at the fastest range: what another range runs at changes this one's step.
TEST(Evaluator, AStepThatFollowsFromAllRangesIsPartOfTheMemo) {
  const Settings explicit_scheme{"solver.scheme=symplectic_euler", "profile.hold_s=0.02", "profile.evaluate_s=0.01",
                                 "profile.ramp_s=0.02"};
  SceneSpec slow = point(explicit_scheme), fast = slow;
  slow.solver.step_s.reset();
  fast.solver.step_s.reset();
  fast.range[1].crank_rpm = 9000;
  ASSERT_NE(run_step(compile(slow)), run_step(compile(fast)));
  Evaluator e(options());
  (void)e.evaluate({slow});
  const PointResult p = e.evaluate({fast}).front();
  EXPECT_EQ(p.ranges.at(0)->step_s, run_step(compile(fast)));
}

TEST(Evaluator, AMeasuredSpeedIsPlayedFromWhereTheRangeStands) {
  SceneSpec scene = point();
  SceneSpec swapped = scene;
  std::swap(swapped.range[0], swapped.range[1]);
  MeasuredSpeed measured{{0, 0.2, 0.6, 1}, {0, 900, 1100, 1900}};
  EvaluatorOptions o = options();
  o.measured = &measured;
  Evaluator e(o);
  (void)e.evaluate({scene});
  EXPECT_EQ(difference(e.evaluate({swapped}).front(), fresh(swapped, o)), "");
}

TEST(Evaluator, APointThatCannotBeBuiltHasProblemsAndDisturbsNoOther) {
  const SceneSpec base = point();
  SceneSpec broken = base;
  broken.pulley[1].x_mm = 60;  // inside the driver
  std::vector<int> calls(4, 0);
  Evaluator e(options(LaneUse::drives, 2));
  const auto p =
      e.evaluate({broken, base, broken, point({"belt.friction_front=0.5"})}, [&](std::size_t i, const PointResult& r) {
        ++calls[i];
        EXPECT_EQ(r.problems.empty(), i % 2 == 1);
        EXPECT_EQ(r.ok(), i % 2 == 1);
      });
  EXPECT_EQ(calls, (std::vector<int>{1, 1, 1, 1}));
  ASSERT_FALSE(p[0].problems.empty());
  EXPECT_FALSE(p[0].problems[0].what.empty());
  EXPECT_TRUE(p[0].ranges.empty());
  EXPECT_TRUE(p[0].quantities.empty());
  EXPECT_EQ(difference(p[1], fresh(base)), "");
  EXPECT_EQ(e.simulations(), 4u);
}

TEST(Evaluator, APointWithoutARangeThatIsAskedForDisturbsNoOther) {
  SceneSpec base = point(), renamed = base;
  renamed.range[1].name = "faster";
  EvaluatorOptions o = options();
  o.ranges = {"fast"};
  Evaluator e(o);
  const auto p = e.evaluate({renamed, base});
  EXPECT_FALSE(p[0].problems.empty());
  ASSERT_TRUE(p[1].ok());
  EXPECT_EQ(p[1].ranges.size(), 1u);
}

TEST(Evaluator, CallsBackOnceAPointWhereverItsRangesComeFrom) {
  const SceneSpec base = point(), stiffer = point({"belt.axial_stiffness_n=120000"});
  Evaluator e(options(LaneUse::drives, 2));
  (void)e.evaluate({base});
  std::vector<int> calls(5, 0);
  std::vector<PointResult> seen(5);
  const auto p = e.evaluate({base, stiffer, stiffer, base, point({"range.fast.crank_rpm=2400"})},
                            [&](std::size_t i, const PointResult& r) {
                              ++calls[i];
                              seen[i] = r;
                            });
  EXPECT_EQ(calls, (std::vector<int>{1, 1, 1, 1, 1}));
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(difference(p[i], seen[i]), "") << i;
  EXPECT_EQ(e.simulations(), 5u);  // two, two, and the one range that the last point has to itself
}

TEST(Evaluator, QuantitiesHaveTheNamesOfTheSceneInOrder) {
  for (const SceneSpec& scene :
       {point(), point({"driver.body=driven"}),
        read_scene(BELTLIFE_SCENES "/overrunning_alternator.toml",
                   {"solver.scheme=linearly_implicit", "solver.step_s=2e-5", "belt.elements=128",
                    "profile.settle_s=0.01", "profile.ramp_s=0.05", "profile.hold_s=0.05", "profile.evaluate_s=0.04"})
            .scene}) {
    const PointResult p = fresh(scene);
    ASSERT_TRUE(p.ok());
    EXPECT_EQ(names(p), quantity_names(compile(scene)));
  }
}

SceneSpec thrown() { return point({"torque.load.torques_n_m=[1e6, 1e6, 1e6]", "torque.load.speeds_rpm=[1, 2, 3]"}); }

TEST(Evaluator, APointThatFailsSaysSoAndNamesNothingThatTheSceneDoesNotHave) {
  const SceneSpec failing = thrown();
  Evaluator e(options());
  const auto p = e.evaluate({failing, point()});
  EXPECT_FALSE(p[0].ok());
  EXPECT_TRUE(p[0].problems.empty());
  ASSERT_EQ(p[0].ranges.size(), 2u);
  for (const auto& r : p[0].ranges) {
    EXPECT_FALSE(r->status.ok());
    EXPECT_TRUE(r->retried);
    EXPECT_EQ(r->step_s, 1e-5);
  }
  EXPECT_TRUE(p[0].life.error.has_value());
  EXPECT_TRUE(std::isnan(p[0].life.life_h));
  const auto known = quantity_names(compile(failing));
  for (const std::string& name : names(p[0])) EXPECT_NE(std::ranges::find(known, name), known.end()) << name;
  EXPECT_EQ(difference(p[1], fresh(point())), "");
  EXPECT_EQ(e.simulations(), 4u);
}

TEST(Evaluator, ARangeThatFailsAtItsStepIsRunAgainAtHalf) {
  // An axial damper strong enough to be what limits the step: beyond it the belt blows up at once.
  SceneSpec scene = point({"solver.scheme=symplectic_euler", "belt.axial_damping_n_s=100"});
  const double limit = step_limits(compile(scene), Scheme::symplectic_euler).front().limit_s;
  scene.solver.step_s = 1.5 * limit;
  const double step = run_step(compile(scene));
  ASSERT_GT(step, 1.2 * limit);
  const PointResult p = fresh(scene);
  ASSERT_TRUE(p.ok());
  for (const auto& r : p.ranges) {
    EXPECT_TRUE(r->retried);
    EXPECT_NEAR(r->step_s, 0.5 * step, 1e-12 * step);
  }
  scene.solver.step_s = 0.5 * step;
  const PointResult half = fresh(scene);
  EXPECT_FALSE(half.ranges.at(0)->retried);
  EXPECT_EQ(difference(p, half), "");
  scene.solver.step_s = 1.5 * limit;
  EvaluatorOptions once = options();
  once.retry = false;
  const PointResult failed = fresh(scene, once);
  EXPECT_FALSE(failed.ok());
  EXPECT_FALSE(failed.ranges.at(0)->retried);
}

TEST(Evaluator, EarlyEndReadsEveryPointByItsOwnNames) {
  const Settings early{"profile.evaluate_s=0.03", "profile.settled_within=0.05"};
  const SceneSpec driven = point(early);
  SceneSpec driver = driven;
  driver.output->body = "driver";
  const auto p = Evaluator(options()).evaluate({driven, driver});
  ASSERT_TRUE(p[0].ok());
  ASSERT_TRUE(p[1].ok());
  EXPECT_EQ(difference(p[0], fresh(driven)), "");
  EXPECT_EQ(difference(p[1], fresh(driver)), "");
}

}  // namespace
}  // namespace beltlife
