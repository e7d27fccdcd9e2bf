// Owns the reduction of a measured time series as the simulation reduces its own: order amplitudes, bands, noise.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/signal/bands.h"

namespace beltlife {

struct ReductionSettings {
  double sample_rate_hz = 0;       ///< of the simulation
  double evaluate_s = 0;           ///< length of a window
  double nominal_hz = 0;           ///< the range's crank speed
  std::optional<double> crank_hz;  ///< of the record, if it is known
};

struct ReducedOrder {
  double order = 0;
  double amplitude = 0;
  double scatter = 0;  ///< of its amplitude from window to window; 0 of fewer than four
};

/// What a file comes to. Amplitudes are in the signal's unit.
struct Reduction {
  double crank_hz = 0;
  double explained = 0;  ///< share of the variance that the orders explain
  bool at_edge = false;  ///< the crank speed that fits best is as far off as it may be
  int windows = 0;       ///< of a time series
  double mean = 0;
  std::vector<ReducedOrder> orders;  ///< all that the sampling can tell
  double noise = 0;                  ///< standard deviation of one of these amplitudes
  std::vector<double> bands;         ///< octave_bands with the noise in them; not a number where unknown
  std::vector<double> band_noise;    ///< what of each is noise
  Spectrum spectrum;
  std::vector<double> angle_deg, trace;
};

/// Samples in one window of the simulation.
std::size_t window_samples(const ReductionSettings& settings);

/// The record holds at least one window at the simulation's rate. It is brought to that rate and cut into windows from
/// its end; each is reduced as the simulation's own. Amplitudes of orders are means over the windows with
/// their phase, or of their squares where the phase drifts; those of bands and of the spectrum root mean squares.
Reduction reduce_record(std::span<const double> signal, double sample_rate_hz, const ReductionSettings& settings);

}  // namespace beltlife
