// Owns the noise of a function from neighbouring values of it.
#pragma once

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

}  // namespace beltlife
