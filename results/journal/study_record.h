// Owns a study as its log or its result file holds it: what it depends on, its points, its answer.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/eval/point.h"

namespace beltlife {

/// What the answers of a study depend on, and how they came about.
struct StudyHead {
  std::string driver;  ///< "study noise", "calibrate"
  std::string version, revision, compiler, command_line;
  std::string scene_path, scene_text;  ///< settings applied, as write_scene spells it; empty: another simulator
  std::string study_path, study_text;  ///< the study file as write_spec spells it, flags applied
  std::string lanes;                   ///< "drives" or "arcs": how the simulator used its vector lanes
  std::vector<std::string> parameters, quantities;  ///< columns of every point
};

struct StudyPoint {
  std::size_t number = 0;  ///< from 0, in the order in which the driver asked
  Point settings;
  Answer answer;
};

/// A study as a log or a result file holds it; points by number, which may have gaps if it was stopped. `answer` is
/// null until the study has ended.
struct StudyRecord {
  StudyHead head;
  std::vector<StudyPoint> points;
  nlohmann::json answer;
};

}  // namespace beltlife
