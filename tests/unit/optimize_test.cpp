// Owns the claims about the parts of an optimisation: designs and their scenes, scatter, ranks, fronts, last rounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "optimize/design_problem.h"
#include "optimize/fidelity_check.h"
#include "optimize/finalists.h"
#include "optimize/layout/layout_base.h"
#include "optimize/layout_search.h"
#include "optimize/pareto.h"
#include "optimize/scatter_draws.h"
#include "results/course/run_driver.h"
#include "sim/route/layout.h"
#include "tests/unit/study_fixture.h"

namespace beltlife {
namespace {

ParameterSpec between(const std::string& path, double lower, double upper, double start, bool log = false) {
  ParameterSpec p;
  p.path = path;
  p.lower = lower;
  p.upper = upper;
  p.start = start;
  p.log = log;
  return p;
}

/// The thesis' drive, restated, with an idler and the pivot to move.
struct Drive {
  LoadedProblem problem;
  OptimizationSpec spec;

  Drive() {
    problem.spec.scene = std::string(BELTLIFE_SCENES) + "/baseline.toml";
    problem.scene = load_scene(*problem.spec.scene, {});
    problem.scene->file.scene = layout_base(problem.scene->file.scene);
    problem.spec.parameter = {between("pulley.idler_5.x_mm", 30, 90, 60),
                              between("tensioner.pivot_y_mm", 540, 600, 570),
                              between("belt.friction_front", 0.2, 1.2, 0.6, true)};
    problem.spec.quantities = {"log10_life_h"};
    spec.objective.quantity = "log10_life_h";
  }
};

TEST(Optimize, StartsAtTheBitsOfTheSceneAndEndsOnTheBoundsThemselves) {
  Drive d;
  d.problem.spec.parameter[0] = between("pulley.idler_5.x_mm", 30.1, 90.7, 60);
  const DesignProblem design(d.problem, d.spec);
  EXPECT_EQ(design.values(design.start().x), (std::vector<double>{60, 570, 0.6}));
  EXPECT_EQ(write_scene(design.scene(design.start())), write_scene(d.problem.scene->file.scene));
  EXPECT_EQ(design.values({0, 0, 0}), (std::vector<double>{30.1, 540, 0.2}));
  EXPECT_EQ(design.values({1, 1, 1}), (std::vector<double>{90.7, 600, 1.2}));
  EXPECT_NEAR(design.values({0.5, 0.5, 0.5})[2], std::sqrt(0.2 * 1.2), 1e-15) << "with log = true in ln p; rounding";
}

TEST(Optimize, SceneOfADesignIsThatOfItsPoint) {
  Drive d;
  d.spec.choice.push_back({"pulley.idler_5.side", {"back", "front"}});
  const DesignProblem design(d.problem, d.spec);
  ASSERT_EQ(design.combinations(), 2u);
  for (const std::size_t combination : {0, 1}) {
    const Candidate c{combination, {0.25, 0.75, 0.5}};
    const SceneSpec of_point = scene_at(d.problem.scene->file.scene, design.columns(), design.point(c, ""));
    EXPECT_EQ(write_scene(design.scene(c)), write_scene(of_point));
    EXPECT_EQ(of_point.pulley[4].side, combination == 0 ? Side::back : Side::front) << "the scene's own comes first";
  }
}

TEST(Optimize, GeometryFollowsTheParametersAndForgetsTheDesignBefore) {
  Drive d;
  const DesignProblem design(d.problem, d.spec);
  const auto at_start = design.geometry(design.start());
  ASSERT_FALSE(at_start.empty());
  EXPECT_NE(design.geometry({0, {1, 0, 0.5}}), at_start);
  EXPECT_EQ(design.geometry(design.start()), at_start);
}

TEST(Optimize, QuasiStaticLimitsAreKeptFromTheFreeOnes) {
  Drive d;
  const std::size_t free = DesignProblem(d.problem, d.spec).limits({0, {0.5, 0.5, 0.5}}).size();
  d.spec.layout.emplace();
  d.spec.layout->limits.max_hub_load_n = 3000;
  d.problem.scene->file.scene.range.resize(1);  // each takes the time of a bending solution
  const DesignProblem design(d.problem, d.spec);
  EXPECT_EQ(design.limits(design.start()).size(), free);
  const auto running = design.running_limits(design.start());
  ASSERT_EQ(running.size(), 1u);
  EXPECT_EQ(running[0].name, "hub load in idle");
  EXPECT_EQ(design.scale_of(running[0]), 3000);
}

TEST(Optimize, RankCorrelationKnowsOrderOnlyAndSharesTies) {
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {1, 10, 100, 1e6}), 1);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {4, 3, 2, 1}), -1);
  // By hand: d = (0, 1, -1, 0), 1 - 6 * 2 / (4 * 15) = 0.8.
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 3, 2, 4}), 0.8, 1e-15);
  // Ranks 0.5 0.5 2 against 0 1 2: covariance 1.5, variances 1.5 and 2.
  EXPECT_NEAR(rank_correlation({5, 5, 7}, {1, 2, 3}), 1.5 / std::sqrt(1.5 * 2), 1e-15);
  EXPECT_EQ(rank_correlation({1, 1}, {1, 2}), 0);
  EXPECT_EQ(rank_correlation({1}, {2}), 0);
}

