// Owns the claims about `beltlife check`: what it says of every scene that comes with the program.
#include <algorithm>
#include <set>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

nlohmann::json checked(const std::string& path, const Arguments& more = {}) {
  const Answer answer = beltlife(Arguments{"check", path, "--json"} + more);
  EXPECT_EQ(answer.code, 0) << path << "\n" << answer.err;
  EXPECT_EQ(answer.err, "") << path;
  return answer.json();
}

TEST(Check, AnswersForEverySceneThatComesWithTheProgram) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    SCOPED_TRACE(entry.path().filename().string());
    const auto j = checked(entry.path());
    expect_keys(j, {"stable_step_s", "kernels", "quantities"});
    EXPECT_GT(j["stable_step_s"], 0);
    EXPECT_FALSE(j["kernels"].empty());
    if (entry.path().stem() == "spinning_ring") continue;  // no pulleys, hence no layout
    expect_keys(j, {"printed", "static"});
    for (const char* where : {"printed", "static"}) {
      SCOPED_TRACE(where);
      const auto& layout = j[where];
      expect_keys(layout, {"arm_angle_rad", "path_length_mm", "tension_n", "unstretched_length_m", "pulleys", "spans"});
      ASSERT_GE(layout["pulleys"].size(), 2u);
      ASSERT_EQ(layout["pulleys"].size(), layout["spans"].size());
      double turns = 0, length = 0;
      for (const auto& pulley : layout["pulleys"]) {
        expect_keys(pulley, {"name", "wrap_deg"});
        EXPECT_GT(pulley["wrap_deg"], 0);
        turns += pulley["wrap_deg"].get<double>();
      }
      for (const auto& span : layout["spans"]) {
        expect_keys(span, {"name", "length_mm"});
        length += span["length_mm"].get<double>();
      }
      EXPECT_GE(turns, 360 - 1e-9);  // a closed loop turns once; wraps on the back add to it. Rounding alone
      EXPECT_GT(layout["path_length_mm"], length);
      EXPECT_GT(layout["tension_n"], 0);
    }
  }
  EXPECT_GE(scenes, 7);  // the baseline, three alternatives and three drives of other kinds
}

// The layout of the thesis' drive: numbers that follow from its printed table, to the digits stated.
TEST(Check, StatesTheBaselineAsPrintedAndInBalance) {
  const auto j = checked(scene("baseline"));
  EXPECT_NEAR(j["printed"]["path_length_mm"], 2635.0, 0.05);
  EXPECT_NEAR(j["printed"]["tension_n"], 322, 0.5);
  EXPECT_NEAR(j["printed"]["unstretched_length_m"], 2.629, 0.5e-3);
  EXPECT_NEAR(j["static"]["path_length_mm"], 2590.5, 0.05);
  EXPECT_GE(j["static"]["tension_n"], 684);
  EXPECT_LE(j["static"]["tension_n"], 686);
  EXPECT_NEAR(j["static"]["unstretched_length_m"], 2.578, 0.5e-3);
  EXPECT_NEAR(std::abs(j["static"]["arm_angle_rad"].get<double>()), 0.39, 0.005);
}

TEST(Check, ListsEachQuantityOfEachRangeOnce) {
  const auto names = checked(scene("baseline"))["quantities"].get<std::vector<std::string>>();
  const std::set<std::string> unique(names.begin(), names.end());
  EXPECT_EQ(unique.size(), names.size());
  for (const char* name : {"B100.drive_shaft.speed_rpm.order_3", "idle.span.drive-idler_2.tension_n.mean",
                           "C100.pulley.drive.slip_percent", "A100.life_h", "life_h", "log10_life_h"})
    EXPECT_TRUE(unique.contains(name)) << name;
}

TEST(Check, ShowsWhatFlagsAndSettingsChanged) {
  const auto plain = checked(scene("two_pulley"));
  const auto j = checked(scene("two_pulley"), {"--elements", "240", "--scheme", "thesis", "--step", "1e-7", "--set",
                                               "belt.pretension_n=500", "--set", "pulley.driven.x_mm = 600"});
  EXPECT_EQ(j["elements"], 240);
  EXPECT_EQ(j["scheme"], "thesis");
  EXPECT_NEAR(j["step_s"], 1e-7, 1e-9);  // rounded so that samples fall on steps
  EXPECT_NEAR(j["static"]["tension_n"], 500, 1e-6);
  // Twice 100 mm more between the centres, but for the change of the spans' slope, 20 mm over 500 to 600 mm.
  EXPECT_NEAR(j["static"]["path_length_mm"].get<double>() - plain["static"]["path_length_mm"].get<double>(), 200, 0.2);
}

TEST(Check, PrintsTablesForPeople) {
  const Answer answer = beltlife({"check", scene("baseline")});
  EXPECT_EQ(answer.code, 0) << answer.err;
  for (const char* part : {"idler_7", "placed", "at rest", "step limit", "kernels:", "tightest clearance"})
    EXPECT_NE(answer.out.find(part), answer.out.npos) << part << "\n" << answer.out;
}

TEST_F(InFolder, CheckAnswersInValidJsonForAFileNameThatIsNoUtf8) {
  const fs::path odd = write("odd\xff.toml", text_of(scene("two_pulley")));
  EXPECT_FALSE(checked(odd).is_discarded());
}

}  // namespace
}  // namespace beltlife::system_test
