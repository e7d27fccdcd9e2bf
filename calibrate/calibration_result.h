// Owns what a calibration answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

struct ProfileAnswer {
  double low = not_known, high = not_known;
  std::vector<double> value, cost;

  template <class V>
  void visit(V& v) {
    v("low", low, unit_of_its_name,
      "where the cost exceeds the fit's by what the confidence allows; null: not reached");
    v("high", high, unit_of_its_name, "likewise above");
    v("value", value, unit_of_its_name, "values of the parameter, from low to high");
    v("cost", cost, "", "cost there, all others fitted again");
  }
};

struct FittedValue {
  double value = not_known, standard_error = not_known, low = not_known, high = not_known, start = not_known;
  std::optional<double> lower, upper;
  std::string identified, at_bound;
  std::optional<ProfileAnswer> profile;

  template <class V>
  void visit(V& v) {
    v("value", value, unit_of_its_name, "fitted value");
    v("standard_error", standard_error, unit_of_its_name, "by the curvature; null: the data say nothing");
    v("low", low, unit_of_its_name, "lower end of its interval");
    v("high", high, unit_of_its_name, "upper end of its interval");
    v("start", start, unit_of_its_name, "start of the file");
    v("lower", lower, unit_of_its_name, "lower bound; absent without one");
    v("upper", upper, unit_of_its_name, "upper bound; absent without one");
    v("identified", identified, "", "yes; confounded: it would be settled were the others known; no");
    v("at_bound", at_bound, "", "no; lower or upper: it ended there and would go beyond");
    v("profile", profile, "", "cost over this parameter; absent where no profile was made");
  }
};

struct WeakestDirection {
  double eigenvalue = not_known;
  std::map<std::string, double> direction;
  std::string words;

  template <class V>
  void visit(V& v) {
    v("eigenvalue", eigenvalue, "", "lowest of the curvature, every parameter scaled to 1");
    v("direction", direction, "", "its eigenvector by parameter");
    v("words", words, "", "what trades off against what");
  }
};

struct ResidualAnswer {
  std::string quantity;
  double measured = not_known, start = not_known, calibrated = not_known, start_error = not_known,
         calibrated_error = not_known, sigma = not_known, model_noise = not_known;
  bool logarithm = false;
  double residual = not_known;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, "", "what was measured");
    v("measured", measured, "the quantity's", "measured value");
    v("start", start, "the quantity's", "the model's at the start; null if it failed there");
    v("calibrated", calibrated, "the quantity's", "the model's at the end");
    v("start_error", start_error, "", "relative error at the start");
    v("calibrated_error", calibrated_error, "", "relative error at the end");
    v("sigma", sigma, "", "stated deviation: relative with logarithm, else in the quantity's unit");
    v("model_noise", model_noise, "", "the model's own noise, likewise");
    v("logarithm", logarithm, "", "whether logarithms are compared");
    v("residual", residual, "", "calculated less measured, in standard deviations");
  }
};

/// The highest order of one record.
struct MainFrequency {
  std::string range, channel;
  double order = not_known, hz = not_known, measured = not_known, start = not_known, calibrated = not_known,
         start_error = not_known, calibrated_error = not_known, thesis_error = not_known;

  template <class V>
  void visit(V& v) {
    v("range", range, "", "operating range");
    v("channel", channel, "", "measured channel");
    v("order", order, "", "of the crank's rotation");
    v("hz", hz, "Hz", "frequency");
    v("measured", measured, "the channel's", "measured amplitude");
    v("start", start, "the channel's", "amplitude at the start");
    v("calibrated", calibrated, "the channel's", "amplitude at the end");
    v("start_error", start_error, "", "relative error at the start");
    v("calibrated_error", calibrated_error, "", "relative error at the end");
    v("thesis_error", thesis_error, "", "error that the thesis reports for such a range");
  }
};

struct FitAnswer {
  bool ok = false;
  std::string ended;
  double start_cost = not_known, cost = not_known;
  std::map<std::string, double> parameters;
  std::optional<std::vector<std::int64_t>> points;
  std::optional<std::vector<double>> costs;

  template <class V>
  void visit(V& v) {
    v("ok", ok, "", "whether it has a point with residuals");
    v("ended", ended, "", "why it ended");
    v("start_cost", start_cost, "", "cost at its start");
    v("cost", cost, "", "cost at its end; null if it failed");
    v("parameters", parameters, unit_of_its_name, "values at its end");
    v("points", points, "", "points asked after each iteration");
    v("costs", costs, "", "cost after each iteration");
  }
};

