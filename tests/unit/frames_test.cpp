// Frames of the moving drive: when they are taken, what they show, that nothing else changes, and their way to a file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "results/store/frames_group.h"
#include "results/store/result_reader.h"
#include "sim/eval/run_ranges.h"
#include "sim/lanes/run_pack.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using Settings = std::vector<std::string>;

/// Observed at least so often, s, by every scheme.
constexpr double observation_s = 1e-4;

SceneSpec scene_of(const Settings& more = {}) {
  Settings settings{"belt.elements=64", "profile.settle_s=0.01", "profile.ramp_s=0.05", "profile.hold_s=0.13",
                    "profile.evaluate_s=0.1"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(BELTLIFE_SCENES "/two_pulley.toml", settings).scene;
}

RunRecord record_of(const SceneSpec& scene, int frames, std::size_t range = 1) {
  RunOptions options;
  options.frames = frames;
  return run(compile(scene), plan_range(scene, scene.range.at(range)), options).record;
}

bool same(const Frames& a, const Frames& b) {
  return a.time_s == b.time_s && a.x_m == b.x_m && a.y_m == b.y_m && a.tension_n == b.tension_n &&
         a.pulley_angle_rad == b.pulley_angle_rad && a.pulley_x_m == b.pulley_x_m && a.pulley_y_m == b.pulley_y_m;
}

class FramesOf : public testing::TestWithParam<const char*> {
 protected:
  static SceneSpec scene() { return scene_of({std::string("solver.scheme=") + GetParam()}); }
};

TEST_P(FramesOf, AWindowCoverItsLastTwoRevolutionsAtEqualTimes) {
  const RunRecord record = record_of(scene(), 33);
  const WindowRecord& w = record.windows.at(0);
  const Frames& f = w.frames;
  ASSERT_EQ(f.time_s.size(), 33u);
  EXPECT_EQ(f.nodes(), 64u);
  EXPECT_EQ(f.pulleys(), 2u);
  const double covered = 2 * 60 / w.crank_rpm;
  for (std::size_t k = 0; k < 33; ++k) {
    const double due = w.end_s - covered * static_cast<double>(32 - k) / 32;
    EXPECT_GE(f.time_s[k], due - record.step_s) << k;
    EXPECT_LE(f.time_s[k], due + observation_s + record.step_s) << k;
  }
  // The scene runs clockwise. A ripple of 8 r/min at order 2 over 1e-4 s is 1e-4 rad.
  const double late = f.time_s[0] - (w.end_s - covered), speed = w.crank_rpm * std::numbers::pi / 30;
  EXPECT_NEAR(f.pulley_angle_rad[32 * 2] - f.pulley_angle_rad[0], -4 * std::numbers::pi + speed * late, 1e-3);
}

TEST_P(FramesOf, AWindowEndWithTheLoopAtItsEnd) {
  const WindowRecord w = record_of(scene(), 5).windows.at(0);
  const Frames& f = w.frames;
  ASSERT_EQ(f.time_s.size(), 5u);
  EXPECT_NEAR(f.time_s.back(), w.end_s, 1e-12);  // sums of steps
  const double half = 0.5 + 1e-9;                // of what frames are rounded to
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(f.x_m[4 * 64 + i], w.loop.x_m[i], half * Frames::position_step);
    EXPECT_NEAR(f.y_m[4 * 64 + i], w.loop.y_m[i], half * Frames::position_step);
    EXPECT_NEAR(f.tension_n[4 * 64 + i], w.loop.tension_n[i], half * Frames::tension_step);
  }
  EXPECT_GT(std::abs(f.x_m[0] - f.x_m[4 * 64]), 1e-3) << "the belt moves";
}

TEST_P(FramesOf, AWindowChangeNothingElse) {
  const RunRecord with = record_of(scene(), 40), without = record_of(scene(), 0);
  EXPECT_EQ(with.steps, without.steps);
  for (std::size_t c = 0; c < with.trace.channels.size(); ++c)
    EXPECT_EQ(with.trace.channels[c].values, without.trace.channels[c].values) << with.trace.channels[c].name;
  const WindowRecord &a = with.windows.at(0), &b = without.windows.at(0);
  EXPECT_EQ(a.energy.joule, b.energy.joule);
  for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(a.passes[p].normal_resolved, b.passes[p].normal_resolved);
  EXPECT_EQ(a.element.normal_n, b.element.normal_n);
  EXPECT_EQ(a.loop.x_m, b.loop.x_m);
  EXPECT_EQ(a.frames.time_s.size(), 40u);
  EXPECT_EQ(b.frames.time_s.capacity() + b.frames.x_m.capacity() + b.frames.pulley_x_m.capacity(), 0u);
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, FramesOf, testing::Values("linearly_implicit", "symplectic_euler"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Frames, OfAWindowShorterThanTwoRevolutionsCoverAllOfIt) {
  const WindowRecord w = record_of(scene_of({"profile.evaluate_s=0.05"}), 21, 0).windows.at(0);  // 0.12 s a cycle
  ASSERT_EQ(w.frames.time_s.size(), 21u);
  EXPECT_NEAR(w.frames.time_s.front(), w.begin_s, observation_s + 1e-5);
}

TEST(Frames, AreNoMoreThanObservations) {
  const WindowRecord w = record_of(scene_of({"profile.evaluate_s=0.01"}), 500).windows.at(0);
  EXPECT_LE(w.frames.time_s.size(), 101u);
  EXPECT_GT(w.frames.time_s.size(), 95u);
  for (std::size_t k = 1; k < w.frames.time_s.size(); ++k) EXPECT_GT(w.frames.time_s[k], w.frames.time_s[k - 1]);
}

TEST(Frames, AreTheSameOnOneThreadAndTwoAndOfEveryWindowOfAProfile) {
  const SceneSpec scene = scene_of({"profile.transition_s=0.05"});
  const Model model = compile(scene);
  const auto plans = plans_of(scene, {}, nullptr);
  const auto one = run_plans(model, plans, 1, {}, false, 9), two = run_plans(model, plans, 2, {}, false, 9);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(one[i].record.windows.at(0).frames.time_s.size(), 9u);
    EXPECT_TRUE(same(one[i].record.windows.at(0).frames, two[i].record.windows.at(0).frames)) << i;
  }
  RunOptions options;
  options.frames = 9;
  const RunRecord whole = run(model, plan_profile(scene), options).record;
  ASSERT_EQ(whole.windows.size(), 2u);
  for (const WindowRecord& w : whole.windows) EXPECT_EQ(w.frames.time_s.size(), 9u) << w.range;
}

