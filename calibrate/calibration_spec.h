// Owns what a calibration's file says: observations, measured spectra, settings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/records/measurement.h"
#include "sim/eval/problem_spec.h"

namespace beltlife {

/// How a residual that is many standard deviations off counts; `none`: in full.
enum class Loss { none, huber, soft_l1, cauchy };
template <>
struct EnumNames<Loss> {
  static constexpr std::array<std::string_view, 4> names{"none", "huber", "soft_l1", "cauchy"};
};

struct ObservationSpec {
  std::string quantity;
  double value = 0;
  double sigma = 1;
  bool log = false;
  double floor = 0;
  double weight = 1;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, required_text, "what was measured; names: beltlife check --json, or the command's own");
    v("value", value, required(any_text), "measured value, in the quantity's unit");
    v("sigma", sigma, above(0, 1e300),
      "its standard deviation, in the quantity's unit; with `log` that of ln(value + floor)");
    v("log", log, any_text, "true: compare ln(value + floor)");
    v("floor", floor, within(0, 1e300), "added before the logarithm");
    v("weight", weight, above(0, 1e6), "of the square of its residual");
  }
};

struct CalibrationSettings {
  int starts = 3;
  int screen = 64;
  int iterations = 200;
  int budget = 20000;
  std::optional<double> noise;
  std::optional<double> tolerance;
  std::optional<Loss> loss;
  double loss_scale = 3;
  double confidence = 0.95;
  bool profiles = true;

  template <class V>
  void visit(V& v) {
    v("starts", starts, within(1, 100),
      "places from which the fit is begun: the file's start, then the best of the screen");
    v("screen", screen, within(0, 100000),
      "points spread between the bounds to find starts; without effect where a parameter has no bounds");
    v("iterations", iterations, within(1, 100000),
      "of the fit, at most; of several starts each gets eight, the best goes on");
    v("budget", budget, within(1, 1e7), "points in all after which no iteration is begun");
    v("noise", noise, within(0, 1),
      "relative noise of the model's quantities, which sets the steps of the derivatives; "
      "absent: measured at the start from seven neighbouring points");
    v("tolerance", tolerance, within(0, 1), "relative change of the cost at which a fit ends; absent: by the noise");
    v("loss", loss, any_text, "absent: huber for measured files, none for observations");
    v("loss_scale", loss_scale, above(0, 1e6), "residual, in standard deviations, from which the loss is robust");
    v("confidence", confidence, within(0.5, 0.999), "of the intervals");
    v("profiles", profiles, any_text, "profile likelihoods, of up to six parameters");
  }
};

struct CalibrationSpec {
  ProblemSpec problem;
  std::vector<SpectrumSpec> spectrum;
  std::vector<ObservationSpec> observation;
  CalibrationSettings calibration;

  template <class V>
  void visit(V& v) {
    problem.visit(v);
    v("spectrum", spectrum, any_text, "measured files, one an operating range and channel");
    v("observation", observation, any_text, "single measured numbers");
    v("calibration", calibration, any_text, "settings of the fit");
  }
};

}  // namespace beltlife
