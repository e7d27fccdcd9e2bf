// Owns the claims about the Gaussian process: it interpolates, knows what it does not know, and finds lengths and
// noise.
#include "optimize/search/kriging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "optimize/search/search_design.h"

namespace beltlife {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd points(Eigen::Index count, std::size_t variables) {
  HaltonSequence sequence(variables, 1);
  MatrixXd x(count, static_cast<Eigen::Index>(variables));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point p = sequence.next();
    x.row(i) = Eigen::Map<const VectorXd>(p.data(), x.cols()).transpose();
  }
  return x;
}

template <class F>
VectorXd values_at(const MatrixXd& x, F f) {
  VectorXd y(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i) y(i) = f(x.row(i).transpose());
  return y;
}

double wave(const VectorXd& x) { return std::sin(4 * x(0)) + x(1) * x(1); }

KrigingShape quiet(Eigen::Index variables) { return {usual_shape(variables).log_length, std::log(1e-9)}; }

TEST(Kriging, WithoutNoisePassesThroughItsPointsAndKnowsIt) {
  const MatrixXd x = points(25, 2);
  const VectorXd y = values_at(x, wave);
  const Kriging process(x, y, quiet(2));
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto p = process.predict(x.row(i).transpose());
    EXPECT_NEAR(p.mean, y(i), 1e-5);  // the nugget of 1e-9 times a condition of some thousands
    EXPECT_LE(p.deviation, 1e-3 * process.process_deviation());
  }
}

TEST(Kriging, FarFromAllPointsFallsBackToTheTrendAndItsOwnDeviation) {
  const MatrixXd x = points(25, 2);
  const Kriging process(x, values_at(x, wave), quiet(2));
  const auto p = process.predict(VectorXd::Constant(2, 1e3));
  const auto q = process.predict(VectorXd::Constant(2, -1e3));
  EXPECT_NEAR(p.mean, q.mean, 1e-9);
  EXPECT_GE(p.deviation, process.process_deviation());
}

TEST(Kriging, OfTwoPointsIsTheFormulaByHand) {
  MatrixXd x(2, 1);
  x << 0.0, 1.0;
  VectorXd y(2);
  y << 1.0, 3.0;
  const Kriging process(x, y, {VectorXd::Zero(1), std::log(1e-9)});
  // Length 1: by symmetry the trend is 2, and R^-1 (y - 2) = -/+ 1/(1 - r(1)).
  const auto r = [](double d) {
    const double s = std::sqrt(5.0) * d;
    return (1 + s + s * s / 3) * std::exp(-s);
  };
  const double at = 0.25, expected = 2 + (r(1 - at) - r(at)) / (1 - r(1));
  EXPECT_NEAR(process.mean(VectorXd::Constant(1, at)), expected, 1e-7);  // the nugget's share
}

TEST(Kriging, GradientOfTheLossIsItsDifferenceQuotient) {
  const MatrixXd x = points(20, 3);
  const VectorXd y = values_at(x, [](const VectorXd& p) { return wave(p) + 0.3 * p(2); });
  KrigingShape shape = usual_shape(3);
  shape.log_length << -0.8, 0.1, 0.9;
  shape.log_nugget = std::log(1e-2);
  VectorXd gradient;
  kriging_loss(x, y, shape, &gradient);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const auto moved = [&](double by) {
      KrigingShape other = shape;
      (k < 3 ? other.log_length(k) : other.log_nugget) += by;
      return kriging_loss(x, y, other, nullptr);
    };
    const double h = 1e-5;
    EXPECT_NEAR(gradient(k), (moved(h) - moved(-h)) / (2 * h), 1e-5 * (1 + std::abs(gradient(k)))) << k;
  }
}

TEST(Kriging, LikelihoodFindsWhichVariablesMatter) {
  const MatrixXd x = points(60, 3);
  const VectorXd y = values_at(x, [](const VectorXd& p) { return std::sin(6 * p(0)); });
  const KrigingShape found = likeliest_shape(x, y, usual_shape(3), 60);
  EXPECT_GT(found.log_length(1), found.log_length(0) + 1);
  EXPECT_GT(found.log_length(2), found.log_length(0) + 1);
}

TEST(Kriging, LikelihoodFindsTheNoise) {
  const MatrixXd x = points(80, 2);
  SearchRandom random(4);
  const double noise = 0.3 / std::sqrt(12.0);  // of a uniform error 0.3 wide
  const VectorXd y = values_at(x, [&](const VectorXd& p) { return wave(p) + 0.3 * (random.uniform() - 0.5); });
  const Kriging process(x, y, likeliest_shape(x, y, usual_shape(2), 80));
  const double found = process.process_deviation() * std::exp(0.5 * process.shape().log_nugget);
  EXPECT_NEAR(std::log(found / noise), 0, 0.4);  // 80 points give a deviation to 8 %, the trade with lengths the rest
  double squares = 0;
  const MatrixXd elsewhere = points(200, 2).bottomRows(100);
  for (Eigen::Index i = 0; i < elsewhere.rows(); ++i) {
    const VectorXd at = elsewhere.row(i).transpose();
    squares += std::pow(process.mean(at) - wave(at), 2) / 100;
  }
  EXPECT_LT(std::sqrt(squares), 0.7 * noise);  // smoother than the data
}

TEST(Kriging, WithOneMorePointIsTheProcessOfAllPoints) {
  const MatrixXd x = points(15, 2);
  const VectorXd y = values_at(x, wave);
  const Kriging grown = Kriging(x.topRows(14), y.head(14), quiet(2)).with(x.row(14).transpose(), y(14));
  const Kriging whole(x, y, quiet(2));
  const VectorXd at = VectorXd::Constant(2, 0.37);
  EXPECT_EQ(grown.predict(at).mean, whole.predict(at).mean);
  EXPECT_EQ(grown.predict(at).deviation, whole.predict(at).deviation);
}

TEST(Kriging, TakesEqualValuesOnePointAndRepeatedPoints) {
  const MatrixXd x = points(10, 2);
  const Kriging flat(x, VectorXd::Constant(10, 4.0),
                     likeliest_shape(x, VectorXd::Constant(10, 4.0), usual_shape(2), 20));
  EXPECT_NEAR(flat.mean(VectorXd::Constant(2, 0.5)), 4, 1e-6);  // rounding of weights that should be zero
  const Kriging single(x.topRows(1), VectorXd::Constant(1, 7.0), usual_shape(2));
  EXPECT_NEAR(single.mean(VectorXd::Constant(2, 0.9)), 7, 1e-12);
  MatrixXd twice(20, 2);
  twice << x, x;
  VectorXd y(20);
  y << VectorXd::Constant(10, 1.0), VectorXd::Constant(10, 3.0);
  const auto p = Kriging(twice, y, quiet(2)).predict(x.row(0).transpose());
  EXPECT_NEAR(p.mean, 2, 0.1);  // midway between contradictory answers
  EXPECT_TRUE(std::isfinite(p.deviation));
}

}  // namespace
}  // namespace beltlife
