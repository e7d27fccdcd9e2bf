// Owns the claim that a result file gives back what was written.
#include "results/store/result_reader.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sim/eval/run_ranges.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

class ResultReader : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "beltlife_reader_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  /// A short run of a real drive, so that no field keeps its default.
  static std::vector<RunRecord> short_runs(const SceneSpec& scene) {
    const Model model = compile(scene);
    std::vector<RunRecord> records;
    for (RunOutcome& outcome : run_plans(model, plans_of(scene, {}, nullptr), 1))
      records.push_back(std::move(outcome.record));
    return records;
  }

  std::string refusal(const fs::path& path) {
    try {
      read_results(path);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "";
  }

  fs::path folder;
};

SceneSpec short_scene() {
  return read_scene(fs::path(BELTLIFE_SCENES) / "two_pulley.toml",
                    {"belt.elements=64", "profile.settle_s=0.02", "profile.ramp_s=0.05", "profile.hold_s=0.2",
                     "profile.evaluate_s=0.15"})
      .scene;
}

TEST_F(ResultReader, GivesBackEveryNumberThatWasWritten) {
  auto runs = short_runs(short_scene());
  runs[0].settling_change = 0.02;  // of one run; the other has none
  const Provenance from{"1.2", "beltlife simulate", "two_pulley.toml", "text = \"\xC2\xB5\"\n", "g++", "abc", "thesis",
                        64};
  write_results(folder / "r.h5", from, runs, nullptr);
  const ResultFile back = read_results(folder / "r.h5");

  EXPECT_EQ(back.provenance.scene_text, from.scene_text);
  EXPECT_EQ(back.provenance.command_line, from.command_line);
  EXPECT_EQ(back.provenance.elements, 64);
  ASSERT_EQ(back.runs.size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(back.runs[i].steps, runs[i].steps);
    EXPECT_EQ(back.runs[i].step_s, runs[i].step_s);
    EXPECT_EQ(back.runs[i].settling_change, runs[i].settling_change);
    EXPECT_EQ(back.runs[i].trace.time_s, runs[i].trace.time_s);
    ASSERT_EQ(back.runs[i].trace.channels.size(), runs[i].trace.channels.size());
    for (std::size_t c = 0; c < runs[i].trace.channels.size(); ++c) {
      EXPECT_EQ(back.runs[i].trace.channels[c].name, runs[i].trace.channels[c].name);
      EXPECT_EQ(back.runs[i].trace.channels[c].unit, runs[i].trace.channels[c].unit);
      EXPECT_EQ(back.runs[i].trace.channels[c].values, runs[i].trace.channels[c].values);
    }
    ASSERT_EQ(back.runs[i].windows.size(), 1u);
    const WindowRecord &a = runs[i].windows[0], &b = back.runs[i].windows[0];
    EXPECT_EQ(b.range, a.range);
    EXPECT_EQ(b.duty_share, a.duty_share);
    EXPECT_EQ(b.complete, a.complete);
    EXPECT_EQ(b.first_sample, a.first_sample);
    EXPECT_EQ(b.last_sample, a.last_sample);
    EXPECT_EQ(b.energy.joule, a.energy.joule);
    ASSERT_EQ(b.passes.size(), a.passes.size());
    for (std::size_t p = 0; p < a.passes.size(); ++p) {
      EXPECT_EQ(b.passes[p].normal_resolved, a.passes[p].normal_resolved);
      EXPECT_EQ(b.passes[p].tangential_sampled, a.passes[p].tangential_sampled);
      EXPECT_EQ(b.passes[p].unsampled, a.passes[p].unsampled);
    }
    EXPECT_FALSE(a.element.time_s.empty());
    EXPECT_EQ(b.element.normal_n, a.element.normal_n);
    EXPECT_EQ(b.element.pulley, a.element.pulley);
    EXPECT_EQ(a.loop.x_m.size(), 64u);
    EXPECT_EQ(b.loop.tension_n, a.loop.tension_n);
  }
}

