// Distributions by Eigen's incomplete beta and gamma functions: see student_t.h.
#include "sim/eval/student_t.h"

#include <Eigen/Core>
#include <unsupported/Eigen/SpecialFunctions>

namespace beltlife {

double student_t_within(double t, double freedom) {
  return Eigen::numext::betainc(0.5, 0.5 * freedom, t * t / (freedom + t * t));
}

double student_t_quantile(double confidence, double freedom) {
  double low = 0, high = 1;
  while (student_t_within(high, freedom) < confidence && high < 1e12) high *= 2;
  for (int k = 0; k < 200 && low < high; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (student_t_within(middle, freedom) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_squared_above(double value, double freedom) { return Eigen::numext::igammac(0.5 * freedom, 0.5 * value); }

}  // namespace beltlife
