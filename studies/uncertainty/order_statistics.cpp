// Moments, percentiles and shares of a sample: see order_statistics.h.
#include "studies/uncertainty/order_statistics.h"

#include <algorithm>
#include <cmath>

namespace beltlife {

Moments moments_of(const std::vector<double>& values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) m.mean += v / n;
  double sum = 0;
  for (const double v : values) sum += (v - m.mean) * (v - m.mean);
  if (values.size() > 1) m.standard_deviation = std::sqrt(sum / (n - 1));
  return m;
}

double percentile(const std::vector<double>& sorted, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), sorted.size() - 1);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Bounds percentile_interval(const std::vector<double>& sorted, double share, double confidence) {
  // The number of values below the quantile is binomial: value l (from 1) lies above it if at most l - 1 are below.
  const auto n = static_cast<double>(sorted.size());
  const double tail = 0.5 * (1 - confidence);
  Bounds bounds;
  double up_to = 0;  // probability of at most k below
  for (std::size_t k = 0; k <= sorted.size(); ++k) {
    const auto count = static_cast<double>(k);
    up_to += std::exp(std::lgamma(n + 1) - std::lgamma(count + 1) - std::lgamma(n - count + 1) +
                      count * std::log(share) + (n - count) * std::log1p(-share));
    if (up_to <= tail && k < sorted.size()) bounds.low = sorted[k];
    if (1 - up_to <= tail && k < sorted.size()) {
      bounds.high = sorted[k];
      break;
    }
  }
  return bounds;
}

Bounds share_interval(std::size_t hits, std::size_t trials, double confidence) {
  if (trials == 0) return {};
  const double n = static_cast<double>(trials), p = static_cast<double>(hits) / n;
  const double z = normal_quantile(0.5 * (1 + confidence)), z2 = z * z / n;
  const double middle = (p + 0.5 * z2) / (1 + z2);
  const double half = z / (1 + z2) * std::sqrt(p * (1 - p) / n + 0.25 * z2 / n);
  return {std::max(middle - half, 0.0), std::min(middle + half, 1.0)};
}

double normal_quantile(double share) {
  double low = -40, high = 40;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle * std::sqrt(0.5)) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace beltlife
