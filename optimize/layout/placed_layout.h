// Owns one layout as its limits see it: the loop where the arm rests, whether it can be built or not.
#pragma once

#include <optional>

#include "optimize/layout/arm_reach.h"
#include "sim/scene/scene.h"

namespace beltlife {

/// The loop at rest. Where the scene says that the arm rests as placed, or has none, this takes no search.
struct PlacedLayout {
  int orientation = 1;  ///< of the two ways round the one that can be built, else the one that lacks less
  LoopShape shape;      ///< with the arm at `rest`
  std::optional<ArmOfLayout> arm;
  double rest = 0;                ///< rad; where no rest is found: as placed
  double missing = 0;             ///< m of belt by which no rest is found; 0 where it is
  double tension = 0;             ///< N at rest
  double unstretched_length = 0;  ///< m
};

/// Whether the scene itself says where the arm rests, or there is nothing to turn.
bool rests_as_placed(const SceneSpec& scene);

/// For a valid scene with pulleys. Never throws for what its numbers make of the layout.
PlacedLayout place_layout(const SceneSpec& scene);

}  // namespace beltlife
