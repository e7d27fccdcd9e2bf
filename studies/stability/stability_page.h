// Owns how a study of kind stability shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/stability/stability_answer.h"

namespace beltlife {

StudyPart stability_part(const StudyRecord& record, const StabilityAnswer& answer);

}  // namespace beltlife
