// Owns the study of kind stability: predicted and observed stable steps, and whether extreme cases run.
#pragma once

#include "results/course/study_run.h"
#include "studies/stability/stability_answer.h"

namespace beltlife {

/// One field through a list of values.
struct VariationSpec {
  std::string path;
  std::vector<double> values;
  std::vector<double> factors;

  template <class V>
  void visit(V& v) {
    v("path", path, required_text, "a number of the scene by its path");
    v("values", values, any_text, "what it is set to");
    v("factors", factors, any_text, "what its value in the scene is multiplied by; give values, factors or both");
  }
};

/// A drive at its limits: settings on top of the scene.
struct ExtremeSpec {
  std::string name;
  std::vector<std::string> set;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "for tables");
    v("set", set, any_text, "settings PATH=VALUE, as of --set");
  }
};

struct StabilitySettings {
  std::string range;
  std::vector<Scheme> schemes = {Scheme::thesis, Scheme::symplectic_euler, Scheme::linearly_implicit};
  double settle_s = 0.02;
  double ramp_s = 0.1;
  double hold_s = 0.05;
  double resolution = 0.05;
  double longest = 16;
  double largest_residual = 0.05;
  std::vector<VariationSpec> variation;
  std::vector<ExtremeSpec> extreme;

  template <class V>
  void visit(V& v) {
    v("range", range, any_text, "operating range of the trials and of the extreme cases; none: the first");
    v("schemes", schemes, any_text, "time integrators whose steps are bisected");
    v("settle_s", settle_s, above(0, 1000), "of a trial, at rest");
    v("ramp_s", ramp_s, above(0, 1000), "of a trial");
    v("hold_s", hold_s, above(0, 1000), "of a trial, all of it evaluated");
    v("resolution", resolution, within(1e-3, 1), "bisection ends once the bounds are within this part of each other");
    v("longest", longest, within(2, 1000), "no step longer than this times the predicted one is tried");
    v("largest_residual", largest_residual, above(0, 1e6),
      "a trial that ends, but does not account for this part of its energy, counts as unstable");
    v("variation", variation, any_text, "stiffnesses, dampings and meshes over which the stable step is followed");
    v("extreme", extreme, any_text, "cases that run to their end with the scene's scheme, or say why not");
  }
  void check(ReadLog& log) const;
};

class StabilityStudy {
 public:
  using Settings = StabilitySettings;
  using Result = StabilityAnswer;
  static std::vector<std::string> quantities(const Model&) { return {}; }
  StabilityStudy(const LoadedProblem& problem, const StabilitySettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  StabilityAnswer solve(StudyRun& run) const;
  static std::string text(const StabilityAnswer& answer);

 private:
  struct Case {
    std::string name, value;            ///< of tables
    std::vector<std::string> settings;  ///< on top of the scene
  };
  std::vector<StableStep> bisect(StudyRun& run) const;
  std::vector<ExtremeCase> extremes(StudyRun& run) const;
  /// As the short trials run it, or as the scene says; no text as step: the predicted one.
  Point point(const Case& c, bool trial, std::string_view scheme, const std::string& step_s) const;
  /// In the condition of the range that is run.
  Model drive_at(const Point& p) const;

  LoadedProblem problem_;
  StabilitySettings settings_;
  std::string range_;
  std::vector<Case> cases_, extremes_;
};

}  // namespace beltlife
