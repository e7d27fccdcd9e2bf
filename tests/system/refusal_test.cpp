// Owns the claims about what the command refuses: exit code 1 for usage, 2 for bad input; said on standard error with
// file, line, key and what is allowed; nothing on standard output and nothing written.
#include <algorithm>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

TEST_F(InFolder, WrongUsageEndsWithOneAndPointsToTheHelp) {
  const std::string drive = scene("two_pulley");
  for (const Arguments& arguments :
       {Arguments{}, Arguments{"simulat", drive}, Arguments{"simulate"}, Arguments{"life"},
        Arguments{"simulate", drive, "--steps", "1"}, Arguments{"check", drive, "--out", "x.h5"},
        Arguments{"simulate", drive, "--out"}, Arguments{"simulate", drive, "--out", ""},
        Arguments{"simulate", drive, "--threads", "-1"}, Arguments{"simulate", drive, "--threads", "two"},
        Arguments{"simulate", drive, "--threads", "99999999999999999999"}, Arguments{"simulate", drive, drive},
        Arguments{"life", drive, "--flank-for", "0"}, Arguments{"life", drive, "--flank-for", "nan"},
        Arguments{"--json"}}) {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.code, 1) << testing::PrintToString(arguments) << answer.err;
    EXPECT_EQ(answer.out, "") << testing::PrintToString(arguments);
    EXPECT_NE(answer.err.find("--help"), answer.err.npos) << answer.err;
    EXPECT_LT(answer.err.size(), 2000u) << answer.err;
  }
  EXPECT_TRUE(files().empty());
}

/// A scene with one thing wrong, and what must be said about it.
struct Mistake {
  std::string right, wrong;
  std::string said_at;  ///< text whose line is named
  std::vector<std::string> says;
};

int line_of(const std::string& text, const std::string& part) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(part)), '\n'));
}

class Refusal : public InFolder {
 protected:
  // Every command refuses alike, whatever else it is asked for.
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& says) const {
    const auto before = files();
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.code, 2) << testing::PrintToString(arguments) << answer.err;
    EXPECT_EQ(answer.out, "") << testing::PrintToString(arguments);
    for (const std::string& part : says)
      EXPECT_NE(answer.err.find(part), answer.err.npos) << part << "\n" << answer.err;
    EXPECT_EQ(files(), before) << "something was written";
  }
  void expect_refused_by_all(const std::string& scene_file, const std::vector<std::string>& says) const {
    expect_refused({"check", scene_file, "--json"}, says);
    expect_refused({"simulate", scene_file, "--json", "--out", "x.h5"}, says);
    expect_refused({"life", scene_file, "--json", "--out", "x.h5"}, says);
  }
};

TEST_F(Refusal, NamesFileLineKeyAndWhatIsAllowed) {
  const std::string good = text_of(scene("two_pulley"));
  const Mistake mistakes[] = {
      {"mass_kg_per_m = 0.3",
       "mass_kg_m = 0.3",
       "mass_kg_m",
       {"belt.mass_kg_m", "did you mean 'mass_kg_per_m'?", "allowed: "}},
      {"mass_kg_per_m = 0.3", "", "[belt]", {"belt.mass_kg_per_m", "missing key", "above 0"}},
      {"mass_kg_per_m = 0.3",
       "mass_kg_per_m = \"0.3 kg\"",
       "mass_kg_per_m",
       {"belt.mass_kg_per_m", "text \"0.3 kg\"", "number"}},
      {"mass_kg_per_m = 0.3",
       "mass_kg_per_m = nan",
       "mass_kg_per_m",
       {"belt.mass_kg_per_m", "nan is not a finite number"}},
      {"mass_kg_per_m = 0.3", "mass_kg_per_m = inf", "mass_kg_per_m", {"belt.mass_kg_per_m", "not a finite number"}},
      {"mass_kg_per_m = 0.3",
       "mass_kg_per_m = 1e300",
       "mass_kg_per_m",
       {"belt.mass_kg_per_m", "out of limits", "at most 100"}},
      {"mass_kg_per_m = 0.3",
       "mass_kg_per_m = -0.3",
       "mass_kg_per_m",
       {"belt.mass_kg_per_m", "-0.3 is out of limits", "above 0"}},
      {"elements = 264", "elements = 264.5", "elements", {"belt.elements", "wanted an integer", "from 16 to 20000"}},
      {"elements = 264", "elements = 3", "elements", {"belt.elements", "3 is out of limits", "from 16 to 20000"}},
      {"name = \"driven\"",
       "name = \"driver\"",
       "name = \"driver\"\nx_mm = 500",
       {"pulley.driver.name", "another pulley", "unique"}},
      {"body = \"driven\"\nspeeds",
       "body = \"drivn\"\nspeeds",
       "drivn",
       {"torque.load.body", "'drivn'", "did you mean 'driven'?"}},
      {"duty_share = 0.6", "duty_share = 0.7", "[[range]]", {"range", "sum to 1.1", "allowed: 1"}},
      {"format = 1", "format = 2", "format", {"format", "2 is out of limits", "allowed: 1"}},
      {"[belt]", "[belt", "[belt", {"not TOML"}},
      {"x_mm = 500 ", "x_mm = 50 ", "x_mm = 50 ", {"pulleys driver and driven overlap by 50.0 mm"}},
      {"x_mm = 500 ", "x_mm = 0.0 ", "x_mm = 0.0 ", {"pulleys driver and driven overlap by 100.0 mm"}},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.wrong);
    const std::string text = replaced(good, mistake.right, mistake.wrong);
    write("wrong.toml", text);
    auto says = mistake.says;
    says.push_back("wrong.toml:" + std::to_string(line_of(text, mistake.said_at)) + ": ");
    expect_refused_by_all("wrong.toml", says);
  }
}

