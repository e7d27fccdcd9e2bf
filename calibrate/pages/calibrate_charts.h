// Owns the charts of a calibration's page: intervals, profiles, course of the cost, spectra, traces, residuals.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "calibrate/calibration_result.h"

namespace beltlife {

/// A parameter as the answer has it; NaN or empty stand for what it lacks. Values in the parameter's unit.
struct FittedParameter {
  std::string name;
  std::string identified, at_bound;  ///< words of the answer
  double value = NAN, standard_error = NAN;
  double low = NAN, high = NAN;  ///< ends of the interval
  double start = NAN;
  double lower = NAN, upper = NAN;               ///< bounds
  double profile_low = NAN, profile_high = NAN;  ///< ends of the interval by the profile
  std::vector<double> profile_value = {}, profile_cost = {};

  bool bounded() const { return std::isfinite(lower) && std::isfinite(upper) && lower < upper; }
  /// Whether charts show it on a logarithmic scale: its bounds are a factor of ten or more apart.
  bool wide() const { return bounded() && lower > 0 && upper >= 10 * lower; }
};

/// All of these return SVG as an element with this id; empty if there is nothing to draw.

/// Value, intervals and start of each parameter that has bounds, as shares of the way between them.
std::string interval_chart(const std::string& id, const std::vector<FittedParameter>& parameters);
/// Cost over the parameter; `level` is the cost that the confidence allows, NaN for none.
std::string profile_chart(const std::string& id, const FittedParameter& parameter, double level);
/// Cost over points asked, a curve each of the answer's fits.
std::string cost_chart(const std::string& id, const CalibrationAnswer& answer);
/// Amplitude over frequency, measured and calculated, as far as the half order above the ninth.
std::string spectrum_chart(const std::string& id, const RecordPicture& picture);
/// Deviation from the mean over two crank revolutions.
std::string trace_chart(const std::string& id, const RecordPicture& picture);
/// Residuals of order amplitudes over the order, a colour each range and channel.
std::string residual_chart(const std::string& id, const std::vector<ResidualAnswer>& residuals);

}  // namespace beltlife
