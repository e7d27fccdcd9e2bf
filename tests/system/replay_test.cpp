// Owns the claims about replay: a point of a study run again gives the same bits, or says why it cannot.
#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

class Replay : public InStudyFolder {
 protected:
  Answer replay(const std::string& file, int point, const Arguments& more = {"--json"}) const {
    return run(Arguments{"replay", file, "--point", std::to_string(point)} + more);
  }
};

TEST_F(Replay, OfAPointOfADriveGivesTheSameBits) {
  write("n.toml",
        "scene = \"drive.toml\"\nquantities = [\"fast.pulley.driven.hub_load_n.mean\", "
        "\"log10_life_h\"]\n[study]\nphases = "
        "2\nramp_factors = [1]\nperturbations = 2\nline_points = 4\n");
  ASSERT_EQ(study("noise", "n").code, 0);
  const auto all = points("n");
  fs::remove(folder / "drive.toml");  // a log holds its scene
  for (const char* file : {"n.jsonl", "n.h5"})
    for (const int point : {0, static_cast<int>(all.size()) - 1}) {
      const Answer a = replay(file, point);
      ASSERT_EQ(a.code, 0) << a.err;
      const auto j = a.json();
      EXPECT_EQ(j["identical"], true) << j["quantities"];
      EXPECT_EQ(j["point"], point);
      EXPECT_EQ(j["state"], "ok");
      const auto& p = all[static_cast<std::size_t>(point)];
      EXPECT_EQ(j["quantities"]["log10_life_h"]["recorded"], p["values"][1]);
      EXPECT_EQ(j["settings"]["belt.axial_stiffness_n"], p["settings"][0]);
    }
  const Answer print = replay("n.h5", 1, {"--out", "p.h5"});
  EXPECT_EQ(print.code, 0) << print.err;
  EXPECT_NE(print.out.find("The same to the last bit."), print.out.npos) << print.out;
  EXPECT_EQ(run({"report", "p.h5"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "p.html"));
}

TEST_F(Replay, OfARangeThatEndedEarlyGivesTheSameBits) {
  write("e.toml",
        "scene = \"drive.toml\"\nquantities = [\"fast.pulley.driven.hub_load_n.mean\"]\n[study]\nphases = "
        "2\nramp_factors = [1]\n"
        "perturbations = 2\nline_points = 4\n");
  ASSERT_EQ(study("noise", "e", {"--set", "profile.settled_within=0.05", "--set", "profile.evaluate_s=0.03"}).code, 0);
  const Answer a = replay("e.jsonl", 0);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_EQ(a.json()["identical"], true) << a.out;
}

TEST_F(Replay, OfPointsOfStabilityGivesTheSameStates) {
  write("s.toml",
        "scene = \"drive.toml\"\n[study]\nschemes = []\n[[study.extreme]]\nname = \"as it is\"\nset = []\n"
        "[[study.extreme]]\nname = \"overlap\"\nset = [\"pulley.driven.x_mm=50\"]\n"
        "[[study.extreme]]\nname = \"too long a step\"\nset = [\"solver.scheme=symplectic_euler\"]\n");
  ASSERT_EQ(study("stability", "s").code, 0);
  const Answer fine = replay("s.jsonl", 0);
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_EQ(fine.json()["identical"], true) << fine.out;
  const Answer refused = replay("s.jsonl", 1);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("overlap"), refused.err.npos) << refused.err;
  // The scene's step is ten times what this scheme bears.
  const Answer diverged = replay("s.jsonl", 2);
  EXPECT_EQ(points("s")[2]["state"], "diverged");
  EXPECT_EQ(diverged.code, 3) << diverged.err;
  EXPECT_NE(diverged.err.find("diverged"), diverged.err.npos) << diverged.err;
}

TEST_F(Replay, OfAPointThatIsNoneIsRefused) {
  write_model("model.sh", "if (x > 2) exit 3; printf \"{\\\"y\\\": %.17g}\", x");
  write("c.toml",
        "quantities = [\"y\"]\n[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\nstart = 2\n[study]\n"
        "perturbations = 0\nline_points = 4\n");
  ASSERT_EQ(study("noise", "c").code, 0);
  for (const char* file : {"c.jsonl", "c.h5"}) {
    const Answer none = replay(file, 99);
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("--point: the study has no point 99 (allowed: from 0 to 4)"), none.err.npos) << none.err;
  }
  EXPECT_EQ(replay("c.toml", 0).code, 2);
  EXPECT_EQ(replay("none.h5", 0).code, 2);
  EXPECT_EQ(run({"replay", "c.jsonl"}).code, 1);

  const Answer fine = replay("c.jsonl", 0);
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_EQ(fine.json()["identical"], true);
  const Answer file = replay("c.jsonl", 0, {"--out", "x.h5"});
  EXPECT_EQ(file.code, 2);
  EXPECT_NE(file.err.find("another program, which has no result file"), file.err.npos) << file.err;
  for (const auto& p : points("c"))
    if (p["state"] == "failed") {
      const Answer again = replay("c.jsonl", p["point"]);
      EXPECT_EQ(again.code, 3) << again.err;
      EXPECT_NE(again.err.find("exited with status 3"), again.err.npos) << again.err;
    }
}

}  // namespace
}  // namespace beltlife::system_test
