// Owns the spread of starting points over a box.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace beltlife {

/// `count` points of the unit cube, evenly spread: the additive recurrence on the powers of the root of
/// x^(d+1) = x + 1 (Roberts' generalised golden ratio), which has no seed.
inline std::vector<std::vector<double>> spread(std::size_t count, std::size_t dimensions) {
  double root = 2;
  for (int k = 0; k < 60; ++k) root = std::pow(1 + root, 1 / (static_cast<double>(dimensions) + 1));
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < dimensions; ++i) {
      const double x = 0.5 + static_cast<double>(k + 1) * std::pow(root, -static_cast<double>(i + 1));
      points[k][i] = x - std::floor(x);
    }
  return points;
}

}  // namespace beltlife