TEST_F(ResultReader, GivesBackStaticsAndModesAsTheyWereSolved) {
  const SolvedDrive solved = solve_drive(compile(read_scene(fs::path(BELTLIFE_SCENES) / "baseline.toml").scene));
  write_results(folder / "r.h5", {}, {}, nullptr, &solved);
  const ResultFile back = read_results(folder / "r.h5");
  ASSERT_TRUE(back.statics && back.modes);

  const DriveStatics &s = solved.statics, &statics = *back.statics;
  ASSERT_FALSE(s.take_up.empty());
  ASSERT_EQ(statics.take_up.size(), s.take_up.size());
  for (std::size_t i = 0; i < s.take_up.size(); ++i) {
    EXPECT_EQ(statics.take_up[i].name, s.take_up[i].name);
    EXPECT_EQ(statics.take_up[i].reason, s.take_up[i].reason);
    EXPECT_EQ(statics.take_up[i].unstretched_length, s.take_up[i].unstretched_length);
  }
  EXPECT_EQ(statics.estimate.life_h, s.estimate.life_h);
  ASSERT_EQ(statics.ranges.size(), 6u);
  for (std::size_t r = 0; r < s.ranges.size(); ++r) {
    const QuasiStaticRange &a = s.ranges[r], &b = statics.ranges[r];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.error, a.error);
    EXPECT_EQ(b.arm_angle, a.arm_angle);
    EXPECT_EQ(b.loss, a.loss);
    ASSERT_EQ(b.spans.size(), a.spans.size());
    for (std::size_t i = 0; i < a.spans.size(); ++i) EXPECT_EQ(b.spans[i].tension_high, a.spans[i].tension_high);
    ASSERT_EQ(b.pulleys.size(), a.pulleys.size());
    for (std::size_t i = 0; i < a.pulleys.size(); ++i) {
      EXPECT_EQ(b.pulleys[i].name, a.pulleys[i].name);
      EXPECT_EQ(b.pulleys[i].hub_load, a.pulleys[i].hub_load);
      EXPECT_EQ(b.pulleys[i].slip_safety, a.pulleys[i].slip_safety);
      EXPECT_NEAR(b.pulleys[i].hub_x, a.pulleys[i].hub_x, 1e-9 * a.pulleys[i].hub_load);  // stored as a direction
    }
  }

  const DriveModes &m = solved.modes, &modes = *back.modes;
  ASSERT_EQ(modes.points.size(), m.points.size());
  for (std::size_t r = 0; r < m.points.size(); ++r) {
    ASSERT_EQ(modes.points[r].arms.size(), 2u);
    for (std::size_t arm = 0; arm < 2; ++arm) {
      const ArmModes &a = m.points[r].arms[arm], &b = modes.points[r].arms[arm];
      EXPECT_EQ(b.arm, a.arm);
      ASSERT_EQ(b.modes.size(), a.modes.size());
      ASSERT_EQ(b.damped.size(), a.damped.size());
      for (std::size_t i = 0; i < a.modes.size(); ++i) {
        EXPECT_EQ(b.modes[i].frequency_hz, a.modes[i].frequency_hz);
        EXPECT_EQ(b.modes[i].arm_shape, a.modes[i].arm_shape);
        EXPECT_EQ(b.modes[i].body_shape, a.modes[i].body_shape);
        EXPECT_EQ(b.modes[i].energy.body, a.modes[i].energy.body);
      }
      for (std::size_t i = 0; i < a.damped.size(); ++i) EXPECT_EQ(b.damped[i].damping_ratio, a.damped[i].damping_ratio);
    }
    EXPECT_EQ(modes.points[r].spans.at(3).frequency_hz, m.points[r].spans.at(3).frequency_hz);
  }
  EXPECT_EQ(modes.map.crank_rpm, m.map.crank_rpm);
  ASSERT_EQ(modes.map.curves.size(), m.map.curves.size());
  for (std::size_t i = 0; i < m.map.curves.size(); ++i) {
    EXPECT_EQ(modes.map.curves[i].name, m.map.curves[i].name);
    EXPECT_EQ(modes.map.curves[i].arm, m.map.curves[i].arm);
    EXPECT_EQ(modes.map.curves[i].frequency_hz, m.map.curves[i].frequency_hz);
  }
  ASSERT_EQ(modes.crossings.size(), m.crossings.size());
  EXPECT_EQ(modes.crossings.back().near, m.crossings.back().near);
  EXPECT_EQ(modes.crossings.back().mode, m.crossings.back().mode);
}

TEST_F(ResultReader, AFileWithoutStaticsAndModesIsRead) {
  write_results(folder / "r.h5", {}, {}, nullptr);
  const ResultFile back = read_results(folder / "r.h5");
  EXPECT_FALSE(back.statics);
  EXPECT_FALSE(back.modes);
}

TEST_F(ResultReader, RefusesWhatIsNoResultFileInWords) {
  EXPECT_NE(refusal(folder / "none.h5").find("no such file"), std::string::npos);
  EXPECT_NE(refusal(folder).find("no such file"), std::string::npos);
  std::ofstream(folder / "text.h5") << "not HDF5";
  EXPECT_NE(refusal(folder / "text.h5").find("is not a whole HDF5 file"), std::string::npos);

  write_results(folder / "whole.h5", {}, {}, nullptr);
  fs::copy_file(folder / "whole.h5", folder / "cut.h5");
  fs::resize_file(folder / "cut.h5", fs::file_size(folder / "whole.h5") / 2);
  EXPECT_NE(refusal(folder / "cut.h5").find("is not a whole HDF5 file"), std::string::npos);
}

}  // namespace
}  // namespace beltlife
