// The course of an optimisation; see layout_search.h.
#include <fmt/format.h>

#include <algorithm>

#include "optimize/fidelity_check.h"
#include "optimize/finalists.h"
#include "optimize/layout_answer.h"
#include "optimize/layout_search.h"
#include "optimize/pareto.h"

namespace beltlife {
namespace {

using nlohmann::json;

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

/// Best feasible objective so far, null before there is one.
json history_of(const OptimizationSpec& spec, const std::vector<Tried>& tried) {
  json simulations = json::array(), objective = json::array();
  std::optional<double> best;
  for (const Tried& t : tried) {
    if (t.feasible && (!best || better(spec, t.outcome.objective, *best))) best = t.outcome.objective;
    simulations.push_back(t.simulations);
    objective.push_back(best ? json(*best) : json());
  }
  return {{"simulations", std::move(simulations)}, {"objective", std::move(objective)}};
}

json failures_of(const StudyRecord& record) {
  json counts = json::object();
  for (const StudyPoint& p : record.points) {
    if (p.answer.ok()) continue;
    const std::string state(to_string(p.answer.state));
    counts[state] = counts.value(state, 0) + 1;
  }
  return counts;
}

/// Of what was simulated to its end the least violating; where nothing was, the least violating geometry.
const Tried& nearest_to_feasible(const std::vector<Tried>& tried) {
  return *std::min_element(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    if (a.outcome.ok() != b.outcome.ok()) return a.outcome.ok();
    return a.violation < b.violation;
  });
}

json front_json(const DesignRuns& runs, const std::vector<Tried>& tried) {
  json front = json::array();
  for (const std::size_t i : front_of(runs.design().spec(), tried)) {
    json j = json_of(runs, tried[i].candidate, tried[i].outcome);
    j["second"] = tried[i].outcome.second;
    front.push_back(std::move(j));
  }
  return front;
}

/// Runs all searches; adds how to the answer.
void search_all(DesignSearch& search, const DesignProblem& design, json& answer) {
  const OptimizationSpec& spec = design.spec();
  const StartingPoints points = starting_points(search, design);
  const std::size_t budget = static_cast<std::size_t>(spec.optimization.budget), shares = points.starts.size();
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
    answer["combinations"].push_back({{"choices", choice_words(design, start.combination)}, {"budget", share}});
  }
  for (const std::size_t c : points.without_layout)
    answer["combinations"].push_back(
        {{"choices", choice_words(design, c)}, {"budget", 0}, {"why", "no layout found that keeps its limits"}});
  answer["ended"] = ended;
}

json finalist_json(const DesignRuns& runs, const Finalist& f) {
  json j = json_of(runs, f.candidate, f.outcome);
  j.erase("quantities");
  j["replicates"] = f.objectives().size();
  j.update(json_of(mean_of(f.objectives())));
  std::size_t holds = 0;
  for (const Outcome& o : f.replicates) holds += o.ok() && shortfall(o.constraints) == 0;
  j["constraints_hold_in"] = holds;
  j["start"] = f.is_start;
  j["lives"] = lives_of(runs.design(), f.replicates);
  return j;
}

/// What is known of the best, and of the start against it.
void add_best(const DesignRuns& runs, const std::vector<Finalist>& finalists, json& answer) {
  const OptimizationSpec& spec = runs.design().spec();
  const std::size_t w = winner(spec, finalists);
  const Finalist& best = finalists[w];
  answer["best"] = json_of(runs, best.candidate, best.outcome);
  answer["best"].update(json_of(mean_of(best.objectives())));
  answer["comparison"] = json::array();
  answer["finalists"] = json::array();
  for (std::size_t i = 0; i < finalists.size(); ++i) {
    answer["finalists"].push_back(finalist_json(runs, finalists[i]));
    if (finalists[i].is_start) {
      answer["start"].update(json_of(mean_of(finalists[i].objectives())));
      answer["lives"]["start"] = lives_of(runs.design(), finalists[i].replicates);
    }
    if (i == w) continue;
    const Comparison c = compared(spec, best, finalists[i]);
    json line = json_of(c.difference);
    line["of"] = answer["best"]["point"];
    line["against"] = runs.number_of(finalists[i].outcome.point);
    line["against_start"] = finalists[i].is_start;
    line["probability_better"] = c.probability ? json(*c.probability) : json();
    line["words"] = c.words;
    answer["comparison"].push_back(std::move(line));
  }
  answer["lives"]["best"] = lives_of(runs.design(), best.replicates);
  answer["active"] = active_of(runs, best.candidate, best.outcome);
  answer["governing"]["best"] = governing_of(runs.design(), best.outcome.values);
  answer["layouts"]["best"] = layout_of(runs.design(), best.candidate);
}

}  // namespace

