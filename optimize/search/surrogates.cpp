// What a surrogate search believes: see surrogates.h.
#include "optimize/search/surrogates.h"

#include <algorithm>
#include <cmath>

namespace beltlife {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int first_steps = 40, later_steps = 6;  // of the likelihood's search, at first and once a shape is known

VectorXd vector_of(const Point& x) { return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size())); }

Eigen::MatrixXd rows_of(const std::vector<const Trial*>& trials) {
  Eigen::MatrixXd rows(static_cast<Index>(trials.size()), static_cast<Index>(trials.front()->x.size()));
  for (std::size_t i = 0; i < trials.size(); ++i) rows.row(static_cast<Index>(i)) = vector_of(trials[i]->x).transpose();
  return rows;
}

// Centred and of unit spread; what lies far above the median is pressed together, or walls would swamp the valley.
VectorXd normalised(VectorXd y) {
  VectorXd sorted = y;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted(sorted.size() / 2), below = median - sorted(0);
  if (below > 0)
    for (double& v : y)
      if (v > median) v = median + below * std::log1p((v - median) / below);
  y.array() -= y.mean();
  const double spread = std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
  if (spread > 0) y /= spread;
  return y;
}

// Keeps the sign, presses what is far from the limit.
double pressed(double c) { return std::copysign(std::log1p(std::abs(c)), c); }

}  // namespace

Surrogates::Surrogates(const SearchLedger& ledger, const Point& centre, std::vector<KrigingShape>& shapes) {
  const SearchProblem& problem = ledger.problem();
  // The cube of this number is the cost of a round.
  const std::size_t most = std::min<std::size_t>(10 * problem.variables + 30, 150);
  std::vector<std::pair<double, const Trial*>> near;
  for (const Trial& trial : ledger.history()) near.emplace_back(distance(trial.x, centre), &trial);
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Trial*> all, answered;
  for (const auto& [_, trial] : near) {
    if (answered.size() == most || all.size() == 2 * most) break;
    all.push_back(trial);
    if (trial->ok) answered.push_back(trial);
  }
  if (answered.empty())
    for (const auto& [_, trial] : near)
      if (trial->ok && answered.empty()) answered.push_back(trial);
  const Eigen::MatrixXd x = rows_of(answered);
  const auto fitted = [&](std::size_t which, const Eigen::MatrixXd& at, const VectorXd& y) {
    const bool known = shapes.size() > which;
    if (!known) shapes.push_back(usual_shape(at.cols()));
    shapes[which] = likeliest_shape(at, y, shapes[which], known ? later_steps : first_steps);
    return Kriging(at, y, shapes[which]);
  };
  VectorXd y(x.rows());
  for (Index i = 0; i < x.rows(); ++i) y(i) = answered[i]->objective;
  objective_ = fitted(0, x, normalised(y));
  for (std::size_t c = 0; c < problem.constraints; ++c) {
    for (Index i = 0; i < x.rows(); ++i) y(i) = pressed(answered[i]->constraints[c]);
    const double size = std::max(std::sqrt(y.squaredNorm() / static_cast<double>(y.size())), 1e-12);
    constraints_.push_back(fitted(1 + c, x, y / size));
  }
  failure_ = all.size() > answered.size();
  if (failure_) {
    const Eigen::MatrixXd at = rows_of(all);
    VectorXd success(at.rows());
    for (Index i = 0; i < at.rows(); ++i) success(i) = all[i]->ok ? 1 : -1;
    constraints_.push_back(fitted(1 + problem.constraints, at, success));
  }
}

double Surrogates::objective(const Point& x, Boldness boldness) const {
  if (boldness.bold == 0) return objective_->mean(vector_of(x));
  const Kriging::Prediction p = objective_->predict(vector_of(x));
  return p.mean - boldness.bold * p.deviation;
}

std::vector<double> Surrogates::constraints(const Point& x, Boldness boldness) const {
  const VectorXd at = vector_of(x);
  std::vector<double> values;
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    // Failure is told by its mean alone: it is a guess between two values, with no slope to be careful about.
    const bool mean_only = boldness.careful == 0 || (failure_ && c + 1 == constraints_.size());
    if (mean_only) {
      values.push_back(constraints_[c].mean(at));
      continue;
    }
    const Kriging::Prediction p = constraints_[c].predict(at);
    values.push_back(p.mean - boldness.careful * p.deviation);
  }
  return values;
}

void Surrogates::believe(const Point& x) {
  const VectorXd at = vector_of(x);
  objective_ = objective_->with(at, objective_->mean(at));
  for (Kriging& constraint : constraints_) constraint = constraint.with(at, constraint.mean(at));
}

}  // namespace beltlife
