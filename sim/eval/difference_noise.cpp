// Noise from a table of differences: see difference_noise.h.
#include "sim/eval/difference_noise.h"

#include <algorithm>
#include <cmath>

namespace beltlife {

DifferenceNoise difference_noise(const std::vector<double>& values) {
  DifferenceNoise out;
  std::vector<double> column = values;
  std::vector<bool> changes_sign;
  double gamma = 1;
  for (int k = 1; column.size() > 1; ++k) {
    for (std::size_t i = 0; i + 1 < column.size(); ++i) column[i] = column[i + 1] - column[i];
    column.pop_back();
    gamma *= 0.5 * k / (2.0 * k - 1);  // (k!)^2 / (2k)!: turns the variance of a difference into the values'
    double mean_square = 0;
    for (double d : column) mean_square += d * d / static_cast<double>(column.size());
    out.levels.push_back(std::sqrt(gamma * mean_square));
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    changes_sign.push_back(*low * *high < 0);
  }
  for (std::size_t k = 0; k + 2 < out.levels.size() && out.order == 0; ++k) {
    const auto [low, high] = std::minmax({out.levels[k], out.levels[k + 1], out.levels[k + 2]});
    if (high <= 4 * low && changes_sign[k]) out.order = static_cast<int>(k) + 1;
  }
  out.noise = out.order > 0 ? out.levels[static_cast<std::size_t>(out.order) - 1]
                            : *std::min_element(out.levels.begin(), out.levels.end());
  return out;
}

}  // namespace beltlife
