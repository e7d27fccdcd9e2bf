// Owns the claims about scene texts that are refused: what is wrong with them, and where.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "sim/scene/scene_io.h"
#include "sim/scene/toml_tree.h"
#include "tests/unit/scene_fixture.h"

namespace beltlife {
namespace {

using namespace scene_fixture;

// ---------------------------------------------------------------- problems and where they are

struct Mistake {
  std::string_view right;  ///< part of the small scene
  std::string_view wrong;  ///< what stands there instead
  std::string_view at;     ///< text in the line that must be named
  std::string_view key;
  std::string_view what;
  std::string_view allowed;
};

TEST(ReadScene, NamesLineKeyFaultAndRemedyOfEachMistake) {
  // clang-format off
  const Mistake mistakes[] = {
    {"mass_kg_per_m", "mas_kg_per_m", "[belt]", "belt.mass_kg_per_m", "missing key", "number above 0, at most 100"},
    {"title =", "titel =", "titel", "titel", "did you mean 'title'?", "format, title, rotation"},
    {"inertia_kg_m2 = 0.001", "inertia_kg_m2 = 0.001\ninertia_g_m2 = 1", "inertia_g_m2",
     "pulley.idler_2.inertia_g_m2", "did you mean 'inertia_kg_m2'?", "name, x_mm, y_mm"},
    {"y_mm = 0\npitch_diameter_mm = 80", "pitch_diameter_mm = 80", "[[pulley]]\nname = \"idler_2\"",
     "pulley.idler_2.y_mm", "missing key", "from -100000 to 100000"},
    {"name = \"rotor\"\ninertia", "inertia", "[[body]]", "body.0.name", "missing key", "text"},
    {"x_mm = 500", "x_mm = \"500\"", "x_mm = \"500\"", "pulley.idler_2.x_mm", "found text \"500\", wanted a number",
     "from -100000"},
    {"x_mm = 500", "x_mm = true", "x_mm = true", "pulley.idler_2.x_mm", "found true", ""},
    {"x_mm = 500", "x_mm = 1979-05-27", "x_mm = 19", "pulley.idler_2.x_mm", "found a date", ""},
    {"x_mm = 500", "x_mm = [500]", "x_mm = [", "pulley.idler_2.x_mm", "found an array", ""},
    {"x_mm = 500", "x_mm = { a = 1 }", "x_mm = {", "pulley.idler_2.x_mm", "found a table", ""},
    {"x_mm = 500", "x_mm = nan", "x_mm = nan", "pulley.idler_2.x_mm", "not a finite number", ""},
    {"x_mm = 500", "x_mm = -inf", "x_mm = -inf", "pulley.idler_2.x_mm", "not a finite number", ""},
    {"ribs = 6", "ribs = 6.0", "ribs", "belt.ribs", "found number 6.0, wanted an integer", "from 1 to 100"},
    {"ribs = 6", "ribs = 5000000000", "ribs", "belt.ribs", "out of limits", "from 1 to 100"},
    {"mass_kg_per_m = 0.1", "mass_kg_per_m = 0", "mass_kg", "belt.mass_kg_per_m", "0 is out of limits", "above 0"},
    {"friction_back = 0.5", "friction_back = -1", "friction_back", "belt.friction_back", "-1 is out", "from 0 to 10"},
    {"format = 1", "format = 2", "format", "format", "2 is out of limits", "1"},
    {"side = \"front\"", "side = \"frnt\"", "frnt", "pulley.crank.side", "did you mean 'front'?", "front, back"},
    {"side = \"front\"", "side = 1", "side = 1", "pulley.crank.side", "found integer 1", "front, back"},
    {"[0, 1000, 2000]", "[0, \"a\", 2000]", "speeds_rpm = [0", "torque.load.speeds_rpm.1", "found text \"a\"", ""},
    {"[0, 1000, 2000]", "[0, 1000, -1]", "speeds_rpm = [0", "torque.load.speeds_rpm.2", "out of limits", "from 0"},
    {"[0, 1000, 2000]", "1000", "speeds_rpm = 1", "torque.load.speeds_rpm", "wanted an array", ""},
    {"[belt]", "[[belt]]", "[[belt]]", "belt", "found an array, wanted a table", ""},
    {"[[body]]", "[body]", "[body]", "body", "found a table, wanted an array of tables", "[[body]]"},
    {"[profile]", "[profle]", "[profle]", "profle", "did you mean 'profile'?", "profile"},
    // What no single field can know:
    {"name = \"B100\"", "name = \"idle\"", "\"idle\"\ncrank_rpm = 1500", "range.idle.name", "another range", ""},
    {"name = \"shaft\"", "name = \"a.b\"", "a.b", "torsional_spring.a.b.name", "cannot be used", "letters, digits"},
    {"pulley = \"idler_2\"", "pulley = \"idler_3\"", "idler_3", "tensioner.pulley", "did you mean 'idler_2'?", "crank"},
    {"pulley = \"idler_2\"", "pulley = \"rotor\"", "pulley = \"rotor\"", "tensioner.pulley", "no pulley 'rotor'", ""},
    {"from = \"rotor\"", "from = \"motor\"", "motor", "torsional_spring.shaft.from", "no pulley or body 'motor'", ""},
    {"to = \"idler_2\"", "to = \"rotor\"", "to = \"rotor\"", "torsional_spring.shaft.to", "at both ends", "different"},
    {"gear = \"crank\"", "gear = \"rotor\"", "gear = \"rotor\"", "gear_pair.mesh.gear", "at both ends", ""},
    {"gear = \"crank\"", "gear = \"krank\"", "krank", "gear_pair.mesh.gear", "did you mean 'crank'?", ""},
    {"body = \"idler_2\"", "body = \"x\"", "body = \"x\"", "torque.load.body", "no pulley or body 'x'",
     "idler_2, rotor"},
    {"body = \"idler_2\"", "body = \"idler_2\"\nreferred_to = \"x\"", "referred_to", "torque.load.referred_to",
     "no ", ""},
    {"spring = \"shaft\"", "spring = \"saft\"", "saft", "output.spring", "did you mean 'shaft'?", "shaft"},
    {"spring = \"shaft\"\n", "", "body = \"rotor\"", "output.body", "no pulley 'rotor'", "crank, idler_2"},
    {"[0, 1000, 2000]", "[0, 2000, 2000]", "speeds_rpm = [0", "torque.load.speeds_rpm.2", "does not exceed", "increas"},
    {"[10, 20]", "[10]", "[10]", "driver.harmonic.order_3.amplitudes_rpm", "has 1 entries, speeds_rpm has 2", ""},
    {"unstretched_length_mm = 1500\n", "", "[belt]", "belt.unstretched_length_mm", "0 of four ways", "exactly one"},
    {"_mm = 1500", "_mm = 1500\npretension_n = 9", "unstretched", "belt.unstretched_length_mm", "2 of four ways", ""},
    {"_mm = 1500", "_mm = 1500\neffective_length_mm = 1490\neffective_line_differential_mm = 2", "unstretched",
     "belt.unstretched_length_mm", "2 of four ways", "effective_length_mm"},
    {"unstretched_length_mm = 1500", "effective_length_mm = 1490", "[belt]", "belt.effective_line_differential_mm",
     "belt.effective_length_mm is an effective value", "PK"},
    {"_mm = 1500", "_mm = 1500\nmeasuring_tension_n = 300", "measuring", "belt.measuring_tension_n",
     "no effective length", "effective_length_mm"},
    {"pitch_diameter_mm = 80\n", "", "[[pulley]]\nname = \"idler_2\"", "pulley.idler_2.pitch_diameter_mm",
     "missing key", "exactly one of pitch_diameter_mm, effective_diameter_mm"},
    {"pitch_diameter_mm = 80", "effective_diameter_mm = 76", "[belt]", "belt.effective_line_differential_mm",
     "pulley.idler_2.effective_diameter_mm is an effective value", "PK"},
    {"pitch_diameter_mm = 80", "effective_diameter_mm = 76\npitch_diameter_mm = 80", "effective",
     "pulley.idler_2.effective_diameter_mm", "given too", "exactly one"},
    {"pitch_diameter_mm = 80\nside = \"front\"", "effective_diameter_mm = 76\nside = \"back\"", "effective",
     "pulley.idler_2.effective_diameter_mm", "on the belt's back", "outside diameter plus twice"},
    {"body = \"crank\"", "body = \"krank\"", "krank", "driver.body", "did you mean 'crank'?", "crank, idler_2, rotor"},
    {"y_mm = 0\n", "y_mm = 0\nlocked = true\n", "body = \"crank\"", "driver.body", "'crank' is locked", "can turn"},
    {"duty_share = 0.25", "duty_share = 0.24", "[[range]]", "range", "sum to 0.99", "1"},
    {"evaluate_s = 1", "evaluate_s = 0.005", "evaluate_s", "profile.evaluate_s", "hold 5 samples at 1000 Hz", "at least 8"},
    {"evaluate_s = 1", "evaluate_s = 2.5", "evaluate_s", "profile.evaluate_s", "longer than the hold", "hold_s"},
    {"evaluate_s = 1", "evaluate_s = 1.2\nsettled_within = 0.01", "settled", "profile.settled_within", "no two stretches",
     "half of hold_s"},
    {"_x_mm = 450\npivot_y_mm = 50", "_x_mm = 500\npivot_y_mm = 0", "_x_mm = 500\n", "tensioner.pivot_x_mm", "pivot",
     ""},
  };
  // clang-format on
  for (const Mistake& mistake : mistakes) {
    const std::string text = replaced(small_scene, mistake.right, mistake.wrong);
    const auto problems = problems_of(text);
    const auto found = std::find_if(problems.begin(), problems.end(), [&](const Problem& problem) {
      return problem.key == mistake.key && problem.what.find(mistake.what) != problem.what.npos;
    });
    ASSERT_NE(found, problems.end()) << mistake.wrong << "\n" << message_of([&] { (void)parse_scene(text, "t"); });
    EXPECT_EQ(found->line, line_of(text, mistake.at)) << mistake.wrong;
    EXPECT_EQ(found->file, "test.toml");
    EXPECT_NE(found->allowed.find(mistake.allowed), found->allowed.npos) << found->allowed;
    EXPECT_LE(problems.size(), 2u) << "one mistake must not set off a cascade: " << mistake.wrong;
  }
}

TEST(ReadScene, LocatesASecondUseOfANameAtTheSecondPlace) {
  const std::string pulley = replaced(small_scene, "\"idler_2\"\nx_mm", "\"crank\"\nx_mm");
  EXPECT_EQ(problems_of(pulley).at(0).key, "pulley.crank.name");
  EXPECT_EQ(problems_of(pulley).at(0).line, line_of(pulley, "\"crank\"\nx_mm = 500"));
  const std::string body = replaced(small_scene, "name = \"rotor\"", "name = \"crank\"");
  EXPECT_EQ(problems_of(body).at(0).key, "body.crank.name");
  EXPECT_EQ(problems_of(body).at(0).line, line_of(body, "\"crank\"\ninertia"));
}

TEST(ReadScene, ReportsAllProblemsAtOnceInTheOrderOfTheLines) {
  std::string text = replaced(small_scene, "ribs = 6", "ribs = 600");
  text = replaced(text, "x_mm = 500", "x_mm = \"far\"");
  text = replaced(text, "gear = \"crank\"", "gear = \"nobody\"");
  text = replaced(text, "evaluate_s = 1", "evaluate_s = 3\nunknown = 1");
  const auto problems = problems_of(text);
  std::vector<std::string> keys;
  for (const Problem& problem : problems) keys.push_back(problem.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"belt.ribs", "pulley.idler_2.x_mm", "gear_pair.mesh.gear",
                                            "profile.evaluate_s", "profile.unknown"}));
}

