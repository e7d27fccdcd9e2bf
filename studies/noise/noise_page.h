// Owns how a noise study shows its answer on a page.
#pragma once

#include "results/pages/study/study_parts.h"
#include "studies/noise/noise_answer.h"

namespace beltlife {

StudyPart noise_part(const StudyRecord& record, const NoiseAnswer& answer);

}  // namespace beltlife
