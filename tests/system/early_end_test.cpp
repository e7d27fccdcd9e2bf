// Owns the claims about `profile.settled_within`: a range run alone ends early, says so, and gives what the full run
// gives.
#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

/// Stretches of five turns at 1000 r/min, twelve at 2500: in each, what the drive's second order does is the same.
Arguments drive(const std::string& settled_within) {
  Arguments a{scene("two_pulley"), "--quiet", "--elements", "64"};
  for (const char* setting :
       {"profile.settle_s=0.05", "profile.ramp_s=0.1", "profile.hold_s=1.5", "profile.evaluate_s=0.3"})
    a = a + Arguments{"--set", setting};
  return settled_within.empty() ? a : a + Arguments{"--set", "profile.settled_within=" + settled_within};
}

nlohmann::json answer(const Arguments& arguments) {
  const Answer a = beltlife(arguments + Arguments{"--json"});
  EXPECT_EQ(a.code, 0) << a.err;
  return a.json();
}

constexpr double whole_s = 0.05 + 0.1 + 1.5;

TEST(EarlyEnd, OfALifeGivesThatOfTheFullRun) {
  const auto full = answer(Arguments{"life"} + drive("")), early = answer(Arguments{"life"} + drive("0.05"));
  for (const auto& run : early["runs"]) {
    EXPECT_LT(run["simulated_s"], 0.7 * whole_s) << run;
    EXPECT_NEAR(run["planned_s"], whole_s, 1e-9);
    EXPECT_LE(run["settling_change"], 0.05) << run;
  }
  for (const auto& run : full["runs"]) {
    EXPECT_NEAR(run["simulated_s"], whole_s, 1e-6);
    EXPECT_FALSE(run.contains("settling_change"));
  }
  // Tensions agree within what was asked for. A life goes with the 15th power of a stress: 5 % of the alternating
  // stress are a factor of 2, and the decimal logarithm is off by 0.3.
  for (const char* range : {"slow", "fast"})
    for (std::size_t p = 0; p < 2; ++p)
      for (const char* load : {"tension_high_n", "tension_low_n"})
        EXPECT_NEAR(early["ranges"][range]["loads"][p][load].get<double>() /
                        full["ranges"][range]["loads"][p][load].get<double>(),
                    1, 0.05)
            << range << p << load;
  EXPECT_NEAR(early["log10_life_h"], full["log10_life_h"].get<double>(), 0.3);
}

TEST(EarlyEnd, ThatNeverComesChangesNothingToTheBit) {
  const auto full = answer(Arguments{"life"} + drive("")), strict = answer(Arguments{"life"} + drive("1e-6"));
  EXPECT_EQ(strict["ranges"], full["ranges"]);
  EXPECT_EQ(strict["life_h"], full["life_h"]);
  for (const auto& run : strict["runs"]) EXPECT_GT(run["settling_change"], 1e-6);
}

TEST(EarlyEnd, IsOfRangesRunAloneNotOfTheWholeProfile) {
  const auto each = answer(Arguments{"simulate", "--each-range"} + drive("0.05"));
  EXPECT_LT(each["simulated_s"], 0.7 * 2 * whole_s);
  const auto one = answer(Arguments{"simulate"} + drive("0.05") + Arguments{"--range", "fast"});
  EXPECT_EQ(one["ranges"]["fast"], each["ranges"]["fast"]);
  const auto with = answer(Arguments{"simulate"} + drive("0.05")), without = answer(Arguments{"simulate"} + drive(""));
  EXPECT_EQ(with["ranges"], without["ranges"]);
  EXPECT_EQ(with["steps"], without["steps"]);
  EXPECT_FALSE(with["runs"][0].contains("settling_change"));
}

TEST_F(InFolder, AnEarlyEndIsSaidInPrintAndOnThePage) {
  const Answer life = run(Arguments{"life", "--out", "r.h5"} + drive("0.05"));
  EXPECT_EQ(life.code, 0) << life.err;
  for (const char* range : {"slow: ended after ", "fast: ended after "})
    EXPECT_NE(life.out.find(range), life.out.npos) << life.out;
  EXPECT_NE(life.out.find(" of 1.65 s: last two stretches of 0.3 s agree within "), life.out.npos) << life.out;
  const Answer each = run(Arguments{"simulate", "--each-range"} + drive("1e-6"));
  EXPECT_NE(each.out.find("fast: ran to its end of 1.65 s: last two stretches of 0.3 s differ by "), each.out.npos)
      << each.out;
  EXPECT_EQ(run(Arguments{"simulate", "--each-range"} + drive("")).out.find("stretches"), std::string::npos);
  EXPECT_EQ(run({"report", "r.h5"}).code, 0);
  const std::string page = text_of(folder / "r.html");
  EXPECT_NE(page.find("This range ended after "), page.npos);
}

TEST(EarlyEnd, NeedsTwoStretchesToCompare) {
  const Answer a = beltlife(Arguments{"life"} + drive("0.05") + Arguments{"--set", "profile.evaluate_s=1"});
  EXPECT_EQ(a.code, 2);
  EXPECT_NE(a.err.find("profile.settled_within"), a.err.npos) << a.err;
}

}  // namespace
}  // namespace beltlife::system_test
