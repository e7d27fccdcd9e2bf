// Owns the claims between a study file and the simulator: starts, ranges, scenes of points, states and words of
// answers.
#include "sim/eval/study_input.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>

#include "sim/eval/drive_model.h"
#include "sim/eval/quantities.h"
#include "sim/eval/quantity_unit.h"
#include "sim/model.h"

namespace beltlife {
namespace {

using Names = std::vector<std::string>;

/// The smallest drive that is still one; its fast range takes 0.18 s.
SceneSpec drive(const Names& more = {}) {
  Names settings{"solver.scheme=linearly_implicit", "solver.step_s=2e-5",  "belt.elements=64",
                 "profile.settle_s=0.01",           "profile.ramp_s=0.05", "profile.hold_s=0.12",
                 "profile.evaluate_s=0.06"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(BELTLIFE_SCENES "/two_pulley.toml", settings).scene;
}

ParameterSpec parameter(std::optional<double> lower, std::optional<double> upper, bool log = false) {
  ParameterSpec p;
  p.path = "belt.friction_front";  // 0.6 in the scene
  p.lower = lower;
  p.upper = upper;
  p.log = log;
  return p;
}

std::optional<double> start_of(const ParameterSpec& p, const SceneSpec* scene) {
  ProblemSpec problem;
  problem.parameter = {p};
  complete_starts(problem, scene);
  return problem.parameter[0].start;
}

TEST(Starts, AreThoseOfTheSceneMovedToTheNearerBound) {
  const SceneSpec scene = drive();
  EXPECT_EQ(start_of(parameter({}, {}), &scene), 0.6);
  EXPECT_EQ(start_of(parameter(0.1, 1), &scene), 0.6);
  EXPECT_EQ(start_of(parameter(0.7, 1), &scene), 0.7);
  EXPECT_EQ(start_of(parameter(0.7, {}), &scene), 0.7);
  EXPECT_EQ(start_of(parameter(0.1, 0.5), &scene), 0.5);
  EXPECT_EQ(start_of(parameter({}, 0.5), &scene), 0.5);
  ParameterSpec own = parameter(0.1, 1);
  own.start = 0.3;
  EXPECT_EQ(start_of(own, &scene), 0.3) << "what the file says stays";
  own = parameter(0.1, 1);
  own.distribution = DistributionSpec{DistributionKind::normal, 0.9, 0.1, {}};
  EXPECT_EQ(start_of(own, &scene), 0.6) << "of a scene its value, not the mean of the scatter";
}

TEST(Starts, WithoutASceneAreTheMeanOrTheMiddle) {
  EXPECT_EQ(start_of(parameter(1, 4), nullptr), 2.5);
  EXPECT_EQ(start_of(parameter(1, 4, true), nullptr), 2);
  EXPECT_EQ(start_of(parameter(1, {}), nullptr), std::nullopt);
  EXPECT_EQ(start_of(parameter({}, {}), nullptr), std::nullopt);
  ParameterSpec scattered = parameter(1, 4);
  scattered.distribution = DistributionSpec{DistributionKind::lognormal, 1.5, 0.1, {}};
  EXPECT_EQ(start_of(scattered, nullptr), 1.5);
  scattered.distribution = DistributionSpec{};
  EXPECT_EQ(start_of(scattered, nullptr), 2.5);
}

TEST(RangesFor, AreThoseThatTheQuantitiesName) {
  const SceneSpec scene = drive();
  const Names all;  // empty stands for all
  EXPECT_EQ(ranges_for(scene, {"fast.life_h"}), Names{"fast"});
  EXPECT_EQ(ranges_for(scene, {"slow.life_h", "slow.drift"}), Names{"slow"});
  EXPECT_EQ(ranges_for(scene, {"fast.life_h", "slow.life_h"}), all);
  EXPECT_EQ(ranges_for(scene, {"fast.life_h", "life_h"}), all) << "the duty cycle needs every range";
  EXPECT_EQ(ranges_for(scene, {"log10_life_h"}), all);
  EXPECT_EQ(ranges_for(scene, {"faster.life_h"}), all) << "not of the range fast";
  EXPECT_EQ(ranges_for(drive({"range.slow.name=fast_2"}), {"fast_2.drift"}), Names{"fast_2"});
}

TEST(SceneAt, SetsNumbersTextAndSettings) {
  const SceneSpec base = drive();
  const SceneSpec s = scene_at(base, {"belt.friction_front", "solver.scheme", "pulley.driven.pitch_diameter_mm"},
                               {0.5, std::string("thesis"), 85.0});
  EXPECT_EQ(s.belt.friction_front, 0.5);
  EXPECT_EQ(s.solver.scheme, Scheme::thesis);
  EXPECT_EQ(get_number(s, "pulley.driven.pitch_diameter_mm"), 85);
  EXPECT_EQ(write_scene(scene_at(base, {}, {})), write_scene(base));
  const std::string column(settings_column), repeat(repeat_column);
  const auto two = scene_at(base, {column}, {std::string("belt.friction_front=0.4\nbelt.ribs=5")});
  EXPECT_EQ(two.belt.friction_front, 0.4);
  EXPECT_EQ(two.belt.ribs, 5);
  EXPECT_EQ(write_scene(scene_at(base, {column}, {std::string()})), write_scene(base));
  // Settings come first, wherever their column stands.
  EXPECT_EQ(scene_at(base, {"belt.ribs", column}, {7.0, std::string("belt.ribs=5")}).belt.ribs, 7);
  // No text takes away an optional value; a repeat changes nothing.
  EXPECT_EQ(scene_at(base, {"solver.step_s"}, {std::string()}).solver.step_s, std::nullopt);
  EXPECT_EQ(write_scene(scene_at(base, {repeat}, {3.0})), write_scene(base));
}

TEST(SceneAt, RefusesWhatIsNotAllowed) {
  const SceneSpec base = drive();
  const std::string column(settings_column);
  EXPECT_THROW(scene_at(base, {"belt.ribs"}, {0.5}), BadInput);
  EXPECT_THROW(scene_at(base, {"belt.friction_front"}, {-1.0}), BadInput);
  EXPECT_THROW(scene_at(base, {"belt.friction_front"}, {std::nan("")}), BadInput);
  EXPECT_THROW(scene_at(base, {"belt.elements"}, {100.0}), BadInput) << "of eight parts with this scheme";
  EXPECT_THROW(scene_at(base, {"belt.nothing"}, {1.0}), BadInput);
  EXPECT_THROW(scene_at(base, {"solver.scheme"}, {std::string("rk4")}), BadInput);
  EXPECT_THROW(scene_at(base, {column}, {std::string("belt.ribs")}), BadInput);
}

Answer answer_at(const Point& point, const Names& paths, const Names& quantities, DriveModelOptions options = {}) {
  options.threads = 1;
  return drive_model(drive(), paths, quantities, options)({point}, {}).at(0);
}

TEST(DriveModel, AnswersInStatesWithWords) {
  const Names paths{"belt.friction_front"}, wanted{"fast.pulley.driven.hub_load_n.mean"};
  const Answer ok = answer_at({0.6}, paths, wanted);
  EXPECT_EQ(ok.state, PointState::ok) << ok.reason;
  EXPECT_EQ(ok.reason, "");
  EXPECT_GT(ok.processor_s, 0);
  ASSERT_EQ(ok.values.size(), 1u);
  EXPECT_GT(ok.values[0], 0);

  const Answer limits = answer_at({-0.5}, paths, wanted);
  EXPECT_EQ(limits.state, PointState::infeasible);
  EXPECT_EQ(limits.reason.find("belt.friction_front: -0.5 is out of limits"), 0u) << limits.reason;
  const Answer overlap = answer_at({50.0}, {"pulley.driven.x_mm"}, wanted);
  EXPECT_EQ(overlap.state, PointState::infeasible);
  EXPECT_NE(overlap.reason.find("overlap"), overlap.reason.npos) << overlap.reason;

  const Answer budget = answer_at({0.6}, paths, wanted, {.step_budget = 1000});
  EXPECT_EQ(budget.state, PointState::timed_out);
  for (const char* part : {"range fast needs 9e+03 ", "2e-05 s", "more than the budget of 1e+03"})
    EXPECT_NE(budget.reason.find(part), budget.reason.npos) << budget.reason;
  EXPECT_EQ(answer_at({0.6}, paths, wanted, {.step_budget = 9001}).state, PointState::ok);

  const Answer diverged = answer_at({std::string("symplectic_euler")}, {"solver.scheme"}, wanted, {.retry = false});
  EXPECT_EQ(diverged.state, PointState::diverged);
  EXPECT_EQ(diverged.reason.find("range fast: diverged after "), 0u) << diverged.reason;

  // The window holds one turn at 1000 r/min; orders need two.
  const Answer missing = answer_at({0.6}, paths, {"slow.driven.speed_rpm.order_0.5"});
  EXPECT_EQ(missing.state, PointState::failed);
  EXPECT_EQ(missing.reason, "slow.driven.speed_rpm.order_0.5 has no finite value");
  for (const Answer& a : {limits, overlap, budget, diverged, missing}) EXPECT_TRUE(a.values.empty());
}

TEST(DriveModel, HearsOfEveryPointOnceAndInAnyCompany) {
  const Names paths{"belt.friction_front"}, wanted{"fast.pulley.driven.hub_load_n.mean"};
  const std::vector<Point> batch{{0.6}, {-1.0}, {0.5}, {0.6}};
  std::multiset<std::size_t> heard;
  const auto answers = drive_model(drive(), paths, wanted, {.threads = 2})(
      batch, [&](std::size_t i, const Answer&) { heard.insert(i); });
  EXPECT_EQ(heard, (std::multiset<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(answers[0].values, answers[3].values);
  EXPECT_EQ(answers[2].values, answer_at({0.5}, paths, wanted).values);
  EXPECT_EQ(answers[1].state, PointState::infeasible);
}

// What a point costs beside its simulation: only the flank's strength differs, so that all points share one run.
TEST(DriveModel, OverheadOfAPointIsRecorded) {
  std::vector<Point> batch;
  for (int i = 0; i < 100; ++i) batch.push_back({10 + 0.01 * i});
  const auto model = drive_model(drive(), {"fatigue.strength_mpa"}, {"fast.log10_life_h"}, {.threads = 1});
  model({batch[0]}, {});
  const auto begin = std::chrono::steady_clock::now();
  for (const Answer& a : model(batch, {})) EXPECT_TRUE(a.ok()) << a.reason;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  RecordProperty("overhead_ms_a_point", std::to_string(1e3 * took.count() / static_cast<double>(batch.size())));
}

// So that tables and pages can name the unit of whatever is asked for.
TEST(QuantityNames, StateAUnitOrAreKnownToHaveNone) {
  for (const char* scene : {"two_pulley", "baseline", "accessory_drive"}) {
    const Model model = compile(read_scene(std::string(BELTLIFE_SCENES) + "/" + scene + ".toml").scene);
    const Names names = quantity_names(model);
    EXPECT_GT(names.size(), 50u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << "a name twice";
    for (const std::string& name : names) {
      const bool share = name.ends_with(".energy_residual") || name.ends_with(".drift");
      EXPECT_EQ(unit_of_name(name).empty(), share) << name << ": " << unit_of_name(name);
    }
  }
}

}  // namespace
}  // namespace beltlife
