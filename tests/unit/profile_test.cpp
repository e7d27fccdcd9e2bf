// Owns the tests of the given speed over time: tables, mean speed by straight pieces, harmonics over the angle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/scene/scene_io.h"
#include "sim/speed_profile.h"

namespace beltlife {
namespace {

constexpr double rad_s = std::numbers::pi / 30;
constexpr double rounding = 1e-12;

TEST(SpeedTable, IsLinearBetweenEntriesAndExactAtThem) {
  const Table1 t{{10, 20, 40}, {1, 3, -1}};
  EXPECT_EQ(t(10), 1);
  EXPECT_EQ(t(20), 3);
  EXPECT_EQ(t(40), -1);
  EXPECT_NEAR(t(15), 2, rounding);
  EXPECT_NEAR(t(30), 1, rounding);
}

TEST(SpeedTable, IsHeldAboveItsLastEntry) {
  const Table1 t{{10, 20}, {1, 3}};
  EXPECT_EQ(t(20.001), 3);
  EXPECT_EQ(t(1e9), 3);
}

TEST(SpeedTable, IsProportionalBelowItsFirstEntryAndZeroFromStandstillDown) {
  const Table1 t{{10, 20}, {1, 3}};
  EXPECT_NEAR(t(5), 0.5, rounding);
  EXPECT_EQ(t(0), 0);
  EXPECT_EQ(t(-7), 0);
}

TEST(SpeedTable, ThatBeginsAtStandstillIsZeroThereEvenIfItsFirstEntryIsNot) {
  const Table1 t{{0, 10}, {4, 6}};
  EXPECT_EQ(t(0), 0);
  EXPECT_NEAR(t(5), 5, rounding);
}

SpeedProfile up_and_down(std::vector<Harmonic> harmonics = {}, double phase = 0) {
  return SpeedProfile({0, 0.3, 1.0, 2.0, 2.5}, {0, 0, 100, 100, 40}, std::move(harmonics), phase);
}

TEST(Profile, AngleIsTheIntegralOfTheMeanSpeed) {
  const SpeedProfile p = up_and_down();
  double angle = 0;
  constexpr double dt = 1e-3;  // midpoints: exact on straight pieces, and all knots are multiples of dt
  for (int i = 0; i < 3000; ++i) {
    angle += dt * p.at((i + 0.5) * dt).mean;
    EXPECT_NEAR(p.at((i + 1) * dt).angle, angle, 1e-9) << (i + 1) * dt;  // 3000 roundings of 200 rad
  }
}

TEST(Profile, HoldsTheFirstSpeedBeforeAndTheLastAfterItsKnots) {
  const SpeedProfile p({1, 2}, {10, 30});
  EXPECT_EQ(p.speed(0), 10);
  EXPECT_EQ(p.speed(5), 30);
  EXPECT_NEAR(p.at(5).angle - p.at(4).angle, 30, rounding * 100);
  EXPECT_NEAR(p.at(0).angle, -10, rounding * 100);
}

TEST(Profile, WithoutKnotsIsRest) {
  const SpeedProfile p;
  EXPECT_EQ(p.speed(3), 0);
  EXPECT_EQ(p.at(3).acceleration, 0);
}

TEST(Profile, AddsEachHarmonicOverTheAngleWithItsPhase) {
  const Harmonic third{3, 0.4, {{50, 150}, {2, 4}}}, half{0.5, 1.0, {{50, 150}, {1, 1}}};
  const double phase = 0.25;
  const SpeedProfile p = up_and_down({third, half}, phase);
  for (double t = 1.05; t < 2; t += 0.0371) {
    const auto v = p.at(t);
    const double expected = 100 + 3 * std::cos(3 * (v.angle + phase) + 0.4) + std::cos(0.5 * (v.angle + phase) + 1.0);
    EXPECT_NEAR(v.speed, expected, 1e-11) << t;  // rounding at 100 rad/s and 600 rad
  }
}

TEST(Profile, RippleVanishesAtRest) {
  const SpeedProfile p = up_and_down({{3, 0.4, {{50, 150}, {2, 4}}}});
  EXPECT_EQ(p.speed(0.1), 0);
  EXPECT_EQ(p.at(0.1).acceleration, 0);
}

TEST(Profile, AccelerationIsTheSpeedsDerivativeWhileTheMeanIsHeld) {
  const SpeedProfile p = up_and_down({{3, 0.4, {{50, 150}, {2, 4}}}});
  constexpr double d = 1e-6;
  for (double t = 1.05; t < 1.95; t += 0.0371)
    // Central difference: truncation 3 (300 rad/s)^3 d^2/6 = 1e-5, rounding 1e-14 x 100 / d = 1e-8.
    EXPECT_NEAR(p.at(t).acceleration, (p.speed(t + d) - p.speed(t - d)) / (2 * d), 1e-4) << t;
}

TEST(Profile, AccelerationOfARampIsItsSlope) {
  EXPECT_NEAR(up_and_down().at(0.5).acceleration, 100 / 0.7, 1e-9);
  EXPECT_NEAR(up_and_down().at(2.2).acceleration, -60 / 0.5, 1e-9);
}

TEST(DriverHarmonics, ComeInRadiansPerSecondAndScaled) {
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml", {"driver.ripple_scale=2"}).scene;
  const auto harmonics = harmonics_of(*scene.driver);
  ASSERT_EQ(harmonics.size(), scene.driver->harmonic.size());
  EXPECT_EQ(harmonics[0].order, 3);
  EXPECT_NEAR(harmonics[0].amplitude(1500 * rad_s), 2 * 20.1 * rad_s, rounding * 10);
  EXPECT_NEAR(harmonics[0].amplitude(1375 * rad_s), 2 * 0.5 * (26.6 + 20.1) * rad_s, rounding * 10);
  EXPECT_NEAR(harmonics[0].amplitude(350 * rad_s), 10.4 * rad_s, rounding * 10);  // half the speed, half the ripple
}

}  // namespace
}  // namespace beltlife