TEST(Optimize, QuantilesOfScatterAreThoseOfTheirDistributions) {
  ScatterSpec s;
  s.distribution = {DistributionKind::normal, 10, 2, {}};
  EXPECT_NEAR(quantile_of(s, 0.5), 10, 1e-12);
  EXPECT_NEAR(quantile_of(s, 0.975), 10 + 2 * 1.959963984540054, 1e-12) << "tables of the normal distribution";
  s.upper = 10;
  EXPECT_NEAR(quantile_of(s, 0.5), 10 - 2 * 0.6744897501960817, 1e-12) << "the lower half: its median is a quartile";
  EXPECT_LE(quantile_of(s, 1), 10);
  s.upper.reset();
  s.distribution.kind = DistributionKind::lognormal;
  EXPECT_NEAR(quantile_of(s, 0.5), 10 / std::sqrt(1.04), 1e-12) << "median = mean / sqrt(1 + variation^2)";
  s.lower = 2;
  s.upper = 6;
  s.distribution = {DistributionKind::uniform, {}, {}, {}};
  EXPECT_DOUBLE_EQ(quantile_of(s, 0.25), 3);
  s.distribution = {DistributionKind::triangular, {}, {}, 2.0};
  EXPECT_DOUBLE_EQ(quantile_of(s, 0.75), 4) << "share above x is ((6 - x) / 4)^2";
}

TEST(Optimize, DrawsFillEveryColumnEvenlyAndDependOnTheSeedAlone) {
  ScatterSpec s;
  s.lower = 0;
  s.upper = 1;
  const auto draws = scatter_draws({s, s}, 10, 3);
  EXPECT_EQ(draws, scatter_draws({s, s}, 10, 3));
  EXPECT_NE(draws, scatter_draws({s, s}, 10, 4));
  for (const std::size_t k : {0, 1}) {
    std::set<int> cells;
    for (const auto& row : draws) cells.insert(static_cast<int>(row[k] * 10));
    EXPECT_EQ(cells.size(), 10u) << "one in every tenth";
  }
}

Tried tried(double first, double second, bool feasible = true, Design x = {0.5}) {
  Tried t;
  t.candidate.x = std::move(x);
  t.outcome.state = PointState::ok;
  t.outcome.objective = first;
  t.outcome.second = second;
  t.feasible = feasible;
  return t;
}

TEST(Optimize, FrontHoldsWhatNoFeasibleDesignBeats) {
  OptimizationSpec spec;  // the first is made large, the second small
  spec.pareto.emplace();
  const std::vector<Tried> all{tried(1, 1), tried(3, 5), tried(2, 6), tried(4, 0, false), tried(2, 2), tried(3, 7)};
  EXPECT_EQ(front_of(spec, all), (std::vector<std::size_t>{1, 4, 0}));
  spec.objective.maximize = false;
  EXPECT_EQ(front_of(spec, all), (std::vector<std::size_t>{0})) << "it is best in both";
}

