// Owns the claims about the report page: its sections, its ids, and that it stands alone.
#include <map>
#include <regex>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

const Arguments short_profile{"--set",      "profile.settle_s=0.02",
                              "--set",      "profile.ramp_s=0.05",
                              "--set",      "profile.hold_s=0.4",
                              "--set",      "profile.evaluate_s=0.3",
                              "--elements", "64",
                              "--quiet"};

class Report : public InFolder {
 protected:
  std::string page_of(const std::string& scene_name, const Arguments& more = {}) {
    const Answer run = beltlife(
        Arguments{"simulate", scene(scene_name), "--each-range", "--out", "r.h5"} + short_profile + more, folder);
    EXPECT_EQ(run.code, 0) << run.err;
    const Answer report = beltlife({"report", "r.h5"}, folder);
    EXPECT_EQ(report.code, 0) << report.err;
    return text_of(folder / "r.html");
  }
};

TEST_F(Report, HasEverySectionOfADriveAndEveryIdOnce) {
  const std::string page = page_of("two_pulley");
  for (const char* id : {"summary",
                         "key-numbers",
                         "layout",
                         "layout-drawing",
                         "layout-table",
                         "animation",
                         "animation-picture",
                         "animation-play",
                         "animation-range",
                         "animation-speed",
                         "animation-time",
                         "animation-data",
                         "life",
                         "life-ranges",
                         "life-damage-ranges",
                         "life-damage-cycle",
                         "life-pulleys",
                         "statics",
                         "statics-tensions",
                         "statics-hub-loads",
                         "statics-slip-safety",
                         "modes",
                         "modes-map",
                         "modes-crossings",
                         "modes-rotational-none",
                         "modes-transverse",
                         "losses",
                         "losses-table",
                         "ranges",
                         "range-slow",
                         "range-slow-trace-speed_rpm",
                         "range-slow-spectrum-torque_n_m",
                         "range-slow-tensions",
                         "range-slow-loop",
                         "range-slow-element",
                         "range-slow-spans",
                         "range-slow-pulleys",
                         "range-fast-orders",
                         "warnings",
                         "provenance",
                         "scene"})
    EXPECT_NE(page.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;

  std::map<std::string, int> count;
  const std::regex pattern(R"(\bid=['"]([^'"]+)['"])");
  for (std::sregex_iterator i(page.begin(), page.end(), pattern), end; i != end; ++i) ++count[(*i)[1]];
  EXPECT_GT(count.size(), 50u);
  for (const auto& [id, times] : count) EXPECT_EQ(times, 1) << id;
}

TEST_F(Report, StandsAloneWithoutAnythingFromElsewhere) {
  const std::string page = page_of("two_pulley");
  for (const char* fetches : {"fetch(", "XMLHttpRequest", "import(", "WebSocket"})
    EXPECT_EQ(page.find(fetches, page.find("<script")), std::string::npos) << fetches;
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  for (std::size_t at = page.find("href="); at != std::string::npos; at = page.find("href=", at + 1))
    EXPECT_EQ(page[at + 6], '#') << page.substr(at, 60);
}

TEST_F(Report, OfARingHasNoLayoutAndNoLife) {
  const std::string page = page_of("spinning_ring");
  EXPECT_NE(page.find("id=\"summary\""), std::string::npos);
  EXPECT_NE(page.find("id=\"range-rest-loop\""), std::string::npos);
  EXPECT_EQ(page.find("id=\"layout\""), std::string::npos);
  for (const char* id : {"life", "statics", "modes"})
    EXPECT_EQ(page.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
}

TEST_F(Report, OfADriveWithATensionerHasItsTakeUpAndBothStatesOfItsArm) {
  const std::string page = page_of("accessory_drive", {"--range", "town"});
  for (const char* id : {"statics-take-up", "modes-rotational-free", "modes-rotational-stuck", "modes-near"})
    EXPECT_NE(page.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
  EXPECT_NE(page.find("motorway"), std::string::npos) << "statics and modes are of all ranges, run or not";
}

TEST_F(Report, OfADriveThatSlipsByItsStaticsSaysSoInTableAndWarnings) {
  EXPECT_EQ(page_of("two_pulley").find(" slips</td>"), std::string::npos);
  const std::string page = page_of("two_pulley", {"--set", "belt.friction_front=0.2"});
  EXPECT_NE(page.find(" slips</td>"), std::string::npos);
  EXPECT_NE(page.find("class=\"alarm\""), std::string::npos);
  EXPECT_NE(page.find("quasi-static slip safety of 0."), std::string::npos);
}

TEST_F(Report, LinksOnlyToSectionsThatAreThere) {
  const std::string page = page_of("spinning_ring");
  for (std::size_t at = page.find("href=\"#"); at != std::string::npos; at = page.find("href=\"#", at + 1)) {
    const std::string id = page.substr(at + 7, page.find('"', at + 7) - at - 7);
    EXPECT_TRUE(page.find("id=\"" + id + "\"") != page.npos || page.find("id='" + id + "'") != page.npos) << id;
  }
}

TEST_F(Report, OfADivergedRunSaysSoAmongTheWarnings) {
  const Answer run = beltlife(Arguments{"simulate", scene("two_pulley"), "--range", "fast", "--scheme",
                                        "symplectic_euler", "--step", "1e-4", "--force", "--out", "r.h5"} +
                                  short_profile,
                              folder);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_EQ(beltlife({"report", "r.h5"}, folder).code, 0);
  EXPECT_NE(text_of(folder / "r.html").find("A run ended early: diverged"), std::string::npos);
}

TEST_F(Report, OfSomethingElseIsRefusedAndLeavesNothing) {
  std::ofstream(folder / "r.h5") << "no HDF5";
  const Answer report = beltlife({"report", "r.h5"}, folder);
  EXPECT_EQ(report.code, 2);
  EXPECT_NE(report.err.find("r.h5: is not a whole HDF5 file"), std::string::npos) << report.err;
  EXPECT_FALSE(fs::exists(folder / "r.html"));
}

}  // namespace
}  // namespace beltlife::system_test
