// Owns the last round: the best designs that differ, run again with replicates and compared in pairs.
#pragma once

#include "optimize/design_search.h"

namespace beltlife {

struct Finalist {
  Candidate candidate;
  Outcome outcome;                  ///< of the fine model, replicate 0: what stands in the log under `point`
  std::vector<Outcome> replicates;  ///< the same among them, first
  bool is_start = false;

  /// Objectives of the replicates that are ok.
  std::vector<double> objectives() const;
};

/// Mean of some values, with its interval of 95 % by Student's t; of one value there is no deviation and no interval.
struct MeanOf {
  double mean = 0;
  std::optional<double> deviation, low, high;
};
MeanOf mean_of(const std::vector<double>& values);

/// How much better a is than b, by replicates of equal number (their crank phases are the same): positive where a is
/// better.
struct Comparison {
  MeanOf difference;
  std::optional<double> probability;  ///< that a is better (Student's t of the differences); of one run each none
  std::string words;
};
Comparison compared(const OptimizationSpec& spec, const Finalist& a, const Finalist& b);

/// The best feasible of `tried` that are at least a hundredth of the cube apart, at most `count`.
std::vector<Tried> selected(const OptimizationSpec& spec, const std::vector<Tried>& tried, std::size_t count);

/// Runs them fine, with replicates, each once if it stands there twice. Feasible ones alone, best first by replicate 0;
/// after the start, where it is among them, none that is worse. A coarse search's designs may turn out infeasible and
/// are then left out.
std::vector<Finalist> run_finalists(DesignRuns& runs, const std::vector<Tried>& chosen, const Candidate& start);

/// The one of the best mean; of one whose replicates failed the mean of the others counts. `finalists` is not empty.
std::size_t winner(const OptimizationSpec& spec, const std::vector<Finalist>& finalists);

}  // namespace beltlife
