// Sobol' indices from values: see sobol_indices.h.
#include "studies/sobol/sobol_indices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "studies/uncertainty/order_statistics.h"

namespace beltlife {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// First, total, and the sum of the first.
struct Indices {
  std::vector<double> first, total;
  double sum = 0;
};

/// Sums over some of the base rows, of columns f(A), f(B), f(A with i of B).
class Sums {
 public:
  explicit Sums(std::size_t columns) : sum_(columns), square_(columns), with_a_(columns), with_b_(columns) {}

  void add(const double* row) {
    count_ += 1;
    for (std::size_t c = 0; c < sum_.size(); ++c) {
      sum_[c] += row[c];
      square_[c] += row[c] * row[c];
      with_a_[c] += row[0] * row[c];
      with_b_[c] += row[1] * row[c];
    }
  }

  Indices indices() const {
    const double chance = correlation(with_a_, 0, 1), left = 1 - chance * chance;
    Indices out;
    for (std::size_t c = 2; c < sum_.size(); ++c) {
      const double a = correlation(with_a_, 0, c), b = correlation(with_b_, 1, c);
      out.first.push_back((b - chance * a) / left);
      out.total.push_back(1 - (a - chance * b) / left);
      out.sum += out.first.back();
    }
    return out;
  }

 private:
  double variance(std::size_t c) const { return square_[c] - sum_[c] * sum_[c] / count_; }
  double correlation(const std::vector<double>& products, std::size_t with, std::size_t c) const {
    const double both = variance(with) * variance(c);
    return both > 0 ? (products[c] - sum_[with] * sum_[c] / count_) / std::sqrt(both) : none;
  }

  double count_ = 0;
  std::vector<double> sum_, square_, with_a_, with_b_;
};

Estimate estimate(double value, std::vector<double>& resampled, double confidence) {
  std::erase_if(resampled, [](double v) { return !std::isfinite(v); });
  if (!std::isfinite(value) || resampled.size() < 2) return {value, none, none};
  std::sort(resampled.begin(), resampled.end());
  return {value, percentile(resampled, 0.5 * (1 - confidence)), percentile(resampled, 0.5 * (1 + confidence))};
}

}  // namespace

Rows saltelli_rows(const Rows& base) {
  Rows rows;
  for (const std::vector<double>& both : base) {
    const auto half = both.begin() + static_cast<std::ptrdiff_t>(both.size() / 2);
    const std::vector<double> a(both.begin(), half), b(half, both.end());
    rows.push_back(a);
    rows.push_back(b);
    for (std::size_t i = 0; i < a.size(); ++i) {
      rows.push_back(a);
      rows.back()[i] = b[i];
    }
  }
  return rows;
}

SobolIndices sobol_indices(const Rows& values, const BootstrapOptions& o) {
  SobolIndices out;
  if (values.empty()) return out;
  const std::size_t rows = values.size(), columns = values[0].size(), parameters = columns - 2;
  std::vector<double> both;
  for (const auto& row : values) both.insert(both.end(), {row[0], row[1]});
  const Moments moments = moments_of(both);
  out.mean = moments.mean;
  out.variance = moments.standard_deviation * moments.standard_deviation;

  // About the mean and in standard deviations, so that sums of squares keep their digits.
  const double scale = moments.standard_deviation > 1e-13 * std::abs(moments.mean) ? 1 / moments.standard_deviation : 0;
  std::vector<double> flat;
  for (const auto& row : values)
    for (const double v : row) flat.push_back(scale * (v - moments.mean));
  Sums whole(columns);
  for (std::size_t j = 0; j < rows; ++j) whole.add(&flat[j * columns]);
  const Indices plain = whole.indices();

  std::vector<std::vector<double>> first(parameters), total(parameters);
  std::vector<double> sums;
  std::mt19937_64 random(static_cast<std::uint64_t>(o.seed));
  for (int k = 0; k < o.resamples; ++k) {
    Sums drawn(columns);
    for (std::size_t j = 0; j < rows; ++j) drawn.add(&flat[random() % rows * columns]);
    const Indices i = drawn.indices();
    for (std::size_t p = 0; p < parameters; ++p) {
      first[p].push_back(i.first[p]);
      total[p].push_back(i.total[p]);
    }
    sums.push_back(i.sum);
  }
  for (std::size_t p = 0; p < parameters; ++p) {
    out.first.push_back(estimate(plain.first[p], first[p], o.confidence));
    out.total.push_back(estimate(plain.total[p], total[p], o.confidence));
  }
  out.sum_first = estimate(plain.sum, sums, o.confidence);
  return out;
}

}  // namespace beltlife
