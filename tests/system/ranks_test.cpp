// Owns the claims about drivers whose points are shared out over processes by mpirun.
#include "tests/system/study_files.h"

#ifdef BELTLIFE_MPIRUN

namespace beltlife::system_test {
namespace {

class Ranks : public InStudyFolder {
 protected:
  void SetUp() override {
    if (access(BELTLIFE_MPIRUN, X_OK) != 0) GTEST_SKIP() << "no " << BELTLIFE_MPIRUN;
    InStudyFolder::SetUp();
    if (geteuid() == 0) {  // in a container; mpirun wants to be told twice
      setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
      setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    }
    // A launcher that cannot even start nothing twice is the machine's affair: containers without what it needs.
    static const Answer nothing =
        run_program(BELTLIFE_MPIRUN, {"mpirun", "--oversubscribe", "-n", "2", "true"}, folder, 30);
    if (nothing.code != 0) GTEST_SKIP() << "mpirun does not run here: " << nothing.err;
  }
  void TearDown() override {
    if (!folder.empty()) InStudyFolder::TearDown();
  }

  Answer ranks(int count, const Arguments& arguments) const {
    return run_program(
        BELTLIFE_MPIRUN,
        Arguments{"mpirun", "--oversubscribe", "-n", std::to_string(count), BELTLIFE_COMMAND} + arguments, folder, 50);
  }

