// Owns the transforms behind amplitude spectra (FFT of any length) and order tracking (least squares).
#include "sim/signal/spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/FFT>

namespace beltlife {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

std::size_t largest_prime_factor(std::size_t n) {
  std::size_t largest = 1;
  for (std::size_t p = 2; p * p <= n; ++p)
    for (; n % p == 0; n /= p) largest = p;
  return n > 1 ? n : largest;
}

/// Discrete Fourier transform by Bluestein's chirp convolution: n log n also for prime n.
std::vector<Complex> chirp_transform(const std::vector<Complex>& in) {
  const std::size_t n = in.size();
  const std::size_t padded = std::bit_ceil(2 * n - 1);
  std::vector<Complex> chirp(n), a(padded), b(padded);
  for (std::size_t k = 0; k < n; ++k) {
    // The phase repeats after 2 n; reducing k^2 in integers keeps it exact for long signals.
    chirp[k] = std::polar(1.0, -pi * static_cast<double>(k * k % (2 * n)) / static_cast<double>(n));
    a[k] = in[k] * chirp[k];
    b[k] = b[(padded - k) % padded] = std::conj(chirp[k]);
  }
  Eigen::FFT<double> fft;
  std::vector<Complex> fa, fb, convolved;
  fft.fwd(fa, a);
  fft.fwd(fb, b);
  for (std::size_t k = 0; k < padded; ++k) fa[k] *= fb[k];
  fft.inv(convolved, fa);
  std::vector<Complex> out(n);
  for (std::size_t k = 0; k < n; ++k) out[k] = convolved[k] * chirp[k];
  return out;
}

std::vector<Complex> transform(const std::vector<Complex>& in) {
  // Mixed radix costs n times the sum of n's prime factors; the chirp about as much as radix 50.
  if (largest_prime_factor(in.size()) > 50) return chirp_transform(in);
  Eigen::FFT<double> fft;
  std::vector<Complex> out;
  fft.fwd(out, in);
  return out;
}

}  // namespace

Spectrum amplitude_spectrum(std::span<const double> signal, double sample_rate_hz) {
  const std::size_t n = signal.size();
  if (n < 2) return {};
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(n);
  std::vector<Complex> windowed(n);
  // The periodic Hann window: a sine on a bin leaks into the two neighbouring bins only and its sum is n / 2.
  for (std::size_t k = 0; k < n; ++k) {
    const double hann = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(k) / static_cast<double>(n));
    windowed[k] = hann * (signal[k] - mean);
  }
  const std::vector<Complex> bins = transform(windowed);

  Spectrum spectrum;
  const double window_sum = 0.5 * static_cast<double>(n);
  for (std::size_t k = 0; k <= n / 2; ++k) {
    // Every bin but zero and Nyquist shares its amplitude with its mirror image.
    const double sides = k == 0 || 2 * k == n ? 1 : 2;
    spectrum.frequency_hz.push_back(static_cast<double>(k) * sample_rate_hz / static_cast<double>(n));
    spectrum.amplitude.push_back(sides * std::abs(bins[k]) / window_sum);
  }
  return spectrum;
}

double peak_frequency(std::span<const double> signal, double sample_rate_hz) {
  if (signal.size() < 8) return std::nan("");
  const Spectrum s = amplitude_spectrum(signal, sample_rate_hz);
  const auto highest = std::max_element(s.amplitude.begin() + 1, s.amplitude.end() - 1);
  if (!(*highest > 0)) return std::nan("");
  const auto k = static_cast<std::size_t>(highest - s.amplitude.begin());
  const double bin = s.frequency_hz[1] - s.frequency_hz[0];
  const double a = std::log(s.amplitude[k - 1]), b = std::log(s.amplitude[k]), c = std::log(s.amplitude[k + 1]);
  const double shift = std::isfinite(a) && std::isfinite(c) && a - 2 * b + c < 0 ? 0.5 * (a - c) / (a - 2 * b + c) : 0;
  return s.frequency_hz[k] + bin * shift;
}

std::vector<double> default_orders() {
  std::vector<double> orders;
  for (int half = 1; half <= 18; ++half) orders.push_back(0.5 * half);
  return orders;
}

std::vector<OrderAmplitude> track_orders(std::span<const double> signal, std::span<const double> angle_rad,
                                         std::span<const double> orders) {
  assert(signal.size() == angle_rad.size());
  const auto rows = static_cast<Eigen::Index>(signal.size());
  if (rows < 2) return {};
  const double angle_step = (angle_rad.back() - angle_rad.front()) / static_cast<double>(rows - 1);
  // Each sample stands for one angle step; the slack lets exactly two revolutions pass in spite of rounding.
  const double revolutions = angle_step * static_cast<double>(rows) / (2 * pi);
  if (!(revolutions > 2 - 1e-9)) return {};

  std::vector<double> tracked;
  for (const double order : orders)
    if (order * angle_step < pi) tracked.push_back(order);

  const auto count = static_cast<Eigen::Index>(tracked.size());
  const Eigen::Index columns = 1 + 2 * count;
  if (rows < columns) return {};
  Eigen::MatrixXd basis(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    basis(i, 0) = 1;
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto at = static_cast<std::size_t>(i);
      const double phase = tracked[static_cast<std::size_t>(j)] * angle_rad[at];
      basis(i, 1 + 2 * j) = std::cos(phase);
      basis(i, 2 + 2 * j) = std::sin(phase);
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(basis);
  qr.setThreshold(1e-9);  // beyond this condition less than half the digits of an amplitude would be real
  if (qr.rank() < columns) return {};
  const Eigen::VectorXd solution = qr.solve(Eigen::Map<const Eigen::VectorXd>(signal.data(), rows));

  std::vector<OrderAmplitude> result;
  for (Eigen::Index j = 0; j < count; ++j) {
    // A cos(x + p) = A cos p cos x - A sin p sin x
    const double cosine = solution(1 + 2 * j), sine = solution(2 + 2 * j);
    result.push_back({.order = tracked[static_cast<std::size_t>(j)],
                      .amplitude = std::hypot(cosine, sine),
                      .phase_rad = std::atan2(-sine, cosine)});
  }
  return result;
}

}  // namespace beltlife
