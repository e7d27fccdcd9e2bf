// Owns how a study of kind surrogate shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/surrogate/surrogate_answer.h"

namespace beltlife {

StudyPart surrogate_part(const StudyRecord& record, const SurrogateAnswer& answer);

}  // namespace beltlife
