// Owns one fit: from a start to the nearest minimum of the cost, by Ceres.
#pragma once

#include <string>
#include <vector>

#include "calibrate/fit_model.h"

namespace beltlife {

struct FitOptions {
  int iterations = 200;        ///< at most
  std::size_t budget = 20000;  ///< points in all, of the FitModel, after which no iteration is begun
  double tolerance = 1e-8;     ///< relative change of the cost
  double loss_scale = 3;
};

/// The cost after an iteration.
struct CostStep {
  std::size_t points = 0;  ///< asked so far
  double cost = 0;
};

struct FitResult {
  bool ok = false;       ///< there is a point with residuals
  std::string ended;     ///< in words
  bool at_rest = false;  ///< ended because the cost changes no more
  std::vector<double> u;
  double start_cost = 0, cost = 0;  ///< sum of losses, halved; of squares, halved, if not robust
  std::vector<CostStep> steps;
  Derivatives end;  ///< at u
};

enum class Differences { one_sided, central };

/// Levenberg-Marquardt. `robust`: with the targets' losses; else squares, which lead further from a poor start.
FitResult fit(FitModel& model, std::vector<double> start, Differences differences, bool robust,
              const FitOptions& options, const std::string& what);

/// Sum of losses, halved, as Ceres has it.
double cost_of(const Eigen::VectorXd& residuals, const std::vector<Target>& targets, double loss_scale,
               bool robust = true);

/// Factor of each squared residual in the local quadratic model: the loss function's slope there; 1 without a loss.
Eigen::VectorXd loss_weights(const Eigen::VectorXd& residuals, const std::vector<Target>& targets, double loss_scale);

}  // namespace beltlife
