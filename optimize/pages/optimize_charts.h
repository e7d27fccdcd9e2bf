// Owns the pictures of a layout search's page: layouts to scale, course of the search, front, lives, coarse and fine.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/journal/study_record.h"

namespace beltlife {

/// All of these return HTML with this id; empty if there is nothing to draw.

/// The layout (an answer's "layouts.best") to scale, in a frame that holds `other` too, so that two drawings of the
/// same pair can stand beside each other. With `faint` the other is drawn dashed beneath it.
std::string layout_drawing(const std::string& id, const std::string& caption, const nlohmann::json& layout,
                           const nlohmann::json& other, bool faint);

/// Best objective so far over simulations, and every simulation of the search as a mark.
std::string history_chart(const std::string& id, const StudyRecord& record);
/// Life by range, at the start and of the best, with intervals; `lives` is the answer's.
std::string lives_chart(const std::string& id, const nlohmann::json& lives);
/// The fine model's objective over the coarse one's, of the layouts that the check ran by both.
std::string fidelity_chart(const std::string& id, const StudyRecord& record);
/// The second objective over the first: front, start, best, and every simulation.
std::string front_chart(const std::string& id, const StudyRecord& record);

}  // namespace beltlife
