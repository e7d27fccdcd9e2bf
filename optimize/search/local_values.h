// Owns what a local search is told about any point, answered or not: always finite, always with a slope to follow.
#pragma once

#include <optional>

#include "optimize/search/nlopt_search.h"
#include "optimize/search/search_ledger.h"

namespace beltlife {

/// Objective and constraints (geometry first, then the simulated ones). A point outside the geometry is simulated as
/// long as the model answers there: a local search gains from true values on both sides of a limit. Once most of such
/// simulations failed, a linear fit through the nearest answers takes their place; a design that failed inside the
/// geometry counts as worse than its neighbours.
class LocalValues {
 public:
  /// Spends the budget down to `floor` points left.
  LocalValues(SearchLedger& ledger, int floor) : ledger_(ledger), floor_(floor) {}
  /// Nothing once the budget allows no more points.
  std::optional<Assessed> at(const Point& x);

 private:
  bool model_answers_outside() const;
  Assessed substitute(const Point& x, bool inside) const;

  SearchLedger& ledger_;
  int floor_;
};

}  // namespace beltlife
