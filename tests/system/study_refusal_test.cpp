// Owns the claims about study files that are refused: exit code 2, file, line, key and what is allowed, nothing
// written.
#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

/// A study file with something wrong, the line that has to be named (0: the message stands for the whole file), and
/// what has to be said.
struct Mistake {
  const char* kind;
  std::string text;
  int line;
  std::vector<std::string> says;
};

/// Beginnings of study files, of one line, of three lines, of two lines.
const std::string drive = "scene = \"drive.toml\"\n";
const std::string program = "quantities = [\"y\"]\n[command]\nrun = [\"true\"]\n";
const std::string friction = "[[parameter]]\npath = \"belt.friction_front\"\n";

class StudyRefusal : public InStudyFolder {
 protected:
  void SetUp() override {
    InStudyFolder::SetUp();
    fs::create_directory(folder / "in");  // not where the command runs: paths in a study file are relative to it
    fs::rename(folder / "drive.toml", folder / "in/drive.toml");
  }
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& says) const {
    const Answer answer = run(Arguments{"study"} + arguments);
    EXPECT_EQ(answer.code, 2) << testing::PrintToString(arguments) << answer.err;
    EXPECT_EQ(answer.out, "");
    for (const std::string& part : says)
      EXPECT_NE(answer.err.find(part), answer.err.npos) << part << "\n" << answer.err;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string ending = entry.path().extension();
      EXPECT_FALSE(ending == ".h5" || ending == ".jsonl") << entry.path() << " was written";
    }
  }
  void expect_refused(const std::vector<Mistake>& mistakes) const {
    for (const Mistake& mistake : mistakes) {
      SCOPED_TRACE(mistake.text);
      write("in/wrong.toml", mistake.text);
      auto says = mistake.says;
      if (mistake.line > 0) says.push_back("in/wrong.toml:" + std::to_string(mistake.line) + ": ");
      expect_refused(Arguments{mistake.kind, "in/wrong.toml", "--quiet"}, says);
    }
  }
};

TEST_F(StudyRefusal, NamesUnknownKeysAndWhatWasMeant) {
  expect_refused({
      {"noise", drive + "qantities = []\n", 2, {"qantities: unknown key", "did you mean 'quantities'?", "allowed: "}},
      {"noise", drive + "zzz = 1\n", 2, {"zzz: unknown key", "allowed: format, scene, command"}},
      {"noise", drive + friction + "lowr = 0.1\n", 4, {"parameter.0.lowr: unknown key", "did you mean 'lower'?"}},
      {"noise",
       drive + friction + "[parameter.distribution]\nkind = \"normal\"\nmen = 1\nstandard_deviation = 1\n",
       6,
       {"parameter.0.distribution.men: unknown key", "did you mean 'mean'?"}},
      {"noise", drive + "[study]\nfases = 1\n", 3, {"study.fases: unknown key", "did you mean 'phases'?"}},
      {"convergence", drive + "[study]\nseed = 1\n", 3, {"study.seed: unknown key", "allowed: ranges, schemes"}},
      {"stability", drive + "[[study.extrem]]\nname = \"a\"\n", 2, {"study.extrem: unknown key", "'extreme'"}},
      {"noise", program + "timout_s = 1\n" + friction, 4, {"command.timout_s: unknown key", "'timeout_s'"}},
  });
}

