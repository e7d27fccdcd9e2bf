// Spread and responses of replicates: see noise.h.
#include "studies/noise/noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace beltlife {
namespace {

/// Sum of squares about the mean.
double scatter(const std::vector<double>& v, const std::vector<std::size_t>& at, std::size_t from, std::size_t to) {
  double mean = 0, sum = 0;
  for (std::size_t i = from; i < to; ++i) mean += v[at[i]] / static_cast<double>(to - from);
  for (std::size_t i = from; i < to; ++i) sum += (v[at[i]] - mean) * (v[at[i]] - mean);
  return sum;
}

/// A stretch of the sorted values.
struct Stretch {
  std::size_t from = 0, to = 0;
};

std::vector<Stretch> split(const std::vector<double>& v, const std::vector<std::size_t>& sorted, Stretch all,
                           double resolution) {
  std::size_t cut = 0;
  double widest = 0;
  for (std::size_t i = all.from + 2; i + 2 <= all.to; ++i)
    if (const double gap = v[sorted[i]] - v[sorted[i - 1]]; gap > widest) {
      widest = gap;
      cut = i;
    }
  if (cut == 0) return {all};
  // Either side first: one that holds several responses would count their distance as its scatter.
  std::vector<Stretch> parts = split(v, sorted, {all.from, cut}, resolution);
  for (const Stretch& part : split(v, sorted, {cut, all.to}, resolution)) parts.push_back(part);
  double inside = 0;
  for (const Stretch& part : parts) inside += scatter(v, sorted, part.from, part.to);
  const auto free = static_cast<double>(all.to - all.from - parts.size());
  inside = std::sqrt(inside / free);
  // The scatter of few values is uncertain: with this margin 1 in 150 normal samples of any size is split at most.
  const double margin = 4 + 80 / (free * free);
  const double largest = std::max(std::abs(v[sorted[all.from]]), std::abs(v[sorted[all.to - 1]]));
  return widest > margin * inside && widest > resolution * largest ? parts : std::vector<Stretch>{all};
}

}  // namespace

std::vector<Response> responses_of(const std::vector<double>& values, double resolution) {
  std::vector<std::size_t> sorted(values.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<Response> out;
  if (values.empty()) return out;
  for (const Stretch& part : split(values, sorted, {0, values.size()}, resolution)) {
    Response r;
    r.members.assign(sorted.begin() + static_cast<std::ptrdiff_t>(part.from),
                     sorted.begin() + static_cast<std::ptrdiff_t>(part.to));
    std::sort(r.members.begin(), r.members.end());
    for (const std::size_t i : r.members) r.mean += values[i] / static_cast<double>(r.members.size());
    out.push_back(std::move(r));
  }
  return out;
}

Spread spread_of(const std::vector<double>& values) {
  Spread s;
  if (values.empty()) return s;
  const auto n = static_cast<double>(values.size());
  for (double v : values) s.mean += v / n;
  double sum = 0;
  for (double v : values) sum += (v - s.mean) * (v - s.mean);
  s.standard_deviation = values.size() > 1 ? std::sqrt(sum / (n - 1)) : 0;
  s.low = *std::min_element(values.begin(), values.end());
  s.high = *std::max_element(values.begin(), values.end());
  return s;
}

}  // namespace beltlife
