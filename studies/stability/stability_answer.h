// Owns what a study of kind stability answers.
#pragma once

#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// The longest stable step of one case with one scheme. A step that was not found is 0.
struct StableStep {
  std::string name, value, scheme;
  double predicted_s = 0;
  std::string limited_by;
  double observed_s = 0, beyond_s = 0, observed_over_predicted = 0, residual = 0;
  std::string why;

  template <class V>
  void visit(V& v) {
    v("case", name, "", "field that is varied, or \"as the scene\"");
    v("value", value, unit_of_its_name, "its value; empty as the scene");
    v("scheme", scheme, "", "time integrator");
    v("predicted_s", predicted_s, "s", "predicted longest stable step; 0 where the case was refused");
    v("limited_by", limited_by, "", "what limits the prediction");
    v("observed_s", observed_s, "s", "longest step with which a trial was stable; 0: none was");
    v("beyond_s", beyond_s, "s", "shortest step with which a trial was not stable; 0: all were");
    v("observed_over_predicted", observed_over_predicted, "", "ratio of the two steps");
    v("residual", residual, "", "share of the energy not accounted for at the observed step");
    v("why", why, "", "what happened beyond it");
  }
};

struct ExtremeCase {
  std::string name, settings;
  double step_s = 0;
  std::string state, reason;
  double residual = 0, drift = 0, processor_s = 0;

  template <class V>
  void visit(V& v) {
    v("case", name, "", "name of the case");
    v("settings", settings, "", "what it changes of the scene, a line each");
    v("step_s", step_s, "s", "time step");
    v("state", state, "", "ok, infeasible, diverged, timed_out or failed");
    v("reason", reason, "", "why it is not ok");
    v("residual", residual, "", "share of the energy not accounted for");
    v("drift", drift, "", "largest relative change of a span's mean tension between the halves of the window");
    v("processor_s", processor_s, "s", "processor time");
  }
};

struct StabilityAnswer : DriverAnswer {
  std::string range;
  std::vector<StableStep> steps;
  std::vector<ExtremeCase> extremes;

  template <class V>
  void visit(V& v) {
    v("range", range, "", "operating range of trials and extreme cases");
    v("steps", steps, "", "longest stable steps, by case and scheme");
    v("extremes", extremes, "", "extreme cases");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
