// The search on surrogates: see kriging_search.h.
#include "optimize/search/kriging_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "optimize/search/nlopt_search.h"
#include "optimize/search/search_design.h"
#include "optimize/search/surrogates.h"

namespace beltlife {
namespace {

struct Region {
  Point centre;
  double half_width = 0;
  Point lower() const { return shifted(-half_width); }
  Point upper() const { return shifted(half_width); }
  Point shifted(double by) const {
    Point x = centre;
    for (double& v : x) v += by;
    return in_cube(x);
  }
};

// The first few of a batch trust the means, the later ones look where little is known.
constexpr std::array<Boldness, 8> boldnesses{
    {{0, 0}, {1, -0.5}, {0, 0.5}, {2, -1}, {0.5, 0.5}, {1, 0}, {0, 1}, {3, -1}}};

// Points around the centre that move some coordinates only: in many dimensions moving all goes too far.
Point candidate(const Region& region, SearchRandom& random) {
  const std::size_t n = region.centre.size();
  const double share = std::min(1.0, 4.0 / static_cast<double>(n));
  const Point low = region.lower(), high = region.upper();
  Point x = region.centre;
  const std::size_t always = random.bits() % n;
  for (std::size_t k = 0; k < n; ++k)
    if (k == always || random.uniform() < share) x[k] = low[k] + random.uniform() * (high[k] - low[k]);
  return x;
}

// Minimises the bound in the region under the constraints' bounds and the exact geometry.
Point best_believed(const SearchLedger& ledger, const Surrogates& surrogates, const Region& region, Boldness boldness,
                    SearchRandom& random) {
  constexpr int candidates = 200, calls_a_variable = 30;
  constexpr double penalty = 10;  // objective's spreads per unit of violation
  const double margin = boldness.careful > 0 ? 1e-4 : 1e-6;
  const auto assess = [&](const Point& x) {
    Assessed found{surrogates.objective(x, boldness), ledger.geometry(x)};
    const std::vector<double> bounds = surrogates.constraints(x, boldness);
    found.constraints.insert(found.constraints.end(), bounds.begin(), bounds.end());
    for (double& c : found.constraints) c -= margin;
    return found;
  };
  Point best = region.centre;
  double least = 0;
  const auto offer = [&](const Point& x, const Assessed& found) {
    const double merit = found.objective + penalty * shortfall(found.constraints);
    if (merit < least) {
      least = merit;
      best = x;
    }
  };
  const Assessed here = assess(best);
  least = here.objective + penalty * shortfall(here.constraints);
  for (int i = 0; i < candidates; ++i) {
    const Point x = candidate(region, random);
    offer(x, assess(x));
  }
  NloptTask task(SearchAlgorithm::cobyla, best);
  task.lower = region.lower();
  task.upper = region.upper();
  task.step = region.half_width / 4;
  task.xtol = region.half_width * 1e-3;
  task.max_calls = calls_a_variable * static_cast<int>(best.size() + 1);
  task.constraints = ledger.problem().geometry_constraints + surrogates.constraint_count();
  task.assess = [&](const Point& x) -> std::optional<Assessed> {
    const Assessed found = assess(x);
    offer(x, found);
    return found;
  };
  run_nlopt(task);
  return best;
}

bool too_close(const SearchLedger& ledger, const std::vector<Point>& batch, const Point& x, double apart) {
  const auto close = [&](const Point& other) { return distance(other, x) < apart; };
  if (std::any_of(batch.begin(), batch.end(), close)) return true;
  return std::any_of(ledger.history().begin(), ledger.history().end(), [&](const Trial& t) { return close(t.x); });
}

std::vector<Point> next_batch(const SearchLedger& ledger, Surrogates& surrogates, const Region& region,
                              SearchRandom& random) {
  const double apart = 0.01 * region.half_width * std::sqrt(static_cast<double>(region.centre.size()));
  const std::size_t size = static_cast<std::size_t>(std::min(ledger.batch(), ledger.left()));
  std::vector<Point> batch;
  for (std::size_t i = 0; batch.size() < size; ++i) {
    const Boldness boldness = boldnesses[i % boldnesses.size()];
    Point x = best_believed(ledger, surrogates, region, boldness, random);
    constexpr int attempts = 50;
    for (int k = 0; k < attempts && too_close(ledger, batch, x, apart); ++k) {
      x = candidate(region, random);
      if (k < attempts / 2 && !ledger.geometry_feasible(x)) x = region.centre;  // too close, so drawn again
    }
    batch.push_back(x);
    if (batch.size() < size) surrogates.believe(x);
  }
  return batch;
}

bool any_ok(const SearchLedger& ledger) {
  return std::any_of(ledger.history().begin(), ledger.history().end(), [](const Trial& t) { return t.ok; });
}

/// What a region may do.
struct Lease {
  std::size_t from = 0;   ///< its trials are those from here on
  double half_width = 0;  ///< at first
  double end = 0;         ///< half width at which it is given up
  int keep = 0;           ///< trials that it leaves to others
};

// One region's life, from its best trial on.
void explore(SearchLedger& ledger, const SearchOptions& options, const Lease& lease, SearchRandom& random) {
  constexpr double most_half_width = 0.8;
  constexpr int enough_successes = 2;
  const std::size_t n = ledger.problem().variables, batch = static_cast<std::size_t>(options.batch);
  // A batch too small to look along every axis has to try more often.
  const int patience = std::max(2, static_cast<int>((n + batch - 1) / batch));
  Region region{{}, lease.half_width};
  std::vector<KrigingShape> shapes;
  int successes = 0, failures = 0;
  while (ledger.left() > lease.keep && region.half_width > lease.end) {
    const Trial& before = ledger.history()[ledger.ranked(lease.from).front()];
    region.centre = before.x;
    const double old_rank = rank_value(before);
    Surrogates surrogates(ledger, region.centre, shapes);
    ledger.ask(next_batch(ledger, surrogates, region, random));
    const double rank = rank_value(ledger.history()[ledger.ranked(lease.from).front()]);
    const bool success = rank < old_rank - 1e-4 * std::min(1.0, std::abs(old_rank));
    successes = success ? successes + 1 : 0;
    failures = success ? 0 : failures + 1;
    if (successes == enough_successes) {
      region.half_width = std::min(2 * region.half_width, most_half_width);
      successes = 0;
    } else if (failures == patience) {
      region.half_width /= 2;
      failures = 0;
    }
  }
}

}  // namespace

std::string kriging_search(SearchLedger& ledger, const SearchOptions& options) {
  constexpr double first_half_width = 0.4;
  constexpr double enough = 0.02;             // half width at which a region has shown what it holds
  constexpr double polish_half_width = 0.05;  // wider than `enough`: the best may lie just outside of what was seen
  const double least = 5 * options.xtol;
  const int polish = options.budget / 4;
  const std::size_t n = ledger.problem().variables, batch = static_cast<std::size_t>(options.batch);
  HaltonSequence sequence(n, options.seed);
  SearchRandom random(options.seed ^ 0x6b72696765);  // not the sequence's own
  const std::size_t whole_batches = (2 * (n + 1) + batch - 1) / batch * batch;
  const std::size_t design = std::min(whole_batches, static_cast<std::size_t>(options.budget / 3 + 1));
  std::size_t from = 0;  // trials before it belong to earlier regions
  const auto begin = [&] {
    const int before = ledger.left();
    ledger.ask(screened(ledger, sequence, design));
    return ledger.left() < before;
  };
  while (ledger.left() > polish) {
    if (!begin()) break;  // what is left goes to the best known
    if (!any_ok(ledger)) continue;
    explore(ledger, options, {from, first_half_width, std::max(enough, least), polish}, random);
    from = ledger.history().size();
  }
  if (any_ok(ledger)) explore(ledger, options, {0, polish_half_width, least, 0}, random);
  while (ledger.left() > 0)
    if (!begin()) return "no new design of feasible geometry";
  return "budget spent";
}

}  // namespace beltlife
