// Owns the tests of sweeps and events before and after their runs: plans, refusals, extremes, the way through a file.
#include "sim/eval/event.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <numbers>

#include "results/store/result_reader.h"
#include "sim/eval/sweep.h"
#include "sim/observe/sensors.h"
#include "tests/unit/scene_fixture.h"

namespace beltlife {
namespace {

using scene_fixture::problems_of;
using scene_fixture::small_scene;

constexpr double rad_s = std::numbers::pi / 30;
constexpr double rounding = 1e-9;

SceneSpec two_pulley() { return read_scene(BELTLIFE_SCENES "/two_pulley.toml").scene; }

SceneSpec with_event(std::vector<double> times, std::vector<double> speeds) {
  SceneSpec scene = two_pulley();
  scene.event = EventSpec{std::move(times), std::move(speeds)};
  return scene;
}

TEST(SweepPlan, SettlesRampsHoldsThenSweepsSteadily) {
  const RunPlan plan = plan_sweep(two_pulley(), {2500, 1000, 10});  // 0.2 s at rest, 0.5 s ramp, 2 - 1 s hold
  EXPECT_NEAR(plan.end_s, 11.7, rounding);
  ASSERT_EQ(plan.windows.size(), 1u);
  EXPECT_NEAR(plan.windows[0].begin_s, 1.7, rounding);
  EXPECT_FALSE(plan.windows[0].contact_forces);
  EXPECT_NEAR(plan.profile.at(1.7).mean, 2500 * rad_s, rounding);
  EXPECT_NEAR(plan.profile.at(6.7).mean, 1750 * rad_s, rounding);
  EXPECT_NEAR(plan.profile.at(11.7).mean, 1000 * rad_s, rounding);
}

TEST(SweepPlan, OfAHoldThatIsAllEvaluatedHasNoKnotTwice) {
  SceneSpec scene = two_pulley();
  scene.profile.evaluate_s = scene.profile.hold_s;
  const RunPlan plan = plan_sweep(scene, {1000, 2500, 10});
  for (std::size_t i = 1; i < plan.profile.knots().size(); ++i)
    EXPECT_GT(plan.profile.knots()[i].time, plan.profile.knots()[i - 1].time);
}

TEST(SweepPlan, TheShortestSweepChangesATenthOfTheLowestSpeedInEightRevolutions) {
  const double seconds = shortest_sweep_s(600, 2200), window_s = 8 / (600 / 60.0);
  EXPECT_NEAR(1600 / seconds * window_s, 60, rounding);
  EXPECT_EQ(shortest_sweep_s(2200, 600), seconds);
}

TEST(EventPlan, FromRestBeginsAfterSettling) {
  const RunPlan plan = plan_event(with_event({0, 1, 3}, {0, 600, 900}));
  EXPECT_NEAR(plan.windows[0].begin_s, 0.2, rounding);
  EXPECT_NEAR(plan.end_s, 3.2, rounding);
  EXPECT_NEAR(plan.profile.at(0.7).mean, 300 * rad_s, rounding);
  EXPECT_NEAR(plan.profile.at(2.2).mean, 750 * rad_s, rounding);
}

TEST(EventPlan, FromASpeedBeginsAfterRampAndHold) {
  const RunPlan plan = plan_event(with_event({0, 0.5}, {2100, 0}));  // 0.2 s at rest, 0.5 s ramp, 2 s hold
  EXPECT_NEAR(plan.windows[0].begin_s, 2.7, rounding);
  EXPECT_NEAR(plan.profile.at(2.7).mean, 2100 * rad_s, rounding);
  EXPECT_EQ(plan.profile.at(3.3).mean, 0);
}

TEST(EventInAScene, IsRefusedWithWhatIsAllowed) {
  const auto refused = [](const std::string& event, const std::string& field, const std::string& what) {
    const auto problems = problems_of(small_scene + "[event]\n" + event);
    ASSERT_EQ(problems.size(), 1u) << event;
    EXPECT_EQ(problems[0].key, field);
    EXPECT_NE(problems[0].what.find(what), std::string::npos) << problems[0].what;
    EXPECT_FALSE(problems[0].allowed.empty());
  };
  EXPECT_TRUE(problems_of(small_scene + "[event]\ntimes_s = [0, 1]\nspeeds_rpm = [0, 700]\n").empty());
  refused("times_s = [0, 1]\n", "event.speeds_rpm", "missing");
  refused("times_s = [0]\nspeeds_rpm = [0]\n", "event.times_s", "1 entries");
  refused("times_s = [0.1, 1]\nspeeds_rpm = [0, 700]\n", "event.times_s", "starts at 0.1");
  refused("times_s = [0, 1, 1]\nspeeds_rpm = [0, 700, 0]\n", "event.times_s.2", "does not exceed");
  refused("times_s = [0, 1]\nspeeds_rpm = [0, 700, 0]\n", "event.speeds_rpm", "3 entries");
  refused("times_s = [0, 1]\nspeeds_rpm = [0, -1]\n", "event.speeds_rpm.1", "-1");
}

// A record in which every channel rises from 0 at 1 s to 4 at 5 s, and the event begins at 2 s.
TEST(EventSummary, TimesCountFromItsBeginning) {
  const Model model = compile(with_event({0, 3}, {1000, 2000}));
  RunRecord run;
  run.trace.channels = channels_of(model);
  for (int i = 0; i <= 4; ++i) {
    run.trace.time_s.push_back(1 + i);
    for (Channel& c : run.trace.channels) c.values.push_back(c.name.ends_with("slip_speed_m_s") ? -i : i);
  }
  WindowRecord window;
  window.begin_s = 2;
  window.first_sample = 1;
  window.last_sample = 5;
  window.complete = true;
  const EventSummary s = summarise_event(model, run, window);
  EXPECT_EQ(s.duration_s, 3);
  EXPECT_EQ(s.spans[0].tension_n.high.value, 4);
  EXPECT_EQ(s.spans[0].tension_n.high.time_s, 3);
  EXPECT_EQ(s.spans[0].tension_n.low.time_s, 0);
  EXPECT_EQ(s.spans[0].slack_s, 3) << "6 N are 1 % of the tension at rest";
  EXPECT_EQ(s.pulleys[1].slip_m_s.value, -4) << "largest without regard to its sign";
  EXPECT_EQ(s.pulleys[1].slip_energy_j, 7.5) << "1 to 4 W over 3 s";
  EXPECT_EQ(s.pulleys[1].sliding_s, 3);
  EXPECT_EQ(s.pulleys[1].hub_load_n.value, std::hypot(4, 4));
  EXPECT_FALSE(s.arm);
}

TEST(SlipChannels, AreThoseOfScenesWithAnEvent) {
  const auto slips = [](const SceneSpec& scene) {
    int count = 0;
    for (const Channel& c : channels_of(compile(scene))) count += c.name.ends_with("slip_power_w");
    return count;
  };
  EXPECT_EQ(slips(two_pulley()), 0);
  EXPECT_EQ(slips(with_event({0, 1}, {0, 500})), 2);
}

TEST(SweepAndEvent, ComeBackFromAFileToTheSameBits) {
  const auto path = std::filesystem::temp_directory_path() / ("beltlife_sweep_" + std::to_string(getpid()) + ".h5");
  Sweep sweep;
  sweep.asked = {600, 2200, 60};
  sweep.begin_s = 3;
  sweep.end_s = 63;
  sweep.complete = true;
  sweep.window_revolutions = 8;
  sweep.time_s = {3.4, 3.8, 4.2};
  sweep.crank_rpm = {610, 621, 632};
  sweep.orders = {0.125, 0.25};
  sweep.channels = {{"shaft.speed_rpm", "r/min", {{1, 2, 3}, {4, 5, 6}}},
                    {"shaft.torque_n_m", "N m", {{7, 8, 9}, {10, 11, 12}}}};
  sweep.energy[Energy::work_driver] = 5;
  sweep.modes.crank_rpm = {600, 2200};
  sweep.modes.curves = {{"rotational 1, arm free", ArmState::free, {17, 18}, 0.1}};
  sweep.crossings = {{17.3, 1.5, 690, "rotational 1, arm free", 0.1, {}}};
  RunRecord run;
  run.trace.time_s = {0, 1, 2};
  WindowRecord event;
  event.begin_s = 1;
  event.end_s = 2;
  event.first_sample = 1;
  event.last_sample = 3;
  event.energy[Energy::lost_friction] = 2;
  Provenance from;
  write_results(path, from, {run}, nullptr, nullptr, {&sweep, &event});
  const ResultFile file = read_results(path);
  ASSERT_TRUE(file.sweep && file.event);
  EXPECT_EQ(file.sweep->asked.to_rpm, 2200);
  EXPECT_EQ(file.sweep->crank_rpm, sweep.crank_rpm);
  ASSERT_EQ(file.sweep->channels.size(), 2u);
  EXPECT_EQ(file.sweep->channels[1].unit, "N m");
  EXPECT_EQ(file.sweep->channels[1].amplitude, sweep.channels[1].amplitude);
  EXPECT_EQ(file.sweep->energy.joule, sweep.energy.joule);
  ASSERT_EQ(file.sweep->modes.curves.size(), 1u);
  EXPECT_EQ(file.sweep->modes.curves[0].frequency_hz, sweep.modes.curves[0].frequency_hz);
  ASSERT_EQ(file.sweep->crossings.size(), 1u);
  EXPECT_EQ(file.sweep->crossings[0].crank_rpm, 690);
  EXPECT_EQ(file.event->last_sample, 3u);
  EXPECT_EQ(file.event->energy.joule, event.energy.joule);

  event.last_sample = 4;  // beyond the trace
  write_results(path, from, {run}, nullptr, nullptr, {nullptr, &event});
  EXPECT_THROW(read_results(path), BadInput);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace beltlife
