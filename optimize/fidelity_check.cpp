// Coarse against fine: see fidelity_check.h.
#include "optimize/fidelity_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimize/search/feasible_design.h"

namespace beltlife {
namespace {

std::vector<double> ranks_of(const std::vector<double>& v) {
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return v[i] < v[j]; });
  std::vector<double> ranks(v.size());
  for (std::size_t from = 0; from < v.size();) {
    std::size_t to = from;
    while (to < v.size() && v[order[to]] == v[order[from]]) ++to;
    for (std::size_t k = from; k < to; ++k) ranks[order[k]] = 0.5 * static_cast<double>(from + to - 1);
    from = to;
  }
  return ranks;
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2) return 0;
  const std::vector<double> x = ranks_of(a), y = ranks_of(b);
  const double middle = 0.5 * static_cast<double>(a.size() - 1);
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - middle) * (y[i] - middle);
    xx += (x[i] - middle) * (x[i] - middle);
    yy += (y[i] - middle) * (y[i] - middle);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

FidelityCheck check_fidelity(DesignRuns& runs) {
  const DesignProblem& design = runs.design();
  const Candidate start = design.start();
  const auto wanted = static_cast<std::size_t>(design.spec().fidelity->check);
  DesignSearch unused(runs, true);
  // A seed of its own: the search's first designs are not spent on the check.
  const auto designs =
      feasible_designs(unused.problem(0, start.x, {}), wanted, design.spec().optimization.seed + 104729);
  std::vector<Candidate> candidates;
  if (shortfall(design.geometry(start)) == 0) candidates.push_back(start);
  for (const Design& x : designs)
    if (candidates.size() < wanted) candidates.push_back({0, x});
  const std::vector<Outcome> coarse = runs.evaluate(candidates, {true, 0}, "check, coarse");
  const std::vector<Outcome> fine = runs.evaluate(candidates, {false, 0}, "check, fine");
  FidelityCheck check;
  check.asked = candidates.size();
  std::vector<double> a, b;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    check.fine.push_back({candidates[i], fine[i], runs.feasible(candidates[i], fine[i]), 0, 0});
    if (!coarse[i].ok() || !fine[i].ok()) continue;
    a.push_back(coarse[i].objective);
    b.push_back(fine[i].objective);
  }
  check.compared = a.size();
  check.correlation = rank_correlation(a, b);
  constexpr std::size_t least = 5;
  check.trusted = check.compared >= least && check.correlation >= enough_correlation;
  return check;
}

}  // namespace beltlife