TEST_F(StudyRefusal, NamesWrongTypesAndNumbersOutOfLimits) {
  expect_refused({
      {"noise", "format = 2\n" + drive, 1, {"format: 2 is out of limits", "allowed: 1"}},
      {"noise", "scene = 5\n", 1, {"scene: found integer 5, wanted text"}},
      {"noise", drive + "parameter = 5\n", 2, {"parameter: found integer 5", "[[parameter]]"}},
      {"noise", drive + "[parameter]\npath = \"belt.ribs\"\n", 2, {"parameter: found a table", "[[parameter]]"}},
      {"noise", drive + "study = 5\n", 2, {"study: found integer 5, wanted a table"}},
      {"noise", drive + "quantities = \"y\"\n", 2, {"quantities: found text \"y\", wanted an array"}},
      {"noise", drive + "quantities = [5]\n", 2, {"quantities.0: found integer 5, wanted text"}},
      {"noise", drive + friction + "lower = \"low\"\n", 4, {"parameter.0.lower: found text \"low\", wanted a number"}},
      {"noise", drive + friction + "lower = nan\n", 4, {"parameter.0.lower: nan is not a finite number"}},
      {"noise", drive + friction + "upper = inf\n", 4, {"parameter.0.upper: inf is not a finite number"}},
      {"noise", drive + friction + "log = 1\n", 4, {"parameter.0.log: found integer 1", "true or false"}},
      {"noise", drive + "step_budget = 0\n", 2, {"step_budget: 0 is out of limits", "above 0"}},
      {"noise", drive + "step_budget = nan\n", 2, {"step_budget: nan is not a finite number"}},
      {"noise", program + "timeout_s = 0\n" + friction, 4, {"command.timeout_s: 0 is out of limits", "above 0"}},
      {"noise", program + "timeout_s = -3\n" + friction, 4, {"command.timeout_s: -3 is out of limits"}},
      {"noise", drive + "[study]\nphases = 1e3\n", 3, {"study.phases: found number 1000", "wanted an integer"}},
      {"noise", drive + "[study]\nseed = -1\n", 3, {"study.seed: -1 is out of limits", "from 0"}},
      {"noise", drive + "[study]\nline_points = 3\n", 3, {"study.line_points: 3 is out of limits", "from 4 to 100"}},
      {"noise", drive + "[study]\nramp_factors = [1, 0]\n", 3, {"study.ramp_factors.1: 0 is out of limits"}},
      {"stability", drive + "[study]\nschemes = [\"rk4\"]\n", 3, {"study.schemes.0: \"rk4\"", "thesis, symplectic"}},
      {"convergence", drive + "[study]\nrepeats = 0\n", 3, {"study.repeats: 0 is out of limits", "from 1"}},
  });
}

TEST_F(StudyRefusal, NamesWhatIsWrongWithSceneAndCommand) {
  expect_refused({
      {"noise", "", 1, {"scene: missing", "exactly one of scene, [command]"}},
      {"noise", drive + "[command]\nrun = [\"true\"]\n", 2, {"command: the file gives a scene as well", "exactly one"}},
      {"noise", "scene = \"none.toml\"\n", 0, {"there is no file in/none.toml"}},
      {"noise", "scene = \"\"\n", 1, {"scene: names no file"}},
      {"noise", "scene = \".\"\n", 0, {"is a directory"}},
      {"noise", "\n[command]\nrun = []\n", 3, {"command.run: names no program", "quantities: missing"}},
      {"noise",
       "[command]\nrun = [\"true\"]\n" + friction,
       1,
       {"quantities: missing", "names of the command's answer"}},
      {"noise", program, 1, {"parameter: missing: there is nothing to perturb", "[[parameter]]"}},
      {"noise", program + "[[parameter]]\npath = \"x\"\nlower = 1\n", 4, {"parameter.0.start: missing", "both bounds"}},
      {"convergence", program, 1, {"scene: missing: schemes and meshes are those of the embedded simulator"}},
      {"stability", program, 1, {"scene: missing: steps are those of the embedded simulator"}},
  });
  write("in/bad.toml", replaced(small_drive(), "ribs = 6", "ribs = 600"));
  expect_refused({{"noise", "scene = \"bad.toml\"\n", 0, {"in/bad.toml:", "belt.ribs: 600 is out of limits"}}});
}

TEST_F(StudyRefusal, NamesParametersThatCannotBeVaried) {
  const std::string stiffness = "[[parameter]]\npath = \"belt.axial_stiffness_n\"\n";
  expect_refused({
      {"noise", drive + "[[parameter]]\nlower = 1\n", 2, {"parameter.0.path: missing key"}},
      {"noise", drive + "[[parameter]]\npath = \"\"\n", 3, {"parameter.0.path: is empty"}},
      {"noise",
       drive + "[[parameter]]\npath = \"belt.frction_front\"\n",
       3,
       {"parameter.0.path: belt.frction_front no such field", "did you mean 'belt.friction_front'?"}},
      {"noise", drive + "[[parameter]]\npath = \"pulley.driven.side\"\n", 3, {"is not a number but front or back"}},
      {"noise", drive + "[[parameter]]\npath = \"tensioner.mass_kg\"\n", 3, {"there is no table [tensioner]"}},
      {"noise", drive + friction + friction, 5, {"parameter.1.path: 'belt.friction_front' stands here twice"}},
      {"noise", drive + friction + "lower = 1\nupper = 0.5\n", 4, {"parameter.0.lower: 1 is not below upper (0.5)"}},
      {"noise", drive + friction + "lower = 0.5\nupper = 0.5\n", 4, {"parameter.0.lower: 0.5 is not below upper"}},
      {"noise",
       drive + friction + "lower = 0.5\nupper = 0.6\nstart = 0.7\n",
       6,
       {"parameter.0.start: 0.7 is not between the bounds", "from 0.5 to 0.6"}},
      {"noise", drive + friction + "log = true\nupper = 1\n", 2, {"parameter.0.lower: log = true needs a positive"}},
      {"noise", drive + friction + "log = true\nlower = 0\nupper = 1\n", 5, {"parameter.0.lower: log = true needs"}},
      {"noise", drive + friction + "log = true\nlower = -1\nupper = 1\n", 5, {"parameter.0.lower: log = true needs"}},
      {"noise",
       drive + stiffness + "lower = -1\n",
       4,
       {"parameter.0.lower: belt.axial_stiffness_n: -1 is out of", "above"}},
      {"noise",
       drive + "[[parameter]]\npath = \"profile.ramp_s\"\n",
       3,
       {"varied by this study itself", "ramp_factors"}},
      {"convergence", drive + friction, 2, {"parameter: this kind of study varies scheme, mesh and step only"}},
      {"stability", drive + friction, 2, {"parameter: this kind of study has none", "[[study.variation]]"}},
  });
}