TEST(ReadScene, TakesIntegersWhereNumbersAreWanted) {
  EXPECT_EQ(parse_scene(small_scene, "small").pulley[1].x_mm, 500.0);
}

TEST(ReadScene, RingsDrivesAndTensionersNeedWhatTheyNeed) {
  const std::string ring =
      "format = 1\n[belt]\nunstretched_length_mm = 1000\naxial_stiffness_n = 1e5\nmass_kg_per_m = 0.1\n"
      "ribs = 6\nfriction_front = 0\nfriction_back = 0\n";
  EXPECT_TRUE(problems_of(ring + "[ring]\nspeed_rad_s = 10\n").empty());
  EXPECT_EQ(problems_of(ring).at(0).key, "pulley");
  EXPECT_EQ(
      problems_of(replaced(ring, "unstretched_length_mm", "pretension_n") + "[ring]\nspeed_rad_s = 1\n").at(0).key,
      "belt.pretension_n");
  EXPECT_EQ(problems_of(small_scene + "[ring]\nspeed_rad_s = 1\n").at(0).key, "pulley");
  EXPECT_EQ(problems_of(ring + "[ring]\nspeed_rad_s = 1\n[[range]]\nname = \"a\"\ncrank_rpm = 1\n").at(0).key,
            "driver");
  const auto problems = problems_of(replaced(ring, "unstretched_length_mm = 1000", "balanced_as_placed = true"));
  EXPECT_EQ(problems.at(1).key, "belt.balanced_as_placed");
  EXPECT_EQ(problems.at(1).line, 3);
}

