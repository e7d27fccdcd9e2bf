// Owns Sobol' indices: their design, their estimates, and how sure these are.
#pragma once

#include <cstdint>
#include <vector>

#include "results/answer/estimate.h"
#include "studies/sample.h"

namespace beltlife {

/// Rows of the design of Saltelli et al. (Comput. Phys. Commun. 181, 2010) from rows of 2d columns, whose halves are A
/// and B: of each base row A, B, then A with column i of B, for i = 1 to d.
Rows saltelli_rows(const Rows& base);

struct SobolIndices {
  double mean = 0, variance = 0;       ///< of the quantity, over A and B
  std::vector<Estimate> first, total;  ///< one a parameter; NaN where the quantity does not vary
  Estimate sum_first;                  ///< below 1 by what interactions contribute
};

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 1000;
  std::int64_t seed = 1;
};

/// `values`: one row a base row, of the d + 2 values in the order of saltelli_rows; rows with a failed point left out,
/// which leaves the estimates without bias if failures are by chance. First index and one minus total index of
/// parameter i are the standardised coefficients of f(B) and f(A) in the regression of f(A with i of B) on both: the
/// correlations of Martinez (2011), freed of the chance correlation of f(A) and f(B) as by Glen and Isaacs (Environ.
/// Model. Softw. 37, 2012). Intervals: percentiles over resampled base rows.
SobolIndices sobol_indices(const Rows& values, const BootstrapOptions& options);

}  // namespace beltlife
