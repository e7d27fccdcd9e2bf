// Owns amplitude spectra and order tracking of sampled signals.
#pragma once

#include <span>
#include <vector>

namespace beltlife {

/// One-sided amplitude spectrum (a sine of amplitude A on a bin gives A), mean removed, Hann window with its
/// amplitude correction. Bins k / (n dt), k = 0 .. n/2.
struct Spectrum {
  std::vector<double> frequency_hz;
  std::vector<double> amplitude;  ///< in the signal's unit
};
Spectrum amplitude_spectrum(std::span<const double> signal, double sample_rate_hz);

/// Frequency (Hz) at which the amplitude spectrum is highest, between bins by a parabola through the logarithms of
/// three of them: right to a few hundredths of a bin. Not a number for fewer than eight samples or a constant signal.
double peak_frequency(std::span<const double> signal, double sample_rate_hz);

/// Amplitude and phase of A cos(order x angle + phase) in a signal, by least squares on all orders and the mean
/// together, so that the window need not hold whole revolutions.
struct OrderAmplitude {
  double order = 0;
  double amplitude = 0;
  double phase_rad = 0;
};

/// The orders of crank rotation that are tracked by default: 0.5 to 9 by halves.
std::vector<double> default_orders();

/// `angle_rad` is the driven body's nominal angle at each sample, counted positive in its running sense. Orders
/// above the Nyquist order of the window are left out. Empty if the window is too short to tell the orders apart
/// (fewer than two revolutions).
std::vector<OrderAmplitude> track_orders(std::span<const double> signal, std::span<const double> angle_rad,
                                         std::span<const double> orders);

}  // namespace beltlife
