// What a local search is told: see local_values.h.
#include "optimize/search/local_values.h"

#include <Eigen/Dense>
#include <algorithm>

namespace beltlife {
namespace {

// Answered trials nearest to x, nearest first.
std::vector<const Trial*> neighbours(const std::vector<Trial>& history, const Point& x, std::size_t count) {
  std::vector<std::pair<double, const Trial*>> all;
  for (const Trial& trial : history)
    if (trial.ok) all.emplace_back(distance(trial.x, x), &trial);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Trial*> nearest;
  for (std::size_t i = 0; i < std::min(count, all.size()); ++i) nearest.push_back(all[i].second);
  return nearest;
}

// At x, the plane through the first point that fits the others best; kept within their range on either side.
double extrapolated(const std::vector<const Trial*>& near, const Eigen::VectorXd& values, const Point& x) {
  const auto n = static_cast<Eigen::Index>(x.size()), m = values.size();
  Eigen::MatrixXd offsets(m, n);
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index k = 0; k < n; ++k) offsets(i, k) = near[i]->x[k] - near[0]->x[k];
  Eigen::VectorXd to(n);
  for (Eigen::Index k = 0; k < n; ++k) to(k) = x[k] - near[0]->x[k];
  Eigen::MatrixXd normal = offsets.transpose() * offsets;
  constexpr double ridge = 1e-3, tiny = 1e-12;  // directions that nobody went along get no slope
  normal.diagonal().array() += ridge * normal.trace() / static_cast<double>(n) + tiny;
  const Eigen::VectorXd rises = values.array() - values(0);
  const double value = values(0) + to.dot(normal.ldlt().solve(offsets.transpose() * rises));
  const double low = values.minCoeff(), high = values.maxCoeff();
  return std::clamp(value, low - (high - low), high + (high - low));
}

}  // namespace

bool LocalValues::model_answers_outside() const {
  constexpr int benefit_of_doubt = 2;
  int asked = 0, failed = 0;
  for (const Trial& trial : ledger_.history())
    if (shortfall(trial.geometry) > 0) {
      ++asked;
      failed += !trial.ok;
    }
  return failed < benefit_of_doubt || 2 * failed <= asked;
}

Assessed LocalValues::substitute(const Point& x, bool inside) const {
  Assessed found{0, ledger_.geometry(x)};
  const std::size_t geometry = found.constraints.size(), simulated = ledger_.problem().constraints;
  found.constraints.resize(geometry + simulated, 0.0);
  const auto near = neighbours(ledger_.history(), x, 2 * (x.size() + 1));
  if (near.empty()) return found;
  for (std::size_t c = 0; c <= simulated; ++c) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(near.size()));
    for (std::size_t i = 0; i < near.size(); ++i)
      values(static_cast<Eigen::Index>(i)) = c < simulated ? near[i]->constraints[c] : near[i]->objective;
    const double low = values.minCoeff(), high = values.maxCoeff();
    const double worse = c < simulated ? low : high + (high - low);
    (c < simulated ? found.constraints[geometry + c] : found.objective) =
        inside ? worse : extrapolated(near, values, x);
  }
  return found;
}

std::optional<Assessed> LocalValues::at(const Point& x) {
  const bool inside = ledger_.geometry_feasible(x);
  const Trial* trial = ledger_.known(x);
  if (!trial && (inside || model_answers_outside())) {
    if (ledger_.left() <= floor_) return std::nullopt;
    trial = ledger_.ask(x);
  }
  if (!trial || !trial->ok) return substitute(x, inside);
  Assessed found{trial->objective, trial->geometry};
  found.constraints.insert(found.constraints.end(), trial->constraints.begin(), trial->constraints.end());
  return found;
}

}  // namespace beltlife
