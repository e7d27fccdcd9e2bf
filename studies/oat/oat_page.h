// Owns how a study of kind oat shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/oat/oat_answer.h"

namespace beltlife {

StudyPart oat_part(const StudyRecord& record, const OatAnswer& answer);

}  // namespace beltlife
