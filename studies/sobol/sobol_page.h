// Owns how a study of kind sobol shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/sobol/sobol_answer.h"

namespace beltlife {

StudyPart sobol_part(const StudyRecord& record, const SobolAnswer& answer);

}  // namespace beltlife
