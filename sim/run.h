// Owns a run from rest to the end of its plan: steps, samples, observes, and ends with a record whatever happens.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/plan.h"
#include "sim/record.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

struct RunOptions {
  /// Sample channels from the first evaluated window on only; false: from rest.
  bool windows_only = false;
  /// Frames of the moving drive kept at the end of each evaluated window; fewer where a window has fewer observations.
  int frames = 0;
  /// Called as an evaluated window ends with what was recorded so far; true ends the run there. May be empty.
  std::function<bool(const RunRecord&)> enough;
  /// Called with simulated seconds done, now and then; may be empty.
  std::function<void(double)> progress;
  /// Fill kernel_times.
  bool profile_kernels = false;
};

struct RunOutcome {
  RunRecord record;
  std::vector<KernelTime> kernel_times;
};

/// The step that a run of this model takes: the scene's, or the predicted stable one, shortened so that a whole number
/// of steps makes one sampling interval.
double run_step(const Model& model);

/// Names of what a step of this model goes through under its scheme, in order.
std::vector<std::string> kernel_names(const Model& model);

/// The model is of the plan's condition; else std::logic_error is thrown.
RunOutcome run(const Model& model, const RunPlan& plan, const RunOptions& options = {});

}  // namespace beltlife
