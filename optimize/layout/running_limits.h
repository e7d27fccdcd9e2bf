// Owns what the quasi-static solutions of all ranges say of a layout.
#pragma once

#include <vector>

#include "optimize/layout/placed_layout.h"

namespace beltlife {

/// Of one range; `solved` false: the drive cannot run so, and the numbers say nothing.
struct RunningLimits {
  bool solved = false;
  double lengthening = 0, shortening = 0;  ///< rad, travel left to the arm on either side; without arm 0
  double slip_safety = 0;                  ///< smallest of the turning pulleys, at most 100
  double hub_load = 0;                     ///< N, largest
};

/// What a quasi-static solution of a search takes into account. The belt's bending loss takes nearly all the time (some
/// 50 ms a range against 0.2 ms) and shifts hub loads by 10 to 25 % and the arm by a degree or two on the shipped
/// drives, 2026-11-22. Without it, limits are a first sieve.
enum class RunningDetail { with_bending_loss, without_bending_loss };

/// One entry a range. `reach` is needed for the travel, `friction_band` for the travel and the largest hub load.
std::vector<RunningLimits> running_limits(const SceneSpec& scene, const PlacedLayout& layout, const ArmReach& reach,
                                          bool friction_band, RunningDetail detail);

}  // namespace beltlife
