// Owns the page about a study: what a kind of study adds to it, and what all kinds have in common.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "results/journal/study_record.h"

namespace beltlife {

struct StudyPart;

/// How the page about one kind of study differs from the others. Every driver has a table of its own; main hands them
/// all to the command report.
struct StudyPage {
  std::string_view driver;  ///< as the log names it: "study noise"
  const char* title;
  const char* about;                      ///< the question that such a study asks
  StudyPart (*part)(const StudyRecord&);  ///< from answer and points; called with an answer that is an object
  bool scatters;                          ///< whether charts of quantities against parameters mean anything
  const char* failures;                   ///< HTML: what points that are not ok mean here
};

/// The page. Of every kind: summary, failures, provenance; points where parameters are numbers; between them the
/// sections of the kind. A study that has not ended, or of a kind that `pages` does not have, has the common ones.
/// It reads nothing but the record. Throws BadInput if gnuplot is missing.
std::string study_html(const StudyRecord& record, const std::string& name, std::span<const StudyPage> pages);

}  // namespace beltlife
