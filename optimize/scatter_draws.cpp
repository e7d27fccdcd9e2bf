// Draws of what scatters: see scatter_draws.h.
#include "optimize/scatter_draws.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimize/search/search_design.h"

namespace beltlife {
namespace {

double normal_below(double z) { return 0.5 * std::erfc(-z * std::sqrt(0.5)); }

double normal_quantile_of(double share) {
  double low = -40, high = 40;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (normal_below(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Of a normal score, cut off where `lower` and `upper` have theirs.
double cut_off(double share, std::optional<double> lower, std::optional<double> upper) {
  const double below = lower ? normal_below(*lower) : 0, above = upper ? normal_below(*upper) : 1;
  const double z = normal_quantile_of(below + share * (above - below));
  return std::clamp(z, lower.value_or(-40), upper.value_or(40));
}

}  // namespace

double quantile_of(const ScatterSpec& s, double share) {
  const DistributionSpec& d = s.distribution;
  if (d.kind == DistributionKind::uniform) return *s.lower + share * (*s.upper - *s.lower);
  if (d.kind == DistributionKind::triangular) {
    const double low = *s.lower, high = *s.upper, mode = d.mode.value_or(0.5 * (low + high));
    const double turn = (mode - low) / (high - low);
    return share < turn ? low + std::sqrt(share * (high - low) * (mode - low))
                        : high - std::sqrt((1 - share) * (high - low) * (high - mode));
  }
  double mean = *d.mean, deviation = *d.standard_deviation;
  const bool logarithm = d.kind == DistributionKind::lognormal;
  if (logarithm) {
    const double variance = std::log1p(deviation * deviation / (mean * mean));
    mean = std::log(mean) - 0.5 * variance;
    deviation = std::sqrt(variance);
  }
  const auto score = [&](std::optional<double> bound) -> std::optional<double> {
    if (!bound || (logarithm && *bound <= 0)) return std::nullopt;
    return ((logarithm ? std::log(*bound) : *bound) - mean) / deviation;
  };
  const double value = mean + deviation * cut_off(share, score(s.lower), score(s.upper));
  return logarithm ? std::exp(value) : value;
}

std::vector<std::vector<double>> scatter_draws(const std::vector<ScatterSpec>& scatter, int samples,
                                               std::int64_t seed) {
  const auto rows = static_cast<std::size_t>(samples);
  std::vector<std::vector<double>> draws(rows, std::vector<double>(scatter.size()));
  SearchRandom random(seed);
  for (std::size_t k = 0; k < scatter.size(); ++k) {
    std::vector<std::size_t> cell(rows);
    std::iota(cell.begin(), cell.end(), std::size_t{0});
    for (std::size_t i = rows - 1; i > 0; --i) std::swap(cell[i], cell[random.bits() % (i + 1)]);
    for (std::size_t i = 0; i < rows; ++i)
      draws[i][k] =
          quantile_of(scatter[k], (static_cast<double>(cell[i]) + random.uniform()) / static_cast<double>(rows));
  }
  return draws;
}

}  // namespace beltlife
