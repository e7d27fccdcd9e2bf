// Owns the fit of a mean and all half orders to a long, evenly sampled record, and the crank speed that fits best.
#pragma once

#include <complex>
#include <functional>
#include <span>
#include <vector>

namespace beltlife {

/// Least-squares fit of c_0 + 2 Re sum c_m exp(i m phi), phi the half angle of the crank from the record's middle.
struct HalfOrderFit {
  double crank_hz = 0;
  double middle_s = 0;  ///< from the first sample
  std::vector<std::complex<double>> coefficients;
  double explained = 0;  ///< sum of squares over all samples; the mean's part is in it

  double at(double time_s) const;
};

/// In one pass, whatever the length. Orders 0.5 to 9, as far as the sampling tells them.
HalfOrderFit fit_half_orders(std::span<const double> signal, double sample_rate_hz, double crank_hz);

/// How far a record's speed may be from its range's.
inline constexpr double speed_share = 0.02;

struct CrankSpeed {
  double crank_hz = 0;
  double explained = 0;  ///< share of the variance about the mean that the orders explain
  bool at_edge = false;  ///< the best fit lies at speed_share from the nominal speed, or beyond
};

/// The crank speed near `nominal_hz` whose orders explain most of the record, coherently from its first to its last
/// sample. Found on the record's beginning first, then on ever longer parts of it, each of which narrows the search.
CrankSpeed find_crank_speed(std::span<const double> signal, double sample_rate_hz, double nominal_hz);

/// The share of the variance that the orders of this speed explain.
CrankSpeed crank_speed_at(std::span<const double> signal, double sample_rate_hz, double crank_hz);

/// Where `height` is largest in low .. high: best of a grid of at most `step`, then golden section beside it.
double highest_point(const std::function<double(double)>& height, double low, double high, double step);

}  // namespace beltlife
