// From a record to amplitudes: see record_reduction.h.
#include "calibrate/records/record_reduction.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "calibrate/records/half_orders.h"
#include "calibrate/records/resample.h"

namespace beltlife {
namespace {

using std::numbers::pi;

double mean_of(std::span<const double> v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

/// `signal` at another rate. What `fit` says of it is carried over exactly, so that only the rest feels the ends.
std::vector<double> at_rate(std::span<const double> signal, double rate, double new_rate, const HalfOrderFit& fit) {
  std::vector<double> rest;
  for (std::size_t i = 0; i < signal.size(); ++i) rest.push_back(signal[i] - fit.at(static_cast<double>(i) / rate));
  const BandLimited limited(rest, rate, new_rate);
  std::vector<double> out(resampled_size(signal.size(), rate, new_rate));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double time = static_cast<double>(i) / new_rate;
    out[i] = fit.at(time) + limited.at(time);
  }
  return out;
}

HalfOrderFit mean_alone(std::span<const double> signal) { return {0, 0, {mean_of(signal)}, 0}; }

/// Orders over the windows: amplitude, in-phase and quadrature part of each window.
struct Tracked {
  double order = 0;
  std::vector<std::complex<double>> parts;
};

std::complex<double> mean_of(const Tracked& t) {
  return std::accumulate(t.parts.begin(), t.parts.end(), std::complex<double>{}) / static_cast<double>(t.parts.size());
}

/// Standard deviation of either part of an order from window to window.
double deviation_of(const Tracked& t) {
  const std::complex<double> mean = mean_of(t);
  double squares = 0;
  for (const auto& part : t.parts) squares += std::norm(part - mean);
  return std::sqrt(squares / (2 * (static_cast<double>(t.parts.size()) - 1)));
}

/// Standard deviation of an amplitude averaged over the windows: from how much the windows differ.
double noise_between(const std::vector<Tracked>& tracked) {
  std::vector<double> deviations;
  for (const Tracked& t : tracked) deviations.push_back(deviation_of(t));
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  const auto windows = static_cast<double>(tracked[0].parts.size());
  // The median of a chi-square variable of k degrees of freedom is k (1 - 2 / (9 k))^3: of few windows it lies low.
  const double freedom = 2 * (windows - 1);
  return *middle / std::pow(1 - 2 / (9 * freedom), 1.5) / std::sqrt(windows);
}

/// Mean over the windows. With its phase, so that noise averages out; where an order differs from window to window by
/// much more than the noise (its phase drifts, it swells) by squares, so that nothing is lost.
double amplitude_of(const Tracked& t, double noise) {
  constexpr double much_more = 2;  // of four windows one order in 2000 does by chance
  const auto windows = static_cast<double>(t.parts.size());
  if (noise > 0 && !(deviation_of(t) > much_more * noise * std::sqrt(windows))) return std::abs(mean_of(t));
  double squares = 0;
  for (const auto& part : t.parts) squares += std::norm(part);
  // To each window's square the noise adds two parts' own, each sqrt(windows) times as strong as the average's.
  return std::sqrt(std::max(0.0, squares / windows - 2 * windows * noise * noise));
}

/// Standard deviation of the amplitude itself from window to window.
double scatter_of(const Tracked& t) {
  const auto windows = static_cast<double>(t.parts.size());
  double mean = 0, squares = 0;
  for (const auto& part : t.parts) mean += std::abs(part) / windows;
  for (const auto& part : t.parts) squares += (std::abs(part) - mean) * (std::abs(part) - mean);
  return std::sqrt(squares / (windows - 1));
}

/// Mean over all whole double revolutions at 144 angles, deviation from the mean of all.
void average_cycles(std::span<const double> signal, double rate, double crank_hz, Reduction& out) {
  constexpr int points = 144;
  const double mean = mean_of(signal);
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& x : centred) x -= mean;
  const BandLimited limited(centred, rate, rate);
  const double cycle = 2 / crank_hz, length = static_cast<double>(signal.size()) / rate;
  // Cycles near the ends are left out where others remain: interpolation lacks what lies beyond.
  int first = static_cast<int>(std::ceil(limited.reach_s() / cycle)),
      last = static_cast<int>(std::floor((length - limited.reach_s()) / cycle));
  if (first >= last) first = 0, last = std::max(1, static_cast<int>(std::floor(length / cycle)));
  for (int p = 0; p < points; ++p) {
    double sum = 0;
    for (int c = first; c < last; ++c) sum += limited.at((c + static_cast<double>(p) / points) * cycle);
    out.angle_deg.push_back(720.0 * p / points);
    out.trace.push_back(sum / (last - first));
  }
  const double rest = mean_of(out.trace);
  for (double& x : out.trace) x -= rest;
}

}  // namespace

std::size_t window_samples(const ReductionSettings& s) {
  return static_cast<std::size_t>(std::llround(s.evaluate_s * s.sample_rate_hz));
}

