// Owns the claims about surrogates: they predict what they say they predict, and say so when they cannot.
#include "studies/surrogate/surrogate_study.h"
#include "tests/unit/sampled_fixture.h"

namespace beltlife::study_test {
namespace {

struct Sample {
  Rows at;
  std::vector<double> values;
};

Sample sample_of(const std::vector<ParameterSpec>& parameters, const Function& f, std::size_t points,
                 SamplingMethod method = SamplingMethod::sobol_sequence, std::int64_t seed = 1) {
  Sample s;
  s.at = Inputs(parameters).at(unit_design(method, points, parameters.size(), seed));
  for (const auto& x : s.at) s.values.push_back(f(x));
  return s;
}

/// Share of the variance that a surrogate predicts at 1000 points of its own.
double share_predicted(const Surrogate& s, const std::vector<ParameterSpec>& parameters, const Function& f) {
  const Sample fresh = sample_of(parameters, f, 1000, SamplingMethod::monte_carlo, 77);
  double mean = 0, errors = 0, variance = 0;
  for (const double v : fresh.values) mean += v / 1000;
  for (std::size_t i = 0; i < 1000; ++i) {
    errors += std::pow(s.predict(fresh.at[i]) - fresh.values[i], 2);
    variance += std::pow(fresh.values[i] - mean, 2);
  }
  return 1 - errors / variance;
}

TEST(Chaos, OfIshigamiForetellsAndKnowsTheIndices) {
  const auto parameters = ishigami_inputs();
  const Sample s = sample_of(parameters, ishigami, 300);
  const Surrogate chaos = chaos_surrogate(parameters, s.at, s.values, 8);
  EXPECT_GE(chaos.q2, 0.99);
  EXPECT_NEAR(share_predicted(chaos, parameters, ishigami), chaos.q2, 0.01);
  EXPECT_LT(chaos.terms, 60u);  // of 165
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(chaos.first[p], ishigami_first[p], 0.01);
    EXPECT_NEAR(chaos.total[p], ishigami_total[p], 0.01);
  }
}

TEST(Chaos, OfTooLowADegreeSaysSo) {
  const auto parameters = ishigami_inputs();
  const Sample s = sample_of(parameters, ishigami, 300);
  const Surrogate chaos = chaos_surrogate(parameters, s.at, s.values, 3);
  EXPECT_LT(chaos.q2, 0.7);
  EXPECT_NEAR(share_predicted(chaos, parameters, ishigami), chaos.q2, 0.1);
  // x1 and x3 interact: with what each does alone their totals make up the rest, twice for the interaction.
  double alone = 0, any = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_GE(chaos.total[p], chaos.first[p]);
    alone += chaos.first[p];
    any += chaos.total[p];
  }
  EXPECT_NEAR(any, alone + 2 * (1 - alone), 1e-12);
}

// Polynomials orthogonal under cut-off, skewed and logarithmic distributions.
TEST(Chaos, OfASumOverAnyDistributionsIsExact) {
  std::vector<ParameterSpec> parameters{scattered("n", DistributionKind::normal, 5, 0.7),
                                        scattered("cut", DistributionKind::normal, 0, 1), uniform("t", 0, 4),
                                        scattered("l", DistributionKind::lognormal, 2, 0.5), uniform("log", 0.1, 10)};
  parameters[1].lower = -1, parameters[1].upper = 2;
  parameters[2].distribution = DistributionSpec{DistributionKind::triangular, {}, {}, 1};
  parameters[4].log = true;
  const Function sum = [](const std::vector<double>& x) {
    return x[0] + x[1] * x[1] + x[2] + std::log(x[3]) + std::log(x[4]);
  };
  const Sample s = sample_of(parameters, sum, 150);
  const Surrogate chaos = chaos_surrogate(parameters, s.at, s.values, 2);
  EXPECT_GT(chaos.q2, 1 - 1e-9);
  EXPECT_GT(share_predicted(chaos, parameters, sum), 1 - 1e-9);
  const double var_log = std::pow(std::log(100), 2) / 12, var_t = 13.0 / 18, var_l = std::log1p(0.0625);
  EXPECT_NEAR(chaos.first[4] / chaos.first[0], var_log / 0.49, 1e-6);
  EXPECT_NEAR(chaos.total[2] / chaos.first[0], var_t / 0.49, 1e-6);
  EXPECT_NEAR(chaos.first[3] / chaos.first[0], var_l / 0.49, 1e-6);
}

