// Owns the claims about scatter: distributions and correlations as given, intervals that hold, failures not hidden.
#include <algorithm>

#include "studies/uncertainty/order_statistics.h"
#include "studies/uncertainty/uncertainty_study.h"
#include "tests/unit/sampled_fixture.h"

namespace beltlife::study_test {
namespace {

TEST(OrderStatistics, PercentilesAreLinearBetweenValues) {
  const std::vector<double> v{1, 2, 4, 8, 16};
  EXPECT_EQ(percentile(v, 0), 1);
  EXPECT_EQ(percentile(v, 0.5), 4);
  EXPECT_EQ(percentile(v, 0.625), 6);
  EXPECT_EQ(percentile(v, 1), 16);
  EXPECT_EQ(percentile({3}, 0.7), 3);
}

// Of 100 values the 95 % interval of the median reaches from the 40th to the 61st (David and Nagaraja, table).
TEST(OrderStatistics, IntervalOfTheMedianIsThatOfTheTables) {
  std::vector<double> v;
  for (int i = 1; i <= 100; ++i) v.push_back(i);
  const Bounds b = percentile_interval(v, 0.5, 0.95);
  EXPECT_EQ(b.low, 40);
  EXPECT_EQ(b.high, 61);
  v.resize(20);
  EXPECT_FALSE(percentile_interval(v, 0.05, 0.95).low);  // 0.95^20 is 0.36: the least value may well lie above
  EXPECT_TRUE(percentile_interval(v, 0.05, 0.95).high);
  EXPECT_FALSE(percentile_interval({1}, 0.5, 0.95).high);
}

TEST(OrderStatistics, IntervalsHoldThePercentileWhateverTheDistribution) {
  for (const double share : {0.05, 0.5, 0.9}) {
    int held = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
      std::mt19937_64 random(seed);
      std::exponential_distribution<double> life(1);
      std::vector<double> v(150);
      for (double& x : v) x = life(random);
      std::sort(v.begin(), v.end());
      const Bounds b = percentile_interval(v, share, 0.95);
      const double known = -std::log1p(-share);
      held += (!b.low || *b.low <= known) && (!b.high || known <= *b.high);
    }
    EXPECT_GE(held, 368);  // at least 95 % of 400 are meant: less three standard deviations
  }
}

TEST(OrderStatistics, IntervalOfAShareIsWilsons) {
  const Bounds none = share_interval(0, 100, 0.95), tenth = share_interval(10, 100, 0.95);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(*none.high, 0.0370, 5e-5);
  EXPECT_NEAR(*tenth.low, 0.0552, 5e-5);
  EXPECT_NEAR(*tenth.high, 0.1744, 5e-5);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 1e-9);
}

TEST(Designs, StandInEveryCellOfALatinHypercube) {
  const Rows unit = unit_design(SamplingMethod::lhs, 64, 3, 7);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<int> cells(64);
    for (const auto& row : unit) ++cells[static_cast<std::size_t>(row[k] * 64)];
    EXPECT_EQ(cells, std::vector<int>(64, 1));
  }
}

TEST(Designs, DependOnTheSeedAlone) {
  for (const SamplingMethod m : {SamplingMethod::lhs, SamplingMethod::sobol_sequence, SamplingMethod::monte_carlo}) {
    const Rows once = unit_design(m, 32, 4, 5);
    EXPECT_NE(once, unit_design(m, 32, 4, 6));
    EXPECT_EQ(once, unit_design(m, 32, 4, 5));
    for (const auto& row : once)
      for (const double u : row) EXPECT_TRUE(u > 0 && u < 1);
  }
}

