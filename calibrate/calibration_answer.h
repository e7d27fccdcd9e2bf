// Owns how a calibration's answer follows from its fits.
#pragma once

#include "calibrate/calibration_result.h"
#include "calibrate/fit_many.h"
#include "calibrate/inference.h"

namespace beltlife {

/// Values with intervals, cost and its course, correlations, the weakest direction.
CalibrationAnswer answer_of(const FitModel& model, const FitCourse& course, const Inference& inference,
                            const std::vector<std::size_t>& profiled, const std::vector<Profile>& profiles,
                            double confidence);

/// Targets beside the model's numbers at the start and at the end.
std::vector<ResidualAnswer> residuals_of(const std::vector<Target>& targets, const Answer& start, const Answer& end);

}  // namespace beltlife
