// Owns the run of a plan whose one window is no range: a sweep, an event.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/commands/simulate_options.h"
#include "sim/record.h"
#include "sim/run.h"

namespace beltlife {

struct StretchRun {
  RunRecord record;     ///< without windows
  WindowRecord window;  ///< that of the plan
  std::vector<KernelTime> kernel_times;
  double wall_s = 0;
  bool failed = false;
  std::vector<double> power_w;  ///< mean, by Energy, over what was observed of the window
};

/// Runs with progress on standard error; there also says what failed and what of the energy is amiss.
StretchRun run_stretch(const LoadedScene& scene, const RunPlan& plan, const SimulateOptions& options);

/// What simulate's answers have in common: status, run, times, step, energy.
nlohmann::json json_of(const StretchRun& run, const RunPlan& plan);
/// Energy, then one line about times, step and scheme; with --profile the time by kernel.
std::string closing_text(const StretchRun& run, const LoadedScene& scene, const SimulateOptions& options);

/// simulate of a scene with an event; returns the exit code.
int run_event(const LoadedScene& scene, const SimulateOptions& options);

}  // namespace beltlife
