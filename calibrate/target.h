// Owns the residual: a number of the model beside the measured one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/calibration_spec.h"

namespace beltlife {

/// One measured number. `column` is its place in an answer's values.
struct Target {
  std::string quantity;
  std::size_t column = 0;
  double value = 0;
  double sigma = 1;  ///< of ln(value + floor) with `logarithm`, else in the quantity's unit
  double floor = 0;
  bool logarithm = false;  ///< compares ln(A + floor)
  double weight = 1;
  Loss loss = Loss::none;
  double model_noise = 0;  ///< standard deviation of the model's own number, in the unit of sigma

  double deviation() const { return std::hypot(sigma, model_noise); }
  double residual(double model) const {
    const double r = logarithm ? std::log((std::max(model, 0.0) + floor) / (value + floor)) : model - value;
    return std::sqrt(weight) * r / deviation();
  }
};

}  // namespace beltlife
