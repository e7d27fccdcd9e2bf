// Order tracking over changing speed: see order_map.h.
#include "sim/signal/order_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace beltlife {
namespace {

using std::numbers::pi;
constexpr double half_window = pi * order_window_revolutions;  // rad

/// Step of angle for which a sample stands.
double angle_step(std::span<const double> angle, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, angle.size() - 1);
  return (angle[after] - angle[before]) / static_cast<double>(after - before);
}

/// Removes the parabola that fits best under the weights, in place; `place` runs from -1 to 1.
void remove_trend(std::vector<double>& values, const std::vector<double>& place, const std::vector<double>& weight) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::Vector3d basis(1, place[i], place[i] * place[i]);
    moments += weight[i] * basis * basis.transpose();
    right += weight[i] * values[i] * basis;
  }
  const Eigen::Vector3d fit = moments.ldlt().solve(right);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= fit[0] + place[i] * (fit[1] + place[i] * fit[2]);
}

std::vector<double> window_amplitudes(std::span<const double> signal, std::span<const double> angle,
                                      const OrderWindow& w, std::size_t orders) {
  const std::size_t n = w.last - w.first;
  std::vector<double> values(n), place(n), weight(n);
  double sum = 0, longest_step = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double step = angle_step(angle, w.first + i);
    values[i] = signal[w.first + i];
    place[i] = (angle[w.first + i] - w.centre_rad) / half_window;
    weight[i] = step * (0.5 + 0.5 * std::cos(pi * place[i]));
    sum += weight[i];
    longest_step = std::max(longest_step, step);
  }
  remove_trend(values, place, weight);
  std::vector<std::complex<double>> bins(orders);
  for (std::size_t i = 0; i < n; ++i) {
    // Orders are multiples of the spacing: their turns are powers of the first one's.
    const std::complex<double> turn = std::polar(1.0, -order_spacing * half_window * place[i]);
    std::complex<double> value = weight[i] * values[i];
    for (std::complex<double>& bin : bins) bin += value *= turn;
  }
  std::vector<double> amplitudes(orders);
  for (std::size_t k = 0; k < orders; ++k) {
    const bool above_nyquist = order_spacing * static_cast<double>(k + 1) * longest_step >= pi;
    amplitudes[k] = above_nyquist ? std::nan("") : 2 * std::abs(bins[k]) / sum;
  }
  return amplitudes;
}

}  // namespace

std::vector<OrderWindow> order_windows(std::span<const double> time_s, std::span<const double> angle) {
  assert(time_s.size() == angle.size());
  std::vector<OrderWindow> windows;
  if (angle.size() < 3) return windows;
  constexpr double rounding = 1e-9;  // so that exactly a window's samples hold one
  const double end = angle.back() + angle_step(angle, angle.size() - 1) + rounding;
  for (double centre = angle.front() + half_window; centre + half_window <= end; centre += half_window) {
    const auto at = [&](double wanted) {
      return static_cast<std::size_t>(std::lower_bound(angle.begin(), angle.end(), wanted) - angle.begin());
    };
    const std::size_t middle = std::clamp<std::size_t>(at(centre), 1, angle.size() - 2);
    const double rate = (angle[middle + 1] - angle[middle - 1]) / (time_s[middle + 1] - time_s[middle - 1]);
    windows.push_back({at(centre - half_window), at(centre + half_window - rounding), centre,
                       time_s[middle] + (centre - angle[middle]) / rate, rate * 30 / pi});
  }
  return windows;
}

std::vector<double> map_orders(double highest) {
  std::vector<double> orders;
  for (int k = 1; k * order_spacing <= highest; ++k) orders.push_back(k * order_spacing);
  return orders;
}

std::vector<std::vector<double>> order_amplitudes(std::span<const double> signal, std::span<const double> angle,
                                                  const std::vector<OrderWindow>& windows, double highest) {
  assert(signal.size() == angle.size());
  const std::size_t orders = map_orders(highest).size();
  std::vector<std::vector<double>> map(orders, std::vector<double>(windows.size()));
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const auto amplitudes = window_amplitudes(signal, angle, windows[w], orders);
    for (std::size_t k = 0; k < orders; ++k) map[k][w] = amplitudes[k];
  }
  return map;
}

}  // namespace beltlife
