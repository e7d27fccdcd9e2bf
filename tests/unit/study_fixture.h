// Owns what tests of studies share: a folder of their own, refusals in words, an example of a study.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "results/journal/journal.h"
#include "sim/scene/scene_io.h"

namespace beltlife::study_test {

namespace fs = std::filesystem;

/// A folder of one test's own, which disappears with it.
class InFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "beltlife_study_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    log = folder / "study.jsonl";
  }
  void TearDown() override { fs::remove_all(folder); }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder), {}); }

  fs::path folder, log;
};

inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

inline void expect_words(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), text.npos) << "no \"" << word << "\" in: " << text;
}

inline std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

inline StudyHead example_head() {
  return {
      .driver = "study noise",
      .version = "1.2.3",
      .revision = "abc",
      .compiler = "g++",
      .command_line = "beltlife study noise n.toml",
      .scene_path = "scene.toml",
      .scene_text = "format = 1\n\n[belt]\nribs = 6\nfriction_front = 0.6\n\n[[pulley]]\nname = \"crank\"\nx_mm = 1\n",
      .study_path = "n.toml",
      .study_text = "# \xC2\xB5\n[[parameter]]\npath = \"belt.friction_front\"\nlower = 0.1\n",
      .lanes = "drives",
      .parameters = {"belt.friction_front", "solver.scheme"},
      .quantities = {"B100.drive_shaft.torque_n_m.order_3", "log10_life_h"}};
}

/// Point `number` of the example: every third one is not ok.
inline StudyPoint example_point(std::size_t number) {
  StudyPoint p{number, {0.1 + static_cast<double>(number), std::string("thesis")}, {}};
  p.answer.processor_s = 0.25;
  if (number % 3 == 2) {
    p.answer.state = PointState::infeasible;
    p.answer.reason = "no \"balance\",\nnowhere";
  } else {
    p.answer.state = PointState::ok;
    p.answer.values = {1.0 / static_cast<double>(number + 1), -0.0};
  }
  return p;
}

inline void expect_same(const StudyHead& a, const StudyHead& b) {
  EXPECT_EQ(a.driver, b.driver);
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(a.compiler, b.compiler);
  EXPECT_EQ(a.command_line, b.command_line);
  EXPECT_EQ(a.scene_path, b.scene_path);
  EXPECT_EQ(a.scene_text, b.scene_text);
  EXPECT_EQ(a.study_path, b.study_path);
  EXPECT_EQ(a.study_text, b.study_text);
  EXPECT_EQ(a.lanes, b.lanes);
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.quantities, b.quantities);
}

/// A point as text that differs whenever a bit of it differs, but for its time.
inline std::string bits_of(const StudyPoint& p) {
  std::string text = std::to_string(p.number) + " " + std::string(to_string(p.answer.state)) + " " + p.answer.reason;
  const auto add = [&](double value) {
    char spelled[40];
    std::snprintf(spelled, sizeof spelled, " %a", value);
    text += spelled;
  };
  for (const Setting& setting : p.settings)
    setting.index() == 0 ? add(std::get<double>(setting)) : void(text += " '" + std::get<std::string>(setting) + "'");
  for (const double value : p.answer.values) add(value);
  return text;
}

inline void expect_same_history(const StudyRecord& a, const StudyRecord& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(bits_of(a.points[i]), bits_of(b.points[i]));
  EXPECT_EQ(a.answer.dump(), b.answer.dump());
}

}  // namespace beltlife::study_test
