// Owns the claims about `beltlife modes`: it answers for every scene, in words and as JSON, and draws its map.
#include <algorithm>
#include <cmath>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, HasAnAnswerInWordsAndAsJson) {
  const bool ring = GetParam() == "spinning_ring";
  const Answer words = beltlife({"modes", scene(GetParam())});
  EXPECT_EQ(words.code, 0) << words.err;
  EXPECT_EQ(words.err, "");
  EXPECT_NE(words.out.find(ring ? "nothing to solve" : "transverse 1 and 2, Hz"), words.out.npos) << words.out;

  const Answer answer = beltlife({"modes", scene(GetParam()), "--json"});
  ASSERT_EQ(answer.code, 0) << answer.err;
  const auto j = answer.json();
  expect_keys(j, {"scene", "ranges", "map", "crossings"});
  EXPECT_EQ(j.contains("nothing_to_solve"), ring);
  EXPECT_EQ(j["ranges"].empty(), ring);
  EXPECT_EQ(j["crossings"].empty(), ring);
  for (const auto& range : j["ranges"]) {
    expect_keys(range, {"crank_rpm", "belt_speed_m_s", "arm_angle_rad", "rotational", "damped", "spans", "gears",
                        "slack", "instead"});
    for (const auto& modes : range["rotational"]) {
      ASSERT_FALSE(modes.empty());
      double before = 0;
      for (const auto& mode : modes) {
        expect_keys(mode, {"frequency_hz", "shape", "energy"});
        EXPECT_GE(mode["frequency_hz"].get<double>(), before);
        before = mode["frequency_hz"];
        double energy = mode["energy"]["arm"].get<double>() + mode["energy"]["belt"].get<double>();
        for (const auto& share : mode["energy"]["bodies"]) energy += share.get<double>();
        EXPECT_NEAR(energy, 1, 1e-6);
      }
    }
    for (const auto& modes : range["damped"])
      for (const auto& mode : modes) {
        expect_keys(mode, {"frequency_hz", "damping_ratio", "energy"});
        EXPECT_GE(mode["damping_ratio"].get<double>(), -1e-9);
      }
    for (const auto& span : range["spans"]) {
      expect_keys(span, {"name", "length_mm", "tension_n", "wave_speed_m_s", "frequency_hz"});
      EXPECT_GT(span["frequency_hz"][0].get<double>(), 0);
    }
  }
  for (const auto& c : j["crossings"]) expect_keys(c, {"frequency_hz", "order", "crank_rpm", "mode", "near_range"});
  for (const auto& curve : j["map"]["curves"])
    EXPECT_EQ(curve["frequency_hz"].size(), j["map"]["crank_rpm"].size()) << curve["name"];
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_SCENES))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Modes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

class ModesIn : public InFolder {};

TEST_F(ModesIn, TheMapIsDrawnOrThePackageIsNamed) {
  const Answer answer = run({"modes", scene("baseline"), "--map", "map.svg"});
  if (answer.code == 0) {
    const std::string svg = text_of(folder / "map.svg");
    for (const char* part : {"<svg", "crank speed", "B100", "rotational 1, arm free"})
      EXPECT_NE(svg.find(part), svg.npos) << part;
  } else {
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.err.find("apt-get install gnuplot-nox"), answer.err.npos) << answer.err;
    EXPECT_EQ(answer.out, "");
  }
  EXPECT_EQ(files().size(), answer.code == 0 ? 1u : 0u);
}

TEST_F(ModesIn, ARangeAloneIsThatOfTheWholeAnswer) {
  const auto whole = run({"modes", scene("two_pulley"), "--json"}).json();
  const auto alone = run({"modes", scene("two_pulley"), "--range", "fast", "--json"}).json();
  EXPECT_EQ(alone["ranges"].size(), 1u);
  EXPECT_EQ(alone["ranges"]["fast"], whole["ranges"]["fast"]);
  EXPECT_TRUE(alone["crossings"].empty());
  EXPECT_EQ(run({"modes", scene("two_pulley"), "--range", "fast"}).out.find("crossings"), std::string::npos);
}

TEST_F(ModesIn, AnUnknownRangeIsRefusedWithTheNamesThereAre) {
  const Answer answer = run({"modes", scene("two_pulley"), "--range", "faster"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("allowed: slow, fast"), answer.err.npos) << answer.err;
  EXPECT_EQ(run({"modes", scene("two_pulley"), "--range", "fast", "--map", "map.svg"}).code, 1);
}

TEST_F(ModesIn, AtAStandstillTheTensionAtRestIsSaidToBeTaken) {
  const Answer answer = run({"modes", scene("two_pulley"), "--set", "range.fast.crank_rpm=0"});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_NE(answer.out.find("fast: the drive stands still: the tension at rest is taken"), answer.out.npos)
      << answer.out;
}

TEST_F(ModesIn, SettingsCount) {
  const auto first = [&](const Arguments& more) {
    const auto j = run(Arguments{"modes", scene("two_pulley"), "--json"} + more).json();
    return j["ranges"]["fast"]["rotational"]["none"][0]["frequency_hz"].get<double>();
  };
  const double as_is = first({});
  EXPECT_NEAR(first({"--set", "belt.axial_stiffness_n=50000"}) / as_is, std::sqrt(50000 / 105422.0), 0.05);
  // Shorter elements make rounder arcs, on which the belt is a little tighter.
  EXPECT_NEAR(first({"--elements", "496"}) / as_is, 1, 1e-4);
}

}  // namespace
}  // namespace beltlife::system_test
