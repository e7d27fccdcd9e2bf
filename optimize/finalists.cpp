// The last round: see finalists.h.
#include "optimize/finalists.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/eval/student_t.h"

namespace beltlife {
namespace {

constexpr double confidence = 0.95;

bool same(const Candidate& a, const Candidate& b) { return a.combination == b.combination && a.x == b.x; }

}  // namespace

std::vector<double> Finalist::objectives() const {
  std::vector<double> v;
  for (const Outcome& o : replicates)
    if (o.ok()) v.push_back(o.objective);
  return v;
}

MeanOf mean_of(const std::vector<double>& values) {
  MeanOf m;
  const auto n = static_cast<double>(values.size());
  if (values.empty()) return m;
  m.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) return m;
  double squares = 0;
  for (const double v : values) squares += (v - m.mean) * (v - m.mean);
  m.deviation = std::sqrt(squares / (n - 1));
  const double half = student_t_quantile(confidence, n - 1) * *m.deviation / std::sqrt(n);
  m.low = m.mean - half;
  m.high = m.mean + half;
  return m;
}

Comparison compared(const OptimizationSpec& spec, const Finalist& a, const Finalist& b) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < std::min(a.replicates.size(), b.replicates.size()); ++k)
    if (a.replicates[k].ok() && b.replicates[k].ok())
      differences.push_back((spec.objective.maximize ? 1 : -1) *
                            (a.replicates[k].objective - b.replicates[k].objective));
  Comparison c{mean_of(differences), {}, ""};
  const double mean = c.difference.mean;
  if (differences.size() < 2) {
    c.words = differences.empty() ? "not compared: no replicate of both ran to its end"
                                  : "one run of each: how sure this is, is not known";
    return c;
  }
  const auto n = static_cast<double>(differences.size());
  const double error = *c.difference.deviation / std::sqrt(n);
  const double within = error > 0 ? student_t_within(mean / error, n - 1) : (mean == 0 ? 0 : 1);
  c.probability = 0.5 * (1 + (mean < 0 ? -within : within));
  const double p = *c.probability;
  c.words = p >= 0.99   ? "better beyond doubt"
            : p >= 0.95 ? "better, very likely"
            : p >= 0.8  ? "better, likely"
            : p > 0.2   ? "cannot be told apart"
                        : "worse, likely";
  return c;
}

std::vector<Tried> selected(const OptimizationSpec& spec, const std::vector<Tried>& tried, std::size_t count) {
  std::vector<const Tried*> order;
  for (const Tried& t : tried)
    if (t.feasible) order.push_back(&t);
  std::stable_sort(order.begin(), order.end(), [&](const Tried* a, const Tried* b) {
    return better(spec, a->outcome.objective, b->outcome.objective);
  });
  constexpr double distinct = 0.01;
  std::vector<Tried> chosen;
  for (const Tried* t : order) {
    if (chosen.size() >= count) break;
    const auto close = [&](const Tried& c) { return apart(c.candidate, t->candidate) < distinct; };
    if (std::none_of(chosen.begin(), chosen.end(), close)) chosen.push_back(*t);
  }
  return chosen;
}

std::vector<Finalist> run_finalists(DesignRuns& runs, const std::vector<Tried>& chosen, const Candidate& start) {
  const OptimizationSpec& spec = runs.design().spec();
  std::vector<Candidate> candidates;
  for (const Tried& t : chosen)
    if (std::none_of(candidates.begin(), candidates.end(), [&](const Candidate& c) { return same(c, t.candidate); }))
      candidates.push_back(t.candidate);
  const std::vector<Outcome> first = runs.evaluate(candidates, {}, "finalists");
  std::vector<Finalist> finalists;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (runs.feasible(candidates[i], first[i]))
      finalists.push_back({candidates[i], first[i], {first[i]}, same(candidates[i], start)});
  std::stable_sort(finalists.begin(), finalists.end(), [&](const Finalist& a, const Finalist& b) {
    return better(spec, a.outcome.objective, b.outcome.objective);
  });
  const auto at = std::find_if(finalists.begin(), finalists.end(), [](const Finalist& f) { return f.is_start; });
  if (at != finalists.end()) finalists.erase(at + 1, finalists.end());
  candidates.clear();
  for (const Finalist& f : finalists) candidates.push_back(f.candidate);
  for (int k = 1; k < runs.replicates() && !candidates.empty(); ++k) {
    const std::vector<Outcome> more = runs.evaluate(candidates, {false, k}, "replicates");
    for (std::size_t i = 0; i < finalists.size(); ++i) finalists[i].replicates.push_back(more[i]);
  }
  return finalists;
}

std::size_t winner(const OptimizationSpec& spec, const std::vector<Finalist>& finalists) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < finalists.size(); ++i)
    if (better(spec, mean_of(finalists[i].objectives()).mean, mean_of(finalists[best].objectives()).mean)) best = i;
  return best;
}

}  // namespace beltlife
