// A Gaussian process through scattered points: see kriging.h.
#include "optimize/search/kriging.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beltlife {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double length_spread = 1.0, nugget_spread = 3.0;  // of the prior, in logarithms
const double least_log_length = std::log(0.01), most_log_length = std::log(100.0);
const double least_log_nugget = std::log(1e-9), most_log_nugget = std::log(0.5);

MatrixXd scaled_points(const MatrixXd& x, const KrigingShape& shape) {
  return (x * (-shape.log_length).array().exp().matrix().asDiagonal()).transpose();
}

// s of all pairs of columns.
MatrixXd separations(const MatrixXd& scaled) {
  const VectorXd squares = scaled.colwise().squaredNorm();
  MatrixXd s = -2.0 * scaled.transpose() * scaled;
  s.colwise() += squares;
  s.rowwise() += squares.transpose();
  return (5.0 * s.cwiseMax(0.0)).cwiseSqrt();
}

double matern(double s) { return (1 + s + s * s / 3) * std::exp(-s); }

MatrixXd correlation_matrix(const MatrixXd& s, double nugget) {
  MatrixXd r = s.unaryExpr(&matern);
  r.diagonal().setConstant(1 + nugget);
  return r;
}

KrigingShape bounded(KrigingShape shape) {
  shape.log_length = shape.log_length.cwiseMax(least_log_length).cwiseMin(most_log_length);
  shape.log_nugget = std::clamp(shape.log_nugget, least_log_nugget, most_log_nugget);
  return shape;
}

}  // namespace

KrigingShape usual_shape(Index variables) {
  // Lengths grow with the dimension as distances do, so that neighbours keep telling something of each other.
  return {VectorXd::Constant(variables, std::log(0.5 * std::sqrt(static_cast<double>(variables)))), std::log(1e-4)};
}

double kriging_loss(const MatrixXd& x, const VectorXd& y, const KrigingShape& shape, VectorXd* gradient) {
  const Index n = x.rows(), d = x.cols();
  const MatrixXd scaled = scaled_points(x, shape), s = separations(scaled);
  const double nugget = std::exp(shape.log_nugget);
  const Eigen::LLT<MatrixXd> factor(correlation_matrix(s, nugget));
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const VectorXd ones = factor.solve(VectorXd::Ones(n));
  const VectorXd residual = y.array() - ones.dot(y) / ones.sum();
  const VectorXd weights = factor.solve(residual);
  const double variance = std::max(residual.dot(weights) / static_cast<double>(n), 1e-300);
  const KrigingShape usual = usual_shape(d);
  const VectorXd off = (shape.log_length - usual.log_length) / length_spread;
  const double nugget_off = (shape.log_nugget - usual.log_nugget) / nugget_spread;
  const double half_log_determinant = factor.matrixLLT().diagonal().array().log().sum();
  const double loss = 0.5 * static_cast<double>(n) * std::log(variance) + half_log_determinant +
                      0.5 * (off.squaredNorm() + nugget_off * nugget_off);
  if (!gradient) return loss;
  // d loss / d p = 1/2 sum_ij W_ij dR_ij/dp, W = R^-1 - w w^T / variance; the trend's share vanishes at its optimum.
  const MatrixXd w = factor.solve(MatrixXd::Identity(n, n)) - weights * weights.transpose() / variance;
  const MatrixXd m = w.cwiseProduct(s.unaryExpr([](double v) { return 5.0 / 3.0 * (1 + v) * std::exp(-v); }));
  const VectorXd row_sums = m.rowwise().sum();
  const MatrixXd m_scaled = scaled * m;
  gradient->resize(d + 1);
  for (Index k = 0; k < d; ++k) {
    const VectorXd xk = scaled.row(k);
    (*gradient)(k) = row_sums.dot(xk.cwiseAbs2()) - m_scaled.row(k).dot(xk) + off(k) / length_spread;
  }
  (*gradient)(d) = 0.5 * nugget * w.trace() + nugget_off / nugget_spread;
  return loss;
}

KrigingShape likeliest_shape(const MatrixXd& x, const VectorXd& y, const KrigingShape& start, int steps) {
  // Rprop (Riedmiller & Braun 1993): steps by the signs of the gradient alone, so badly scaled directions do not
  // matter.
  constexpr double faster = 1.3, slower = 0.5, least_step = 1e-3, most_step = 1.0;
  const Index d = x.cols();
  KrigingShape now = bounded(start), best = now;
  VectorXd gradient, before = VectorXd::Zero(d + 1), step = VectorXd::Constant(d + 1, 0.3);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const double loss = kriging_loss(x, y, now, &gradient);
    if (!std::isfinite(loss)) {
      now = best;
      now.log_nugget += 1;
      now = bounded(now);
      continue;
    }
    if (loss < least) {
      least = loss;
      best = now;
    }
    for (Index k = 0; k <= d; ++k) {
      const double turn = gradient(k) * before(k);
      step(k) = std::clamp(step(k) * (turn > 0 ? faster : turn < 0 ? slower : 1.0), least_step, most_step);
      const double move = gradient(k) > 0 ? -step(k) : gradient(k) < 0 ? step(k) : 0.0;
      (k < d ? now.log_length(k) : now.log_nugget) += move;
    }
    now = bounded(now);
    before = gradient;
    if (step.maxCoeff() < 10 * least_step) break;
  }
  return best;
}

Kriging::Kriging(const MatrixXd& x, const VectorXd& y, const KrigingShape& shape)
    : x_(x), y_(y), shape_(bounded(shape)), scaled_(scaled_points(x, shape_)) {
  inverse_length_ = (-shape_.log_length).array().exp();
  const MatrixXd s = separations(scaled_);
  // Points that lie on each other make R singular: noise is then part of the truth.
  for (factor_.compute(correlation_matrix(s, std::exp(shape_.log_nugget)));
       factor_.info() != Eigen::Success && shape_.log_nugget < most_log_nugget;
       factor_.compute(correlation_matrix(s, std::exp(shape_.log_nugget))))
    shape_ = bounded({shape_.log_length, shape_.log_nugget + 2});
  ones_ = factor_.solve(VectorXd::Ones(x.rows()));
  scale_ = ones_.sum();
  trend_ = ones_.dot(y) / scale_;
  const VectorXd residual = y.array() - trend_;
  weights_ = factor_.solve(residual);
  variance_ = std::max(residual.dot(weights_), 0.0) / static_cast<double>(x.rows());
}

VectorXd Kriging::correlations(const VectorXd& at) const {
  const VectorXd to = at.cwiseProduct(inverse_length_);
  return (scaled_.colwise() - to).colwise().norm().unaryExpr([](double s) { return matern(std::sqrt(5.0) * s); });
}

double Kriging::mean(const VectorXd& at) const { return trend_ + correlations(at).dot(weights_); }

Kriging::Prediction Kriging::predict(const VectorXd& at) const {
  const VectorXd r = correlations(at);
  const double unknown_trend = 1 - ones_.dot(r);
  const double share = 1 - factor_.matrixL().solve(r).squaredNorm() + unknown_trend * unknown_trend / scale_;
  return {trend_ + r.dot(weights_), std::sqrt(variance_ * std::max(share, 0.0))};
}

Kriging Kriging::with(const VectorXd& at, double value) const {
  MatrixXd x(x_.rows() + 1, x_.cols());
  x << x_, at.transpose();
  VectorXd y(y_.size() + 1);
  y << y_, value;
  return {x, y, shape_};
}

double Kriging::process_deviation() const { return std::sqrt(variance_); }

}  // namespace beltlife
