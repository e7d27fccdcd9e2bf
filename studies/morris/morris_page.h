// Owns how a study of kind morris shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/morris/morris_answer.h"

namespace beltlife {

StudyPart morris_part(const StudyRecord& record, const MorrisAnswer& answer);

}  // namespace beltlife
