// Owns how the command calibrate shows its answer on a page.
#pragma once

#include "calibrate/calibration_result.h"
#include "results/pages/study/study_page.h"

namespace beltlife {

StudyPart calibrate_part(const StudyRecord& record, const CalibrationAnswer& answer);

/// The row for the command report.
const StudyPage& calibration_page();

}  // namespace beltlife
