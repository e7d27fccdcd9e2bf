// Owns the run of a pack with the linearly implicit scheme: as run.h, for up to eight drives in lockstep.
#pragma once

#include <vector>

#include "sim/lanes/lane_simulator.h"
#include "sim/run.h"

namespace beltlife {

struct PackMember {
  const Model* model = nullptr;
  const RunPlan* plan = nullptr;
};

/// Runs the members together; all have the same topology, element count, step and sampling rate. A member that fails
/// ends there; the others go on. Throws std::logic_error for a model that is not of its plan's condition.
std::vector<RunOutcome> run_pack(const std::vector<PackMember>& members, LaneUse use, const RunOptions& options = {});

}  // namespace beltlife