TEST_F(Refusal, ListsAllProblemsAtOnce) {
  std::string text = replaced(text_of(scene("two_pulley")), "ribs = 6", "ribs = 600");
  text = replaced(text, "name = \"fast\"", "name = \"slow\"");
  text = replaced(text, "[fatigue]", "[fatige]");
  write("wrong.toml", text);
  expect_refused_by_all("wrong.toml", {"belt.ribs", "range.slow.name", "fatige"});
}

TEST_F(Refusal, HoldsForThingsThatAreNoSceneFile) {
  fs::create_directory(folder / "folder.toml");
  expect_refused_by_all("folder.toml", {"folder.toml: is a directory"});
  expect_refused_by_all("none.toml", {"none.toml: no such file"});
  write("empty.toml", "");
  expect_refused_by_all("empty.toml", {"empty.toml:1: ", "format: missing key"});
  write("binary.toml", text_of(BELTLIFE_COMMAND).substr(0, 200000));
  expect_refused_by_all("binary.toml", {"binary.toml:"});
  write("nul.toml", std::string("format = 1\n\0\0\0", 14));
  expect_refused_by_all("nul.toml", {"nul.toml:2: not TOML"});
  const std::string whole = text_of(scene("baseline"));
  write("cut.toml", whole.substr(0, whole.find("speeds_rpm") + 15));
  expect_refused_by_all("cut.toml", {"cut.toml:", "not TOML"});
  // Cut between two tables late in the file, a scene may be a whole one of a simpler drive. No cut crashes the command.
  for (std::size_t share = 0; share < 24; ++share) {
    write("cut.toml", whole.substr(0, whole.size() * share / 24));
    const Answer answer = run({"check", "cut.toml"});
    EXPECT_TRUE(answer.code == 0 || answer.code == 2) << share << ": " << answer.code << answer.err;
  }
}

TEST_F(Refusal, CoversSettingsAndFlags) {
  const std::string drive = scene("two_pulley");
  const auto refuse = [&](const Arguments& more, const std::vector<std::string>& says) {
    expect_refused(Arguments{"simulate", drive, "--json", "--out", "x.h5"} + more, says);
  };
  refuse({"--set", "belt.ribs"}, {"--set: belt.ribs", "allowed: PATH=VALUE"});
  refuse({"--set", ""}, {"--set", "PATH=VALUE"});
  refuse({"--set", "belt.rib=5"}, {"--set: belt.rib:", "did you mean 'belt.ribs'?"});
  refuse({"--set", "belt.ribs=many"}, {"--set: belt.ribs", "from 1 to 100"});
  refuse({"--set", "belt.ribs=nan"}, {"--set: belt.ribs", "from 1 to 100"});
  refuse({"--set", "tensioner.mass_kg=1"}, {"tensioner.mass_kg", "there is no table [tensioner]"});
  refuse({"--set", "pulley.driver.x_mm=450"}, {"pulleys driver and driven overlap by 50.0 mm"});
  refuse({"--scheme", "rk4"}, {"solver.scheme", "thesis, symplectic_euler"});
  refuse({"--step", "0"}, {"solver.step_s", "above 0, at most 0.01"});
  refuse({"--step", "1e-4"}, {"solver.step_s: 0.0001 s is longer than the limit of belt entry", "or --force"});
  refuse({"--step", "1e-5", "--scheme", "symplectic_euler"}, {"solver.step_s", "longer than the limit of", "at most"});
  refuse({"--elements", "100"}, {"belt.elements", "a multiple of 8", "96 or 104, or another solver.scheme"});
  refuse({"--elements", "1e9"}, {"belt.elements", "from 16 to 20000"});
  refuse({"--range", "slwo"}, {"--range: slwo", "allowed: slow, fast"});
  expect_refused({"life", drive, "--range", "slwo"}, {"--range: slwo", "allowed: slow, fast"});
  expect_refused({"life", scene("spinning_ring")}, {"spinning_ring.toml: range", "at least one [[range]]"});
}

TEST_F(Refusal, CoversResultFilesThatCannotBeWritten) {
  fs::create_directory(folder / "folder");
  write("file", "");
  for (const char* command : {"simulate", "life"}) {
    const Arguments start{command, scene("two_pulley"), "--out"};
    expect_refused(start + Arguments{"none/x.h5"}, {"none/x.h5: there is no folder none", "existing folder"});
    expect_refused(start + Arguments{"folder"}, {"folder: is a directory", "a file name inside it"});
    expect_refused(start + Arguments{"folder/"}, {"names no file"});
    expect_refused(start + Arguments{"file/x.h5"}, {"file is not a folder"});
    expect_refused(start + Arguments{"/dev/null"}, {"/dev/null: exists and is not a regular file"});
  }
  expect_refused({"life", scene("two_pulley"), "--details", "none/d.txt"}, {"none/d.txt"});
}

}  // namespace
}  // namespace beltlife::system_test
