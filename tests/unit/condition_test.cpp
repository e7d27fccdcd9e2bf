// Ranges in other conditions than the base one: models, packs, batches, statics, modes and limits are each range's own.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "optimize/layout/layout_limits.h"
#include "optimize/layout/order_distance.h"
#include "sim/eval/evaluator.h"
#include "sim/eval/run_ranges.h"
#include "sim/eval/solved_drive.h"
#include "sim/lanes/run_pack.h"
#include "sim/range_models.h"

namespace beltlife {
namespace {

constexpr DriveCondition base{}, loaded{.torque_factor = 1.25}, idle{.torque_factor = 0};

/// Ranges "slow" and "fast", both in the base condition.
SceneSpec drive(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{"solver.step_s=2e-5",  "belt.elements=64",    "profile.settle_s=0.01",
                                    "profile.ramp_s=0.05", "profile.hold_s=0.08", "profile.evaluate_s=0.06"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(BELTLIFE_SCENES "/two_pulley.toml", settings).scene;
}

SceneSpec in(SceneSpec scene, const DriveCondition& condition) {
  for (RangeSpec& range : scene.range) range.condition = condition;
  return scene;
}

SceneSpec with_loaded_fast(SceneSpec scene) {
  scene.range[1].condition = loaded;
  return scene;
}

EvaluatorOptions options(LaneUse use = LaneUse::drives) {
  EvaluatorOptions o;
  o.threads = 1;
  o.use = use;
  return o;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// The first channel in which two runs differ, empty if they are equal to the bit.
std::string difference(const RunRecord& a, const RunRecord& b) {
  if (!a.status.ok() || !b.status.ok() || a.steps != b.steps) return "run";
  for (std::size_t c = 0; c < a.trace.channels.size(); ++c) {
    const auto &x = a.trace.channels[c].values, &y = b.trace.channels[c].values;
    if (!std::equal(x.begin(), x.end(), y.begin(), y.end(), same)) return a.trace.channels[c].name;
  }
  return "";
}

/// The first quantity of a range in which two points differ, empty if they are equal to the bit.
std::string difference(const PointResult& a, const PointResult& b, const std::string& range) {
  if (!a.ok() || !b.ok()) return "point";
  for (std::size_t i = 0; i < a.quantities.size(); ++i)
    if (a.quantities[i].name.starts_with(range + ".") && !same(a.quantities[i].value, b.quantities[i].value))
      return a.quantities[i].name;
  return "";
}

TEST(Condition, ChangesTheModelThatIsCompiledAndNotTheDrive) {
  const SceneSpec scene = drive();
  const Model one = compile(scene), two = compile(scene, loaded);
  EXPECT_EQ(one.condition, base);
  EXPECT_EQ(two.condition, loaded);
  ASSERT_FALSE(one.torques.empty());
  for (std::size_t i = 0; i < one.torques.size(); ++i) EXPECT_EQ(two.torques[i].factor, 1.25 * one.torques[i].factor);
  EXPECT_EQ(two.belt.unstretched_length, one.belt.unstretched_length);
  EXPECT_EQ(two.statics.balance.tension, one.statics.balance.tension);
}

// Where the balance at rest is solved for, too: the pretension asks for a spring torque.
TEST(Condition, OfAModelAtHandIsWhatCompilingTheSceneGives) {
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/accessory_drive.toml",
                               {"belt.elements=64", "solver.step_s=2e-5", "profile.settle_s=0.01",
                                "profile.ramp_s=0.05", "profile.hold_s=0.02", "profile.evaluate_s=0.01"})
                        .scene;
  scene.tensioner->spring_torque_n_m.reset();
  scene.belt.pretension_n = 500;
  validate(scene);
  scene.range.front().condition = loaded;
  const RunPlan plan = plan_range(scene, scene.range.front());
  const Model built = compile(scene);
  EXPECT_EQ(difference(run(in_condition(built, loaded), plan).record, run(compile(scene, loaded), plan).record), "");
}

TEST(Condition, RangesOfOneShareAModel) {
  SceneSpec scene = drive();
  const Model built = compile(scene);
  EXPECT_EQ(&RangeModels(built).of(base), &built);
  EXPECT_THROW((void)RangeModels(built).of(loaded), std::logic_error);

  scene = with_loaded_fast(scene);
  scene.range.push_back({"fast_again", 1500, 0, loaded});
  const Model again = compile(scene);
  const RangeModels models(again);
  EXPECT_EQ(&models.of(scene.range[0].condition), &again);
  EXPECT_EQ(models.of(loaded).condition, loaded);
  EXPECT_EQ(&models.of(scene.range[1].condition), &models.of(scene.range[2].condition));
  // From a model of another condition: the base one is there, too.
  const RangeModels from_loaded(models.of(loaded));
  EXPECT_EQ(from_loaded.of(base).condition, base);
}

TEST(Condition, AModelOfAnotherIsRefused) {
  SceneSpec scene = with_loaded_fast(drive());
  const Model built = compile(scene);
  for (const char* scheme : {"linearly_implicit", "symplectic_euler"}) {
    SceneSpec with_scheme = scene;
    set_field(with_scheme, std::string("solver.scheme=") + scheme);
    EXPECT_THROW((void)run(compile(with_scheme), plan_range(with_scheme, with_scheme.range[1])), std::logic_error);
  }
  EXPECT_THROW((void)solve_quasi_static(built, scene.range[1]), std::logic_error);
  EXPECT_THROW((void)estimated_load(built, scene.range[1], solve_quasi_static(built, scene.range[0])),
               std::logic_error);
  EXPECT_THROW((void)solve_modes(built, scene.range[1]), std::logic_error);
}

TEST(Condition, DrivesThatDifferInItRunInOnePackAsIfAlone) {
  const SceneSpec scene = drive();
  std::vector<Model> models;
  std::vector<RunPlan> plans;
  for (const DriveCondition& condition : {base, loaded, idle}) {
    models.push_back(compile(scene, condition));
    plans.push_back(plan_range(scene, in(scene, condition).range[1]));
  }
  std::vector<PackMember> pack;
  for (std::size_t i = 0; i < models.size(); ++i) pack.push_back({&models[i], &plans[i]});
  const auto together = run_pack(pack, LaneUse::drives);
  for (std::size_t i = 0; i < pack.size(); ++i) {
    EXPECT_EQ(difference(together[i].record, run_pack({pack[i]}, LaneUse::drives).front().record), "") << i;
    EXPECT_NE(difference(together[i].record, together[(i + 1) % pack.size()].record), "") << i;
  }
}

TEST(Condition, OfEachRangeIsRunByPlansAndTheBaseOneByTheWholeProfile) {
  const SceneSpec plain = drive(), mixed = with_loaded_fast(plain);
  const auto plans = plans_of(mixed, {}, nullptr);
  const auto outcomes = run_plans(compile(mixed), plans, 1);
  EXPECT_EQ(difference(outcomes[0].record, run(compile(plain), plan_range(plain, plain.range[0])).record), "");
  EXPECT_EQ(difference(outcomes[1].record, run(compile(plain, loaded), plan_range(mixed, mixed.range[1])).record), "");
  EXPECT_NE(difference(outcomes[1].record, run(compile(plain), plan_range(plain, plain.range[1])).record), "");
  EXPECT_EQ(difference(run_plans(compile(mixed), {plan_profile(mixed)}, 1).front().record,
                       run(compile(plain), plan_profile(plain)).record),
            "");
}

TEST(Condition, OfEachRangeIsEvaluatedInABatchAsIfAlone) {
  for (const LaneUse use : {LaneUse::drives, LaneUse::arcs}) {
    Evaluator together(options(use));
    const auto all = together.evaluate({with_loaded_fast(drive()), drive(), in(drive(), loaded)});
    EXPECT_EQ(together.simulations(), 4u);  // two speeds, two conditions
    EXPECT_EQ(together.reused(), 2u);
    const auto alone = [&](const SceneSpec& scene) { return Evaluator(options(use)).evaluate({scene}).front(); };
    EXPECT_EQ(difference(all[0], alone(drive()), "slow"), "");
    EXPECT_EQ(difference(all[0], alone(in(drive(), loaded)), "fast"), "");
    EXPECT_EQ(difference(all[1], alone(drive()), "fast"), "");
    EXPECT_EQ(difference(all[2], alone(in(drive(), loaded)), "slow"), "");
    EXPECT_NE(difference(all[0], all[1], "fast"), "");
    EXPECT_NE(difference(all[0], all[2], "slow"), "");
  }
}

/// Doubles one field of a Spec, whichever it is.
struct ChangeOne {
  int at = 0, seen = 0;
  void operator()(std::string_view, double& value, const Rule&, std::string_view) {
    if (seen++ == at) value *= 2;
  }
};

TEST(Condition, IsPartOfTheMemoKeyInEveryField) {
  const SceneSpec scene = drive();
  int fields = 1;
  for (int i = 0; i < fields; ++i) {
    SceneSpec other = scene;
    ChangeOne change{i};
    other.range[1].condition.visit(change);
    fields = change.seen;
    EXPECT_NE(simulation_key(other, "fast"), simulation_key(scene, "fast")) << i;
    EXPECT_EQ(simulation_key(other, "slow"), simulation_key(scene, "slow")) << i;
  }
  EXPECT_GE(fields, 1);
}

TEST(Condition, OfEachRangeIsThatOfItsStaticsAndModes) {
  const SceneSpec plain = drive(), mixed = with_loaded_fast(plain);
  const SolvedDrive solved = solve_drive(compile(mixed)), as_base = solve_drive(compile(plain));
  const Model at_load = compile(plain, loaded);
  for (const SolvedDrive* s : {&solved, &as_base})
    for (const QuasiStaticRange& r : s->statics.ranges) ASSERT_FALSE(r.error) << *r.error;
  const auto torque = [](const QuasiStaticRange& r) { return r.pulleys.back().torque; };
  EXPECT_EQ(torque(solved.statics.ranges[0]), torque(as_base.statics.ranges[0]));
  EXPECT_EQ(torque(solved.statics.ranges[1]), torque(solve_quasi_static(at_load, mixed.range[1])));
  EXPECT_GT(std::abs(torque(solved.statics.ranges[1])), 1.2 * std::abs(torque(as_base.statics.ranges[1])));
  EXPECT_NE(solved.statics.estimate.ranges[1].life_h, as_base.statics.estimate.ranges[1].life_h);
  EXPECT_EQ(solved.modes.points[0].loop.tension, as_base.modes.points[0].loop.tension);
  EXPECT_EQ(solved.modes.points[1].loop.tension, solve_modes(at_load, mixed.range[1]).loop.tension);
  EXPECT_NE(solved.modes.points[1].loop.tension, as_base.modes.points[1].loop.tension);
  EXPECT_EQ(solved.modes.map.curves[0].frequency_hz, as_base.modes.map.curves[0].frequency_hz);  // the base one's
}

TEST(Condition, OfEachRangeIsThatOfALayoutsLimits) {
  // Of one speed, so that they may differ by their condition alone.
  const SceneSpec plain = drive({"range.slow.crank_rpm=1500", "range.fast.crank_rpm=1500"});
  const SceneSpec mixed = with_loaded_fast(plain);
  LayoutLimitsSpec spec;
  spec.min_slip_safety = 1;
  const auto limit = [&](const SceneSpec& scene, const std::string& range) {
    for (const Clearance& c : layout_limits(scene, spec))
      if (c.name == "slip safety in " + range) return c.value;
    ADD_FAILURE() << "no limit";
    return 0.0;
  };
  EXPECT_EQ(limit(mixed, "slow"), limit(plain, "slow"));
  EXPECT_EQ(limit(mixed, "fast"), limit(in(plain, loaded), "fast"));
  EXPECT_LT(limit(mixed, "fast"), limit(plain, "fast"));
  const auto all = order_distances(mixed, {2, 3}, true), at_load = order_distances(in(plain, loaded), {2, 3}, true);
  EXPECT_EQ(all[0].frequency_hz, order_distances(plain, {2, 3}, true)[0].frequency_hz);
  EXPECT_EQ(all[1].frequency_hz, at_load[1].frequency_hz);
}

}  // namespace
}  // namespace beltlife
