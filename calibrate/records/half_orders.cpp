// Half orders of a long record: see half_orders.h.
#include "calibrate/records/half_orders.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

using std::numbers::pi;

/// Sum of exp(i k h n) over n samples about their middle: real, since the middle is the origin.
double dirichlet(double k_times_h, double n) {
  const double half = 0.5 * k_times_h;
  return std::abs(std::sin(half)) < 1e-12 ? n : std::sin(n * half) / std::sin(half);
}

}  // namespace

double HalfOrderFit::at(double time_s) const {
  const std::complex<double> turn = std::polar(1.0, pi * crank_hz * (time_s - middle_s));
  std::complex<double> power = 1;
  double sum = coefficients.empty() ? 0 : coefficients[0].real();
  for (std::size_t m = 1; m < coefficients.size(); ++m) {
    power *= turn;
    sum += 2 * (coefficients[m] * power).real();
  }
  return sum;
}

HalfOrderFit fit_half_orders(std::span<const double> signal, double sample_rate_hz, double crank_hz) {
  const auto n = static_cast<double>(signal.size());
  const double step = pi * crank_hz / sample_rate_hz;  // half angle a sample
  const auto half_orders = static_cast<double>(default_orders().size());
  // Two bins below Nyquist an order and its mirror image can still be told apart.
  const int top = static_cast<int>(std::clamp(std::floor((pi - 4 * pi / n) / step), 0.0, half_orders));
  const auto size = static_cast<std::size_t>(top) + 1;

  constexpr std::size_t block = 256;  // within which the angle is turned on instead of computed: rounding stays small
  constexpr std::size_t most = 19;
  std::array<double, most> real{}, imaginary{};
  for (std::size_t first = 0; first < signal.size(); first += block) {
    const double start = step * (static_cast<double>(first) - 0.5 * (n - 1));
    std::array<double, most> c{}, s{}, dc{}, ds{};
    for (std::size_t m = 0; m < most; ++m) {
      const auto order = static_cast<double>(m);
      c[m] = std::cos(order * start), s[m] = -std::sin(order * start);
      dc[m] = std::cos(order * step), ds[m] = -std::sin(order * step);
    }
    for (std::size_t i = first; i < std::min(first + block, signal.size()); ++i)
      for (std::size_t m = 0; m < most; ++m) {
        real[m] += signal[i] * c[m];
        imaginary[m] += signal[i] * s[m];
        const double turned = c[m] * dc[m] - s[m] * ds[m];
        s[m] = s[m] * dc[m] + c[m] * ds[m];
        c[m] = turned;
      }
  }

  // Normal equations of exp(i m phi), m = -top .. top. Their matrix is real, Toeplitz and known without any sum.
  const auto columns = 2 * top + 1;
  Eigen::MatrixXd gram(columns, columns);
  Eigen::MatrixXd projected(columns, 2);
  for (int a = 0; a < columns; ++a) {
    for (int b = 0; b < columns; ++b) gram(a, b) = dirichlet((a - b) * step, n);
    const auto m = static_cast<std::size_t>(std::abs(a - top));
    projected(a, 0) = real[m];
    projected(a, 1) = a < top ? -imaginary[m] : imaginary[m];
  }
  const Eigen::MatrixXd solved = gram.ldlt().solve(projected);
  HalfOrderFit fit{crank_hz, 0.5 * (n - 1) / sample_rate_hz, std::vector<std::complex<double>>(size),
                   projected.cwiseProduct(solved).sum()};
  for (int m = 0; m <= top; ++m)
    fit.coefficients[static_cast<std::size_t>(m)] = {solved(top + m, 0), solved(top + m, 1)};
  return fit;
}

CrankSpeed crank_speed_at(std::span<const double> signal, double sample_rate_hz, double crank_hz) {
  double sum = 0, squares = 0, all = 0;
  for (const double x : signal) sum += x, all += x * x;
  const auto n = static_cast<double>(signal.size());
  for (const double x : signal) squares += (x - sum / n) * (x - sum / n);
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& x : centred) x -= sum / n;
  constexpr double rounding = 1e-24;  // of a constant record nothing but rounding varies
  return {crank_hz,
          squares > rounding * all ? fit_half_orders(centred, sample_rate_hz, crank_hz).explained / squares : 0, false};
}

double highest_point(const std::function<double(double)>& height, double low, double high, double step) {
  const int points = std::max(2, static_cast<int>(std::ceil((high - low) / step)));
  const double grid = (high - low) / points;
  double best = low, most = height(low);
  for (int i = 1; i <= points; ++i) {
    const double x = low + i * grid, y = height(x);
    if (y > most) best = x, most = y;
  }
  constexpr double golden = 0.6180339887498949;
  constexpr int halvings = 34;  // to 1e-7 of a grid step: at a smooth maximum rounding hides more
  double a = std::max(low, best - grid), b = std::min(high, best + grid);
  double left = b - golden * (b - a), right = a + golden * (b - a);
  double at_left = height(left), at_right = height(right);
  for (int i = 0; i < halvings; ++i) {
    if (at_left >= at_right) {
      b = right, right = left, at_right = at_left;
      left = b - golden * (b - a), at_left = height(left);
    } else {
      a = left, left = right, at_left = at_right;
      right = a + golden * (b - a), at_right = height(right);
    }
  }
  return 0.5 * (a + b);
}

CrankSpeed find_crank_speed(std::span<const double> signal, double sample_rate_hz, double nominal_hz) {
  double sum = 0;
  for (const double x : signal) sum += x;
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& x : centred) x -= sum / static_cast<double>(signal.size());

  constexpr double first_samples = 4096, first_revolutions = 16;
  const auto enough =
      static_cast<std::size_t>(std::max(first_samples, std::ceil(first_revolutions * sample_rate_hz / nominal_hz)));
  std::size_t length = signal.size();
  while (length / 2 >= enough) length /= 2;
  const double lowest = nominal_hz * (1 - speed_share), highest = nominal_hz * (1 + speed_share);
  double low = lowest, high = highest, found = nominal_hz;
  while (true) {
    const auto part = std::span(centred).first(length);
    const double seconds = static_cast<double>(length) / sample_rate_hz;
    // The line of order 9 is 1 / (9 T) wide in crank speed: four points across it.
    const double step = 1 / (36 * seconds);
    found =
        highest_point([&](double hz) { return fit_half_orders(part, sample_rate_hz, hz).explained; }, low, high, step);
    if (length == signal.size()) break;
    length = std::min(2 * length, signal.size());
    if (2 * length > signal.size()) length = signal.size();
    // The line of order 1 is 1 / T wide; its middle is known to a quarter of that even in much noise.
    low = std::max(lowest, found - 0.25 / seconds), high = std::min(highest, found + 0.25 / seconds);
  }
  CrankSpeed speed = crank_speed_at(signal, sample_rate_hz, found);
  constexpr double edge = 1e-4;
  speed.at_edge = std::abs(found / nominal_hz - 1) > speed_share - edge;
  return speed;
}

}  // namespace beltlife
