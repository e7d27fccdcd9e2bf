// Owns what the parts of a layout search's page share: what was asked, and small readings of the answer.
#pragma once

#include <limits>
#include <map>

#include "optimize/search_answer.h"
#include "results/pages/study/study_parts.h"

namespace beltlife::optimize_page {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A bound of the study's file; NaN where it has none.
struct Bounds {
  double lower = none, upper = none;
};
struct Constraint {
  std::string name, quantity;
  Bounds bounds;
};
/// What the search was asked, as far as its file says.
struct Asked {
  std::map<std::string, Bounds> parameters;
  std::vector<Constraint> constraints;
};

/// Empty where the study's file cannot be read.
Asked asked_of(const StudyHead& head);

/// The design that the page speaks of beside the start: the best, or of a failed search what breaks least; null where
/// there is neither.
const DesignAnswer* found_of(const SearchAnswer& answer);
std::string number_text(double v, int digits = 5);
/// None if there is no HTML.
Section section_of(const char* id, const char* title, const char* heading, const std::string& html);
/// What the best layout comes near to, its constraints, and which limits were broken.
Section active_section(const SearchAnswer& answer, const Asked& asked);

}  // namespace beltlife::optimize_page
