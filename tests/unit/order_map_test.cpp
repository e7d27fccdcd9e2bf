// Owns the tests of order tracking over changing speed: known orders in a run-up are found again.
#include "sim/signal/order_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

using std::numbers::pi;

/// A run-up (or down) sampled at 1000 Hz.
struct RunUp {
  std::vector<double> time_s, angle_rad, rpm;

  RunUp(double from, double to, double seconds) {
    for (int i = 0; i <= static_cast<int>(1000 * seconds); ++i) {
      const double t = 1e-3 * i, rate = (to - from) / seconds;
      time_s.push_back(t);
      rpm.push_back(from + rate * t);
      angle_rad.push_back((from * t + 0.5 * rate * t * t) * pi / 30);
    }
  }
};

const std::vector<double>& row(const std::vector<std::vector<double>>& map, double order) {
  return map.at(static_cast<std::size_t>(std::lround(order / order_spacing)) - 1);
}

class RunUps : public testing::TestWithParam<std::pair<double, double>> {};

// Half orders on a mean that is three times the crank's speed, as of a drive shaft. The bound is that of the parabola
// which is removed, and of what it takes from order 0.5: both below 1e-3 of the largest amplitude.
TEST_P(RunUps, FindKnownOrdersAgain) {
  const RunUp run(GetParam().first, GetParam().second, 24);
  const double amplitude[] = {2, 0, 5, 30, 0.5};
  const double order[] = {0.5, 1, 1.5, 3, 9};
  std::vector<double> signal(run.time_s.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    signal[i] = 3 * run.rpm[i];
    for (int k = 0; k < 5; ++k) signal[i] += amplitude[k] * std::cos(order[k] * run.angle_rad[i] + 0.7 * k);
  }
  const auto windows = order_windows(run.time_s, run.angle_rad);
  const auto map = order_amplitudes(signal, run.angle_rad, windows, 9);
  const double revolutions = run.angle_rad.back() / (2 * pi);
  EXPECT_EQ(windows.size(), static_cast<std::size_t>(revolutions / 4) - 1);
  for (std::size_t w = 0; w < windows.size(); ++w) {
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(row(map, order[k])[w], amplitude[k], 0.03) << order[k] << " in " << w;
    for (const double absent : {2.0, 2.5, 3.5, 6.0, 8.5}) EXPECT_NEAR(row(map, absent)[w], 0, 0.03) << absent;
    const double at = GetParam().first + (GetParam().second - GetParam().first) * windows[w].time_s / 24;
    EXPECT_NEAR(windows[w].speed_rpm, at, 0.1);  // the speed is that of the nearest sample: 0.07 r/min in 1e-3 s
  }
}

INSTANTIATE_TEST_SUITE_P(UpAndDown, RunUps, testing::Values(std::pair{600.0, 2200.0}, std::pair{2200.0, 600.0}));

TEST(OrderMap, FollowsAnAmplitudeThatChangesWithSpeed) {
  const RunUp run(600, 2200, 60);
  std::vector<double> signal(run.time_s.size());
  const auto amplitude = [](double rpm) { return 10 / std::hypot(1, (rpm - 1400) / 100); };
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = amplitude(run.rpm[i]) * std::cos(3 * run.angle_rad[i]);
  const auto windows = order_windows(run.time_s, run.angle_rad);
  const auto map = order_amplitudes(signal, run.angle_rad, windows, 9);
  // The window is 9 r/min wide at 1400 r/min, a tenth of the half width of this peak: its curvature is felt by 1e-3.
  for (std::size_t w = 0; w < windows.size(); ++w)
    EXPECT_NEAR(row(map, 3)[w], amplitude(windows[w].speed_rpm), 0.02) << windows[w].speed_rpm;
}

TEST(OrderMap, LeavesOutWhatTheSamplesCannotTell) {
  const RunUp run(6000, 6000, 2);  // order 5 is at 500 Hz
  const auto windows = order_windows(run.time_s, run.angle_rad);
  ASSERT_FALSE(windows.empty());
  const auto map = order_amplitudes(run.rpm, run.angle_rad, windows, 9);
  EXPECT_TRUE(std::isfinite(row(map, 4.5)[0]));
  EXPECT_TRUE(std::isnan(row(map, 5.5)[0]));
  EXPECT_TRUE(order_windows(std::vector<double>(10), std::vector<double>(10)).empty());
}

}  // namespace
}  // namespace beltlife