TEST(Optimize, FinalistsAreTheBestThatDiffer) {
  OptimizationSpec spec;
  const std::vector<Tried> all{tried(1, 0, true, {0.1}), tried(5, 0, true, {0.5}), tried(4.9, 0, true, {0.505}),
                               tried(9, 0, false, {0.9}), tried(3, 0, true, {0.7})};
  const auto chosen = selected(spec, all, 2);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].outcome.objective, 5);
  EXPECT_EQ(chosen[1].outcome.objective, 3) << "4.9 is within a hundredth of the best, 9 is infeasible";
}

Finalist finalist(const std::vector<double>& objectives) {
  Finalist f;
  for (const double v : objectives) f.replicates.push_back(tried(v, 0).outcome);
  f.outcome = f.replicates.front();
  return f;
}

TEST(Optimize, ComparisonIsOfPairsAndByStudentsT) {
  OptimizationSpec spec;
  // Differences 1, 2, 3: mean 2, error 1/sqrt(3), t = 3.4641 of 2 degrees: two-sided 0.9258 (tables), interval
  // +- 2.484.
  const Comparison c = compared(spec, finalist({11, 22, 33}), finalist({10, 20, 30}));
  EXPECT_DOUBLE_EQ(c.difference.mean, 2);
  EXPECT_NEAR(*c.difference.high, 2 + 4.302653 / std::sqrt(3), 1e-5) << "t of the table has six decimals";
  EXPECT_NEAR(*c.probability, 0.5 * (1 + 0.9258), 1e-4);
  EXPECT_EQ(c.words, "better, very likely");
  spec.objective.maximize = false;
  EXPECT_DOUBLE_EQ(compared(spec, finalist({11, 22, 33}), finalist({10, 20, 30})).difference.mean, -2);
  EXPECT_EQ(compared(spec, finalist({1, -1, 2, -2}), finalist({0, 0, 0, 0})).words, "cannot be told apart");
  EXPECT_FALSE(compared(spec, finalist({1}), finalist({2})).probability) << "one run each says nothing of chance";
}

TEST(Optimize, WinnerHasTheBestMeanNotTheLuckiestRun) {
  OptimizationSpec spec;
  EXPECT_EQ(winner(spec, {finalist({9, 1, 1}), finalist({8, 8, 8})}), 1u);
  spec.objective.maximize = false;
  EXPECT_EQ(winner(spec, {finalist({9, 1, 1}), finalist({8, 8, 8})}), 0u);
}

class OptimizeFile : public study_test::InFolder {
 protected:
  /// What the command says of a file that it refuses before anything runs.
  std::string said_of(const std::string& text) {
    study_test::write_text(folder / "o.toml", text);
    DriverOptions options;
    options.file = (folder / "o.toml").string();
    options.out = (folder / "o.h5").string();
    options.quiet = true;
    std::string words = study_test::refusal([&] { run_driver<LayoutSearch>(options, "optimize"); });
    EXPECT_EQ(files(), 1) << "something ran";
    return words;
  }
  const std::string scene_ = "scene = \"" + std::string(BELTLIFE_SCENES) + "/baseline.toml\"\n";
  const std::string life_ = "[objective]\nquantity = \"log10_life_h\"\n";
  const std::string x_ = "[[parameter]]\npath = \"pulley.idler_5.x_mm\"\nlower = 30\nupper = 90\n";
};

