// Owns how a study of kind convergence shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/convergence/convergence_answer.h"

namespace beltlife {

StudyPart convergence_part(const StudyRecord& record, const ConvergenceAnswer& answer);

}  // namespace beltlife
