// Owns the claims that hold of every scene that comes with the program: each command answers, and they agree.
#include <algorithm>
#include <cmath>
#include <regex>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_SCENES))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class EverySceneRuns : public InFolder, public testing::WithParamInterface<std::string> {
 protected:
  bool ring() const { return GetParam() == "spinning_ring"; }  // without pulleys and ranges
  bool has(const std::string& key) const {
    return std::regex_search(text_of(scene(GetParam())), std::regex("(^|\n)" + key));
  }
};

// Tables for people hold no number that is none, no sign on zero, and what the scene has beside what it has not.
TEST_P(EverySceneRuns, CheckAndModesSpeakInWholeNumbers) {
  for (const char* command : {"check", "modes"}) {
    const Answer answer = run({command, scene(GetParam())});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.err, "");
    std::smatch odd;
    EXPECT_FALSE(std::regex_search(answer.out, odd, std::regex(R"((\bnan\b|\binf\b| -0(\.0+)?[ \n]))")))
        << command << ": " << odd.str();
    if (std::string(command) == "check") {
      EXPECT_EQ(answer.out.find("effective dia mm") != answer.out.npos, has("effective_diameter_mm"));
      EXPECT_EQ(answer.out.find("take-up") != answer.out.npos, has("\\[tensioner\\]"));
      EXPECT_EQ(answer.out.find("the arm meets its stop") != answer.out.npos, has("stop_lengthening_deg"));
      EXPECT_EQ(answer.out.find("in brackets between the arm") != answer.out.npos, has("\\[tensioner\\]"));
    }
  }
}

// A short run of coarse elements in the first two ranges: whether the life is right is for other tests. The ramp is
// just long enough for the slackest drive to follow without slip.
TEST_P(EverySceneRuns, LifeAndReportAnswerAndAgree) {
  Arguments brief_life = Arguments{"life", scene(GetParam()), "--out", "r.h5", "--json"} + brief(128) +
                         Arguments{"--set", "profile.ramp_s=0.2", "--set", "profile.hold_s=0.3"};
  const std::string text = text_of(scene(GetParam()));
  const std::regex range("\\[\\[range\\]\\]\nname = \"([^\"]+)\"");
  std::sregex_iterator at(text.begin(), text.end(), range);
  for (int i = 0; i < 2 && at != std::sregex_iterator(); ++i, ++at)
    brief_life.insert(brief_life.end(), {"--range", (*at)[1]});
  const Answer answer =
      ring() ? run(Arguments{"simulate", scene(GetParam()), "--out", "r.h5", "--json"} + brief(128)) : run(brief_life);
  ASSERT_EQ(answer.code, 0) << answer.err;
  const Answer report = run({"report", "r.h5"});
  ASSERT_EQ(report.code, 0) << report.err;
  const std::string page = text_of(folder / "r.html");
  const auto shows = [&](const std::string& part) { return page.find(part) != page.npos; };
  for (const char* odd : {">nan<", ">inf<", ">-0<", ">-0.0<", ">-0.00<", "1000000000000", "() N"})
    EXPECT_FALSE(shows(odd)) << odd;
  for (const char* id : {"layout", "life", "statics", "modes"})
    EXPECT_EQ(shows("<section id=\"" + std::string(id) + "\""), !ring()) << id;
  EXPECT_EQ(shows("effective diameter mm"), has("effective_diameter_mm"));
  EXPECT_EQ(shows("id=\"statics-take-up\""), has("\\[tensioner\\]"));
  EXPECT_EQ(shows("lost in gears"), has("\\[\\[gear_pair\\]\\]"));
  if (ring()) return;

  // The page works the life out anew, from what the file holds, and gives it to three digits.
  std::smatch stated;
  ASSERT_TRUE(std::regex_search(page, stated, std::regex("predicted to live about <strong>([0-9.]+) h</strong>")));
  const double life = answer.json()["life_h"];
  EXPECT_NEAR(std::stod(stated[1]) / life, 1, 0.5e-2);
}

INSTANTIATE_TEST_SUITE_P(System, EverySceneRuns, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace beltlife::system_test
