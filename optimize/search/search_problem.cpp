// The order of trials: see search_problem.h.
#include "optimize/search/search_problem.h"

#include <algorithm>
#include <cmath>

namespace beltlife {

double shortfall(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::max(0.0, -v);
  return sum;
}

double Trial::violation() const { return shortfall(geometry) + (ok ? shortfall(constraints) : 0.0); }

bool Trial::feasible() const { return ok && violation() == 0; }

double rank_value(const Trial& trial) {
  // asinh keeps the order of doubles of any size, within 711 of zero, so the steps below are always above it.
  constexpr double violated = 1000, failed = 2000;
  if (trial.feasible()) return std::asinh(trial.objective);
  const double v = trial.violation();
  return (trial.ok ? violated : failed) + v / (1 + v);
}

const Trial* best_of(const std::vector<Trial>& history) {
  const Trial* best = nullptr;
  for (const Trial& trial : history)
    if (trial.feasible() && (!best || trial.objective < best->objective)) best = &trial;
  return best;
}

}  // namespace beltlife
