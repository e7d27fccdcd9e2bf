// Owns the course of a calibration: noise, spread of starts, fits, the best of them.
#pragma once

#include <string>
#include <vector>

#include "calibrate/fit.h"

namespace beltlife {

struct FitCourse {
  FitOptions options;           ///< as used, tolerance settled
  std::vector<FitResult> fits;  ///< of squares, by one-sided differences, in the order in which they were begun
  std::size_t best = 0;         ///< lowest cost
  FitResult end;                ///< from the best: with the losses, by central differences, noise measured there
  std::size_t screened = 0, screened_ok = 0;
};

/// Fits from the problem's start and from the best distinct points of a spread between the bounds; the best of them
/// once more in earnest.
FitCourse fit_many(FitModel& model, const CalibrationSettings& settings);

}  // namespace beltlife
