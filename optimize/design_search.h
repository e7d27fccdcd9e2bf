// Owns the searches of one optimisation: over the combinations of choices, with every design that was tried.
#pragma once

#include "optimize/design_runs.h"

namespace beltlife {

/// A design that was simulated.
struct Tried {
  Candidate candidate;
  Outcome outcome;
  bool feasible = false;
  double violation = 0;         ///< sum of what is missing, each so that 1 is a lot
  std::size_t simulations = 0;  ///< of the searches so far, this design's among them
};

/// What a single search is after.
struct SearchAim {
  bool second = false;  ///< the second objective in place of the first
  /// Bound on the second objective: at least where it is made large, at most where it is made small.
  std::optional<double> second_bound;
  double second_scale = 1;  ///< what is a lot of the second objective
};

/// Better by the first objective, or the second, as the file means them.
bool better(const OptimizationSpec& spec, double a, double b);
bool better_second(const OptimizationSpec& spec, double a, double b);

class DesignSearch {
 public:
  DesignSearch(DesignRuns& runs, bool coarse) : runs_(runs), coarse_(coarse) {}

  /// The problem of a search in one combination. `start` is in the cube.
  SearchProblem problem(std::size_t combination, const Design& start, const SearchAim& aim);

  /// Spends `simulations` on designs of the start's combination. Says why it ended.
  std::string run(const Candidate& start, const SearchAim& aim, std::size_t simulations, std::int64_t seed);

  /// In the order of asking.
  const std::vector<Tried>& tried() const { return tried_; }
  std::size_t simulations() const { return simulations_; }

 private:
  std::vector<Trial> evaluate(std::size_t combination, const std::vector<Design>& designs, const SearchAim& aim);

  DesignRuns& runs_;
  bool coarse_;
  std::vector<Tried> tried_;
  std::size_t simulations_ = 0;
};

/// Combinations in which some layout keeps its limits, each with a design to start from; the scene's own, with the
/// file's start, comes first whether it is feasible or not.
struct StartingPoints {
  std::vector<Candidate> starts;
  std::vector<std::size_t> without_layout;  ///< combinations that are left out
};
StartingPoints starting_points(DesignSearch& search, const DesignProblem& design);

}  // namespace beltlife
