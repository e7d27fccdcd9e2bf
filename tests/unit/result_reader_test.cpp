// Owns the claim that a result file gives back what was written.
#include "results/result_reader.h"

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
  const auto runs = short_runs(short_scene());
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
