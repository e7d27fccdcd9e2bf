// The account of a search: see search_ledger.h.
#include "optimize/search/search_ledger.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace beltlife {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

Point in_cube(Point x) {
  for (double& v : x) v = std::isnan(v) ? 0.5 : std::clamp(v, 0.0, 1.0) + 0.0;  // + 0.0: no negative zero in the memo
  return x;
}

double distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

SearchLedger::SearchLedger(const SearchProblem& problem, int budget, int batch)
    : problem_(problem), budget_(budget), batch_(batch) {}

std::vector<double> SearchLedger::geometry(const Point& x) const {
  if (!problem_.geometry) return {};
  std::vector<double> values = problem_.geometry(x);
  if (values.size() != problem_.geometry_constraints) throw std::logic_error("search: wrong number of distances");
  constexpr double far = 1e6;
  for (double& v : values) v = std::isnan(v) ? -far : std::clamp(v, -far, far);
  return values;
}

void SearchLedger::ask(const std::vector<Point>& points) {
  std::vector<Point> fresh;
  for (const Point& point : points) {
    const Point x = in_cube(point);
    if (memo_.contains(x) || std::find(fresh.begin(), fresh.end(), x) != fresh.end()) continue;
    if (static_cast<int>(fresh.size()) < left()) fresh.push_back(x);
  }
  for (std::size_t from = 0; from < fresh.size(); from += batch_) {
    const std::size_t to = std::min(fresh.size(), from + batch_);
    const std::vector<Point> some(fresh.begin() + from, fresh.begin() + to);
    std::vector<Trial> answers = problem_.evaluate(some);
    if (answers.size() != some.size()) throw std::logic_error("search: wrong number of answers");
    for (std::size_t i = 0; i < some.size(); ++i) {
      Trial& trial = answers[i];
      trial.x = some[i];
      trial.geometry = geometry(trial.x);
      if (trial.ok && trial.constraints.size() != problem_.constraints)
        throw std::logic_error("search: wrong number of constraints");
      trial.ok = trial.ok && std::isfinite(trial.objective) && all_finite(trial.constraints);
      memo_.emplace(trial.x, history_.size());
      history_.push_back(std::move(trial));
    }
  }
}

const Trial* SearchLedger::known(const Point& x) const {
  const auto found = memo_.find(in_cube(x));
  return found == memo_.end() ? nullptr : &history_[found->second];
}

const Trial* SearchLedger::ask(const Point& x) {
  if (!known(x)) ask(std::vector<Point>{x});
  return known(x);
}

std::vector<std::size_t> SearchLedger::ranked(std::size_t first) const {
  std::vector<std::size_t> order(history_.size() - std::min(first, history_.size()));
  std::iota(order.begin(), order.end(), first);
  std::vector<double> ranks;
  for (const Trial& trial : history_) ranks.push_back(rank_value(trial));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  return order;
}

}  // namespace beltlife
