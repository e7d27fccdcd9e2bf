// Owns the claims about the measurement of noise: planted noise found, planted responses told apart, none invented.
#include "studies/noise/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/eval/difference_noise.h"

namespace beltlife {
namespace {

using Values = std::vector<double>;

/// A normal number by Box and Muller: the standard library's differs from one implementation to the next.
double normal(std::mt19937_64& random) {
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) / 9007199254740992.0; };
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(6.283185307179586 * uniform());
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) / 9007199254740992.0; }

/// Of 100 samples of a cubic at steps `step` with noise, how many estimates are within this factor.
int found_within(double factor, double planted, double step, int points) {
  int found = 0;
  for (unsigned sample = 0; sample < 100; ++sample) {
    std::mt19937_64 random(sample);
    Values v;
    for (int i = 0; i < points; ++i) {
      const double x = step * (i - (points - 1) / 2.0);
      v.push_back(3 + 2 * x - 0.7 * x * x + 0.3 * x * x * x + planted * normal(random));
    }
    const double noise = difference_noise(v).noise;
    found += noise > planted / factor && noise < planted * factor;
  }
  return found;
}

// Neighbours differ by 2e-5: more than the noise at one end, next to nothing at the other. Of 25 values more than 20
// differences of each order remain, so that an estimate scatters by a fifth or less.
TEST(Noise, IsFoundBesideASmoothPartWithinAFactorOfTwo) {
  for (const double planted : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const int found = found_within(2, planted, 1e-5, 25);
    std::printf("    %g: %d of 100 within a factor of two\n", planted, found);
    EXPECT_GE(found, 95) << planted;
  }
}

// The factor is that of the agreement between orders. A step of 0.02 makes the first three orders smooth part at the
// smallest noise, and somewhere on the way up a smooth part of twice the noise is taken for noise.
TEST(Noise, IsFoundBesideACurveWithinAFactorOfFourAtAnyLevel) {
  for (double planted = 1e-8; planted < 2e-2; planted *= 2)
    EXPECT_GE(found_within(4, planted, 0.02, 15), 95) << planted;
}

TEST(Noise, OfUniformScatterIsItsStandardDeviation) {
  std::mt19937_64 random(1);
  Values v;
  for (int i = 0; i < 100; ++i) v.push_back(uniform(random));
  const DifferenceNoise d = difference_noise(v);
  EXPECT_EQ(d.order, 1);
  EXPECT_NEAR(d.noise * std::sqrt(12), 1, 0.2);  // 100 draws: 7 %
}

TEST(Noise, OfAConstantIsExactlyNone) {
  for (const double value : {0.0, 1.0, -1e300, 0.1}) {
    const DifferenceNoise d = difference_noise(Values(9, value));
    EXPECT_EQ(d.noise, 0) << value;
    EXPECT_EQ(spread_of(Values(9, value)).standard_deviation * 0, 0) << value;
  }
}

TEST(Noise, OfASmoothFunctionIsNotMoreThanRoundingLeaves) {
  Values v;
  for (int i = 0; i < 9; ++i) v.push_back(1 + 0.1 * i + 0.01 * i * i);
  // Third differences of a parabola are rounding alone: a few units in the last place of 2.4, at most 4e-16 each.
  EXPECT_LT(difference_noise(v).noise, 1e-15);
}

// Whatever is measured in newtons is the same in kilonewtons.
TEST(Noise, ScalesWithTheValues) {
  std::mt19937_64 random(3);
  Values v, scaled;
  for (int i = 0; i < 9; ++i) v.push_back(i + 0.01 * normal(random));
  for (const double x : v) scaled.push_back(1024 * x);  // a power of two: exact
  const DifferenceNoise a = difference_noise(v), b = difference_noise(scaled);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(1024 * a.noise, b.noise);
  EXPECT_EQ(responses_of(v, 0).size(), responses_of(scaled, 0).size());
}

Values clusters(const std::vector<double>& means, int each, double scatter, unsigned seed) {
  std::mt19937_64 random(seed);
  Values v;
  for (int i = 0; i < each; ++i)  // mixed, as replicates come
    for (const double mean : means) v.push_back(mean + scatter * normal(random));
  return v;
}

// A planted one may itself be split by chance, 1 in 600 of twelve normal values.
TEST(Responses, ThatArePlantedAreToldApart) {
  int missed = 0;
  for (unsigned seed = 0; seed < 50; ++seed)
    for (const std::vector<double>& means : {std::vector<double>{100, 110}, {100, 110, 120}, {100, 110, 130}}) {
      const Values v = clusters(means, 12, 0.5, 1000 * seed + static_cast<unsigned>(means.back()));
      const auto found = responses_of(v);
      if (found.size() != means.size()) {
        ++missed;
        continue;
      }
      std::vector<bool> seen(v.size(), false);
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k].mean, means[k], 1) << "a mean of 12 scatters by 0.14";
        ASSERT_EQ(found[k].members.size(), 12u) << seed;
        for (const std::size_t i : found[k].members) {
          EXPECT_EQ(i % means.size(), k);
          EXPECT_FALSE(seen[i]);
          seen[i] = true;
        }
      }
    }
  EXPECT_LE(missed, 2) << "of 150";
}

TEST(Responses, OfScatterAloneAreOne) {
  for (const int size : {4, 8, 24}) {
    int split = 0;
    for (unsigned seed = 0; seed < 200; ++seed) split += responses_of(clusters({100}, size, 5, seed)).size() > 1;
    std::printf("    %d values: %d of 200 split\n", size, split);
    EXPECT_LE(split, 2) << size;
  }
}

// Neighbours of a ramp lie apart by the same gap: none stands out.
TEST(Responses, OfARampAreOne) {
  for (const int size : {4, 5, 6, 8, 24}) {
    Values ramp;
    for (int i = 0; i < size; ++i) ramp.push_back(10 + i);
    EXPECT_EQ(responses_of(ramp).size(), 1u) << size;
  }
}

TEST(Responses, CloserThanTheResolutionAreOne) {
  EXPECT_EQ(responses_of({100, 100.0001, 100.2, 100.2001}).size(), 1u) << "2 in 1000";
  EXPECT_EQ(responses_of({100, 100.0001, 100.2, 100.2001}, 1e-3).size(), 2u);
  EXPECT_EQ(responses_of({0, 0, 0, 0}).size(), 1u);
}

TEST(Responses, NeedTwoValuesOnEitherSide) {
  EXPECT_EQ(responses_of({1, 1.001, 1.002, 50}).size(), 1u) << "one that ran astray is no response";
  EXPECT_EQ(responses_of({1, 1.001, 50, 50.001}).size(), 2u);
  EXPECT_EQ(responses_of({1, 50, 50.001}).size(), 1u);
  EXPECT_EQ(responses_of({7}).size(), 1u);
  EXPECT_TRUE(responses_of({}).empty());
}

TEST(Spread, IsThatOfTheTextbook) {
  const Spread s = spread_of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.standard_deviation, std::sqrt(32.0 / 7));
  EXPECT_EQ(s.low, 2);
  EXPECT_EQ(s.high, 9);
  EXPECT_EQ(spread_of({3}).standard_deviation, 0);
  EXPECT_EQ(spread_of({}).mean, 0);
}

}  // namespace
}  // namespace beltlife