TEST(Kriging, ForetellsWhatItSays) {
  const auto parameters = ishigami_inputs();
  const Sample s = sample_of(parameters, ishigami, 200);
  const Surrogate kriging = kriging_surrogate(parameters, s.at, s.values);
  EXPECT_GT(kriging.q2, 0.9);
  // Left out, a point is missed by more than it will be: the others stand less densely.
  EXPECT_NEAR(share_predicted(kriging, parameters, ishigami), kriging.q2, 0.06);
}

// Leave-one-out errors do not repeat the choice of terms, hence not quite 0.
TEST(Surrogates, OfNoiseForetellNothing) {
  const auto parameters = ishigami_inputs();
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  const Sample s = sample_of(
      parameters, [&](const auto&) { return noise(random); }, 100);
  EXPECT_LT(chaos_surrogate(parameters, s.at, s.values, 6).q2, 0.3);
  EXPECT_LT(kriging_surrogate(parameters, s.at, s.values).q2, 0.3);
}

using SurrogateKind = InFolder;

SurrogateSettings settings_of(int samples, SurrogateMethod method, int degree) {
  SurrogateSettings s;
  s.samples = samples;
  s.method = method;
  s.degree = degree;
  return s;
}

TEST_F(SurrogateKind, LearnsFromWhatDidNotFailAndJudgesItself) {
  const LoadedProblem problem = toy_problem(ishigami_inputs(), {"y", "constant"});
  const auto answer =
      answer_of<SurrogateStudy>(problem, settings_of(300, SurrogateMethod::chaos, 8),
                                toy({ishigami, [](const auto&) { return 4.0; }}, fails_by_chance), folder);
  EXPECT_NEAR(answer["samples_used"], 270, 25);
  EXPECT_EQ(answer["evaluations"], 301);
  const auto& q = answer["quantities"]["y"];
  EXPECT_GE(q["q2"], 0.99);
  EXPECT_TRUE(q["usable"]);
  EXPECT_NEAR(q["first"]["x2"], 0.4424, 0.01);
  EXPECT_NEAR(q["total"]["x3"], 0.2437, 0.01);
  EXPECT_EQ(q["nominal"]["simulated"], 0);  // at the origin
  EXPECT_NEAR(q["nominal"]["predicted"], 0, 0.3);
  EXPECT_TRUE(answer["quantities"]["constant"]["q2"].is_null());
  expect_words(text_of<SurrogateStudy>(answer), {"usable", "constant does not vary", "Nominal point"});
}

TEST_F(SurrogateKind, OfKrigingHasIndicesToo) {
  const LoadedProblem problem = toy_problem(ishigami_inputs(), {"y"});
  const auto answer =
      answer_of<SurrogateStudy>(problem, settings_of(200, SurrogateMethod::kriging, 1), toy({ishigami}), folder);
  const auto& q = answer["quantities"]["y"];
  // A twentieth of the variance is not learnt from 200 points.
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(q["first"]["x" + std::to_string(p + 1)], ishigami_first[p], 0.06);
    EXPECT_NEAR(q["total"]["x" + std::to_string(p + 1)], ishigami_total[p], 0.06);
  }
}

TEST_F(SurrogateKind, IsTheSameEveryTime) {
  const LoadedProblem problem = toy_problem(ishigami_inputs(), {"y"});
  for (const SurrogateMethod method : {SurrogateMethod::chaos, SurrogateMethod::kriging}) {
    const auto once = answer_of<SurrogateStudy>(problem, settings_of(60, method, 5), toy({ishigami}), folder);
    unit_design(SamplingMethod::monte_carlo, 7, 3, 99);  // the generator elsewhere
    EXPECT_EQ(once.dump(),
              answer_of<SurrogateStudy>(problem, settings_of(60, method, 5), toy({ishigami}), folder).dump());
  }
}

TEST_F(SurrogateKind, SaysSoWhereNothingIsToBeLearnt) {
  const LoadedProblem problem = toy_problem(ishigami_inputs(), {"y"});
  const auto answer = answer_of<SurrogateStudy>(problem, settings_of(20, SurrogateMethod::chaos, 2),
                                                toy({ishigami}, [](const auto&) { return true; }), folder);
  expect_words(text_of<SurrogateStudy>(answer), {"only 0 of 20 points"});
  SurrogateSettings steep;
  steep.degree = 20;
  std::vector<ParameterSpec> many;
  for (int i = 0; i < 10; ++i) many.push_back(uniform("x" + std::to_string(i), 0, 1));
  expect_words(refusal_of<SurrogateStudy>(toy_problem(many, {"y"}), steep), {"study.degree", "terms"});
}

}  // namespace
}  // namespace beltlife::study_test
