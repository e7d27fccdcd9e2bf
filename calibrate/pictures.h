// Owns what the page of a calibration shows: spectra and revolutions, measured, at the start and calibrated.
#pragma once

#include "calibrate/calibration_result.h"
#include "calibrate/records/measurement.h"
#include "results/course/study_run.h"

namespace beltlife {

/// For every measurement its spectrum and its mean revolution beside those of the drive at `start` and at `end`, run
/// once more with full output. A run that fails leaves its curves out.
std::vector<RecordPicture> pictures_of(const LoadedProblem& problem, const std::vector<Measurement>& measurements,
                                       const Point& start, const Point& end, int threads);

/// The revolution `b` turned so that it lies on `a` as well as it can: where a measured revolution begins nobody knows.
std::vector<double> aligned(const std::vector<double>& a, std::vector<double> b);

}  // namespace beltlife
