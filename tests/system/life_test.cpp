// Owns the claims about `beltlife life`: its answer, the flank height for a wanted life, and several scenes at once.
#include <cmath>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

nlohmann::json life(const Arguments& arguments) {
  const Answer answer = beltlife(Arguments{"life", "--json"} + arguments);
  EXPECT_EQ(answer.code, 0) << answer.err;
  return answer.json();
}

TEST(Life, StatesStressesAndLivesByRangeAndPulley) {
  const auto j = life(Arguments{scene("accessory_drive"), "--range", "motorway", "--range", "full_load"} + brief(168));
  expect_keys(j, {"life_h", "log10_life_h", "ranges"});
  EXPECT_NEAR(j["log10_life_h"], std::log10(j["life_h"].get<double>()), 1e-12);
  ASSERT_EQ(j["ranges"].size(), 2u);
  for (const auto& range : j["ranges"]) {
    expect_keys(range, {"life_h", "pulleys"});
    ASSERT_EQ(range["pulleys"].size(), 6u);
    double damage = 0;
    for (const auto& pulley : range["pulleys"]) {
      expect_keys(pulley, {"name", "sigma_m_mpa", "sigma_a_mpa", "cycles"});
      EXPECT_GT(pulley["sigma_a_mpa"], 0);
      EXPECT_GT(pulley["cycles"], 0);
      damage += pulley["damage_share"].get<double>();
    }
    EXPECT_NEAR(damage, 1, 1e-9);  // rounding
  }
}

// Miner: the duty cycle's damage is the sum of its ranges' damages.
TEST(Life, AddsTheDamageOfItsRanges) {
  const auto j = life(Arguments{scene("two_pulley")} + brief(88));
  const double slow = j["ranges"]["slow"]["life_h"], fast = j["ranges"]["fast"]["life_h"];
  EXPECT_NEAR(j["life_h"].get<double>() * (0.4 / slow + 0.6 / fast), 1, 1e-12);
}

TEST(Life, ReachesTheWantedHoursAtTheFlankHeightItStates) {
  const Arguments drive = Arguments{scene("two_pulley")} + brief(88);
  const auto asked = life(drive + Arguments{"--flank-for", "2000"});
  ASSERT_TRUE(asked.contains("flank_height_mm_for_life")) << asked.dump();
  const double height = asked["flank_height_mm_for_life"];
  const auto changed = life(drive + Arguments{"--set", "fatigue.flank_height_mm=" + nlohmann::json(height).dump()});
  EXPECT_NEAR(changed["life_h"].get<double>() / 2000, 1, 1e-3);
}

// Thesis (6.4): N = (sigma_a / (sigma_f - sigma_m))^(1/b) / 2, with sigma_f 10 and 20 MPa, b = -0.068.
TEST(Life, GrowsWithTheStrengthAsBasquinsRuleHasIt) {
  const Arguments drive = Arguments{scene("two_pulley")} + brief(64);
  const auto weak = life(drive), strong = life(drive + Arguments{"--set", "fatigue.strength_mpa=20"});
  const auto &of_weak = weak["ranges"]["fast"]["pulleys"], &of_strong = strong["ranges"]["fast"]["pulleys"];
  ASSERT_EQ(of_weak.size(), 2u);
  for (std::size_t p = 0; p < of_weak.size(); ++p) {
    const double mean = of_weak[p]["sigma_m_mpa"];
    EXPECT_EQ(of_strong[p]["sigma_a_mpa"], of_weak[p]["sigma_a_mpa"]) << "the strength is no part of the simulation";
    const double factor = std::pow((20 - mean) / (10 - mean), 1 / 0.068);
    EXPECT_NEAR(of_strong[p]["cycles"].get<double>() / (of_weak[p]["cycles"].get<double>() * factor), 1, 1e-9) << p;
  }
}

TEST_F(InFolder, LifeComparesSeveralScenesInTheOrderGiven) {
  const fs::path tight =
      write("tight.toml", replaced(text_of(scene("two_pulley")), "pretension_n = 600", "pretension_n = 900"));
  const Arguments both = Arguments{scene("two_pulley"), tight} + brief(64);
  const auto j = life(both);
  ASSERT_EQ(j["scenes"].size(), 2u);
  EXPECT_EQ(j["scenes"][1]["scene"], tight.string());
  EXPECT_LT(j["scenes"][1]["life_h"], j["scenes"][0]["life_h"]);  // more tension, less life
  EXPECT_EQ(j["scenes"][0]["life_h"], life(Arguments{scene("two_pulley")} + brief(64))["life_h"]);
  const Answer text = run(Arguments{"life"} + both);
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_LT(text.out.rfind("two_pulley"), text.out.rfind("tight")) << text.out;
}

TEST_F(InFolder, LifeWritesOneResultFileForEachScene) {
  const fs::path other = write("other.toml", text_of(scene("two_pulley")));
  const Answer answer =
      run(Arguments{"life", scene("two_pulley"), other, "--out", "r.h5", "--details", "d.txt"} + brief(64));
  EXPECT_EQ(answer.code, 0) << answer.err;
  auto names = files();
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"d.txt", "other.toml", "r_other.h5", "r_two_pulley.h5"}));
  EXPECT_NE(text_of(folder / "d.txt").find("Range fast"), std::string::npos);
}

TEST_F(InFolder, LifeWritesNothingIfAnySceneIsBad) {
  const Answer answer = run({"life", scene("two_pulley"), "none.toml", "--out", "r.h5", "--details", "d.txt"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.out, "");
  EXPECT_TRUE(files().empty());
}

TEST_F(InFolder, ALifeOfTwoScenesOfOneNameRefusesToOverwriteOneWithTheOther) {
  fs::create_directory(folder / "other");
  fs::copy_file(scene("two_pulley"), folder / "other" / "two_pulley.toml");
  const Answer answer = run({"life", scene("two_pulley"), "other/two_pulley.toml", "--out", "r.h5"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("would overwrite"), std::string::npos) << answer.err;
  EXPECT_EQ(files(), std::vector<std::string>{"other"});
}

}  // namespace
}  // namespace beltlife::system_test
