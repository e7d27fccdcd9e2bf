// Owns how the command optimize shows its answer on a page.
#pragma once

#include "optimize/search_answer.h"
#include "results/pages/study/study_page.h"

namespace beltlife {

StudyPart optimize_part(const StudyRecord& record, const SearchAnswer& answer);

/// The row for the command report.
const StudyPage& layout_search_page();

}  // namespace beltlife
