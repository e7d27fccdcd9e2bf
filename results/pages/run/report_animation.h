// Owns the section of a report page in which the belt runs: recorded frames made small, and a player for them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/pages/run/report_subject.h"

namespace beltlife {

/// What the player plays: geometry, and of every complete window of two frames or more `time_ms` (from the first one),
/// `turn` and `centre` (of each pulley by frame, rad; of the tensioner's, m), and node by node in base64 `x`, `y`
/// (16 bits over `box`, little-endian) and `tension` (8 bits over `tension_n`), all frame by frame. Nodes and frames
/// are left out evenly until it all takes less than 1.2 MB. Null if there is nothing to play.
nlohmann::json animation_data(const Subject& subject);

/// Section `#animation`, which needs nothing from elsewhere; empty if there is nothing to play.
std::string animation_section(const Subject& subject);

}  // namespace beltlife