TEST(Frames, OfADriveDoNotDependOnItsPack) {
  const SceneSpec first = scene_of(), second = scene_of({"belt.axial_damping_n_s=20"});
  const Model a = compile(first), b = compile(second);
  const RunPlan plan = plan_range(first, first.range[1]);
  RunOptions options;
  options.frames = 7;
  const auto pack = run_pack({{&b, &plan}, {&a, &plan}}, LaneUse::drives, options);
  const auto alone = run_pack({{&a, &plan}}, LaneUse::drives, options);
  EXPECT_TRUE(same(pack[1].record.windows.at(0).frames, alone[0].record.windows.at(0).frames));
  EXPECT_FALSE(same(pack[0].record.windows.at(0).frames, alone[0].record.windows.at(0).frames));
}

TEST(Frames, OfARangeThatEndsEarlyAreThoseOfTheStretchThatStands) {
  const SceneSpec scene = scene_of({"profile.hold_s=0.4", "profile.settled_within=0.5"});
  const auto outcomes = run_plans(compile(scene), plans_of(scene, {"fast"}, nullptr), 1, {}, false, 7);
  const RunRecord& record = outcomes.at(0).record;
  ASSERT_EQ(record.windows.size(), 1u);
  EXPECT_LT(record.simulated_s, 0.45) << "it does not end early";
  ASSERT_EQ(record.windows[0].frames.time_s.size(), 7u);
  EXPECT_NEAR(record.windows[0].frames.time_s.back(), record.windows[0].end_s, 1e-12);
}

class FramesInAFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "beltlife_frames_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  WindowRecord back(const RunRecord& record) {
    write_results(folder / "r.h5", {}, {record}, nullptr);
    return read_results(folder / "r.h5").runs.at(0).windows.at(0);
  }

  std::filesystem::path folder;
};

TEST_F(FramesInAFile, ComeBackToTheBit) {
  const RunRecord record = record_of(scene_of(), 6);
  EXPECT_TRUE(same(back(record).frames, record.windows[0].frames));
  const Hdf5Source file((folder / "r.h5").string());
  EXPECT_EQ(file.extents("/ranges/fast/frames/x_m"), (std::vector<std::size_t>{6, 64}));
  EXPECT_EQ(file.extents("/ranges/fast/frames/pulley_angle_rad"), (std::vector<std::size_t>{6, 2}));
}

TEST_F(FramesInAFile, OfARingHaveNoPulleys) {
  const SceneSpec scene =
      read_scene(BELTLIFE_SCENES "/spinning_ring.toml",
                 {"belt.elements=64", "profile.settle_s=0.01", "profile.hold_s=0.03", "profile.evaluate_s=0.02"})
          .scene;
  RunOptions options;
  options.frames = 4;
  const RunRecord record = run(compile(scene), plan_rest(scene), options).record;
  const Frames frames = back(record).frames;
  EXPECT_EQ(frames.time_s.size(), 4u);
  EXPECT_TRUE(same(frames, record.windows[0].frames));
  EXPECT_EQ(frames.pulleys(), 0u);
}

TEST_F(FramesInAFile, AreNoGroupIfThereAreNone) {
  EXPECT_TRUE(back(record_of(scene_of(), 0)).frames.time_s.empty());
  EXPECT_EQ(Hdf5Source((folder / "r.h5").string()).kind("/ranges/fast/frames"), Hdf5Kind::nothing);
}

TEST_F(FramesInAFile, AreRefusedInWordsIfTheyDoNotBelongTogether) {
  Frames frames;
  frames.time_s = {1, 2};
  frames.x_m = frames.y_m = {1, 2, 3, 4};
  frames.tension_n = {1, 2};
  Hdf5Image image;
  put_frames(image, "/frames", frames);
  const std::vector<char> bytes = image.bytes();
  std::ofstream(folder / "f.h5", std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const Hdf5Source file((folder / "f.h5").string());
  try {
    read_frames(file, "/frames");
    FAIL() << "it is not refused";
  } catch (const BadInput& bad) {
    EXPECT_NE(std::string(bad.what()).find("/frames/tension_n"), std::string::npos) << bad.what();
  }
}

}  // namespace
}  // namespace beltlife