TEST(Scatter, StaysWithinBoundsAndKeepsTheShapeBetween) {
  std::vector<ParameterSpec> parameters{
      scattered("n", DistributionKind::normal, 1, 2), scattered("l", DistributionKind::lognormal, 1, 2),
      scattered("one_sided", DistributionKind::normal, 0, 1), uniform("t", -1, 3), uniform("log", 1e-3, 10)};
  parameters[0].lower = 0, parameters[0].upper = 1.5;
  parameters[1].lower = 0.5, parameters[1].upper = 4;
  parameters[2].lower = 0;
  parameters[3].distribution = DistributionSpec{DistributionKind::triangular, {}, {}, 3};
  parameters[4].log = true;
  const Inputs inputs(parameters);
  Rows unit = unit_design(SamplingMethod::sobol_sequence, 4096, 5, 1);
  unit.push_back(std::vector<double>(5, 0x1p-53));
  unit.push_back(std::vector<double>(5, 1 - 0x1p-53));
  double one_sided = 0, triangle = 0, logarithm = 0;
  for (const auto& x : inputs.at(unit)) {
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_GE(x[k], parameters[k].lower.value_or(-INFINITY));
      EXPECT_LE(x[k], parameters[k].upper.value_or(INFINITY));
    }
    one_sided += x[2] / 4098;
    triangle += x[3] / 4098;
    logarithm += std::log(x[4]) / 4098;
  }
  EXPECT_NEAR(one_sided, std::sqrt(2 / std::numbers::pi), 3e-3);  // half-normal
  EXPECT_NEAR(triangle, 5.0 / 3, 3e-3);
  EXPECT_NEAR(logarithm, 0.5 * (std::log(1e-3) + std::log(10)), 1e-2);
}

using UncertaintyKind = InFolder;

UncertaintySettings settings_of(int samples, SamplingMethod method = SamplingMethod::lhs, std::int64_t seed = 1) {
  UncertaintySettings s;
  s.samples = samples;
  s.method = method;
  s.seed = seed;
  return s;
}

// var(a + 2 b) = 1 + 4 9 + 2 rho 1 2 3; its percentiles are those of a normal distribution.
TEST_F(UncertaintyKind, OfCorrelatedNormalsIsExact) {
  const auto problem =
      toy_problem({scattered("a", DistributionKind::normal, 1, 1), scattered("b", DistributionKind::normal, -2, 3),
                   scattered("c", DistributionKind::normal, 0, 1)},
                  {"y"});
  for (const double rho : {-0.8, 0.0, 0.5})
    for (const SamplingMethod method : {SamplingMethod::lhs, SamplingMethod::sobol_sequence}) {
      UncertaintySettings settings = settings_of(4096, method);
      settings.correlation = {{{"b", "a"}, rho}, {{"b", "c"}, 0.3}};
      const auto answer = answer_of<UncertaintyStudy>(
          problem, settings, toy({[](const std::vector<double>& x) { return x[0] + 2 * x[1]; }}), folder);
      const auto& q = answer["quantities"]["y"];
      const double known = std::sqrt(37 + 12 * rho);
      // A standard deviation of 4096 values is good to 1.1 %, a mean to 1.6 % of it; three times that.
      EXPECT_NEAR(q["standard_deviation"], known, 0.033 * known);
      EXPECT_NEAR(q["mean"], -3, 0.047 * known);
      EXPECT_NEAR(q["percentiles"]["5"], -3 - 1.645 * known, 0.1 * known);
      EXPECT_NEAR(q["percentiles"]["95"], -3 + 1.645 * known, 0.1 * known);
      EXPECT_LT(q["percentile_intervals"]["50"]["low"], q["percentiles"]["50"]);
    }
}

TEST_F(UncertaintyKind, GivesTheB10LifeAndTheOddsOfMissingATarget) {
  const auto problem = toy_problem({scattered("a", DistributionKind::normal, 3, 0.2)}, {"log10_life_h", "life_h"});
  UncertaintySettings settings = settings_of(1000);
  settings.target_life_h = 1000;
  const auto answer = answer_of<UncertaintyStudy>(
      problem, settings,
      toy({[](const std::vector<double>& x) { return x[0]; }, [](const auto& x) { return std::pow(10, x[0]); }}),
      folder);
  for (const char* name : {"log10_life_h", "life_h"}) {
    const auto& q = answer["quantities"][name];
    EXPECT_NEAR(q["b10_life_h"]["value"], std::pow(10, 3 - 1.2816 * 0.2), 8);  // two of a thousand values
    EXPECT_LT(q["b10_life_h"]["low"], q["b10_life_h"]["value"]);
    EXPECT_NEAR(q["missing_target"]["value"], 0.5, 0.002);
    EXPECT_NEAR(q["missing_target"]["low"], 0.469, 0.003);
  }
  expect_words(text_of<UncertaintyStudy>(answer), {"B10 life", "less than 1000 h: 50 %", "Wilson", "in log10 h"});
}

