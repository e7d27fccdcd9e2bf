// Owns a Gaussian process through scattered points: Matern 5/2 with a length a variable, constant mean, noise.
#pragma once

#include <Eigen/Dense>

namespace beltlife {

/// r(x, x') = (1 + s + s^2/3) exp(-s), s^2 = 5 sum_k (x_k - x'_k)^2 / l_k^2; between equal points plus `nugget`, the
/// share of noise in the variance. (Rasmussen & Williams 2006, eq. 4.17; Roustant, Ginsbourger & Deville 2012.)
struct KrigingShape {
  Eigen::VectorXd log_length;
  double log_nugget = 0;
};

/// Starting values for `variables` coordinates in [0, 1].
KrigingShape usual_shape(Eigen::Index variables);

/// -log likelihood of the values y at the rows of x, mean and variance profiled out, minus a weak log-normal prior that
/// keeps lengths near those of usual_shape where the data do not say. `gradient` (lengths, then nugget) may be null.
/// Infinite if the correlations cannot be factored.
double kriging_loss(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const KrigingShape& shape,
                    Eigen::VectorXd* gradient);

/// The shape of least loss found from `shape` by at most `steps` steps of Rprop.
KrigingShape likeliest_shape(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const KrigingShape& shape, int steps);

class Kriging {
 public:
  struct Prediction {
    double mean = 0;
    double deviation = 0;  ///< of the function beneath the noise
  };

  /// x: one point a row, at least one; y: finite. Values all equal are allowed.
  Kriging(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const KrigingShape& shape);

  double mean(const Eigen::VectorXd& at) const;
  Prediction predict(const Eigen::VectorXd& at) const;
  /// The same with one more point; the shape stays.
  Kriging with(const Eigen::VectorXd& at, double value) const;

  /// Of the process, in the unit of y.
  double process_deviation() const;
  const KrigingShape& shape() const { return shape_; }

 private:
  Eigen::VectorXd correlations(const Eigen::VectorXd& at) const;

  Eigen::MatrixXd x_;
  Eigen::VectorXd y_;
  KrigingShape shape_;
  Eigen::MatrixXd scaled_;  ///< columns: points divided by the lengths
  Eigen::VectorXd inverse_length_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd weights_;  ///< R^-1 (y - mean)
  Eigen::VectorXd ones_;     ///< R^-1 1
  double trend_ = 0, variance_ = 0, scale_ = 1;
};

}  // namespace beltlife
