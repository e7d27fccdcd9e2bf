// Band-limited interpolation: see resample.h.
#include "calibrate/records/resample.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

using std::numbers::pi;

constexpr double cutoff = 0.95;        // of the lower Nyquist frequency, the middle of the slope
constexpr std::size_t entries = 1024;  // between two zeros: straight lines between them are right to 1e-6
constexpr double beta = 10.06;         // Kaiser: 100 dB, a slope of 0.1 of Nyquist over 2 x 64 zeros

/// The kernel over 0 .. 64 zeros of the full-band sinc, without its scale.
const std::vector<double>& kernel() {
  static const std::vector<double> table = [] {
    std::vector<double> values;
    const auto count = static_cast<std::size_t>(BandLimited::zeros) * entries;
    const double scale = 1 / std::cyl_bessel_i(0.0, beta);
    for (std::size_t i = 0; i <= count; ++i) {
      const double x = static_cast<double>(i) / entries, share = x / BandLimited::zeros;
      const double sinc = i == 0 ? cutoff : std::sin(pi * cutoff * x) / (pi * x);
      values.push_back(sinc * scale * std::cyl_bessel_i(0.0, beta * std::sqrt(std::max(0.0, 1 - share * share))));
    }
    values.push_back(0);
    return values;
  }();
  return table;
}

}  // namespace

BandLimited::BandLimited(std::span<const double> signal, double sample_rate_hz, double other_rate_hz)
    : signal_(signal),
      rate_(sample_rate_hz),
      cutoff_share_(std::min(1.0, other_rate_hz / sample_rate_hz)),
      reach_s_(zeros / (sample_rate_hz * cutoff_share_)) {}

double BandLimited::at(double time_s) const {
  const std::vector<double>& table = kernel();
  const double at = time_s * rate_, reach = reach_s_ * rate_;
  const auto last = static_cast<double>(signal_.size()) - 1;
  const auto first = static_cast<std::ptrdiff_t>(std::max(0.0, std::ceil(at - reach)));
  const auto end = static_cast<std::ptrdiff_t>(std::min(last, std::floor(at + reach)));
  double sum = 0;
  for (std::ptrdiff_t k = first; k <= end; ++k) {
    const double x = std::abs(at - static_cast<double>(k)) * cutoff_share_ * static_cast<double>(entries);
    const auto entry = std::min(static_cast<std::size_t>(x), table.size() - 2);
    const double part = x - static_cast<double>(entry);
    sum += signal_[static_cast<std::size_t>(k)] * (table[entry] + part * (table[entry + 1] - table[entry]));
  }
  return sum * cutoff_share_;
}

std::size_t resampled_size(std::size_t samples, double rate_hz, double new_rate_hz) {
  constexpr double slack = 0.5;  // of a sample: times written with few digits make a rate a little too high
  return static_cast<std::size_t>(std::floor(static_cast<double>(samples) * new_rate_hz / rate_hz + slack));
}

}  // namespace beltlife