TEST_F(UncertaintyKind, SaysWhatFailuresMayHide) {
  const auto problem = toy_problem({uniform("a", 0, 1)}, {"life_h"});
  UncertaintySettings settings = settings_of(1000);
  settings.target_life_h = 0.25;
  settings.percentiles = {5, 50, 99.5};
  const auto answer = answer_of<UncertaintyStudy>(
      problem, settings,
      toy({[](const std::vector<double>& x) { return x[0]; }}, [](const auto& x) { return x[0] < 0.1; }), folder);
  EXPECT_NEAR(answer["failed_share"], 0.1, 1e-12);
  EXPECT_EQ(answer["failed"], 100);
  const auto& q = answer["quantities"]["life_h"];
  const auto& by = q["percentiles_by_failures"];
  EXPECT_NEAR(q["percentiles"]["50"], 0.55, 2e-3);
  EXPECT_NEAR(by["50"]["low"], 0.5, 2e-3);  // the truth: here they do lie below
  EXPECT_NEAR(by["50"]["high"], 0.6, 2e-3);
  EXPECT_TRUE(by["5"]["low"].is_null());
  EXPECT_TRUE(by["99.5"]["high"].is_null());
  EXPECT_NEAR(q["missing_target"]["if_failed_miss"], 0.25, 2e-3);
  EXPECT_NEAR(q["missing_target"]["if_failed_hold"], 0.15, 2e-3);
  expect_words(text_of<UncertaintyStudy>(answer),
               {"10 % of the points failed", "25 % if every failed point misses it"});
  const auto all =
      answer_of<UncertaintyStudy>(problem, settings, toy({ishigami}, [](const auto&) { return true; }), folder);
  expect_words(text_of<UncertaintyStudy>(all), {"only 0 of 1000"});
}

TEST_F(UncertaintyKind, RefusesCorrelationsThatCannotHoldByLineAndKey) {
  write_text(folder / "c.toml", R"(quantities = ["y"]
parameter = [{ path = "a", lower = 0, upper = 1 }, { path = "b", lower = 0, upper = 1 }, { path = "c", lower = 0, upper = 1 }]
[command]
run = ["cat"]
[[study.correlation]]
between = ["a", "b"]
value = 0.2
[[study.correlation]]
between = ["b", "c"]
value = 0.2
[[study.correlation]]
between = ["a", "c"]
value = -0.98
[[study.correlation]]
between = ["a", "d"]
value = 0.1
[[study.correlation]]
between = ["b", "a"]
value = 0.2
)");
  auto input = read_study<StudySpec<UncertaintySettings>>(folder / "c.toml");
  ASSERT_TRUE(input.log.problems.empty()) << input.log.problems[0].what;
  const LoadedProblem problem = toy_problem(input.spec.problem.parameter, {"y"});
  const std::string words = refusal([&] {
    const UncertaintyStudy kind(problem, input.spec.study, input.log);
    throw_problems(input.log.problems);
  });
  expect_words(words, {"c.toml:13", "study.correlation.2.value: -0.98", "not positive definite", "c.toml:15",
                       "no parameter 'd'", "c.toml:18", "earlier correlation"});
}

// The first two alone, with 0 between a and c, could not hold.
TEST_F(UncertaintyKind, JudgesCorrelationsTogether) {
  const auto problem = toy_problem({uniform("a", 0, 1), uniform("b", 0, 1), uniform("c", 0, 1)}, {"y"});
  UncertaintySettings settings;
  settings.correlation = {{{"a", "b"}, 0.9}, {{"b", "c"}, 0.9}};
  expect_words(refusal_of<UncertaintyStudy>(problem, settings), {"not positive definite"});
  settings.correlation.push_back({{"c", "a"}, 0.8});
  EXPECT_EQ(refusal_of<UncertaintyStudy>(problem, settings), "");
}

TEST_F(UncertaintyKind, RefusesAHundredthPercentile) {
  UncertaintySettings settings;
  settings.percentiles = {5, 100};
  expect_words(refusal_of<UncertaintyStudy>(toy_problem({uniform("a", 0, 1)}, {"y"}), settings),
               {"study.percentiles", "100th"});
}

TEST_F(UncertaintyKind, IsTheSameEveryTime) {
  const auto problem = toy_problem(ishigami_inputs(), {"y"});
  const auto once = answer_of<UncertaintyStudy>(problem, settings_of(100), toy({ishigami}), folder);
  answer_of<UncertaintyStudy>(problem, settings_of(100, SamplingMethod::monte_carlo, 9), toy({ishigami}), folder);
  EXPECT_EQ(once.dump(), answer_of<UncertaintyStudy>(problem, settings_of(100), toy({ishigami}), folder).dump());
}

}  // namespace
}  // namespace beltlife::study_test
