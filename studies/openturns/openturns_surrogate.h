// Owns surrogates: functions fitted to a sample, with how well they predict points that they have not seen.
#pragma once

#include <functional>
#include <vector>

#include "studies/openturns/openturns_inputs.h"

namespace beltlife {

enum class SurrogateMethod { chaos, kriging };
template <>
struct EnumNames<SurrogateMethod> {
  static constexpr std::array<std::string_view, 2> names{"chaos", "kriging"};
};

struct Surrogate {
  double q2 = 0;                     ///< 1 - mean square leave-one-out error / variance; NaN where nothing varies
  std::size_t terms = 0;             ///< coefficients fitted
  std::vector<double> first, total;  ///< Sobol' indices; of chaos alone, from its coefficients
  std::function<double(const std::vector<double>&)> predict;  ///< of parameters, each in its unit
};

/// Terms of a polynomial of this total degree, before any is dropped.
double chaos_terms(std::size_t parameters, int degree);

/// Polynomials orthogonal under the parameters' distributions (independent) up to a total degree, of which least-angle
/// regression takes those that pay (Blatman and Sudret, J. Comput. Phys. 230, 2011). `at`: a row a point.
Surrogate chaos_surrogate(const std::vector<ParameterSpec>& parameters, const Rows& at,
                          const std::vector<double>& values, int degree);

/// Ordinary Kriging with a Matern 5/2 covariance, a length for each parameter and a nugget for the noise, by largest
/// likelihood.
Surrogate kriging_surrogate(const std::vector<ParameterSpec>& parameters, const Rows& at,
                            const std::vector<double>& values);

}  // namespace beltlife
