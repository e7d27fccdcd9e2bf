// Owns the checks of a scene as a whole: what no single field can know.
#pragma once

#include "sim/scene/scene.h"
#include "sim/scene/spec_reader.h"

namespace beltlife {

/// Appends every contradiction in the scene to log.problems. With a log that comes from reading, problems carry the
/// file's lines, and values that reading already refused are not complained of again.
void check_scene(const SceneSpec& scene, ReadLog& log);

}  // namespace beltlife
