// Owns order tracking of a signal over changing speed: amplitudes by order in short windows of whole revolutions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace beltlife {

/// Crank revolutions of a window: four cycles of a four-stroke engine.
inline constexpr double order_window_revolutions = 8;
/// Spacing of a map's orders, 1 / order_window_revolutions; half orders are every fourth.
inline constexpr double order_spacing = 1 / order_window_revolutions;

/// One window: samples [first, last) and the angle in their middle.
struct OrderWindow {
  std::size_t first = 0, last = 0;
  double centre_rad = 0;
  double time_s = 0;     ///< at the centre
  double speed_rpm = 0;  ///< at the centre
};

/// Windows that lie within the samples, each half a window behind the one before. `angle_rad` is the driven body's
/// nominal angle, increasing, at `time_s`. None if the samples are fewer than a window.
std::vector<OrderWindow> order_windows(std::span<const double> time_s, std::span<const double> angle_rad);

/// The orders of a map: from order_spacing to `highest` in steps of order_spacing.
std::vector<double> map_orders(double highest);

/// Amplitude of every order of map_orders(highest) in every window: [order][window]. The transform is taken over angle,
/// so that a sweep does not smear an order: its integral weighs every sample with its step of angle, which needs no
/// resampling. Hann window; a parabola fitted under it, the mean and its drift, is removed first. Orders that differ
/// by half an order do not mix. Not a number where an order lies above half the sampling rate.
std::vector<std::vector<double>> order_amplitudes(std::span<const double> signal, std::span<const double> angle_rad,
                                                  const std::vector<OrderWindow>& windows, double highest);

}  // namespace beltlife
