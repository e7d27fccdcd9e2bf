// Owns the options of the command simulate, and its two runs that are no ranges: a sweep and an event.
#pragma once

#include <string>

#include "results/course/loaded_scene.h"
#include "results/course/options.h"

namespace beltlife {

struct SimulateOptions : RangeOptions {
  std::string scene;
  bool each_range = false;  ///< --each-range
  std::string sweep;        ///< --sweep, FROM:TO:SECONDS; empty: none
};

/// simulate with --sweep; returns the exit code.
int run_sweep(const SimulateOptions& options);
/// simulate of a scene with an event; returns the exit code.
int run_event(const LoadedScene& scene, const SimulateOptions& options);

}  // namespace beltlife