TEST(ReadScene, PrintsAProblemAsCompilersDo) {
  EXPECT_EQ(to_string({"a.toml", 3, "belt.ribs", "is wrong", "from 1 to 9"}),
            "a.toml:3: belt.ribs: is wrong (allowed: from 1 to 9)");
  EXPECT_EQ(to_string({"a.toml", 0, "", "no such file", ""}), "a.toml: no such file");
}

// ---------------------------------------------------------------- texts and files that are no scenes

TEST(ReadScene, RefusesTextsThatAreNoScene) {
  const std::string embedded_nul = small_scene.substr(0, 100) + std::string(1, '\0') + small_scene.substr(100);
  std::string binary(4096, '\0');
  std::mt19937 random(2);
  for (char& c : binary) c = static_cast<char>(random());
  std::string deep = "a";
  for (int i = 0; i < 2000000; ++i) deep += ".a";  // would overflow the stack if it reached the parser
  for (const std::string& text :
       {std::string{}, std::string(" \n\n"), embedded_nul, binary, deep + " = 1", std::string(100000, '['),
        std::string(max_toml_bytes + 1, '\n'), std::string("\xff\xfe")}) {
    EXPECT_FALSE(problems_of(text).empty()) << text.substr(0, 40);
  }
  EXPECT_EQ(problems_of(replaced(small_scene, "ribs = 6", "ribs = = 6")).at(0).line, 7);
  EXPECT_EQ(problems_of(replaced(small_scene, "[[body]]", "[ = 1")).at(0).line, line_of(small_scene, "[[body]]"))
      << "here toml++ 3.3 asserts instead of refusing";
}

TEST(ReadScene, RefusesOrReadsButNeverCrashesOnATruncatedFile) {
  const std::string text = read_text(std::filesystem::path(BELTLIFE_SCENES) / "baseline.toml");
  for (std::size_t size = 0; size < text.size(); size += 13) {
    const bool refused = !problems_of(text.substr(0, size)).empty();  // cut after a table, a file may be a scene still
    EXPECT_TRUE(refused || size > text.find("name = \"idler_2\"")) << size;
  }
}

TEST(ReadScene, SaysWhatIsWrongWithAFileItCannotRead) {
  const auto message = [](const std::filesystem::path& path) { return message_of([&] { (void)read_scene(path); }); };
  EXPECT_EQ(message("/nowhere/scene.toml"), "/nowhere/scene.toml: no such file");
  EXPECT_NE(message(BELTLIFE_SCENES).find("is a directory"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("too large"), std::string::npos);
  EXPECT_NE(message("/dev/null").find("format: missing key"), std::string::npos);
}

}  // namespace
}  // namespace beltlife
