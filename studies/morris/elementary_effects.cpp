// Trajectories and their elementary effects: see elementary_effects.h.
#include "studies/morris/elementary_effects.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "studies/uncertainty/order_statistics.h"

namespace beltlife {
namespace {

double jump(int levels) { return levels / (2.0 * (levels - 1)); }

}  // namespace

Rows trajectories(std::size_t count, std::size_t dimensions, int levels, std::int64_t seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  const auto p = static_cast<std::uint64_t>(levels);
  Rows rows;
  for (std::size_t t = 0; t < count; ++t) {
    std::vector<std::uint64_t> level(dimensions);
    for (auto& l : level) l = random() % p;
    std::vector<std::size_t> order(dimensions);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = dimensions; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
    const auto place = [&] {
      std::vector<double> at;
      for (const auto l : level) at.push_back(static_cast<double>(l) / (levels - 1));
      return at;
    };
    rows.push_back(place());
    for (const std::size_t k : order) {
      // Half the levels away there is one neighbour only: up from the lower half, down from the upper.
      level[k] = level[k] < p / 2 ? level[k] + p / 2 : level[k] - p / 2;
      rows.push_back(place());
    }
  }
  return rows;
}

std::vector<Effects> elementary_effects(const Rows& at, const std::vector<std::optional<double>>& values) {
  const std::size_t d = at.empty() ? 0 : at[0].size();
  std::vector<std::vector<double>> found(d);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (i % (d + 1) == d || !values[i] || !values[i + 1]) continue;
    for (std::size_t k = 0; k < d; ++k)
      if (const double moved = at[i + 1][k] - at[i][k]; moved != 0)
        found[k].push_back((*values[i + 1] - *values[i]) / moved);
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<Effects> out;
  for (const auto& effects : found) {
    std::vector<double> sizes;
    for (const double e : effects) sizes.push_back(std::abs(e));
    const Moments signed_ones = moments_of(effects), magnitudes = moments_of(sizes);
    if (effects.empty())
      out.push_back({0, none, none, none, none});
    else
      out.push_back({effects.size(), signed_ones.mean, magnitudes.mean, signed_ones.standard_deviation,
                     magnitudes.standard_deviation / std::sqrt(static_cast<double>(effects.size()))});
  }
  return out;
}

double mu_star_of_noise(double standard_deviation, int levels, std::size_t used) {
  // An effect is the difference of two noisy values over the jump; its magnitude is half-normal.
  const double of_effect = std::numbers::sqrt2 * standard_deviation / jump(levels);
  const double mean = std::sqrt(2 / std::numbers::pi), scatter = std::sqrt(1 - 2 / std::numbers::pi);
  return of_effect * (mean + 2 * scatter / std::sqrt(static_cast<double>(std::max<std::size_t>(used, 1))));
}

}  // namespace beltlife
