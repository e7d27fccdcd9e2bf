// Owns what a fit says beside its values: intervals, correlations, the weakest direction, whether it is an end at all.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibrate/fit.h"

namespace beltlife {

/// In the fit's coordinates u. Parameters whose column is zero have an infinite standard error and no correlation.
struct Inference {
  double freedom = 0;            ///< residuals less parameters
  double residual_variance = 0;  ///< weighted squares over `freedom`: 1 where the stated deviations are right
  /// Factor of the standard errors that the curvature gives: the root of the residual variance (not below 1 where a
  /// model error is stated: one that all residuals share does not show in them), times how far from its minimum a
  /// rough cost left the fit.
  double scale = 0;
  double quantile = 0;                                       ///< of Student's t at the confidence, two-sided
  std::vector<double> standard_error, standard_error_alone;  ///< scaled; alone: were all others known
  Eigen::MatrixXd correlation;
  std::vector<double> eigenvalues;  ///< of the normalised curvature (unit diagonal), from low to high
  Eigen::VectorXd weakest;          ///< change of u along its lowest eigenvector that costs one residual variance
  Eigen::VectorXd share;            ///< the same eigenvector, normalised
  std::vector<int> at_bound;  ///< -1 on the lower bound, +1 on the upper, and the cost would fall beyond it; else 0
  double unexplained = 0;     ///< probability of residuals this large, were the stated deviations the whole truth
  double remaining = 0;       ///< distance to where the local quadratic model has its minimum, in standard errors
  /// Cost that the quadratic model would still take off, inside the bounds.
  double remaining_cost = 0;
};

/// Of the end of a fit. Curvature is J^T W J with the losses' slopes as weights.
Inference infer(const FitModel& model, const FitResult& end, double confidence, double loss_scale,
                bool model_error = false);

/// The cost over one parameter with all others fitted again.
struct Profile {
  std::vector<double> u, cost;  ///< from low to high u, the end of the fit among them
  /// Where the cost exceeds the fit's by as much as the confidence allows (likelihood ratio by Student's t); not a
  /// number where the profile does not reach it.
  double low = 0, high = 0;
};

/// Profiles of `which` parameters, by chord Gauss-Newton steps from the end of the fit: two batches in all, no new
/// derivatives. An upper bound of the true profile, tight where the model is near to linear.
std::vector<Profile> profiles(FitModel& model, const FitResult& end, const Inference& inference,
                              const std::vector<std::size_t>& which, double loss_scale);

}  // namespace beltlife
