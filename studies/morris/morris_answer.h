// Owns what a study of kind morris answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// What one parameter does to one quantity.
struct ParameterEffects {
  double mu = not_known, mu_star = not_known, sigma = not_known, mu_star_error = not_known;
  std::int64_t effects = 0;
  std::optional<double> noise_floor;
  std::optional<bool> within_noise;

  template <class V>
  void visit(V& v) {
    v("mu", mu, unit_of_its_name, "mean of the effects for the parameter's whole range");
    v("mu_star", mu_star, unit_of_its_name, "mean of their magnitudes: how much the parameter matters");
    v("sigma", sigma, unit_of_its_name, "their standard deviation: curvature and interactions");
    v("mu_star_error", mu_star_error, unit_of_its_name, "standard error of mu_star");
    v("effects", effects, "", "effects of which both points are ok");
    v("noise_floor", noise_floor, unit_of_its_name,
      "largest mu_star that noise makes by itself; absent without a noise study");
    v("within_noise", within_noise, "", "whether mu_star is no more than that");
  }
};

struct MorrisAnswer : DriverAnswer {
  std::vector<std::string> parameters;
  int trajectories = 0, levels = 0;
  std::map<std::string, std::map<std::string, ParameterEffects>> quantities;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, "", "paths, in the file's order");
    v("trajectories", trajectories, "", "that were asked for");
    v("levels", levels, "", "values of each parameter");
    v("quantities", quantities, "", "effects by quantity and parameter");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
