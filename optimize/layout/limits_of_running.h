// Owns the limits that are about the arm's reach and about running: take-up, travel, slip, hub loads, frequencies.
#pragma once

#include "optimize/layout/limit_list.h"
#include "optimize/layout/placed_layout.h"

namespace beltlife {

/// Adds those that `spec` asks for.
void add_limits_of_running(const SceneSpec& scene, const LayoutLimitsSpec& spec, const PlacedLayout& layout,
                           RunningDetail detail, LimitList& limits);

}  // namespace beltlife
