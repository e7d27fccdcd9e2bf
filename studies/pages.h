// Owns the list of pages that the kinds of study have.
#pragma once

#include <span>

#include "results/pages/study/study_page.h"

namespace beltlife {

std::span<const StudyPage> study_pages();

/// Each kind's own part of its page.
StudyPart convergence_part(const StudyRecord& record);
StudyPart stability_part(const StudyRecord& record);
StudyPart oat_part(const StudyRecord& record);

}  // namespace beltlife
