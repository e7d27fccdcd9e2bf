// Owns how drives of one layout differ: draws of what scatters.
#pragma once

#include <cstdint>
#include <vector>

#include "optimize/optimization_spec.h"

namespace beltlife {

/// Value at `share` (0 to 1) of a distribution; of normal and lognormal what lies outside the bounds is cut off.
double quantile_of(const ScatterSpec& scatter, double share);

/// `samples` rows, one column an entry of `scatter`: a Latin hypercube, the same for the same arguments.
std::vector<std::vector<double>> scatter_draws(const std::vector<ScatterSpec>& scatter, int samples, std::int64_t seed);

}  // namespace beltlife
