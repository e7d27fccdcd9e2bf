// Owns the driver optimize: the best design of a drive, or of another program, within its limits.
#pragma once

#include "optimize/optimization_spec.h"
#include "optimize/search_answer.h"
#include "results/course/study_run.h"

namespace beltlife {

class LayoutSearch {
 public:
  using Spec = OptimizationSpec;
  using Result = SearchAnswer;
  static void prepare(Spec& spec, const DriverOptions& options, ReadLog& log);
  static std::vector<std::string> quantities(const Model&) { return {}; }  // what is needed is added later
  LayoutSearch(const LoadedProblem& problem, const Spec& spec, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  /// With the scene as it is varied, starts read from that, and all quantities recorded.
  const LoadedProblem& problem() const { return problem_; }
  SearchAnswer solve(StudyRun& run) const;
  static std::string text(const SearchAnswer& answer);

 private:
  void restate_scene(ReadLog& log);
  void add_quantities(ReadLog& log);

  LoadedProblem problem_;
  Spec spec_;
};

}  // namespace beltlife
