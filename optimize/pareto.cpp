// The trade between two objectives: see pareto.h.
#include "optimize/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace beltlife {

std::vector<std::size_t> front_of(const OptimizationSpec& spec, const std::vector<Tried>& tried) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (tried[i].feasible) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Outcome &a = tried[i].outcome, &b = tried[j].outcome;
    return a.objective != b.objective ? better(spec, a.objective, b.objective)
                                      : better_second(spec, a.second, b.second);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || better_second(spec, tried[i].outcome.second, tried[front.back()].outcome.second))
      front.push_back(i);
  return front;
}

std::string search_front(DesignSearch& search, const OptimizationSpec& spec, const Candidate& start,
                         std::size_t budget) {
  const auto steps = static_cast<std::size_t>(spec.pareto->steps);
  const std::size_t share = std::max<std::size_t>(1, budget / (steps + 2));
  std::int64_t seed = spec.optimization.seed;
  std::string words = "best by the objective: " + search.run(start, {}, budget - share * (steps + 1), seed++);
  SearchAim other;
  other.second = true;
  const auto ends = front_of(spec, search.tried());
  const Candidate from = ends.empty() ? start : search.tried()[ends.back()].candidate;
  words += "; by the second: " + search.run(from, other, share, seed++);
  const auto wide = front_of(spec, search.tried());
  if (wide.size() < 2) return words + "; the two objectives have one best layout, so that there is nothing to trade";
  const double first = search.tried()[wide.front()].outcome.second, last = search.tried()[wide.back()].outcome.second;
  for (std::size_t k = 1; k <= steps; ++k) {
    SearchAim level;
    level.second_bound = first + (last - first) * static_cast<double>(k) / static_cast<double>(steps + 1);
    level.second_scale = std::abs(last - first);
    const auto known = front_of(spec, search.tried());
    const auto holds = [&](std::size_t i) {
      return !better_second(spec, *level.second_bound, search.tried()[i].outcome.second);
    };
    const auto best = std::find_if(known.begin(), known.end(), holds);
    const Candidate begin = search.tried()[best == known.end() ? known.back() : *best].candidate;
    words += fmt::format("; held to {:.4g}: {}", *level.second_bound, search.run(begin, level, share, seed++));
  }
  return words;
}

}  // namespace beltlife
