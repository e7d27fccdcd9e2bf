// Designs of feasible geometry: see feasible_design.h.
#include "optimize/search/feasible_design.h"

#include <algorithm>

#include "optimize/search/search_design.h"

namespace beltlife {

std::vector<Design> feasible_designs(const SearchProblem& problem, std::size_t count, std::int64_t seed) {
  const SearchLedger ledger(problem, 1, 1);
  HaltonSequence sequence(problem.variables, seed);
  std::vector<Design> found = screened(ledger, sequence, count);
  std::erase_if(found, [&](const Design& x) { return !ledger.geometry_feasible(x); });
  return found;
}

Design least_violating(const SearchProblem& problem, std::int64_t seed) {
  const SearchLedger ledger(problem, 1, 1);
  HaltonSequence sequence(problem.variables, seed);
  std::vector<Design> found = screened(ledger, sequence, 1);
  found.push_back(problem.start);
  return *std::min_element(found.begin(), found.end(), [&](const Design& a, const Design& b) {
    return shortfall(ledger.geometry(a)) < shortfall(ledger.geometry(b));
  });
}

}  // namespace beltlife
