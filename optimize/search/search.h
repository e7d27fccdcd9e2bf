// Owns the choice among search algorithms: their names, their options, and the one call that runs them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "optimize/search/search_problem.h"
#include "sim/scene/field.h"

namespace beltlife {

enum class SearchAlgorithm {
  automatic,          ///< crs2_cobyla up to 6 variables, kriging above (measured: README.md)
  crs2_cobyla,        ///< half the budget CRS2, then COBYLA from the best distinct designs
  cobyla,             ///< from the start alone: local
  cobyla_multistart,  ///< from the best of some screened designs, one after another
  kriging,            ///< Gaussian-process surrogates in a trust region that restarts
  crs2,
  isres,
  esch,
  direct_l,
  bobyqa,  ///< local, constraints as a penalty; with one variable Nelder-Mead takes its place
  neldermead,
  sbplx,
  random  ///< low-discrepancy points of feasible geometry; the yardstick of the others
};
template <>
struct EnumNames<SearchAlgorithm> {
  static constexpr std::array<std::string_view, 13> names{
      "automatic", "crs2_cobyla", "cobyla", "cobyla_multistart", "kriging", "crs2",  "isres",
      "esch",      "direct_l",    "bobyqa", "neldermead",        "sbplx",   "random"};
};

struct SearchOptions {
  SearchAlgorithm algorithm = SearchAlgorithm::automatic;
  int budget = 600;       ///< simulations at most; the start is the first of them
  std::int64_t seed = 1;  ///< same seed and same answers: the same points in the same order
  double xtol = 1e-4;     ///< steps, in the unit cube, below which a local search has converged
  int batch = 8;          ///< points asked at once where an algorithm can
};

/// Searches until the budget is spent or the algorithm has converged. Failed trials stop nothing. An exception of
/// `evaluate` or `geometry` passes through. Throws std::invalid_argument if the problem or the options make no sense.
SearchResult search(const SearchProblem& problem, const SearchOptions& options);

}  // namespace beltlife
