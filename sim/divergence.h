// Owns the check that a running drive is still one: what went wrong, where, why, and what to try.
#pragma once

#include <optional>

#include "sim/schemes/scheme.h"
#include "sim/status.h"

namespace beltlife {

/// First thing that is no longer a belt drive, if any: an element stretched by half, a speed beyond reason, a node
/// pressed half way through a pulley.
std::optional<RunStatus> failure(const DriveView& s);

}  // namespace beltlife
