// Owns the measurement of noise: from differences of neighbouring values, and from responses that coexist.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// Noise of a function from its values at equally spaced points (More and Wild, ECnoise, SIAM J. Sci. Comput. 33,
/// 2011).
struct DifferenceNoise {
  std::vector<double> levels;  ///< estimate from the differences of order 1, 2, ... ; same unit as the values
  int order = 0;               ///< order whose estimate is taken; 0: none is reliable, the smallest stands
  double noise = 0;            ///< standard deviation
};
/// At least four values. The smooth part of the function dies out with the order of the differences; the estimate is
/// taken at the first order from which three in a row agree within a factor of 4 and whose differences change sign.
DifferenceNoise difference_noise(const std::vector<double>& values);

/// One of several steady responses.
struct Response {
  double mean = 0;
  std::vector<std::size_t> members;  ///< indices of the values that belong to it
};
/// Splits values where a gap stands out: wider than four times the scatter within the responses on either side of it
/// (24 times of four values, 6 of eight) and than `resolution` of the largest value, with two values or more on either
/// side. One response, or several from low to high.
std::vector<Response> responses_of(const std::vector<double>& values, double resolution = 5e-3);

struct Spread {
  double mean = 0, standard_deviation = 0, low = 0, high = 0;
};
Spread spread_of(const std::vector<double>& values);

}  // namespace beltlife
