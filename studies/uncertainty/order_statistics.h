// Owns what a sample says of its distribution: moments, percentiles and shares, with intervals that assume no shape.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace beltlife {

struct Moments {
  double mean = 0, standard_deviation = 0;  ///< the latter with n - 1; 0 of fewer than two values
};
Moments moments_of(const std::vector<double>& values);

/// Quantile at `share` in 0 to 1 of values in order, linear between neighbours (type 7 of Hyndman and Fan, Am. Stat.
/// 50, 1996); beyond the ends the end.
double percentile(const std::vector<double>& sorted, double share);

struct Bounds {
  std::optional<double> low, high;  ///< none where the sample is too small to have one
};
/// Confidence interval of that quantile from two of the values themselves, whatever the distribution (David and
/// Nagaraja, Order Statistics, 2003, section 7.1). Its confidence holds for independent values; those of a Latin
/// hypercube or a Sobol' sequence scatter less.
Bounds percentile_interval(const std::vector<double>& sorted, double share, double confidence);

/// Interval of a probability after `hits` of `trials` (Wilson, J. Am. Stat. Assoc. 22, 1927).
Bounds share_interval(std::size_t hits, std::size_t trials, double confidence);

/// Quantile of the standard normal distribution.
double normal_quantile(double share);

}  // namespace beltlife
