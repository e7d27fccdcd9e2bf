// Owns how a study of kind uncertainty shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/uncertainty/uncertainty_answer.h"

namespace beltlife {

StudyPart uncertainty_part(const StudyRecord& record, const UncertaintyAnswer& answer);

}  // namespace beltlife
