// Owns residuals and their derivatives by differences, whole batches at a time.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "calibrate/coordinates.h"
#include "calibrate/target.h"

namespace beltlife {

/// Answers a batch of points; `what` names it to whoever waits.
using BatchModel = std::function<std::vector<Answer>(const std::vector<Point>&, const std::string& what)>;

/// What is fitted to what.
struct FitProblem {
  std::vector<ParameterSpec> parameters;  ///< with starts
  std::vector<Target> targets;
  BatchModel evaluate;
  /// A point costs hardly less alone than with its neighbours (a pack of lanes): derivatives are then asked together
  /// with every point, before it is known whether they are needed.
  bool together = false;
};

struct Derivatives {
  bool ok = false;  ///< of the point itself
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;         ///< d residual / d u; of a frozen parameter 0
  std::vector<std::size_t> frozen;  ///< parameters whose neighbours all failed
};

/// Evaluates residuals and derivatives. Asks the same points again and again: whoever answers remembers.
class FitModel {
 public:
  explicit FitModel(FitProblem problem);

  const FitProblem& problem() const { return problem_; }
  const std::vector<Coordinate>& coordinates() const { return coordinates_; }

  /// Relative steps of one-sided and of central differences.
  void set_noise(double noise);
  double noise() const { return noise_; }
  /// Different points asked so far.
  std::size_t points() const { return asked_.size(); }
  /// The model's own noise around u, from seven points 1e-5 apart: of every target, which adds to its deviation from
  /// now on; and relative, which sets the steps: the third quartile over targets, so that a few amplitudes next to
  /// nothing do not rule. Without effect if points fail.
  void measure_noise(const std::vector<double>& u);

  /// Points of the spread; residuals of those that are ok, empty of those that are not.
  std::vector<Eigen::VectorXd> residuals_at(const std::vector<std::vector<double>>& us, const std::string& what);
  /// A column that fails is tried on the other side, then at half the step on both, then frozen.
  Derivatives derivatives_at(const std::vector<double>& u, bool central, const std::string& what);

 private:
  std::vector<Answer> ask(const std::vector<std::vector<double>>& us, const std::string& what);
  Eigen::VectorXd residuals_of(const Answer& answer) const;

  FitProblem problem_;
  std::vector<Coordinate> coordinates_;
  std::set<Point> asked_;
  double noise_ = 2.25e-4, step_ = 0.03, central_step_ = 0.06;
};

}  // namespace beltlife
