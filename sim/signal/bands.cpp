// Octave bands of what orders leave: see bands.h.
#include "sim/signal/bands.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace beltlife {

std::string band_name(const Band& band) { return fmt::format("band_{:g}_{:g}_hz", band.low_hz, band.high_hz); }

std::vector<double> order_remainder(std::span<const double> signal, std::span<const double> angle_rad,
                                    std::span<const OrderAmplitude> orders) {
  assert(signal.size() == angle_rad.size());
  std::vector<double> rest(signal.begin(), signal.end());
  for (const OrderAmplitude& o : orders)
    for (std::size_t i = 0; i < rest.size(); ++i)
      rest[i] -= o.amplitude * std::cos(o.order * angle_rad[i] + o.phase_rad);
  return rest;
}

double band_amplitude(const Spectrum& spectrum, const Band& band) {
  if (spectrum.frequency_hz.size() < 2) return std::nan("");
  constexpr double line_bins = 4;     // Hann's main lobe
  constexpr double noise_bins = 1.5;  // Hann's equivalent noise bandwidth: squares over a line's bins are 1.5 A^2
  constexpr double rounding = 1e-9;
  const double bin = spectrum.frequency_hz[1];
  if (band.high_hz > spectrum.frequency_hz.back() + 0.5 * bin + rounding ||
      band.high_hz - band.low_hz < line_bins * bin - rounding)
    return std::nan("");
  double squares = 0;
  for (std::size_t k = 0; k < spectrum.frequency_hz.size(); ++k)
    if (spectrum.frequency_hz[k] >= band.low_hz && spectrum.frequency_hz[k] < band.high_hz)
      squares += spectrum.amplitude[k] * spectrum.amplitude[k];
  return std::sqrt(squares / noise_bins);
}

std::vector<double> remainder_bands(std::span<const double> signal, std::span<const double> angle_rad,
                                    std::span<const OrderAmplitude> orders, double sample_rate_hz) {
  if (orders.empty()) return std::vector<double>(octave_bands.size(), std::nan(""));
  const Spectrum spectrum = amplitude_spectrum(order_remainder(signal, angle_rad, orders), sample_rate_hz);
  std::vector<double> amplitudes;
  for (const Band& band : octave_bands) amplitudes.push_back(band_amplitude(spectrum, band));
  return amplitudes;
}

}  // namespace beltlife
