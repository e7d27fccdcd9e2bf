// Owns octave bands: how strong a signal is between two frequencies, beside the orders of the crank.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sim/signal/spectrum.h"

namespace beltlife {

/// A stretch of frequencies, lower edge included.
struct Band {
  double low_hz = 0, high_hz = 0;
};

/// The bands that are listed of every output: octaves from 10 to 320 Hz.
inline constexpr std::array<Band, 5> octave_bands{{{10, 20}, {20, 40}, {40, 80}, {80, 160}, {160, 320}}};

/// "band_160_320_hz"
std::string band_name(const Band& band);

/// What the orders leave of a signal: signal - sum of A cos(order x angle + phase). The signal's mean stays in it.
std::vector<double> order_remainder(std::span<const double> signal, std::span<const double> angle_rad,
                                    std::span<const OrderAmplitude> orders);

/// Amplitude of the sine that has the power of the band, from an amplitude spectrum with Hann window. Not a number
/// where the band reaches beyond the spectrum or holds fewer than the four bins over which Hann spreads a line.
double band_amplitude(const Spectrum& spectrum, const Band& band);

/// Amplitudes of octave_bands in the remainder. Not a number throughout if no orders were told apart (`orders` empty).
std::vector<double> remainder_bands(std::span<const double> signal, std::span<const double> angle_rad,
                                    std::span<const OrderAmplitude> orders, double sample_rate_hz);

}  // namespace beltlife
