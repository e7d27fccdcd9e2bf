// Owns the claims about elementary effects: exact for linear functions, honest about failures and noise.
#include <set>

#include "results/store/study_file.h"
#include "studies/morris/elementary_effects.h"
#include "studies/morris/morris_study.h"
#include "tests/unit/sampled_fixture.h"

namespace beltlife::study_test {
namespace {

std::vector<std::optional<double>> values_along(const Rows& at, const Function& f) {
  std::vector<std::optional<double>> values;
  for (const auto& x : at) values.push_back(f(x));
  return values;
}

TEST(Trajectories, MoveEachCoordinateOnceByTheJump) {
  const std::size_t d = 5, count = 200;
  for (const int levels : {2, 4, 8}) {
    const Rows at = trajectories(count, d, levels, 3);
    ASSERT_EQ(at.size(), count * (d + 1));
    std::map<double, int> starts;
    std::set<std::vector<std::size_t>> orders;
    int up = 0;
    for (std::size_t t = 0; t < count; ++t) {
      std::vector<std::size_t> order;
      for (std::size_t i = 0; i < d; ++i) {
        const auto &from = at[t * (d + 1) + i], &to = at[t * (d + 1) + i + 1];
        for (std::size_t k = 0; k < d; ++k) {
          EXPECT_GE(to[k], 0);
          EXPECT_LE(to[k], 1);
          if (to[k] == from[k]) continue;
          order.push_back(k);
          up += to[k] > from[k];
          EXPECT_NEAR(std::abs(to[k] - from[k]), levels / (2.0 * (levels - 1)), 1e-15);
        }
      }
      orders.insert(order);
      EXPECT_EQ(std::set(order.begin(), order.end()).size(), d);
      for (const double start : at[t * (d + 1)]) ++starts[start];
    }
    EXPECT_EQ(starts.size(), static_cast<std::size_t>(levels));
    // 1000 draws; five standard deviations.
    for (const auto& [level, hits] : starts) EXPECT_NEAR(hits, 1000.0 / levels, 5 * std::sqrt(1000.0 / levels));
    EXPECT_NEAR(up, 500, 80);
    EXPECT_GT(orders.size(), 70u);  // of 120
  }
}

TEST(ElementaryEffects, OfALinearFunctionAreItsSlopes) {
  const Rows at = trajectories(10, 3, 4, 1);
  const auto e = elementary_effects(
      at, values_along(at, [](const std::vector<double>& x) { return 2 * x[0] - 7 * x[1] + 1e-3 * x[2]; }));
  const std::vector<double> slopes{2, -7, 1e-3};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(e[k].used, 10u);
    EXPECT_NEAR(e[k].mu, slopes[k], 1e-13);
    EXPECT_NEAR(e[k].mu_star, std::abs(slopes[k]), 1e-13);
    EXPECT_NEAR(e[k].sigma, 0, 1e-13);
    EXPECT_NEAR(e[k].mu_star_error, 0, 1e-13);
  }
}

// Of x0 x1 the effect of x0 is x1: mean 1/2 and the standard deviation of four even levels, sqrt(5)/6 = 0.373. The
// parabola about the middle, on levels 0, 1/3, 2/3, 1: from 0 to 2/3 and from 1/3 to 1 it changes by -/+ 2/9, by the
// jump of 2/3 -/+ 1/3: mean 0, magnitude 1/3.
TEST(ElementaryEffects, TellInteractionAndCurvatureFromSlope) {
  const Rows at = trajectories(2000, 3, 4, 1);
  const auto e = elementary_effects(
      at, values_along(at, [](const std::vector<double>& x) { return x[0] * x[1] + (x[2] - 0.5) * (x[2] - 0.5); }));
  // Four standard errors of 2000 effects.
  EXPECT_NEAR(e[0].mu, 0.5, 0.034);
  EXPECT_NEAR(e[0].sigma, std::sqrt(5.0) / 6, 0.02);
  EXPECT_NEAR(e[0].mu_star_error, std::sqrt(5.0) / 6 / std::sqrt(2000), 5e-4);
  EXPECT_NEAR(e[2].mu, 0, 0.03);
  EXPECT_NEAR(e[2].mu_star, 1.0 / 3, 1e-12);
}

TEST(ElementaryEffects, OfFailedPointsAreLeftOutAndNoOthers) {
  const Rows at = trajectories(2, 3, 4, 1);
  auto values = values_along(at, [](const std::vector<double>& x) { return x[0] + 2 * x[1] + 3 * x[2]; });
  values[1].reset();  // in the middle: two effects
  values[7].reset();  // the last of the second trajectory: one
  const auto e = elementary_effects(at, values);
  EXPECT_EQ(e[0].used + e[1].used + e[2].used, 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(e[k].used == 0 || std::abs(e[k].mu - (k + 1.0)) < 1e-13);
  for (auto& v : values) v.reset();
  EXPECT_TRUE(std::isnan(elementary_effects(at, values)[0].mu_star));
}

// Within two standard errors of what noise makes: one in forty lies above by chance.
TEST(ElementaryEffects, OfNoiseAloneStayBelowItsFloor) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.3);
  int above = 0, floors = 0;
  double mean = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Rows at = trajectories(20, 4, 4, seed);
    for (const Effects& e : elementary_effects(at, values_along(at, [&](const auto&) { return noise(random); }))) {
      above += e.mu_star > mu_star_of_noise(0.3, 4, e.used);
      mean += e.mu_star / 800;
      ++floors;
    }
  }
  EXPECT_NEAR(mean, 2 * 0.3 / (2.0 / 3) / std::sqrt(std::numbers::pi), 0.02);
  EXPECT_GT(above, 0);
  EXPECT_LT(above, floors / 15);
}

