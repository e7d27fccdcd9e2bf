// Owns the interfaces of the lanes' linear solve where they feel each other.
#pragma once

#include "sim/lanes/lane_belt.h"

namespace beltlife {

/// Solves the interfaces together. `block`: upper halves by rows of each lane's 4 x 4; `first`, `second`: 2 x 4
/// couplings of the interface's two nodes to the left interface; `x`: right-hand sides, replaced by the solution.
void solve_coupled_interfaces(LaneUse use, const LaneNumber (&block)[10], const LaneNumber (&first)[8],
                              const LaneNumber (&second)[8], LaneNumber (&x)[4]);

}  // namespace beltlife