TEST_F(StudyRefusal, NamesDistributionsThatLackTheirNumbers) {
  const auto scatter = [](const std::string& d) { return drive + friction + "distribution = {" + d + "}\n"; };
  expect_refused({
      {"noise", scatter("kind = \"gauss\""), 4, {"distribution.kind: \"gauss\"", "uniform, normal, lognormal"}},
      {"noise",
       scatter("kind = \"normal\", standard_deviation = 1"),
       4,
       {"distribution.mean: missing: normal needs it"}},
      {"noise",
       scatter("kind = \"normal\", mean = 1"),
       4,
       {"distribution.standard_deviation: missing: normal needs it"}},
      {"noise", scatter("kind = \"normal\", mean = 1, standard_deviation = -1"), 4, {"deviation: -1 is out of limits"}},
      {"noise", scatter("kind = \"normal\", mean = 1, standard_deviation = 1, mode = 1"), 4, {"mode: normal has none"}},
      {"noise", scatter("kind = \"lognormal\", mean = -2, standard_deviation = 1"), 4, {"mean: -2 is out of limits"}},
      {"noise", scatter("kind = \"uniform\""), 4, {"distribution.kind: uniform needs the parameter's bounds"}},
      {"noise", scatter(""), 4, {"uniform needs the parameter's bounds", "lower and upper"}},
      {"noise", scatter("mean = 1") + "lower = 0\nupper = 2\n", 4, {"distribution.mean: uniform has none"}},
      {"noise",
       scatter("kind = \"triangular\", mode = 2") + "lower = 0\nupper = 1\n",
       4,
       {"distribution.mode: 2 is not between the parameter's bounds"}},
  });
}

TEST_F(StudyRefusal, NamesQuantitiesRangesAndCasesThatAreNone) {
  expect_refused({
      {"noise", drive + "quantities = [\"log10_lif_h\"]\n", 2, {"no quantity 'log10_lif_h'", "'log10_life_h'?"}},
      {"noise", drive + "quantities = [\"log10_life_h\", \"log10_life_h\"]\n", 2, {"'log10_life_h' stands here twice"}},
      {"noise", drive + "quantities = [\"\"]\n", 2, {"quantities: a quantity has no name"}},
      {"noise", drive + "[study]\nramp_factors = []\n", 3, {"study.ramp_factors: is empty"}},
      {"convergence", drive + "[study]\nelements = []\n", 3, {"study.elements: is empty", "at least one"}},
      {"convergence", drive + "[study]\nschemes = []\n", 3, {"study.schemes: is empty"}},
      {"convergence", drive + "[study]\nelements = [100]\n", 3, {"multiple of 8", "not 100", "96 or 104"}},
      {"convergence", drive + "[study]\nranges = [\"slwo\"]\n", 3, {"no range 'slwo'", "'slow'?", "slow, fast"}},
      {"convergence",
       drive + "quantities = [\"fast.log10_life_h\"]\n[study]\nranges = [\"slow\"]\n",
       2,
       {"quantities: none is of the ranges that are run"}},
      {"stability", drive + "[study]\nrange = \"slwo\"\n", 3, {"study.range: no range 'slwo'", "'slow'?"}},
      {"stability",
       drive + "[[study.variation]]\npath = \"belt.elements\"\n",
       2,
       {"study.variation.0: has neither values nor factors"}},
      {"stability", drive + "[[study.variation]]\nvalues = [1]\n", 2, {"study.variation.0.path: missing key"}},
      {"stability",
       drive + "[[study.variation]]\npath = \"belt.elemnts\"\nvalues = [64]\n",
       3,
       {"study.variation.0.path: belt.elemnts: no such field", "'belt.elements'?"}},
      {"stability",
       drive + "[[study.variation]]\npath = \"belt.friction_front\"\nfactors = [-1]\n",
       3,
       {"belt.friction_front: -0.6 is out of limits"}},
      {"stability", drive + "[[study.extreme]]\nset = [\"belt.ribs=1\"]\n", 2, {"study.extreme.0.name: missing key"}},
      {"stability",
       drive + "[[study.extreme]]\nname = \"a\"\nset = [\"belt.x=1\"]\n",
       4,
       {"set: belt.x: no such field"}},
  });
}

