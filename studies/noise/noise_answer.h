// Owns what a noise study answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// Scatter of one quantity over points that should agree.
struct Scatter {
  std::int64_t points = 0;
  double mean = not_known, standard_deviation = not_known, relative = not_known, min = not_known, max = not_known;

  template <class V>
  void visit(V& v) {
    v("points", points, "", "how many are ok");
    v("mean", mean, unit_of_its_name, "mean of them");
    v("standard_deviation", standard_deviation, unit_of_its_name, "of one of them");
    v("relative", relative, "", "standard deviation as a share of the nominal value");
    v("min", min, unit_of_its_name, "lowest");
    v("max", max, unit_of_its_name, "highest");
  }
};

/// What the difference table of a short line through the nominal point shows.
struct LineNoise {
  double noise = not_known, relative = not_known;
  int order = 0;
  std::vector<double> levels;

  template <class V>
  void visit(V& v) {
    v("noise", noise, unit_of_its_name, "standard deviation of the noise");
    v("relative", relative, "", "as a share of the nominal value");
    v("order", order, "", "order of differences that it was read from; 0: none is reliable, and it is an upper bound");
    v("levels", levels, unit_of_its_name, "estimates from differences of order 1, 2, ...");
  }
};

/// One of several steady responses that coexist.
struct SteadyResponse {
  std::string name;
  double mean = not_known;
  std::int64_t replicates = 0;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "response 1, response 2, from low to high");
    v("mean", mean, unit_of_its_name, "mean of its replicates");
    v("replicates", replicates, "", "how many replicates found it");
  }
};

struct QuantityNoise {
  double value = not_known;
  std::optional<Scatter> replicates, perturbation;
  std::optional<LineNoise> differences;
  std::optional<std::vector<SteadyResponse>> responses;
  double noise = not_known, noise_relative = not_known, step_forward = not_known, step_central = not_known;

  template <class V>
  void visit(V& v) {
    v("value", value, unit_of_its_name, "at the nominal point");
    v("replicates", replicates, "", "scatter over crank phases and ramp times");
    v("perturbation", perturbation, "", "scatter over points that differ by a hair");
    v("differences", differences, "", "noise along a short line");
    v("responses", responses, "", "steady responses that the replicates fall into; one: they agree");
    v("noise", noise, unit_of_its_name, "the larger of hair and line, as far as the line is reliable");
    v("noise_relative", noise_relative, "", "as a share of the nominal value");
    v("step_forward", step_forward, "", "relative change of a parameter for forward differences");
    v("step_central", step_central, "", "relative change of a parameter for central differences");
  }
};

struct NoiseAnswer : DriverAnswer {
  std::vector<std::string> parameters;
  std::map<std::string, QuantityNoise> quantities;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, "", "that were perturbed");
    v("quantities", quantities, "", "scatter by quantity");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
