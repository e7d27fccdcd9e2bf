// Owns the distributions behind intervals and tests: Student's t, Fisher's F, chi-squared.
#pragma once

namespace beltlife {

/// Probability that |t| of `freedom` degrees of freedom stays below `t`.
double student_t_within(double t, double freedom);

/// Half-width of the interval of this confidence, in standard errors.
double student_t_quantile(double confidence, double freedom);

/// Probability that a chi-squared of `freedom` degrees of freedom exceeds `value`.
double chi_squared_above(double value, double freedom);

}  // namespace beltlife
