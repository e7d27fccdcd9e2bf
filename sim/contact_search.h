// Owns the search for nodes that may touch a pulley before the next search.
#pragma once

#include "sim/model.h"
#include "sim/state.h"

namespace beltlife {

/// Determines `near` and `segments` of the state and when to search again: before the fastest node can have crossed
/// half the search margin, and at least every 1e-4 s. Nodes that are no longer near lose contact forces and anchors.
/// Allocates nothing once the segments have grown.
void find_contacts(const Model& model, double step, State& state, Work& work);

}  // namespace beltlife