TEST_F(OptimizeFile, IsRefusedInWordsThatNameEveryFault) {
  study_test::expect_words(said_of(scene_ + life_), {"o.toml", "parameter: missing: there is nothing to vary"});
  study_test::expect_words(said_of(scene_ + life_ + "[[parameter]]\npath = \"pulley.idler_5.x_mm\"\nlower = 30\n" +
                                   "[[constraint]]\nquantity = \"hub_load_n.max\"\n"),
                           {"o.toml:4: parameter.0.upper: missing: a search goes from bound to bound",
                            "o.toml:7: constraint.0.upper: missing: this holds nothing"});
  study_test::expect_words(said_of(scene_ + "[objective]\nquantity = \"log10_live_h\"\n" + x_),
                           {"o.toml:3: objective.quantity: no quantity 'log10_live_h'", "log10_life_h"});
  study_test::expect_words(
      said_of(scene_ + life_ + x_ + "[[choice]]\npath = \"pulley.idler_5.side\"\nvalues = [\"front\", \"inside\"]\n"),
      {"choice.0.path: pulley.idler_5.side", "front, back"});
  study_test::expect_words(said_of(scene_ + life_ + x_ + "[layout]\nmin_wrap = 10\n"), {"o.toml:9: layout.min_wrap"});
  study_test::expect_words(said_of(scene_ + life_ + x_ + "[[scatter]]\npath = \"belt.friction_front\"\n"),
                           {"o.toml:8: scatter: without effect"});
  study_test::expect_words(said_of(scene_ + life_ + x_ + "[robust]\n[[scatter]]\npath = \"belt.friction_front\"\n" +
                                   "[[scatter]]\npath = \"pulley.idler_5.x_mm\"\nlower = 1\nupper = 2\n"),
                           {"scatter.0.distribution.kind: uniform needs the parameter's bounds",
                            "o.toml:12: scatter.1.path: pulley.idler_5.x_mm is a parameter"});
}

TEST_F(OptimizeFile, CannotVaryWhatIsSolvedForNorStartWithoutABudgetForEverySearch) {
  const std::string torque = "[[parameter]]\npath = \"tensioner.spring_torque_n_m\"\nlower = 30\nupper = 60\n";
  study_test::expect_words(
      said_of(scene_ + life_ + torque),
      {"o.toml:5: parameter.0.path", "is solved for while the pretension is held", "layout.hold_pretension = false"});
  study_test::expect_words(said_of(scene_ + life_ + x_ + "[pareto]\nquantity = \"hub_load_n.max\"\nsteps = 5\n" +
                                   "[optimization]\nbudget = 6\n"),
                           {"optimization.budget: 6 simulations do not pay", "at least 7"});
}

TEST_F(OptimizeFile, OfACommandHasNoLayout) {
  study_test::expect_words(said_of("[command]\nrun = [\"true\"]\n[objective]\nquantity = \"y\"\n[layout]\n"
                                   "[[parameter]]\npath = \"x\"\nlower = 0\nupper = 1\n"),
                           {"o.toml:5: layout: is of a scene, and there is none"});
}

TEST(Optimize, TakesEveryExampleThatIsShipped) {
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(BELTLIFE_SOURCE) + "/optimize/examples")) {
    auto input = read_study<OptimizationSpec>(entry.path());
    DriverOptions options;
    options.quiet = true;
    LayoutSearch::prepare(input.spec, options, input.log);
    const LoadedProblem problem =
        load_problem(input.spec.problem, input.path, LayoutSearch::quantities, options, input.log);
    ASSERT_TRUE(input.log.problems.empty()) << to_string(input.log.problems.front());
    input.spec.problem = problem.spec;
    const LayoutSearch driver(problem, input.spec, input.log);
    ASSERT_TRUE(input.log.problems.empty()) << to_string(input.log.problems.front());
    const DesignProblem design(driver.problem(), input.spec);
    EXPECT_EQ(shortfall(design.geometry(design.start())), 0) << entry.path() << ": the start keeps all limits";
    EXPECT_NEAR(get_number(driver.problem().scene->file.scene, "belt.pretension_n"),
                solve_statics(problem.scene->file.scene).balance.tension, 1e-9);
    ++examples;
  }
  EXPECT_GE(examples, 3);
}

}  // namespace
}  // namespace beltlife
