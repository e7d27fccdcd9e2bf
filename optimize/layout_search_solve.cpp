// The course of an optimisation; see layout_search.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimize/fidelity_check.h"
#include "optimize/finalists.h"
#include "optimize/layout_answer.h"
#include "optimize/layout_search.h"
#include "optimize/pareto.h"

namespace beltlife {
namespace {

std::string algorithm_words(const OptimizationSpec& spec) {
  SearchAlgorithm a = spec.optimization.algorithm;
  std::string words(enum_name(a));
  if (a != SearchAlgorithm::automatic) return words;
  const std::size_t n = spec.problem.parameter.size();
  constexpr std::size_t most_for_crs2 = 6;  // as search() chooses
  return fmt::format("{} (automatic, {} parameters)", n <= most_for_crs2 ? "crs2_cobyla" : "kriging", n);
}

std::string choice_words(const DesignProblem& design, std::size_t combination) {
  std::string words;
  for (std::size_t i = 0; i < design.spec().choice.size(); ++i)
    words += (i ? ", " : "") + design.spec().choice[i].path + " = " + design.choices(combination)[i];
  return words;
}

/// Best feasible objective so far, not known before there is one.
SearchHistory history_of(const OptimizationSpec& spec, const std::vector<Tried>& tried) {
  SearchHistory history;
  std::optional<double> best;
  for (const Tried& t : tried) {
    if (t.feasible && (!best || better(spec, t.outcome.objective, *best))) best = t.outcome.objective;
    history.simulations.push_back(static_cast<std::int64_t>(t.simulations));
    history.objective.push_back(best.value_or(not_known));
  }
  return history;
}

std::map<std::string, std::int64_t> failures_of(const StudyRecord& record) {
  std::map<std::string, std::int64_t> counts;
  for (const StudyPoint& p : record.points)
    if (!p.answer.ok()) ++counts[std::string(to_string(p.answer.state))];
  return counts;
}

/// Of what was simulated to its end the least violating; where nothing was, the least violating geometry.
const Tried& nearest_to_feasible(const std::vector<Tried>& tried) {
  return *std::min_element(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    if (a.outcome.ok() != b.outcome.ok()) return a.outcome.ok();
    return a.violation < b.violation;
  });
}

std::vector<FrontDesign> front_answer(const DesignRuns& runs, const std::vector<Tried>& tried) {
  std::vector<FrontDesign> front;
  for (const std::size_t i : front_of(runs.design().spec(), tried))
    front.push_back({answer_of(runs, tried[i].candidate, tried[i].outcome), tried[i].outcome.second});
  return front;
}

/// Runs all searches; adds how to the answer.
void search_all(DesignSearch& search, const DesignProblem& design, SearchAnswer& answer) {
  const OptimizationSpec& spec = design.spec();
  const StartingPoints points = starting_points(search, design);
  const std::size_t budget = static_cast<std::size_t>(spec.optimization.budget), shares = points.starts.size();
  const auto add_combination = [&](CombinationAnswer combination) {
    if (!answer.combinations) answer.combinations.emplace();
    answer.combinations->push_back(std::move(combination));
  };
  std::string ended;
  for (std::size_t k = 0; k < shares; ++k) {
    const std::size_t share = budget / shares + (k == 0 ? budget % shares : 0);
    const Candidate& start = points.starts[k];
    const std::string words =
        spec.pareto ? search_front(search, spec, start, share) : search.run(start, {}, share, spec.optimization.seed);
    if (spec.choice.empty()) {
      ended = words;
      continue;
    }
    ended += (k ? "; " : "") + choice_words(design, start.combination) + ": " + words;
    add_combination({choice_words(design, start.combination), static_cast<std::int64_t>(share), {}});
  }
  for (const std::size_t c : points.without_layout)
    add_combination({choice_words(design, c), 0, "no layout found that keeps its limits"});
  answer.ended = ended;
}

FinalistAnswer finalist_answer(const DesignRuns& runs, const Finalist& f) {
  FinalistAnswer answer{answer_of(runs, f.candidate, f.outcome)};
  answer.replicates = std::ssize(f.objectives());
  answer.mean = answer_of(mean_of(f.objectives()));
  for (const Outcome& o : f.replicates) answer.constraints_hold_in += o.ok() && shortfall(o.constraints) == 0;
  answer.start = f.is_start;
  answer.lives = lives_of(runs.design(), f.replicates);
  return answer;
}

/// What the replicates say of the start.
void add_means_of_start(const DesignRuns& runs, const Finalist& f, SearchAnswer& answer) {
  const auto or_null = [](double v) { return OrNull<double>{std::isfinite(v) ? std::optional(v) : std::nullopt}; };
  const ReplicateMean mean = answer_of(mean_of(f.objectives()));
  answer.start.mean = mean.mean;
  answer.start.standard_deviation = or_null(mean.standard_deviation);
  answer.start.low = or_null(mean.low);
  answer.start.high = or_null(mean.high);
  answer.lives->start = lives_of(runs.design(), f.replicates);
}

/// What is known of the best, and of the start against it.
void add_best(const DesignRuns& runs, const std::vector<Finalist>& finalists, SearchAnswer& answer) {
  const OptimizationSpec& spec = runs.design().spec();
  const std::size_t w = winner(spec, finalists);
  const Finalist& best = finalists[w];
  answer.best = BestDesign{answer_of(runs, best.candidate, best.outcome), answer_of(mean_of(best.objectives()))};
  answer.lives.emplace();
  for (std::size_t i = 0; i < finalists.size(); ++i) {
    answer.finalists.push_back(finalist_answer(runs, finalists[i]));
    if (finalists[i].is_start) add_means_of_start(runs, finalists[i], answer);
    if (i == w) continue;
    const Comparison c = compared(spec, best, finalists[i]);
    answer.comparison.push_back({answer_of(c.difference), answer.best->point,
                                 static_cast<std::int64_t>(runs.number_of(finalists[i].outcome.point)),
                                 finalists[i].is_start, c.probability.value_or(not_known), c.words});
  }
  answer.lives->best = lives_of(runs.design(), best.replicates);
  answer.active = active_limits(runs.design(), runs.bounds(), best.candidate, best.outcome);
  answer.governing.best = governing_of(runs.design(), best.outcome.values);
  answer.layouts.best = layout_of(runs.design(), best.candidate);
}

/// Where no design keeps all limits: the nearest, and what it breaks.
void add_nearest(const DesignRuns& runs, const Tried& nearest, SearchAnswer& answer) {
  answer.least_violating = answer_of(runs, nearest.candidate, nearest.outcome);
  std::string words = fmt::format("no layout keeps all limits; the nearest is point {}", answer.least_violating->point);
  const auto broken = violated(runs, nearest.candidate, nearest.outcome);
  for (std::size_t i = 0; i < broken.size(); ++i) words += (i ? "; " : ": ") + broken[i];
  if (!nearest.outcome.ok())
    words += fmt::format("{} it {}: {}", broken.empty() ? ":" : ";", to_string(nearest.outcome.state),
                         nearest.outcome.reason);
  answer.error = words;
}

FidelityAnswer fidelity_answer(const FidelityCheck& check) {
  return {check.correlation, static_cast<std::int64_t>(check.compared), static_cast<std::int64_t>(check.asked),
          enough_correlation, check.trusted ? "coarse" : "fine"};
}

}  // namespace

