// Owns the tests of octave bands: known remainders, what no sampling can know, and their place among the quantities.
#include "sim/signal/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/eval/quantities.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using std::numbers::pi;

constexpr double crank_hz = 23.7;

std::vector<double> angles(std::size_t samples, double rate) {
  std::vector<double> angle;
  for (std::size_t i = 0; i < samples; ++i) angle.push_back(2 * pi * crank_hz * static_cast<double>(i) / rate + 0.3);
  return angle;
}

void add_sine(std::vector<double>& signal, double rate, double hz, double amplitude) {
  for (std::size_t i = 0; i < signal.size(); ++i)
    signal[i] += amplitude * std::cos(2 * pi * hz * static_cast<double>(i) / rate + 0.7);
}

std::vector<double> bands_of(const std::vector<double>& signal, double rate) {
  const auto angle = angles(signal.size(), rate);
  return remainder_bands(signal, angle, track_orders(signal, angle, default_orders()), rate);
}

TEST(Bands, HoldTheSinesBetweenTheirEdgesAndNoOrders) {
  std::vector<double> signal(1000, 4800.0);
  for (const double order : default_orders()) add_sine(signal, 1000, order * crank_hz, 10);
  const std::vector<double> orders_alone = bands_of(signal, 1000);
  for (const double amplitude : orders_alone) EXPECT_LT(amplitude, 1e-8);  // rounding of 4800 in the least squares
  add_sine(signal, 1000, 29, 0.5);
  add_sine(signal, 1000, 208, 0.3);
  add_sine(signal, 1000, 220, 0.4);
  const std::vector<double> bands = bands_of(signal, 1000);
  // The least squares of 37 columns over 1 s take a little of every sine: 1 - (sinc of 5.3 Hz x 1 s)^2 or so, 1 %.
  EXPECT_NEAR(bands[1], 0.5, 0.02);
  EXPECT_NEAR(bands[4], 0.5, 0.02);  // 0.3 and 0.4 add in squares
  EXPECT_LT(bands[2], 0.02);         // and give it to orders in other bands
}

TEST(Bands, OfWhiteNoiseGrowAsTheRootOfTheirWidth) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, 2);
  const double rate = 1000;
  std::vector<double> squares(octave_bands.size(), 0.0);
  constexpr int repeats = 30;
  for (int r = 0; r < repeats; ++r) {
    std::vector<double> signal(2000);
    for (double& x : signal) x = normal(random);
    const auto bands = bands_of(signal, rate);
    for (std::size_t b = 0; b < bands.size(); ++b) squares[b] += bands[b] * bands[b] / repeats;
  }
  for (std::size_t b = 0; b < octave_bands.size(); ++b) {
    const auto [low, high] = octave_bands[b];
    double width = high - low;
    for (const double order : default_orders())  // each takes a bin's width of the noise
      if (order * crank_hz >= low && order * crank_hz < high) width -= 0.5;
    // 10 Hz x 2 s x 30 repeats: 600 independent squares, 4 % scatter and as much for what Hann correlates.
    EXPECT_NEAR(squares[b] / (4 * 2 * 2 * width / rate), 1, 0.15) << b;
  }
}

TEST(Bands, AreUnknownWhereTheSamplingCannotKnowThem) {
  std::vector<double> signal(1000, 1.0);
  add_sine(signal, 600, 50, 1);
  const auto slow = bands_of(signal, 600);
  EXPECT_TRUE(std::isnan(slow[4])) << "320 Hz is above 300";
  EXPECT_FALSE(std::isnan(slow[3]));
  EXPECT_FALSE(std::isnan(bands_of(std::vector<double>(640, 1.0), 640)[4])) << "the edge may be Nyquist itself";
  signal.resize(200);
  const auto brief = bands_of(signal, 1000);
  EXPECT_TRUE(std::isnan(brief[0])) << "10 Hz are two bins of 5 Hz";
  EXPECT_FALSE(std::isnan(brief[1])) << "20 Hz are four";
  signal.resize(50);
  for (const double b : bands_of(signal, 1000)) EXPECT_TRUE(std::isnan(b)) << "too short for orders";
}

TEST(Bands, AreQuantitiesOfTheSceneWithTheUnitOfTheirChannel) {
  const auto names = quantity_names(compile(read_scene(BELTLIFE_SCENES "/two_pulley.toml").scene));
  for (const char* edges : {"10_20", "20_40", "40_80", "80_160", "160_320"})
    for (const auto& [channel, unit] : {std::pair{"speed_rpm", "r/min"}, {"torque_n_m", "N m"}}) {
      const std::string name = std::string("slow.driven.") + channel + ".band_" + edges + "_hz";
      EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
      EXPECT_EQ(unit_of_name(name), unit);
    }
}

}  // namespace
}  // namespace beltlife
