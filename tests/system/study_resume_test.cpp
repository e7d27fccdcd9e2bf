// Owns the claims about studies that are stopped: killed, interrupted, out of disk; and about logs of other studies.
#include <map>
#include <set>

#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

/// Five packs of lanes and more, so that there is a middle to be killed in.
const std::string long_study =
    "scene = \"drive.toml\"\nquantities = [\"fast.pulley.driven.hub_load_n.mean\"]\n[study]\nphases = 16\nramp_factors "
    "= "
    "[0.8, 1, 1.25]\nperturbations = 3\nline_points = 4\n";

const std::string program_study =
    "quantities = [\"y\"]\n[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\nstart = 2\n"
    "[study]\nperturbations = 16\nline_points = 6\n";
const char* const doubled = "printf \"{\\\"y\\\": %.17g}\", 2 * x";

using StudyResume = InStudyFolder;

/// Whole lines: the last may be cut short by a kill.
std::vector<std::string> whole_lines(const std::string& text) { return lines_of(text.substr(0, text.rfind('\n') + 1)); }

TEST_F(StudyResume, AfterKillsGivesWhatAnUndisturbedStudyGives) {
  write("calm.toml", long_study);
  write("killed.toml", long_study);
  const Answer calm = study("noise", "calm", {"--threads", "1"});
  ASSERT_EQ(calm.code, 0) << calm.err;
  int kills = 0;
  for (std::size_t have = 0; kills < 3 && have + 10 < points("calm").size(); ++kills) {
    const auto before = fs::exists(folder / "killed.jsonl") ? whole_lines(text_of(folder / "killed.jsonl"))
                                                            : std::vector<std::string>{};
    const int code = stopped_after(have, SIGKILL, "killed.jsonl",
                                   {"study", "noise", "killed.toml", "--quiet", "--json", "--threads", "1"});
    ASSERT_TRUE(code == 128 + SIGKILL || code == 0) << code << text_of(folder / "said");
    const auto after = whole_lines(text_of(folder / "killed.jsonl"));
    ASSERT_GE(after.size(), before.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << "points that were there have changed";
    have = points("killed").size();
  }
  EXPECT_GE(kills, 2) << "the study was over before it could be killed";
  const auto before = whole_lines(text_of(folder / "killed.jsonl"));
  const Answer again = study("noise", "killed", {"--threads", "1"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.json(), calm.json());
  EXPECT_EQ(timeless_points("killed"), timeless_points("calm"));
  const auto after = whole_lines(text_of(folder / "killed.jsonl"));
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  std::set<int> numbers;
  for (const auto& p : points("killed")) EXPECT_TRUE(numbers.insert(p["point"].get<int>()).second) << p;
}

TEST_F(StudyResume, ARequestToStopFinishesWhatRunsAndTheSameCommandGoesOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string name = "stop" + std::to_string(signal);
    write_model("model.sh",
                std::string("system(\"sleep 0.05\"); print x >> \"begun" + std::to_string(signal) + "\"; ") + doubled);
    write(name + ".toml", program_study);
    const Arguments command{"study", "noise", name + ".toml", "--threads", "2"};
    EXPECT_EQ(stopped_after(3, signal, name + ".jsonl", command), 3);
    const std::string said = text_of(folder / "said");
    EXPECT_NE(said.find("stopped; what was finished is in " + name + ".jsonl: the same command goes on"), said.npos)
        << said;
    EXPECT_FALSE(fs::exists(folder / (name + ".h5")));
    const std::string begun = "begun" + std::to_string(signal);
    EXPECT_EQ(points(name).size(), lines_of(text_of(folder / begun)).size()) << "a program that ran was lost";
    EXPECT_LT(points(name).size(), 20u);
    const Answer rest = run(command);
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_EQ(points(name).size(), 23u);
    EXPECT_EQ(lines_of(text_of(folder / begun)).size(), 23u) << "a point ran twice";
    EXPECT_TRUE(fs::exists(folder / (name + ".h5")));
  }
}

TEST_F(StudyResume, RunsNothingAgainOfAStudyThatHasEnded) {
  write_model("model.sh", std::string("print x >> \"begun\"; ") + doubled);
  write("again.toml", program_study);
  const Answer first = study("noise", "again");
  const std::string log = text_of(folder / "again.jsonl"), result = text_of(folder / "again.h5");
  const Answer second = study("noise", "again");
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(text_of(folder / "again.jsonl"), log);
  EXPECT_TRUE(text_of(folder / "again.h5") == result);
  EXPECT_EQ(lines_of(text_of(folder / "begun")).size(), 23u);
}

TEST_F(StudyResume, RefusesTheLogOfAnotherStudyInWordsThatNameTheDifference) {
  const std::string text =
      "scene = \"drive.toml\"\nquantities = [\"fast.pulley.driven.hub_load_n.mean\"]\n[study]\nphases = 1\n"
      "ramp_factors = [1]\nperturbations = 1\nline_points = 4\n";
  write("s.toml", text);
  ASSERT_EQ(study("noise", "s").code, 0);
  const std::string log = text_of(folder / "s.jsonl"), result = text_of(folder / "s.h5");
  const auto expect_refused = [&](const Arguments& arguments, const std::vector<std::string>& says,
                                  const std::string& now) {
    const Answer a = run(Arguments{"study"} + arguments + Arguments{"--quiet"});
    EXPECT_EQ(a.code, 2) << a.err;
    EXPECT_EQ(a.out, "");
    EXPECT_NE(a.err.find("s.jsonl:1: "), a.err.npos) << a.err;
    EXPECT_NE(a.err.find("or delete the log"), a.err.npos) << a.err;
    for (const std::string& part : says) EXPECT_NE(a.err.find(part), a.err.npos) << part << "\n" << a.err;
    EXPECT_EQ(text_of(folder / "s.jsonl"), now);
    EXPECT_TRUE(text_of(folder / "s.h5") == result);
  };
  expect_refused({"noise", "s.toml", "--set", "belt.mass_kg_per_m=0.31"},
                 {"another scene", "belt.mass_kg_per_m = 0.3, now it is 0.31"}, log);
  expect_refused({"noise", "s.toml", "--seed", "5"}, {"another study", "study.seed = 1, now it is 5"}, log);
  write("s.toml", replaced(text, "line_points = 4", "line_points = 5"));
  expect_refused({"noise", "s.toml"}, {"another study", "study.line_points = 4, now it is 5"}, log);
  write("s.toml", text);
  write("other.toml", "scene = \"drive.toml\"\n");
  expect_refused({"stability", "other.toml", "--out", "s.h5"}, {"made by study noise, now it is study stability"}, log);
  const auto at = log.find("\"version\":\"") + 11;
  std::string older = log;
  older.replace(at, log.find('"', at) - at, "0.0.1");
  write("s.jsonl", older);
  expect_refused({"noise", "s.toml"}, {"made by version 0.0.1, now it is "}, older);
  write("s.jsonl", "no log\n");
  const Answer a = study("noise", "s");
  EXPECT_EQ(a.code, 2);
  EXPECT_NE(a.err.find("s.jsonl: is not the log of a study"), a.err.npos) << a.err;
  EXPECT_EQ(text_of(folder / "s.jsonl"), "no log\n");
}

TEST_F(StudyResume, GoesOnAfterAFullDisk) {
  write_model("model.sh", doubled);
  // Limits in blocks of 512 bytes: too little for the head of the log, for all points, for the result file.
  std::map<int, std::size_t> points_at;
  for (const int blocks : {1, 4, 12}) {
    const std::string name = "full" + std::to_string(blocks);
    write(name + ".toml", program_study);
    write("go", "trap '' XFSZ; ulimit -f " + std::to_string(blocks) + "; exec " BELTLIFE_COMMAND " study noise " +
                    name + ".toml --quiet >said_out 2>said_err\n");
    const int status = std::system(("cd " + folder.string() + " && exec /bin/sh ./go").c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const std::string said = text_of(folder / "said_err");
    EXPECT_TRUE(code == 2 || code == 3) << blocks << ": " << code << said;
    const char* words = blocks < 12 ? "could not be written: File too large" : "bytes failed: File too large";
    EXPECT_NE(said.find(words), said.npos) << blocks << ": " << said;
    EXPECT_NE(said.find("free space"), said.npos) << said;
    EXPECT_EQ(said.find("a bug"), said.npos) << said;
    EXPECT_FALSE(fs::exists(folder / (name + ".h5")));
    if (fs::exists(folder / (name + ".jsonl"))) {
      for (const std::string& line : whole_lines(text_of(folder / (name + ".jsonl"))))
        EXPECT_TRUE(nlohmann::json::accept(line)) << line;
      points_at[blocks] = points(name).size();
    }
    const Answer rest = study("noise", name);
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_EQ(rest.json()["evaluations"], 23);
    EXPECT_EQ(points(name).size(), 23u);
  }
  EXPECT_FALSE(points_at.contains(1)) << "a log without a head is worth nothing";
  EXPECT_GT(points_at[4], 0u);
  EXPECT_LT(points_at[4], 23u);
  EXPECT_EQ(points_at[12], 23u);
}

TEST_F(StudyResume, RunsNothingForAResultThatCannotBeWritten) {
  write_model("model.sh", std::string("print x >> \"begun\"; ") + doubled);
  write("s.toml", program_study);
  fs::create_directory(folder / "folder.jsonl");
  for (const char* out : {"none/x.h5", "/dev/null", "folder.h5", "x.jsonl"}) {
    const Answer a = study("noise", "s", {"--out", out});
    EXPECT_EQ(a.code, 2) << out << a.err;
    EXPECT_NE(a.err, "");
  }
  EXPECT_FALSE(fs::exists(folder / "begun"));
}

}  // namespace
}  // namespace beltlife::system_test