Reduction reduce_record(std::span<const double> raw, double raw_rate, const ReductionSettings& s) {
  const double rate = s.sample_rate_hz;
  // Times that are written with few digits make a rate of 1000.0000001 Hz: a shift of a hundredth of a sample over
  // the whole record is none.
  const bool same = std::abs(raw_rate / rate - 1) * static_cast<double>(raw.size()) < 0.01;
  std::vector<double> signal =
      same ? std::vector<double>(raw.begin(), raw.end()) : at_rate(raw, raw_rate, rate, mean_alone(raw));
  // The record itself has no ends that resampling feels, but much faster ones are searched at the simulation's rate.
  constexpr double much_faster = 4;
  const bool direct = raw_rate <= much_faster * rate;
  CrankSpeed speed{s.crank_hz.value_or(0), 0, false};
  if (!s.crank_hz)
    speed = find_crank_speed(direct ? raw : std::span<const double>(signal), direct ? raw_rate : rate, s.nominal_hz);
  if (!same) signal = at_rate(raw, raw_rate, rate, fit_half_orders(raw, raw_rate, speed.crank_hz));

  Reduction out;
  out.crank_hz = speed.crank_hz;
  out.explained = crank_speed_at(signal, rate, speed.crank_hz).explained;
  out.at_edge = speed.at_edge;
  const std::size_t size = window_samples(s), windows = signal.size() / size;
  out.windows = static_cast<int>(windows);
  const std::span<const double> used = std::span(signal).last(windows * size);
  out.mean = mean_of(used);
  std::vector<double> angle(used.size());
  for (std::size_t i = 0; i < angle.size(); ++i) angle[i] = 2 * pi * speed.crank_hz * static_cast<double>(i) / rate;

  std::vector<Tracked> tracked;
  std::vector<double> band_squares(octave_bands.size(), 0.0);
  double rest_squares = 0;
  for (std::size_t w = 0; w < windows; ++w) {
    const auto window = used.subspan(w * size, size);
    const auto at = std::span<const double>(angle).subspan(w * size, size);
    const auto orders = track_orders(window, at, default_orders());
    tracked.resize(orders.size());
    for (std::size_t o = 0; o < orders.size(); ++o) {
      tracked[o].order = orders[o].order;
      tracked[o].parts.push_back(std::polar(orders[o].amplitude, orders[o].phase_rad));
    }
    const std::vector<double> rest = order_remainder(window, at, orders);
    const double rest_mean = mean_of(rest);
    for (const double x : rest) rest_squares += (x - rest_mean) * (x - rest_mean);
    const std::vector<double> bands = remainder_bands(window, at, orders, rate);
    for (std::size_t b = 0; b < bands.size(); ++b) band_squares[b] += bands[b] * bands[b];
    const Spectrum spectrum = amplitude_spectrum(window, rate);
    out.spectrum.frequency_hz = spectrum.frequency_hz;
    out.spectrum.amplitude.resize(spectrum.amplitude.size());
    for (std::size_t k = 0; k < spectrum.amplitude.size(); ++k)
      out.spectrum.amplitude[k] += spectrum.amplitude[k] * spectrum.amplitude[k];
  }
  const auto count = static_cast<double>(windows), samples = static_cast<double>(used.size());
  for (double& a : out.spectrum.amplitude) a = std::sqrt(a / count);

  constexpr std::size_t enough_windows = 4;
  if (windows >= enough_windows && !tracked.empty()) {
    out.noise = noise_between(tracked);
  } else {
    const double fitted = count * (1 + 2 * static_cast<double>(tracked.size()));
    out.noise = std::sqrt(rest_squares / std::max(1.0, samples - fitted)) * std::sqrt(2 / samples);
  }
  for (const Tracked& t : tracked)
    out.orders.push_back({t.order, amplitude_of(t, windows >= enough_windows ? out.noise : 0),
                          windows >= enough_windows ? scatter_of(t) : 0});
  // White noise of standard deviation noise sqrt(samples / 2) a sample. The orders have taken their bin's width of it.
  const double density = 2 * out.noise * out.noise * samples / rate;
  for (std::size_t b = 0; b < octave_bands.size(); ++b) {
    const auto [low, high] = octave_bands[b];
    double width = high - low;
    for (const Tracked& t : tracked)
      if (t.order * out.crank_hz >= low && t.order * out.crank_hz < high) width -= rate / static_cast<double>(size);
    // Where resampling takes away from the band, or the record never had it, there is nothing to compare.
    const bool beyond = high > BandLimited::flat_share * 0.5 * std::min(raw_rate, rate) && !same;
    out.bands.push_back(beyond ? std::nan("") : std::sqrt(band_squares[b] / count));
    out.band_noise.push_back(std::sqrt(density * std::max(0.0, width)));
  }
  average_cycles(used, rate, out.crank_hz, out);
  return out;
}

}  // namespace beltlife
