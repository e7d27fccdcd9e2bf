// Owns the page about a study: which kind has which sections, and what all kinds have in common.
#pragma once

#include <string>

#include "results/journal.h"

namespace beltlife {

/// The page. Of every kind: summary, failures, provenance; points where parameters are numbers; between them the
/// sections of the kind. A study that has not ended, or of a kind without sections of its own, has the common ones.
/// It reads nothing but the record. Throws BadInput if gnuplot is missing.
std::string study_html(const StudyRecord& record, const std::string& name);

}  // namespace beltlife