TEST_F(StudyRefusal, ListsAllProblemsAtOnceInTheOrderOfTheFile) {
  write("in/wrong.toml", drive + "quantities = [\"log10_lif_h\"]\n" + friction + "lower = 2\nupper = 1\n" +
                             "[[parameter]]\npath = \"belt.rib\"\n[study]\nfases = 2\n");
  const Answer answer = run({"study", "noise", "in/wrong.toml"});
  EXPECT_EQ(answer.code, 2);
  std::size_t from = 0;
  for (const char* part :
       {":2: quantities: ", ":5: parameter.0.lower: ", ":8: parameter.1.path: ", ":10: study.fases: "}) {
    from = answer.err.find(part, from);
    ASSERT_NE(from, answer.err.npos) << part << "\n" << answer.err;
  }
  // Problems of the scene join those of the study.
  write("in/bad.toml", replaced(small_drive(), "ribs = 6", "ribs = 600"));
  expect_refused({{"noise", "scene = \"bad.toml\"\n[study]\nphases = 0\n", 3, {"belt.ribs", "study.phases"}}});
}

TEST_F(StudyRefusal, HoldsForThingsThatAreNoStudyFile) {
  fs::create_directory(folder / "folder.toml");
  expect_refused({"noise", "folder.toml"}, {"folder.toml: is a directory"});
  expect_refused({"noise", "none.toml"}, {"none.toml: no such file"});
  write("huge.toml", drive + "#" + std::string(5u << 20, 'x'));
  expect_refused({"noise", "huge.toml"}, {"huge.toml: the file is too large", "at most"});
  write("nul.toml", std::string("format = 1\n\0\0\0", 14));
  expect_refused({"noise", "nul.toml"}, {"nul.toml:2: not TOML"});
  write("binary.toml", text_of(BELTLIFE_COMMAND).substr(0, 100000));
  expect_refused({"noise", "binary.toml"}, {"binary.toml:"});
  expect_refused({{"noise", drive + "[study\n", 2, {"not TOML"}},
                  {"noise", drive + drive, 2, {"not TOML", "scene"}},
                  {"stability", "phases: 4\n", 1, {"not TOML"}}});
  // A scene is no study.
  expect_refused({"noise", "in/drive.toml"}, {"in/drive.toml:", "belt: unknown key", "scene: missing"});
}

TEST_F(StudyRefusal, CoversSettingsAndFlags) {
  write("in/good.toml", drive);
  write("in/program.toml", program + "[[parameter]]\npath = \"x\"\nstart = 1\n");
  expect_refused({"noise", "in/good.toml", "--set", "belt.rib=5"}, {"--set: belt.rib", "did you mean 'belt.ribs'?"});
  expect_refused({"noise", "in/good.toml", "--set", "belt.ribs"}, {"--set: belt.ribs", "PATH=VALUE"});
  expect_refused({"noise", "in/program.toml", "--set", "belt.ribs=5"},
                 {"--set: belt.ribs=5", "the study has no scene"});
  expect_refused({"noise", "in/program.toml", "--elements", "64"}, {"--set: belt.elements=64", "has no scene"});
  expect_refused({"noise", "in/good.toml", "--elements", "100"}, {"belt.elements", "a multiple of 8"});
  expect_refused({"noise", "in/good.toml", "--out", "none/x.h5"}, {"none/x.h5: there is no folder none"});
  expect_refused({"noise", "in/good.toml", "--out", "in"}, {"in: is a directory"});
  for (const Arguments& usage :
       {Arguments{"study"}, Arguments{"study", "noise"}, Arguments{"study", "nois", "in/good.toml"},
        Arguments{"study", "noise", "in/good.toml", "--seed", "x"},
        Arguments{"study", "noise", "in/good.toml", "--range", "slow"}})
    EXPECT_EQ(run(usage).code, 1) << testing::PrintToString(usage);
  const Answer log = run({"study", "noise", "in/good.toml", "--out", "x.jsonl"});
  EXPECT_EQ(log.code, 2);
  EXPECT_NE(log.err.find("is the name of the log"), log.err.npos) << log.err;
}

}  // namespace
}  // namespace beltlife::system_test
