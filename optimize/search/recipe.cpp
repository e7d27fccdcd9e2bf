// Searches made of several NLopt runs: see recipe.h.
#include "optimize/search/recipe.h"

#include <algorithm>
#include <cmath>

#include "optimize/search/local_values.h"
#include "optimize/search/nlopt_search.h"
#include "optimize/search/search_design.h"

namespace beltlife {
namespace {

// Points without a simulation per simulation allowed, before a run is taken for endless.
constexpr int free_points = 200;

Point best_point(const SearchLedger& ledger) { return ledger.history()[ledger.ranked().front()].x; }

// COBYLA sees limits a little inside the true ones: it ends on them within rounding, and a design outside by 1e-12 is
// no design.
std::string cobyla_from(SearchLedger& ledger, const SearchOptions& options, const Point& start, double step,
                        int floor) {
  LocalValues values(ledger, floor);
  NloptTask task(SearchAlgorithm::cobyla, start);
  task.step = step;
  task.xtol = std::min(options.xtol, step / 10);
  task.seed = options.seed;
  task.max_calls = free_points * std::max(ledger.left(), 1);
  task.constraints = ledger.problem().geometry_constraints + ledger.problem().constraints;
  task.assess = [&](const Point& x) {
    std::optional<Assessed> found = values.at(x);
    if (found)
      for (double& c : found->constraints) c -= options.xtol / 10;
    return found;
  };
  return run_nlopt(task);
}

// The best trial at least `apart` from all `seen`.
const Trial* best_distinct(const SearchLedger& ledger, const std::vector<Point>& seen, double apart) {
  for (const std::size_t i : ledger.ranked()) {
    const Trial& trial = ledger.history()[i];
    const auto close = [&](const Point& x) { return distance(x, trial.x) < apart; };
    if (std::none_of(seen.begin(), seen.end(), close)) return &trial;
  }
  return nullptr;
}

// From the best design, then once more from what that gave (noise and flat limits stop COBYLA early), then from the
// best design far from all those, and so on; once there is none, some new designs are laid out. Ends with the budget.
std::string polish(SearchLedger& ledger, const SearchOptions& options, HaltonSequence& sequence, double step) {
  const std::size_t n = ledger.problem().variables;
  const double apart = 0.1 * std::sqrt(static_cast<double>(n));
  std::vector<Point> seen;
  while (ledger.left() > 0) {
    const Trial* from = best_distinct(ledger, seen, apart);
    if (!from) {
      const int before = ledger.left();
      ledger.ask(screened(ledger, sequence, std::min<std::size_t>(2 * n, before)));
      if (ledger.left() == before) return "no new design of feasible geometry";
      if (!best_distinct(ledger, seen, apart)) seen.clear();
      continue;
    }
    const bool first = seen.empty();
    seen.push_back(from->x);
    // The first start may use all; the later ones share.
    cobyla_from(ledger, options, Point(from->x), step, first ? 0 : ledger.left() / 2);
    seen.push_back(best_point(ledger));
    cobyla_from(ledger, options, Point(seen.back()), step / 4, 0);
    seen.push_back(best_point(ledger));
  }
  return "budget spent";
}

// What an algorithm without constraints is told: ranks where only the order counts.
Assessed ranked_value(SearchLedger& ledger, const Point& x) {
  constexpr double unbuilt = 3000;  // above all ranks of trials
  const double missing = shortfall(ledger.geometry(x));
  if (missing > 0) return {unbuilt + missing / (1 + missing), {}};
  return {rank_value(*ledger.ask(x)), {}};
}

NloptTask ranked_task(SearchLedger& ledger, const SearchOptions& options, SearchAlgorithm method, int floor) {
  NloptTask task(method, best_point(ledger));
  task.seed = options.seed;
  task.xtol = options.xtol;
  task.max_calls = free_points * std::max(ledger.left(), 1);
  task.assess = [&ledger, floor](const Point& x) -> std::optional<Assessed> {
    if (ledger.left() <= floor && !ledger.known(x) && ledger.geometry_feasible(x)) return std::nullopt;
    return ranked_value(ledger, x);
  };
  return task;
}

// CRS2 draws its first population without regard to the answers. A dry run tells which, so they are asked in batches.
std::string crs2(SearchLedger& ledger, const SearchOptions& options, int floor) {
  NloptTask task = ranked_task(ledger, options, SearchAlgorithm::crs2, floor);
  const std::size_t population = 10 * (ledger.problem().variables + 1);
  std::vector<Point> first;
  NloptTask dry = task;
  dry.assess = [&](const Point& x) -> std::optional<Assessed> {
    if (first.size() == population) return std::nullopt;
    first.push_back(x);
    return Assessed{static_cast<double>(first.size()), {}};
  };
  run_nlopt(dry);
  std::vector<Point> affordable;
  for (const Point& x : first)
    if (ledger.geometry_feasible(x) && static_cast<int>(affordable.size()) < ledger.left() - floor)
      affordable.push_back(x);
  ledger.ask(affordable);
  return run_nlopt(task);
}

}  // namespace

std::string crs2_cobyla(SearchLedger& ledger, const SearchOptions& options) {
  HaltonSequence sequence(ledger.problem().variables, options.seed);
  // A few designs that can be built: CRS2 then starts at one, however rare they are.
  const int few = std::min(static_cast<int>(ledger.problem().variables) + 1, ledger.left() / 8);
  ledger.ask(screened(ledger, sequence, std::max(few, 0)));
  crs2(ledger, options, ledger.left() - (options.budget / 2 - few));
  return polish(ledger, options, sequence, 0.1);
}

std::string cobyla_multistart(SearchLedger& ledger, const SearchOptions& options) {
  HaltonSequence sequence(ledger.problem().variables, options.seed);
  const int designs = std::min(3 * static_cast<int>(ledger.problem().variables), ledger.left() / 5);
  ledger.ask(screened(ledger, sequence, std::max(designs, 0)));
  return polish(ledger, options, sequence, 0.3);
}

std::string nlopt_alone(SearchLedger& ledger, const SearchOptions& options) {
  if (options.algorithm == SearchAlgorithm::cobyla) {
    const Point start = best_point(ledger);
    const std::string ended = cobyla_from(ledger, options, start, 0.1, 0);
    return ledger.left() > 0 ? cobyla_from(ledger, options, best_point(ledger), 0.025, 0) : ended;
  }
  if (options.algorithm == SearchAlgorithm::crs2) return crs2(ledger, options, 0);
  NloptTask task = ranked_task(ledger, options, options.algorithm, 0);
  if (options.algorithm == SearchAlgorithm::isres) {
    task.constraints = ledger.problem().geometry_constraints + ledger.problem().constraints;
    task.assess = [&, inner = task.assess](const Point& x) -> std::optional<Assessed> {
      std::optional<Assessed> found = inner(x);
      if (!found) return found;
      const Trial* trial = ledger.known(x);
      found->constraints = ledger.geometry(x);
      if (trial && trial->ok) {
        found->objective = std::asinh(trial->objective);
        found->constraints.insert(found->constraints.end(), trial->constraints.begin(), trial->constraints.end());
      }
      found->constraints.resize(task.constraints, 0.0);
      return found;
    };
  }
  if (options.algorithm == SearchAlgorithm::bobyqa || options.algorithm == SearchAlgorithm::neldermead ||
      options.algorithm == SearchAlgorithm::sbplx) {
    // Their models and simplices need sizes, not ranks: a penalty as steep as the first answers suggest.
    const Trial first = ledger.history()[ledger.ranked().front()];
    const double steep = 10 * (1 + (first.ok ? std::abs(first.objective) : 0.0));
    task.assess = [&, steep, values = LocalValues(ledger, 0)](const Point& x) mutable -> std::optional<Assessed> {
      const std::optional<Assessed> found = values.at(x);
      if (!found) return std::nullopt;
      return Assessed{found->objective + steep * shortfall(found->constraints), {}};
    };
  }
  return run_nlopt(task);
}

std::string random_search(SearchLedger& ledger, const SearchOptions& options) {
  HaltonSequence sequence(ledger.problem().variables, options.seed);
  while (ledger.left() > 0) {
    const int before = ledger.left();
    ledger.ask(screened(ledger, sequence, static_cast<std::size_t>(std::min(ledger.batch(), before))));
    if (ledger.left() == before) return "no new design of feasible geometry";
  }
  return "budget spent";
}

}  // namespace beltlife
