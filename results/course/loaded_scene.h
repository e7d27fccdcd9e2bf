// Owns a scene as a command takes it: read, settings applied, compiled, its measured speed and result file checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/eval/solved_drive.h"
#include "sim/model.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/speed_csv.h"

namespace beltlife {

struct LoadedScene {
  SceneFile file;
  Model model;
  std::optional<MeasuredSpeed> measured;
  std::string out;                    ///< result file, empty: none
  std::optional<SolvedDrive> solved;  ///< for the result file: before a run, so that no run is lost to it
  const MeasuredSpeed* speed() const { return measured ? &*measured : nullptr; }
};

/// Reads and compiles; warns on standard error of a mesh too coarse for its pulleys. With `out`, a result file that
/// will be written, what that file holds beside runs is solved at once. Throws BadInput.
LoadedScene load_scene(const std::string& path, const std::vector<std::string>& settings, const std::string& out = "");

}  // namespace beltlife
