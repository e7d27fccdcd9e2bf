// Owns the running of a scene's operating ranges, each alone and in parallel.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/plan.h"
#include "sim/run.h"

namespace beltlife {

/// Plans of the named ranges (all if `names` is empty), with early end if the scene asks for it; a scene without ranges
/// is run at rest. Throws BadInput for a name that the scene does not have.
std::vector<RunPlan> plans_of(const SceneSpec& scene, const std::vector<std::string>& names,
                              const MeasuredSpeed* measured);

/// Runs plans on `threads` threads (0: all), longest first, each with the drive in the plan's condition, which is the
/// base one or a range's; a plan with early end leaves one window. `progress` gets the simulated seconds done of all
/// plans together; it is called from any thread, never from two at once. `frames` of the moving drive are kept at the
/// end of each window.
std::vector<RunOutcome> run_plans(const Model& drive, const std::vector<RunPlan>& plans, int threads,
                                  const std::function<void(double)>& progress = {}, bool profile_kernels = false,
                                  int frames = 0);

}  // namespace beltlife
