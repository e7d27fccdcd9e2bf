// From an amplitude spectrum to orders: see spectrum_reduction.h.
#include "calibrate/records/spectrum_reduction.h"

#include <algorithm>
#include <cmath>

#include "calibrate/records/half_orders.h"

namespace beltlife {
namespace {

/// Bins [first, end) within `reach_hz` of a frequency.
std::pair<std::size_t, std::size_t> bins_about(const Spectrum& s, double hz, double reach_hz) {
  const auto& f = s.frequency_hz;
  const double rounding = 1e-6 * reach_hz;
  const auto first = std::lower_bound(f.begin(), f.end(), hz - reach_hz - rounding);
  const auto end = std::upper_bound(first, f.end(), hz + reach_hz + rounding);
  return {static_cast<std::size_t>(first - f.begin()), static_cast<std::size_t>(end - f.begin())};
}

/// Power about all orders, less the further from them, so that it changes smoothly with the crank frequency.
double order_power(const Spectrum& s, double crank_hz, double reach_hz) {
  double power = 0;
  for (const double order : default_orders()) {
    const auto [first, end] = bins_about(s, order * crank_hz, reach_hz);
    for (std::size_t k = first; k < end; ++k) {
      const double away = (s.frequency_hz[k] - order * crank_hz) / reach_hz;
      power += std::max(0.0, 1 - away * away) * s.amplitude[k] * s.amplitude[k];
    }
  }
  return power;
}

}  // namespace

LineShape line_shape(SpectrumWindow window) {
  switch (window) {
    case SpectrumWindow::flat_top:
      return {5, 3.77};
    case SpectrumWindow::rectangular:
      return {1, 1};
    default:
      return {2, 1.5};
  }
}

Reduction reduce_spectrum(const Spectrum& s, SpectrumWindow window, const ReductionSettings& settings) {
  const LineShape shape = line_shape(window);
  const auto lines = static_cast<double>(s.frequency_hz.size() - 1);
  const double bin = (s.frequency_hz.back() - s.frequency_hz.front()) / lines, reach = shape.reach * bin;
  Reduction out;
  out.spectrum = s;
  out.crank_hz = settings.crank_hz.value_or(0);
  if (!settings.crank_hz) {
    const double nominal = settings.nominal_hz;
    out.crank_hz = highest_point([&](double hz) { return order_power(s, hz, reach + bin); },
                                 nominal * (1 - speed_share), nominal * (1 + speed_share), bin / 36);
    out.at_edge = std::abs(out.crank_hz / nominal - 1) > speed_share - 1e-4;
  }
  double of_orders = 0, of_all = 0, highest = 0;
  std::vector<bool> taken(s.amplitude.size(), false);
  for (const double order : default_orders()) {
    const double hz = order * out.crank_hz;
    const auto [near_first, near_end] = bins_about(s, hz, reach + bin);
    std::fill(taken.begin() + static_cast<std::ptrdiff_t>(near_first),
              taken.begin() + static_cast<std::ptrdiff_t>(near_end), true);
    if (hz + reach > s.frequency_hz.back() || hz - reach < s.frequency_hz.front()) continue;
    const auto [first, end] = bins_about(s, hz, reach);
    double squares = 0, peak = 0;
    for (std::size_t k = first; k < end; ++k) {
      squares += s.amplitude[k] * s.amplitude[k];
      peak = std::max(peak, s.amplitude[k]);
    }
    of_orders += squares;
    highest = hz + reach;
    const double amplitude = window == SpectrumWindow::rectangular ? peak : std::sqrt(squares / shape.noise_bins);
    out.orders.push_back({order, amplitude});
  }
  std::vector<double> away;
  for (std::size_t k = 0; k < s.amplitude.size(); ++k) {
    // Below half of order 0.5 stands what the mean has left.
    if (s.frequency_hz[k] < 0.25 * out.crank_hz) continue;
    of_all += s.amplitude[k] * s.amplitude[k];
    if (!taken[k]) away.push_back(s.amplitude[k]);
  }
  out.explained = of_all > 0 ? of_orders / of_all : 0;
  if (!away.empty()) {
    const auto middle = away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2);
    std::nth_element(away.begin(), middle, away.end());
    out.noise = *middle;
  }
  for (const Band& band : octave_bands) {
    double squares = 0;
    for (std::size_t k = 0; k < s.amplitude.size(); ++k)
      if (s.frequency_hz[k] >= band.low_hz && s.frequency_hz[k] < band.high_hz)
        squares += s.amplitude[k] * s.amplitude[k];
    const bool known = band.low_hz >= highest && band.high_hz <= s.frequency_hz.back() + bin &&
                       out.orders.size() == default_orders().size();
    out.bands.push_back(known ? std::sqrt(squares / shape.noise_bins) : std::nan(""));
    out.band_noise.push_back(0);
  }
  return out;
}

}  // namespace beltlife