  /// Runs the driver alone and on two processes, and expects the same points and the same answer.
  void expect_the_same(const Arguments& driver, const std::string& text) const {
    write("one.toml", text);
    write("two.toml", text);
    const Answer one = run(driver + Arguments{"one.toml", "--quiet", "--json"});
    const Answer two = ranks(2, driver + Arguments{"two.toml", "--quiet", "--json", "--threads", "1"});
    ASSERT_EQ(one.code, 0) << one.err;
    ASSERT_EQ(two.code, 0) << two.err;
    EXPECT_FALSE(points("one").empty());
    EXPECT_EQ(timeless_points("one"), timeless_points("two"));
    EXPECT_EQ(one.json(), two.json());
    EXPECT_TRUE(fs::exists(folder / "two.h5"));
  }
};

const std::string parameters =
    "[[parameter]]\npath = \"pulley.driven.x_mm\"\nlower = 480\nupper = 520\n"
    "[[parameter]]\npath = \"pulley.driven.y_mm\"\nlower = -20\nupper = 20\n";

TEST_F(Ranks, TwoProcessesWriteTheLogAndTheAnswerOfOneStudy) {
  expect_the_same({"study", "morris"},
                  "scene = \"drive.toml\"\nquantities = [\"fast.pulley.driven.hub_load_n.mean\"]\n" + parameters +
                      "[study]\ntrajectories = 6\n");
}

TEST_F(Ranks, TwoProcessesWriteTheLogAndTheAnswerOfOneSearch) {
  expect_the_same({"optimize"},
                  "scene = \"drive.toml\"\n[objective]\nquantity = \"fast.pulley.driven.hub_load_n.mean\"\n" +
                      parameters + "[optimization]\nbudget = 24\nfinalists = 2\nreplicates = 2\n");
}

TEST_F(Ranks, TwoProcessesWriteTheLogAndTheAnswerOfOneCalibration) {
  write_model("model.sh", "printf \"{\\\"y\\\": %.17g, \\\"z\\\": %.17g}\", 2 * x * x, x / 3");
  expect_the_same({"calibrate"},
                  "[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\nlower = 1\nupper = 9\nstart = 2\n"
                  "[[observation]]\nquantity = \"y\"\nvalue = 18\nsigma = 0.1\n"
                  "[[observation]]\nquantity = \"z\"\nvalue = 1.01\nsigma = 0.01\n");
}

TEST_F(Ranks, BothProcessesAnswerPoints) {
  write_model("model.sh",
              "print ENVIRON[\"OMPI_COMM_WORLD_RANK\"] >> \"who\"; system(\"sleep 0.02\"); "
              "printf \"{\\\"y\\\": %.17g}\", 2 * x");
  write("who.toml",
        "quantities = [\"y\"]\n[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\nstart = 2\n"
        "[study]\nperturbations = 16\nline_points = 6\n");
  const Answer answer = ranks(2, {"study", "noise", "who.toml", "--threads", "1"});
  ASSERT_EQ(answer.code, 0) << answer.err;
  const auto who = lines_of(text_of(folder / "who"));
  EXPECT_GT(std::count(who.begin(), who.end(), "0"), 3);
  EXPECT_GT(std::count(who.begin(), who.end(), "1"), 3);
  EXPECT_EQ(who.size(), points("who").size());
}

TEST_F(Ranks, AKilledProcessEndsTheJobAndTheSameCommandGoesOn) {
  write_model("model.sh",
              "if (ENVIRON[\"OMPI_COMM_WORLD_RANK\"] == 1 && x > 2 && system(\"test -e killed\")) { "
              "system(\"touch killed; kill -9 $(ps -o ppid= -p $PPID)\"); system(\"sleep 5\") } "
              "printf \"{\\\"y\\\": %.17g}\", 2 * x");
  const std::string text =
      "quantities = [\"y\"]\n[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\nstart = 2\n"
      "[study]\nperturbations = 16\nline_points = 6\n";
  write("calm.toml", text);
  write("mauled.toml", text);
  const Arguments command{"study", "noise", "mauled.toml", "--threads", "1", "--json"};
  const Answer mauled = ranks(2, command);
  EXPECT_NE(mauled.code, 0);
  EXPECT_TRUE(fs::exists(folder / "killed"));
  EXPECT_FALSE(fs::exists(folder / "mauled.h5"));
  const Answer again = ranks(2, command);
  ASSERT_EQ(again.code, 0) << again.err;
  write("killed", "");
  const Answer calm = study("noise", "calm");
  ASSERT_EQ(calm.code, 0) << calm.err;
  EXPECT_EQ(again.json(), calm.json());
  EXPECT_EQ(timeless_points("mauled"), timeless_points("calm"));
}

TEST_F(Ranks, WhatIsWrongIsSaidOnceAndEndsTheJob) {
  write("bad.toml", "scene = \"drive.toml\"\n[study]\nphasen = 3\n");
  const Answer bad = ranks(3, {"study", "noise", "bad.toml"});
  EXPECT_EQ(bad.code, 2);
  const auto at = bad.err.find("phasen");
  ASSERT_NE(at, bad.err.npos) << bad.err;
  EXPECT_EQ(bad.err.find("unknown key", bad.err.find("unknown key") + 1), bad.err.npos) << bad.err;
}

TEST_F(Ranks, AProcessThatCannotAnswerSaysWhereAndWhy) {
  write("wrapper.sh", "#!/bin/sh\n[ \"$OMPI_COMM_WORLD_RANK\" = 0 ] || cd elsewhere\nexec \"$@\"\n");
  fs::permissions(folder / "wrapper.sh", fs::perms::owner_all);
  fs::create_directory(folder / "elsewhere");
  write("here.toml", "scene = \"drive.toml\"\n[study]\nphases = 4\n");
  const Answer answer = run_program(BELTLIFE_MPIRUN,
                                    {"mpirun", "--oversubscribe", "-n", "2", (folder / "wrapper.sh").string(),
                                     BELTLIFE_COMMAND, "study", "noise", "here.toml", "--quiet"},
                                    folder, 50);
  EXPECT_EQ(answer.code, 2) << answer.err;
  EXPECT_NE(answer.err.find("process 1 on "), answer.err.npos) << answer.err;
  EXPECT_NE(answer.err.find("here.toml"), answer.err.npos) << answer.err;
}

TEST_F(Ranks, CommandsWithoutPointsAreRefused) {
  const Answer answer = ranks(2, {"check", "drive.toml"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("runs in one process (allowed: study, calibrate, optimize)"), answer.err.npos)
      << answer.err;
}

}  // namespace
}  // namespace beltlife::system_test

#endif
