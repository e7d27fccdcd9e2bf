// Owns the list of pages that the kinds of study have.
#pragma once

#include <span>

#include "results/pages/study/study_page.h"

namespace beltlife {

std::span<const StudyPage> study_pages();

}  // namespace beltlife