SearchAnswer LayoutSearch::solve(StudyRun& run) const {
  const DesignProblem design(problem_, spec_);
  DesignRuns runs(design, run);
  SearchAnswer answer;
  answer.algorithm = algorithm_words(spec_);
  answer.objective = {spec_.objective.quantity, spec_.objective.maximize};
  answer.seed = spec_.optimization.seed;
  std::vector<Tried> checked;
  bool coarse = false;
  if (spec_.fidelity) {
    FidelityCheck check = check_fidelity(runs);
    coarse = check.trusted;
    answer.fidelity = fidelity_answer(check);
    checked = std::move(check.fine);
  }
  const std::size_t before = runs.asked();
  DesignSearch search(runs, coarse);
  search_all(search, design, answer);
  const std::vector<Tried>& tried = search.tried();
  answer.history = history_of(spec_, tried);
  answer.search_simulations = static_cast<std::int64_t>(runs.asked() - before);
  answer.check_simulations = static_cast<std::int64_t>(before);
  if (spec_.robust) answer.robust = {spec_.robust->samples, spec_.robust->percentile};

  const Candidate start = design.start();
  const Outcome at_start = runs.evaluate({start}, {}, "start").front();
  answer.start = StartDesign{answer_of(runs, start, at_start), {}, {}, {}, {}};
  answer.layouts.start = layout_of(design, start);
  answer.governing.start = governing_of(design, at_start.values);

  std::vector<Tried> chosen = selected(spec_, tried, static_cast<std::size_t>(spec_.optimization.finalists));
  if (coarse)  // what the check ran fine may be better than what the coarse model liked
    for (const Tried& t : selected(spec_, checked, 1)) chosen.push_back(t);
  chosen.push_back({start, at_start, false, 0, 0});  // is left out again if it is infeasible
  const std::size_t searched = runs.asked();
  const std::vector<Finalist> finalists = run_finalists(runs, chosen, start);
  if (finalists.empty())
    add_nearest(runs, nearest_to_feasible(tried), answer);
  else
    add_best(runs, finalists, answer);
  answer.replicate_simulations = static_cast<std::int64_t>(runs.asked() - searched);
  if (spec_.pareto)
    answer.pareto = {spec_.pareto->quantity, spec_.pareto->maximize, coarse ? "coarse" : "fine",
                     front_answer(runs, tried)};
  answer.failures = failures_of(run.record());
  return answer;
}

}  // namespace beltlife
