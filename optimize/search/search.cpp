// The choice among search algorithms: see search.h.
#include "optimize/search/search.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "optimize/search/kriging_search.h"
#include "optimize/search/recipe.h"
#include "optimize/search/search_ledger.h"

namespace beltlife {
namespace {

void check(const SearchProblem& problem, const SearchOptions& options) {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument("search: " + why); };
  if (problem.variables == 0) refuse("nothing to vary");
  if (problem.start.size() != problem.variables) refuse("the start has another number of variables");
  for (const double v : problem.start)
    if (!(v >= 0 && v <= 1)) refuse("the start is outside the unit cube");
  if (!problem.evaluate) refuse("nothing to evaluate");
  if (!problem.geometry && problem.geometry_constraints > 0) refuse("distances without a function for them");
  if (options.budget < 1) refuse(fmt::format("budget {} (allowed: at least 1)", options.budget));
  if (options.batch < 1) refuse(fmt::format("batch {} (allowed: at least 1)", options.batch));
  if (!(options.xtol > 0 && options.xtol < 1)) refuse(fmt::format("xtol {} (allowed: 0 to 1)", options.xtol));
}

// COBYLA's and CRS2's needs grow with the variables; a surrogate's steps do not.
constexpr std::size_t most_for_crs2 = 6;

std::string run(SearchLedger& ledger, SearchOptions options) {
  if (options.algorithm == SearchAlgorithm::automatic)
    options.algorithm =
        ledger.problem().variables <= most_for_crs2 ? SearchAlgorithm::crs2_cobyla : SearchAlgorithm::kriging;
  switch (options.algorithm) {
    case SearchAlgorithm::crs2_cobyla:
      return crs2_cobyla(ledger, options);
    case SearchAlgorithm::cobyla_multistart:
      return cobyla_multistart(ledger, options);
    case SearchAlgorithm::kriging:
      return kriging_search(ledger, options);
    case SearchAlgorithm::random:
      return random_search(ledger, options);
    default:
      return nlopt_alone(ledger, options);
  }
}

}  // namespace

SearchResult search(const SearchProblem& problem, const SearchOptions& options) {
  check(problem, options);
  SearchLedger ledger(problem, options.budget, options.batch);
  ledger.ask(problem.start);
  std::string ended = ledger.left() > 0 ? run(ledger, options) : "budget spent";
  if (ledger.left() == 0) ended = "budget spent";
  return {ledger.history(), ended};
}

}  // namespace beltlife