struct CalculatedCurves {
  std::vector<double> frequency_hz, amplitude, trace;

  template <class V>
  void visit(V& v) {
    v("frequency_hz", frequency_hz, "Hz", "of the amplitude spectrum");
    v("amplitude", amplitude, "the channel's", "amplitude spectrum");
    v("trace", trace, "the channel's", "mean over two crank revolutions, deviation from the mean");
  }
};

struct MeasuredCurves : CalculatedCurves {
  std::vector<double> angle_deg;

  template <class V>
  void visit(V& v) {
    CalculatedCurves::visit(v);
    v("angle_deg", angle_deg, "deg", "crank angle of the trace");
  }
};

/// A record beside what the model makes of it.
struct RecordPicture {
  std::string range, channel, file;
  double crank_rpm = not_known, noise = not_known;
  std::int64_t windows = 0;
  std::vector<std::string> left_out;
  MeasuredCurves measured;
  std::optional<CalculatedCurves> start, calibrated;

  template <class V>
  void visit(V& v) {
    v("range", range, "", "operating range");
    v("channel", channel, "", "measured channel");
    v("file", file, "", "measured file");
    v("crank_rpm", crank_rpm, "r/min", "crank speed found in it");
    v("noise", noise, "the channel's", "how uncertain an order's amplitude is");
    v("windows", windows, "", "windows that it was cut into");
    v("left_out", left_out, "", "what of it is not compared, in words");
    v("measured", measured, "", "measured curves");
    v("start", start, "", "calculated at the start; absent if that run failed");
    v("calibrated", calibrated, "", "calculated at the end; absent if that run failed");
  }
};

struct CalibrationAnswer : DriverAnswer {
  std::map<std::string, FittedValue> parameters;
  double cost = not_known, start_cost = not_known;
  std::string ended;
  bool converged = false;
  double remaining_standard_errors = not_known, confidence = not_known, degrees_of_freedom = not_known,
         residual_variance = not_known, error_scale = not_known, probability_of_residuals = not_known,
         noise = not_known, tolerance = not_known;
  std::int64_t points_asked = 0, screened = 0, best_fit = 0;
  std::map<std::string, std::map<std::string, double>> correlation;
  std::vector<double> eigenvalues;
  OrNull<WeakestDirection> weakest;
  std::vector<FitAnswer> fits;
  std::vector<ResidualAnswer> residuals;
  std::vector<MainFrequency> main_frequencies;
  std::vector<std::string> remarks;
  std::optional<std::vector<RecordPicture>> pictures;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, "", "fitted values by path");
    v("cost", cost, "", "half the sum of squared residuals, large ones by the robust loss");
    v("start_cost", start_cost, "", "the same at the start; null if it failed there");
    v("ended", ended, "", "why the fit ended");
    v("converged", converged, "", "whether what remains to the minimum is within the errors stated");
    v("remaining_standard_errors", remaining_standard_errors, "", "distance to the local model's minimum");
    v("confidence", confidence, "", "of the intervals");
    v("degrees_of_freedom", degrees_of_freedom, "", "residuals less parameters");
    v("residual_variance", residual_variance, "", "1 where the stated deviations are right");
    v("error_scale", error_scale, "", "factor on the standard errors that the curvature gives");
    v("probability_of_residuals", probability_of_residuals, "", "of residuals this large, were the deviations right");
    v("noise", noise, "", "of the model, relative");
    v("tolerance", tolerance, "", "relative change of the cost at which a fit ends");
    v("points_asked", points_asked, "", "points that the fits asked for");
    v("screened", screened, "", "points spread between the bounds to begin with");
    v("best_fit", best_fit, "", "index of the fit that went on");
    v("correlation", correlation, "", "correlation of the estimates, by parameter and parameter");
    v("eigenvalues", eigenvalues, "", "of the curvature, every parameter scaled to 1");
    v("weakest", weakest, "", "direction that the data say least about; null where there is none");
    v("fits", fits, "", "the fits, the final one last");
    v("residuals", residuals, "", "every measured number beside the model's");
    v("main_frequencies", main_frequencies, "", "the highest order of each record");
    v("remarks", remarks, "", "what somebody who is to use the values should know first");
    v("pictures", pictures, "", "curves for the page; absent without a scene");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