using MorrisKind = InFolder;

TEST_F(MorrisKind, TakesTheWholeRangeOfAParameterAndItsLogarithm) {
  auto problem = toy_problem({uniform("a", 2, 5), uniform("b", 0.01, 100)}, {"y"});
  problem.spec.parameter[1].log = true;
  problem.spec.parameter[0].distribution = DistributionSpec{DistributionKind::normal, 3, 0.1, {}};  // plays no part
  const auto answer = answer_of<MorrisStudy>(
      problem, {}, toy({[](const std::vector<double>& x) { return 4 * x[0] - std::log(x[1]); }}), folder);
  const auto& q = answer["quantities"]["y"];
  EXPECT_NEAR(q["a"]["mu"], 12, 1e-12);
  EXPECT_NEAR(q["b"]["mu"], -std::log(1e4), 1e-12);
  EXPECT_NEAR(q["b"]["mu_star"], std::log(1e4), 1e-12);
  EXPECT_NEAR(q["a"]["sigma"], 0, 1e-12);
  EXPECT_EQ(q["a"]["effects"], 20);
  EXPECT_EQ(answer["evaluations"], 16);  // 60 points of which the 4 x 4 levels are not run twice
  expect_words(text_of<MorrisStudy>(answer), {"mu*", "a", "12", "20"});
}

TEST_F(MorrisKind, MarksWhatIsNoMoreThanNoise) {
  StudyRecord noise;
  noise.head = example_head();
  noise.answer["quantities"]["y"] = {{"replicates", {{"standard_deviation", 0.5}}}, {"noise", 1e-9}};
  write_study(folder / "noise.h5", noise);
  auto problem = toy_problem({uniform("a", 0, 1), uniform("b", 0, 1)}, {"y"});
  problem.folder = folder;
  MorrisSettings settings;
  settings.noise = "noise.h5";
  const auto answer = answer_of<MorrisStudy>(
      problem, settings, toy({[](const std::vector<double>& x) { return 5 * x[0] + 0.1 * x[1]; }}), folder);
  const auto& q = answer["quantities"]["y"];
  EXPECT_FALSE(q["a"]["within_noise"]);
  EXPECT_TRUE(q["b"]["within_noise"]);
  EXPECT_NEAR(q["a"]["noise_floor"], mu_star_of_noise(0.5, 4, 20), 1e-12);
  expect_words(text_of<MorrisStudy>(answer), {"no more than noise", "above noise"});

  problem.spec.quantities = {"z"};
  expect_words(refusal_of<MorrisStudy>(problem, settings), {"study.noise", "does not know z"});
  settings.noise = "none.h5";
  expect_words(refusal_of<MorrisStudy>(problem, settings), {"study.noise", "none.h5"});
}

TEST_F(MorrisKind, LivesWithFailuresOfAll) {
  const auto problem = toy_problem({uniform("a", 0, 1)}, {"y"});
  const auto answer = answer_of<MorrisStudy>(problem, {}, toy({ishigami}, [](const auto&) { return true; }), folder);
  EXPECT_EQ(answer["quantities"]["y"]["a"]["effects"], 0);
  EXPECT_TRUE(answer["quantities"]["y"]["a"]["mu"].is_null());
  expect_words(text_of<MorrisStudy>(answer), {"-"});
}

TEST_F(MorrisKind, RefusesOddLevelsAndMissingBounds) {
  MorrisSettings settings;
  settings.levels = 5;
  expect_words(refusal_of<MorrisStudy>(toy_problem({uniform("a", 0, 1)}, {"y"}), settings),
               {"study.levels", "5 is odd"});
  const auto normal = toy_problem({scattered("a", DistributionKind::normal, 0, 1)}, {"y"});
  expect_words(refusal_of<MorrisStudy>(normal, {}), {"parameter.0.lower", "bound to bound"});
}

}  // namespace
}  // namespace beltlife::study_test
