// Owns the model that is the belt simulator: a scene with parameters by path, answering named quantities.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/eval/evaluator.h"
#include "sim/eval/point.h"

namespace beltlife {

struct DriveModelOptions {
  int threads = 0;  ///< 0: as many as the machine has
  LaneUse use = LaneUse::drives;
  bool retry = true;
  std::optional<double> step_budget = {};  ///< force evaluations that a range may take
  const MeasuredSpeed* measured = nullptr;
};

/// The operating ranges that have to be run to know the quantities; all if one is of the duty cycle.
std::vector<std::string> ranges_for(const SceneSpec& scene, const std::vector<std::string>& quantities);

/// Columns of a point that are no fields: settings as of --set, one a line, applied first; and a number that does
/// nothing but make repeats different points.
inline constexpr std::string_view settings_column = "settings", repeat_column = "repeat";

/// The scene of a point. Throws BadInput where a value is not allowed.
SceneSpec scene_at(const SceneSpec& base, const std::vector<std::string>& paths, const Point& point);

/// A model that sets `paths` in `base` and answers `quantities` (names of quantity_names, which it trusts). What is
/// refused as a drive (a value out of limits, overlapping pulleys, no balance) is infeasible, with the first problem
/// as its reason.
PointModel drive_model(SceneSpec base, std::vector<std::string> paths, std::vector<std::string> quantities,
                       DriveModelOptions options);

}  // namespace beltlife
