// Owns what simulations say of a design: objective, constraints, and how they are run: coarse or fine, which replicate.
#pragma once

#include <optional>
#include <set>

#include "optimize/design_problem.h"
#include "results/course/study_run.h"

namespace beltlife {

/// How a design is run.
struct RunLevel {
  bool coarse = false;
  int replicate = 0;  ///< crank phase, and with scatter a draw of its own; 0: those of the search
};

/// What came of a design.
struct Outcome {
  PointState state = PointState::failed;
  std::string reason;               ///< in words, unless ok
  Point point;                      ///< as the log has it; with scatter the first of its draws
  std::vector<double> values;       ///< one a quantity of the problem; with scatter the mean; empty unless ok
  double objective = 0;             ///< as the file means it; with scatter the percentile, counted from the bad end
  double second = 0;                ///< the second objective likewise; 0 without
  std::vector<double> constraints;  ///< what is left to the bound, in its unit, negative where it is broken: every
                                    ///< bound of the file in order, lower before upper, then the quasi-static limits

  bool ok() const { return state == PointState::ok; }
};

/// One bound of a constraint.
struct BoundLine {
  std::string name;
  std::string quantity;
  double bound = 0;
  bool upper = false;
  double scale = 1;  ///< what is a lot
};

class DesignRuns {
 public:
  DesignRuns(const DesignProblem& design, StudyRun& run);

  /// In order. Quasi-static limits are computed for what has been simulated alone.
  std::vector<Outcome> evaluate(const std::vector<Candidate>& candidates, RunLevel level, const std::string& what);

  /// Simulations that one design takes.
  std::size_t simulations() const { return draws_.empty() ? 1 : draws_.size(); }
  /// How many different replicates there are: one, where neither a crank's phase nor scatter can tell them apart.
  int replicates() const;

  const std::vector<BoundLine>& bounds() const { return bounds_; }
  /// Number of `Outcome::constraints`.
  std::size_t constraints() const { return bounds_.size() + running_scales_.size(); }
  /// Constraints so that 1 is a lot.
  std::vector<double> scaled(const Outcome& outcome) const;
  /// Nothing of its layout or its simulation is violated.
  bool feasible(const Candidate& c, const Outcome& outcome) const;

  /// Different points asked so far, whether they were in the log or not.
  std::size_t asked() const { return asked_.size(); }
  /// Number of the point in the log. The point must have been evaluated.
  std::size_t number_of(const Point& point) const;

  const DesignProblem& design() const { return design_; }

 private:
  std::vector<std::string> settings_of(RunLevel level) const;
  Outcome outcome_of(const std::vector<Point>& points, const std::vector<Answer>& answers) const;
  std::vector<double> constraints_of(const std::vector<double>& values) const;

  const DesignProblem& design_;
  StudyRun& run_;
  std::size_t objective_ = 0;
  std::optional<std::size_t> second_;
  std::vector<BoundLine> bounds_;
  std::vector<std::size_t> columns_;  ///< of the bounds
  std::vector<double> running_scales_;
  std::set<Point> asked_;
  std::vector<std::vector<double>> draws_;  ///< of the scatter, for the search
};

}  // namespace beltlife
