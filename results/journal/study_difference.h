// Owns the comparison of a log's head with that of the study at hand, in words that name the first difference.
#pragma once

#include <optional>
#include <string>

#include "results/journal/study_record.h"

namespace beltlife {

/// The first thing on which answers depend that differs, in words; none if both heads are of one study. Another
/// revision, compiler, command line or path is no difference.
std::optional<std::string> first_difference(const StudyHead& log, const StudyHead& now);

}  // namespace beltlife
