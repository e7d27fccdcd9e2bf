// Owns the pictures of a layout search's page: layouts to scale, course of the search, front, lives, coarse and fine.
#pragma once

#include <string>

#include "optimize/search_answer.h"
#include "results/journal/study_record.h"

namespace beltlife {

/// All of these return HTML with this id; empty if there is nothing to draw.

/// The layout to scale, in a frame that holds `other` too, so that two drawings of the
/// same pair can stand beside each other. With `faint` the other is drawn dashed beneath it.
std::string layout_drawing(const std::string& id, const std::string& caption, const DrawnLayout* layout,
                           const DrawnLayout* other, bool faint);

/// Best objective so far over simulations, and every simulation of the search as a mark.
std::string history_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer);
/// Life by range, at the start and of the best, with intervals.
std::string lives_chart(const std::string& id, const LivesAnswer& lives);
/// The fine model's objective over the coarse one's, of the layouts that the check ran by both.
std::string fidelity_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer);
/// The second objective over the first: front, start, best, and every simulation.
std::string front_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer);

}  // namespace beltlife
