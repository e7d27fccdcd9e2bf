// Owns the tests of amplitude spectra and order tracking.
#include "sim/signal/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace beltlife {
namespace {

using std::numbers::pi;

std::vector<double> cosine(std::size_t samples, double cycles, double amplitude, double phase = 0, double mean = 0) {
  std::vector<double> signal;
  for (std::size_t k = 0; k < samples; ++k)
    signal.push_back(mean + amplitude * std::cos(2 * pi * cycles * static_cast<double>(k) / samples + phase));
  return signal;
}

TEST(Spectrum, ASineOnABinGivesItsAmplitudeThere) {
  const Spectrum spectrum = amplitude_spectrum(cosine(1000, 75, 3.5, 0.4, 100), 1000);
  ASSERT_EQ(spectrum.frequency_hz.size(), 501u);
  EXPECT_EQ(spectrum.frequency_hz[75], 75);
  EXPECT_EQ(spectrum.frequency_hz.back(), 500);
  EXPECT_NEAR(spectrum.amplitude[75], 3.5, 1e-12);   // rounding
  EXPECT_NEAR(spectrum.amplitude[74], 1.75, 1e-12);  // Hann: half of it on either neighbour
  EXPECT_NEAR(spectrum.amplitude[73], 0, 1e-12);     // and nothing beyond
  EXPECT_NEAR(spectrum.amplitude[0], 0, 1e-11);      // the mean of 100 is gone
}

TEST(Spectrum, BetweenBinsAtMost15PercentAreLost) {
  // Hann's worst case is half a bin: 8 / (3 pi) = 0.8488 of the amplitude; the mirror image adds less than 1e-4.
  for (const double offset : {0.1, 0.25, 0.5, 0.75, 0.9}) {
    const Spectrum spectrum = amplitude_spectrum(cosine(1000, 75 + offset, 1), 1000);
    const double peak = std::max(spectrum.amplitude[75], spectrum.amplitude[76]);
    EXPECT_GT(peak, 8 / (3 * pi) - 1e-4) << offset;
    EXPECT_LT(peak, 1 + 1e-4) << offset;
  }
}

TEST(Spectrum, AgreesWithTheDefinitionForAnyLength) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise;
  for (const std::size_t n : {2, 3, 16, 105, 106, 499, 1001, 1021}) {  // 106, 499, 1021 take the chirp
    std::vector<double> signal(n);
    for (double& value : signal) value = noise(generator);
    const Spectrum spectrum = amplitude_spectrum(signal, 1);
    ASSERT_EQ(spectrum.amplitude.size(), n / 2 + 1);
    double mean = 0;
    for (const double value : signal) mean += value / static_cast<double>(n);
    for (std::size_t bin = 0; bin <= n / 2; ++bin) {
      std::complex<double> sum;
      for (std::size_t k = 0; k < n; ++k) {
        const double turn = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
        sum += (signal[k] - mean) * (0.5 - 0.5 * std::cos(turn)) * std::polar(1.0, -turn * static_cast<double>(bin));
      }
      const double sides = bin == 0 || 2 * bin == n ? 1 : 2;
      // the plain sum itself rounds to about n times 1e-16 of its phases
      EXPECT_NEAR(spectrum.amplitude[bin], sides * std::abs(sum) / (0.5 * static_cast<double>(n)), 1e-11) << n;
    }
  }
}

TEST(Spectrum, OfNothingIsEmpty) {
  EXPECT_TRUE(amplitude_spectrum({}, 1000).amplitude.empty());
  EXPECT_TRUE(amplitude_spectrum(std::vector{1.0}, 1000).frequency_hz.empty());
}

/// 1500 r/min sampled at 1000 Hz, `revolutions` long (not whole in most tests).
std::vector<double> angle(double revolutions) {
  std::vector<double> result;
  for (int k = 0; k < static_cast<int>(revolutions * 40); ++k) result.push_back(0.3 + 2 * pi * k / 40.0);
  return result;
}

TEST(Orders, AreRecoveredFromAWindowWithoutWholeRevolutions) {
  const auto at = angle(7.325);
  std::vector<double> signal;
  for (const double a : at)
    signal.push_back(1500 + 20.1 * std::cos(3 * a + 0.7) + 3.5 * std::cos(6 * a - 2.5) + 0.5 * std::cos(0.5 * a + 3));
  const auto orders = track_orders(signal, at, default_orders());
  ASSERT_EQ(orders.size(), 18u);
  for (const auto& [order, amplitude, phase] : orders) {
    const double expected = order == 3 ? 20.1 : order == 6 ? 3.5 : order == 0.5 ? 0.5 : 0;
    // rounding of the mean, 1500 x 1e-16, times a condition number below 100
    EXPECT_NEAR(amplitude, expected, 1e-10) << order;
    if (expected == 0) continue;  // no amplitude, no phase
    EXPECT_NEAR(phase, order == 3 ? 0.7 : order == 6 ? -2.5 : 3, 1e-10) << order;
  }
}

TEST(Orders, NeedTwoRevolutions) {
  const auto one_short = angle(1.9), two = angle(2);
  EXPECT_TRUE(track_orders(std::vector<double>(one_short.size()), one_short, default_orders()).empty());
  EXPECT_EQ(track_orders(std::vector<double>(two.size()), two, default_orders()).size(), 18u);
  EXPECT_TRUE(track_orders({}, {}, default_orders()).empty());
  const std::vector<double> standing(1000, 0.5);
  EXPECT_TRUE(track_orders(standing, standing, default_orders()).empty());
}

TEST(Orders, AboveNyquistAreLeftOut) {
  // 40 samples a revolution: order 20 is the Nyquist order and cannot be told from its sine
  const auto at = angle(5.5);
  const auto orders = track_orders(cosine(at.size(), 5.5, 1), at, std::vector{1.0, 19.5, 20.0, 25.0});
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_EQ(orders.back().order, 19.5);
}

TEST(Orders, ThatCannotBeToldApartGiveNothing) {
  const auto at = angle(4);
  const std::vector<double> signal(at.size(), 1);
  EXPECT_TRUE(track_orders(signal, at, std::vector{3.0, 3.0}).empty());
  EXPECT_TRUE(track_orders(signal, at, std::vector{0.0, 3.0}).empty());  // order 0 is the mean
  const std::vector<double> few{0, 2, 4, 6, 8, 10, 12, 14};              // 8 samples, 9 unknowns
  EXPECT_TRUE(track_orders(few, few, std::vector{0.5, 0.7, 0.9, 1.1}).empty());
}

}  // namespace
}  // namespace beltlife
