// Owns what is wrong with an optimisation's file before anything runs.
#pragma once

#include "optimize/optimization_spec.h"
#include "sim/eval/study_input.h"

namespace beltlife {

/// Adds what is wrong with the file alone.
void check_optimization(const OptimizationSpec& spec, ReadLog& log);

/// Adds what is wrong with it on this scene, as it is varied.
void check_optimization_on(const OptimizationSpec& spec, const SceneSpec& scene, ReadLog& log);

}  // namespace beltlife