json LayoutSearch::solve(StudyRun& run) const {
  const DesignProblem design(problem_, spec_);
  DesignRuns runs(design, run);
  json answer{{"algorithm", algorithm_words(spec_)},
              {"objective", {{"quantity", spec_.objective.quantity}, {"maximize", spec_.objective.maximize}}},
              {"seed", spec_.optimization.seed}};
  std::vector<Tried> checked;
  bool coarse = false;
  if (spec_.fidelity) {
    FidelityCheck check = check_fidelity(runs);
    coarse = check.trusted;
    answer["fidelity"] = {{"rank_correlation", check.correlation},
                          {"compared", check.compared},
                          {"asked", check.asked},
                          {"enough", enough_correlation},
                          {"search", coarse ? "coarse" : "fine"}};
    checked = std::move(check.fine);
  }
  const std::size_t before = runs.asked();
  DesignSearch search(runs, coarse);
  search_all(search, design, answer);
  const std::vector<Tried>& tried = search.tried();
  answer["history"] = history_of(spec_, tried);
  answer["search_simulations"] = runs.asked() - before;
  answer["check_simulations"] = before;
  if (spec_.robust) answer["robust"] = {{"samples", spec_.robust->samples}, {"percentile", spec_.robust->percentile}};

  const Candidate start = design.start();
  const Outcome at_start = runs.evaluate({start}, {}, "start").front();
  answer["start"] = json_of(runs, start, at_start);
  answer["layouts"]["start"] = layout_of(design, start);
  answer["governing"]["start"] = governing_of(design, at_start.values);

  std::vector<Tried> chosen = selected(spec_, tried, static_cast<std::size_t>(spec_.optimization.finalists));
  if (coarse)  // what the check ran fine may be better than what the coarse model liked
    for (const Tried& t : selected(spec_, checked, 1)) chosen.push_back(t);
  chosen.push_back({start, at_start, false, 0, 0});  // is left out again if it is infeasible
  const std::size_t searched = runs.asked();
  const std::vector<Finalist> finalists = run_finalists(runs, chosen, start);
  if (finalists.empty()) {
    const Tried& nearest = nearest_to_feasible(tried);
    answer["least_violating"] = json_of(runs, nearest.candidate, nearest.outcome);
    std::string words = "no layout keeps all limits; the nearest is point " +
                        std::to_string(answer["least_violating"]["point"].get<std::size_t>());
    const auto broken = violated(runs, nearest.candidate, nearest.outcome);
    for (std::size_t i = 0; i < broken.size(); ++i) words += (i ? "; " : ": ") + broken[i];
    if (!nearest.outcome.ok())
      words += fmt::format("{} it {}: {}", broken.empty() ? ":" : ";", to_string(nearest.outcome.state),
                           nearest.outcome.reason);
    answer["error"] = words;
  } else {
    add_best(runs, finalists, answer);
  }
  answer["replicate_simulations"] = runs.asked() - searched;
  if (spec_.pareto) {
    answer["pareto"] = {{"quantity", spec_.pareto->quantity},
                        {"maximize", spec_.pareto->maximize},
                        {"model", coarse ? "coarse" : "fine"},
                        {"front", front_json(runs, tried)}};
  }
  answer["failures"] = failures_of(run.record());
  return answer;
}

}  // namespace beltlife
