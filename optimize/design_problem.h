// Owns what a design is: parameters and choices as one point of the unit cube, its scene, its limits, its point.
#pragma once

#include <memory>

#include "optimize/layout/layout_limits.h"
#include "optimize/optimization_spec.h"
#include "optimize/search/search_problem.h"
#include "results/course/study_run.h"

namespace beltlife {

/// One design: which combination of the choices, and where in the cube of the parameters.
struct Candidate {
  std::size_t combination = 0;
  Design x;
};

/// Euclidean distance in the cube over the root of its variables, so that 1 is from corner to corner; infinite between
/// combinations.
double apart(const Candidate& a, const Candidate& b);

/// Turns designs into whatever else they are. The problem must have been checked: bounds, starts, choices.
class DesignProblem {
 public:
  DesignProblem(const LoadedProblem& problem, const OptimizationSpec& spec);

  std::size_t variables() const { return parameters_.size(); }
  /// The file's start, with the choices as the scene has them.
  Candidate start() const;
  /// Values in their units. At the start's coordinates the start's own, to the bit.
  std::vector<double> values(const Design& x) const;

  /// Combinations of the choices, at least one; the scene's own is the first.
  std::size_t combinations() const { return combinations_.size(); }
  const std::vector<std::string>& choices(std::size_t combination) const { return combinations_[combination]; }

  /// Columns of the points: of a scene settings first, then choices, then parameters.
  std::vector<std::string> columns() const;
  /// `settings`: lines PATH=VALUE, applied before the design.
  Point point(const Candidate& c, const std::string& settings) const;

  bool has_layout() const { return problem_.scene.has_value(); }
  /// Needs a layout.
  SceneSpec scene(const Candidate& c) const;
  /// Limits that need no simulation, without the quasi-static ones; empty without layout.
  std::vector<LayoutLimit> limits(const Candidate& c) const;
  /// The quasi-static ones alone, bending loss included: too slow to ask for what is not simulated.
  std::vector<LayoutLimit> running_limits(const Candidate& c) const;
  /// `limits` as a search takes them: so that 1 is a lot.
  std::vector<double> geometry(const Candidate& c) const;
  /// What is a lot of a limit, in its unit.
  double scale_of(const LayoutLimit& limit) const;

  const LoadedProblem& problem() const { return problem_; }
  const OptimizationSpec& spec() const { return spec_; }

 private:
  /// A scene whose parameters are written in place: finding them by path takes longer than all limits.
  struct Workpiece {
    SceneSpec scene;
    std::vector<double*> places;  ///< null: by path
  };
  const SceneSpec& placed(const Candidate& c) const;

  LoadedProblem problem_;
  OptimizationSpec spec_;
  LayoutLimitsSpec free_limits_;
  std::vector<ParameterSpec> parameters_;
  std::vector<double> start_x_;
  std::vector<std::vector<std::string>> combinations_;
  std::vector<std::unique_ptr<Workpiece>> workpieces_;
};

}  // namespace beltlife
