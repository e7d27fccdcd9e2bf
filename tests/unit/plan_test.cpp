// Owns the tests of run plans: when each range is held, and which stretch of it is evaluated.
#include "sim/plan.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

constexpr double rad_s = std::numbers::pi / 30;
constexpr double rounding = 1e-12;  // times and speeds are sums of a few decimals

SceneSpec baseline() { return read_scene(BELTLIFE_SCENES "/baseline.toml").scene; }

TEST(WholeProfile, OfTheBaselineLastsTwentySeconds) { EXPECT_NEAR(plan_profile(baseline()).end_s, 20.0, rounding); }

TEST(WholeProfile, EvaluatesTheLastSecondOfEveryHold) {
  const SceneSpec scene = baseline();
  const RunPlan plan = plan_profile(scene);
  ASSERT_EQ(plan.windows.size(), scene.range.size());
  for (std::size_t i = 0; i < plan.windows.size(); ++i) {
    const double hold_end = 0.3 + 0.7 + 3.0 * static_cast<double>(i + 1) + 0.2 * static_cast<double>(i);
    EXPECT_EQ(plan.windows[i].range, scene.range[i].name);
    EXPECT_EQ(plan.windows[i].crank_rpm, scene.range[i].crank_rpm);
    EXPECT_EQ(plan.windows[i].duty_share, scene.range[i].duty_share);
    EXPECT_NEAR(plan.windows[i].begin_s, hold_end - 1, rounding);
    EXPECT_NEAR(plan.windows[i].end_s, hold_end, rounding);
  }
}

TEST(WholeProfile, HoldsTheMeanSpeedThroughEveryHold) {
  const SceneSpec scene = baseline();
  const RunPlan plan = plan_profile(scene);
  for (const Window& w : plan.windows)
    for (const double time : {w.end_s - 2.999, w.begin_s, w.end_s - 0.001})
      EXPECT_NEAR(plan.profile.at(time).mean, w.crank_rpm * rad_s, rounding * 1e3) << w.range << " at " << time;
}

TEST(WholeProfile, RestsThenRampsThenGoesFromRangeToRangeByStraightLines) {
  const RunPlan plan = plan_profile(baseline());
  EXPECT_EQ(plan.profile.at(0.0).speed, 0);
  EXPECT_EQ(plan.profile.at(0.299).speed, 0);
  EXPECT_NEAR(plan.profile.at(0.65).mean, 0.5 * 700 * rad_s, rounding * 1e3);
  EXPECT_NEAR(plan.profile.at(4.1).mean, 0.5 * (700 + 1250) * rad_s, rounding * 1e3);
}

TEST(SingleRange, SettlesRampsHoldsAndEvaluatesTheEnd) {
  const SceneSpec scene = baseline();
  const RunPlan plan = plan_range(scene, scene.range[2]);
  EXPECT_EQ(plan.name, "B100");
  EXPECT_NEAR(plan.end_s, 4.0, rounding);
  ASSERT_EQ(plan.windows.size(), 1u);
  EXPECT_NEAR(plan.windows[0].begin_s, 3.0, rounding);
  EXPECT_NEAR(plan.windows[0].end_s, 4.0, rounding);
  EXPECT_EQ(plan.windows[0].duty_share, 0.8);
  EXPECT_EQ(plan.profile.at(0.2).mean, 0);
  EXPECT_NEAR(plan.profile.at(0.65).mean, 750 * rad_s, rounding * 1e3);
  EXPECT_NEAR(plan.profile.at(2.5).mean, 1500 * rad_s, rounding * 1e3);
}

TEST(SingleRange, CarriesTheRippleOfItsOwnSpeed) {
  SceneSpec scene = baseline();
  double largest = 0;
  const RunPlan plan = plan_range(scene, scene.range[2]);
  for (int i = 0; i < 4000; ++i) {
    const auto v = plan.profile.at(3 + i * 1e-4);
    largest = std::max(largest, v.speed - v.mean);
  }
  EXPECT_GT(largest, 20.1 * rad_s);  // order 3 alone, at some time the others add to it
  EXPECT_LT(largest, 26.1 * rad_s);  // the sum of all amplitudes at 1500 r/min
}

TEST(MeasuredSpeed, ReplacesMeanSpeedAndRippleOfTheWholeProfile) {
  const MeasuredSpeed measured{{0, 10, 20}, {0, 1000, 500}};
  const RunPlan plan = plan_profile(baseline(), &measured);
  EXPECT_NEAR(plan.end_s, 20.0, rounding);
  EXPECT_EQ(plan.windows.size(), 6u);
  EXPECT_NEAR(plan.profile.at(5).speed, 500 * rad_s, rounding * 1e3);
  EXPECT_NEAR(plan.profile.at(15).speed, 750 * rad_s, rounding * 1e3);
}

TEST(MeasuredSpeed, OfASingleRangeIsTheStretchInWhichTheWholeProfileHoldsIt) {
  const SceneSpec scene = baseline();
  MeasuredSpeed measured;
  for (int i = 0; i <= 2000; ++i) {
    measured.time_s.push_back(0.01 * i);
    measured.speed_rpm.push_back(1000 + i % 7);  // no two neighbours alike
  }
  const RunPlan alone = plan_range(scene, scene.range[1], &measured);
  const RunPlan whole = plan_profile(scene, &measured);
  const double shift = 4.2 - 1.0;  // the second hold begins at 4.2 s of the profile and at 1 s of its own run
  for (double t = 1.0; t < 3.999; t += 0.0137)
    // Both interpolate the same samples; their times differ by rounding, 4e-15 s at slopes of 63 rad/s in 0.01 s.
    EXPECT_NEAR(alone.profile.at(t).speed, whole.profile.at(t + shift).speed, 1e-9) << t;
  EXPECT_NEAR(alone.end_s, 4.0, rounding);
}

TEST(SceneWithoutRanges, SettlesAndHoldsAtRest) {
  const SceneSpec scene = read_scene(BELTLIFE_SCENES "/spinning_ring.toml").scene;
  const RunPlan plan = plan_rest(scene);
  ASSERT_EQ(plan.windows.size(), 1u);
  EXPECT_NEAR(plan.end_s, scene.profile.settle_s + scene.profile.hold_s, rounding);
  EXPECT_NEAR(plan.windows[0].end_s - plan.windows[0].begin_s, scene.profile.evaluate_s, rounding);
  EXPECT_EQ(plan.profile.speed(1.0), 0);
}

TEST(MeasuredSpeed, CountsInTheWindowsInsteadOfTheSpeedThatTheRangeIsStatedAt) {
  const SceneSpec scene = baseline();
  const MeasuredSpeed measured{{0, 1, 30}, {0, 900, 900}};
  for (const RunPlan& plan : {plan_profile(scene, &measured), plan_range(scene, scene.range[2], &measured)})
    for (const Window& window : plan.windows) EXPECT_NEAR(window.crank_rpm, 900, 1e-9) << window.range;
}

}  // namespace
}  // namespace beltlife
