// Owns the reduction of a recorded window to the loads that the stresses need (thesis ch. 5).
#pragma once

#include "sim/life/life.h"
#include "sim/record.h"
#include "sim/scene/scene.h"

namespace beltlife {

/// Loads of one window. Tensions come from the sampled channels "span.A-B.tension_n" of the two spans beside each
/// pulley (spans are named by the pulleys they join, in scene order, the last span is LAST-FIRST).
/// `unstretched_length_m` is the solved one. Loads that the window did not record (no sample, no pass) are NaN, which
/// life.h turns into an error in words; a missing channel is a bug and throws std::logic_error.
RangeLoad range_load(const SceneSpec& scene, double unstretched_length_m, const RunRecord& run,
                     const WindowRecord& window);

}  // namespace beltlife
