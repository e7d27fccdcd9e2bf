// Owns a sample of parameters, and the ways to draw one.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "sim/scene/field.h"

namespace beltlife {

enum class SamplingMethod { lhs, sobol_sequence, monte_carlo };
template <>
struct EnumNames<SamplingMethod> {
  static constexpr std::array<std::string_view, 3> names{"lhs", "sobol_sequence", "monte_carlo"};
};

/// A sample: one row a point, one column a parameter.
using Rows = std::vector<std::vector<double>>;

}  // namespace beltlife
