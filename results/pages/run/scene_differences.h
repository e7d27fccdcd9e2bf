// Owns the comparison of scenes: which fields differ, and what they are in each.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace beltlife {

/// A field that is not the same in all scenes.
struct SceneDifference {
  std::string path;                 ///< as --set spells it
  std::vector<std::string> values;  ///< one a scene, as a scene file spells it; "-" where the scene has none
};

/// In the order of the fields; elements of lists (pulleys, ranges, ...) are told apart by their names, not by their
/// places. What only the order of a list changes is no difference here.
std::vector<SceneDifference> scene_differences(const std::vector<const SceneSpec*>& scenes);

}  // namespace beltlife
