// A model that is another program: what it is given, what is read from it, and every way it can go wrong.
#include "sim/eval/command_model.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

#include "sim/eval/child_process.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

class CommandModel : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "beltlife_command_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  Answer answer(const Words& run, double timeout_s = 20, const Words& quantities = {"y"}) const {
    return command_model({run, timeout_s}, folder, {"x1"}, quantities, 1)({{0.3}}, {}).at(0);
  }
  Answer shell(const std::string& script, double timeout_s = 20, const Words& quantities = {"y"}) const {
    return answer({"/bin/sh", "-c", script}, timeout_s, quantities);
  }
  /// A number that a process left in a file of the folder.
  pid_t noted(const std::string& file) const {
    pid_t pid = 0;
    std::ifstream(folder / file) >> pid;
    return pid;
  }

  fs::path folder;
};

::testing::AssertionResult failed_with(const Answer& a, const std::string& words,
                                       PointState state = PointState::failed) {
  const bool as_told = a.state == state && a.values.empty() && a.reason.find(words) != std::string::npos;
  return (as_told ? testing::AssertionSuccess() : testing::AssertionFailure())
         << to_string(a.state) << ": " << a.reason;
}

/// Gone, or dead and only not yet reaped by whoever inherits orphans here.
bool gone(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return !(file >> number >> name >> state) || state == "Z" || state == "X";
}

bool gone_within(pid_t pid, double limit_s) {
  for (const double end = seconds() + limit_s; seconds() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(5)))
    if (gone(pid)) return true;
  return false;
}

std::ptrdiff_t open_files() { return std::distance(fs::directory_iterator("/proc/self/fd"), {}); }

TEST_F(CommandModel, NumbersPassBothWaysToTheBit) {
  const std::vector<double> hard{0.1,   1.0 / 3, -0.0, 5e-324, std::numeric_limits<double>::max(), 123456789012345678.0,
                                 1e-17, 0.3,     -2.5};
  std::vector<Point> points;
  for (const double x : hard) points.push_back({x, 2 * 0.1});
  const auto answers = command_model({{"cat"}, 20}, folder, {"a b", "\"\\"}, {"\"\\", "a b"}, 2)(points, {});
  ASSERT_EQ(answers.size(), hard.size());
  for (std::size_t i = 0; i < hard.size(); ++i) {
    ASSERT_TRUE(answers[i].ok()) << answers[i].reason;
    EXPECT_EQ(answers[i].values[0], 2 * 0.1);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(answers[i].values[1]), std::bit_cast<std::uint64_t>(hard[i])) << hard[i];
  }
}

TEST_F(CommandModel, ParametersComeInTheStudysOrderAndChoicesAsText) {
  const auto model = command_model({{"/bin/sh", "-c", "cat >seen; echo '{\"y\": 7, \"more\": [true]}'"}, 20}, folder,
                                   {"z", "side", "a"}, {"y"}, 1);
  const Answer a = model({{0.3, "in\"ner", 2.0}}, {}).at(0);
  EXPECT_EQ(a.values, std::vector<double>{7}) << a.reason;
  std::string line;
  std::getline(std::ifstream(folder / "seen"), line);
  EXPECT_EQ(line, R"({"z": 0.3, "side": "in\"ner", "a": 2.0})");
}

TEST_F(CommandModel, AnswersAreThoseOfThePointsOnAnyNumberOfThreads) {
  std::vector<Point> points;
  for (int i = 0; i < 24; ++i) points.push_back({double(i)});
  for (const int threads : {1, 4}) {
    // Early points take longest, so that they finish out of order.
    const std::string script = "read t; case $t in *' 0.0}'|*' 1.0}'|*' 5.0}') sleep 0.1;; esac; echo \"$t\"";
    std::set<std::size_t> heard;
    std::atomic<int> at_once = 0;
    const auto on_answer = [&](std::size_t i, const Answer& a) {
      EXPECT_EQ(++at_once, 1);
      EXPECT_TRUE(heard.insert(i).second);
      EXPECT_EQ(a.values, std::vector<double>{double(i)});
      --at_once;
    };
    const auto model = command_model({{"/bin/sh", "-c", script}, 20}, folder, {"x1"}, {"x1"}, threads);
    const auto answers = model(points, on_answer);
    EXPECT_EQ(heard.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(answers[i].values, std::vector<double>{double(i)});
  }
}

TEST_F(CommandModel, ProgramsAreFoundInTheFolderOrInPath) {
  std::ofstream(folder / "model.sh") << "#!/bin/sh\npwd >where\nexec cat\n";
  EXPECT_TRUE(failed_with(answer({"./model.sh"}), "\"./model.sh\" could not be started: Permission denied"));
  chmod((folder / "model.sh").c_str(), 0700);
  EXPECT_TRUE(answer({"./model.sh"}, 20, {"x1"}).ok());
  std::string where;
  std::getline(std::ifstream(folder / "where"), where);
  EXPECT_EQ(fs::canonical(where), fs::canonical(folder));
  EXPECT_TRUE(failed_with(answer({"model.sh"}), "could not be started: No such file"));
  EXPECT_TRUE(failed_with(answer({"./none", "-x"}), "\"./none\" could not be started: No such file"));
  EXPECT_TRUE(failed_with(command_model({{"cat"}, 20}, folder / "gone", {"x1"}, {"x1"}, 1)({{0.3}}, {}).at(0),
                          "no folder \"" + (folder / "gone").string()));
  EXPECT_TRUE(command_model({{"cat"}, 20}, {}, {"x1"}, {"x1"}, 1)({{0.3}}, {}).at(0).ok());
}

TEST_F(CommandModel, AnExitOtherThanZeroFailsWithTheLastWordsOfStandardError) {
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": 1}'; echo far >&2; printf 'one\\n\\n two\\nmesh is bad\\n' >&2; exit 3"),
                          "exited with status 3; standard error ends: one | two | mesh is bad"));
  EXPECT_TRUE(failed_with(shell("kill -SEGV $$"), "killed by signal 11 (Segmentation fault)"));
  // Bytes that are no UTF-8, colours: a reason must fit into a journal.
  EXPECT_TRUE(failed_with(shell("printf 'a\\377b\\033c' >&2; exit 1"), "ends: a\uFFFDb c"));
  const Answer much = shell("i=0; while [ $i -lt 5000 ]; do echo $i $i $i >&2; i=$((i+1)); done; exit 1");
  EXPECT_TRUE(failed_with(much, "4998 4998 4998 | 4999 4999 4999"));
  const Answer wide = shell("head -c 300000 /dev/zero | tr '\\0' x >&2; printf '\\nend' >&2; exit 1");
  EXPECT_TRUE(failed_with(wide, "xxx | end"));
  EXPECT_LT(wide.reason.size(), error_tail_bytes + 100);
}

TEST_F(CommandModel, WhatIsNoAnswerFails) {
  EXPECT_TRUE(failed_with(shell("echo why >&2"), "printed nothing; standard error ends: why"));
  EXPECT_TRUE(failed_with(shell("echo hello"), "no JSON object: hello"));
  EXPECT_TRUE(failed_with(shell("echo '[1]'"), "no JSON object: [1]"));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": 1} x'"), "no JSON object"));
  EXPECT_TRUE(failed_with(shell("head -c 3000000 /dev/zero | tr '\\0' '['"), "no JSON object: [[["));
  EXPECT_TRUE(failed_with(shell("echo '{\"Y\": 1}'"), "no quantity \"y\""));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": 1}'", 20, {"y", "w"}), "no quantity \"w\""));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": \"1\"}'"), "\"y\" is not a number: \"1\""));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": null}'"), "\"y\" is not a number: null"));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": 1e999}'"), "too large to be finite"));
  EXPECT_TRUE(failed_with(shell("echo '{\"y\": NaN}'"), "JSON has no NaN"));
}

TEST_F(CommandModel, ATimeOutKillsGrandchildrenToo) {
  const double begin = seconds();
  const Answer a = shell("sleep 100 & echo $! >pid; echo busy >&2; wait", 1);
  EXPECT_LT(seconds() - begin, 10);  // not 100; a loaded machine may take a while to begin
  EXPECT_TRUE(failed_with(a, "took longer than 1 s; standard error ends: busy", PointState::timed_out));
  ASSERT_GT(noted("pid"), 0);
  EXPECT_TRUE(gone_within(noted("pid"), 1));
  // Likewise one that has closed its output, and one that ignores polite signals.
  EXPECT_TRUE(failed_with(shell("exec >&- 2>&-; sleep 100", 0.2), "0.2 s", PointState::timed_out));
  EXPECT_TRUE(failed_with(shell("trap '' TERM INT HUP; while :; do sleep 1; done", 0.2), "0.2", PointState::timed_out));
}

TEST_F(CommandModel, OutputHeldOpenByAGrandchildDoesNotHoldUpTheAnswer) {
  const double begin = seconds();
  const Answer a = shell("echo '{\"y\": 4}'; sleep 30 & echo $! >pid");
  EXPECT_LT(seconds() - begin, 15);  // the grace, and whatever a loaded machine adds; far from 30
  EXPECT_EQ(a.values, std::vector<double>{4}) << a.reason;
  ASSERT_GT(noted("pid"), 0);
  EXPECT_FALSE(gone(noted("pid")));  // it has done nothing wrong
  kill(noted("pid"), SIGKILL);
  EXPECT_TRUE(shell("(sleep 0.1; echo '{\"y\": 5}') &").ok());  // late, but in time
}

TEST_F(CommandModel, InputNeedNotBeReadAndMayComeAfterOutput) {
  Words names;
  std::vector<double> values;
  for (int i = 0; i < 50000; ++i) {
    names.push_back("a_parameter_" + std::to_string(i));
    values.push_back(i + 0.1);
  }
  const auto model = [&](const std::string& script, const std::string& quantity) {
    return command_model({{"/bin/sh", "-c", script}, 20}, folder, names, {quantity}, 1)({point_of(values)}, {}).at(0);
  };
  struct sigaction before, after;
  sigaction(SIGPIPE, nullptr, &before);
  EXPECT_EQ(model("echo '{\"y\": 1}'", "y").values, std::vector<double>{1});
  EXPECT_EQ(model("exec <&-; sleep 0.1; echo '{\"y\": 2}'", "y").values, std::vector<double>{2});
  EXPECT_EQ(model("cat", "a_parameter_49999").values, std::vector<double>{49999 + 0.1});
  const std::string talk_first = "head -c 1000000 /dev/zero | tr '\\0' ' '; head -c 1000000 /dev/zero >&2; cat";
  EXPECT_EQ(model(talk_first, "a_parameter_0").values, std::vector<double>{0.1});
  sigaction(SIGPIPE, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
  sigset_t blocked;
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  EXPECT_EQ(sigismember(&blocked, SIGPIPE), 0);
  // The program itself dies of a broken pipe as it would from a shell.
  EXPECT_TRUE(failed_with(shell("kill -PIPE $$"), "signal 13"));
}

TEST_F(CommandModel, EndlessOutputIsCutOff) {
  EXPECT_TRUE(failed_with(shell("head -c 10000000 /dev/zero"), "printed more than 4 MB"));
  EXPECT_TRUE(failed_with(shell("yes & echo $! >pid; wait"), "printed more than 4 MB"));
  EXPECT_TRUE(gone_within(noted("pid"), 1));
  EXPECT_TRUE(failed_with(shell("yes >&2", 0.5), "y | y | y", PointState::timed_out));
}

TEST_F(CommandModel, ProcessorTimeIsThatOfTheProgramAndItsChildren) {
  EXPECT_LT(shell("sleep 0.2; echo '{\"y\": 1}'").processor_s, 0.15);
  EXPECT_GT(shell("sh -c 'i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done'; echo '{\"y\": 1}'").processor_s, 0.01);
}

TEST_F(CommandModel, ManyProgramsAtOnceLeaveNoFilesOpen) {
  const std::vector<Point> points(200, Point{0.3});
  const std::ptrdiff_t before = open_files();
  for (const auto& a : command_model({{"true"}, 20}, folder, {"x1"}, {"y"}, 8)(points, {}))
    EXPECT_TRUE(failed_with(a, "printed nothing"));
  for (const auto& a : command_model({{"./none"}, 20}, folder, {"x1"}, {"y"}, 8)(points, {}))
    EXPECT_TRUE(failed_with(a, "No such file"));
  EXPECT_EQ(open_files(), before);
  const double begin = seconds();
  for (const auto& a : command_model({{"cat"}, 20}, folder, {"x1"}, {"x1"}, 1)(points, {})) EXPECT_TRUE(a.ok());
  RecordProperty("overhead_ms_a_point", std::to_string(1e3 * (seconds() - begin) / double(points.size())));
}

TEST_F(CommandModel, ProgramsGetNoFilesButTheirThree) {
  const int plain = dup(0);  // without close-on-exec
  EXPECT_TRUE(shell("[ ! -e /proc/$$/fd/" + std::to_string(plain) + " ] && echo '{\"y\": 1}'").ok());
  close(plain);
}

TEST_F(CommandModel, AnExceptionOfTheReceiverSurfacesAndStartsNothingMore) {
  int heard = 0;
  const auto on_answer = [&](std::size_t, const Answer&) {
    if (++heard == 2) throw std::runtime_error("disk full");
  };
  const auto model = command_model({{"/bin/sh", "-c", "echo . >>count; cat"}, 20}, folder, {"x1"}, {"x1"}, 1);
  EXPECT_THROW(model(std::vector<Point>(50, Point{0.3}), on_answer), std::runtime_error);
  EXPECT_EQ(fs::file_size(folder / "count"), 4u);
}

/// Whether a batch of `count` points ends in Interrupted.
bool interrupted(const PointModel& model, std::size_t count, const OnAnswer& on_answer) {
  try {
    model(std::vector<Point>(count, Point{0.3}), on_answer);
    return false;
  } catch (const Interrupted&) {
    return true;
  }
}

/// Ends a process that was started for one claim.
[[noreturn]] void leave(const fs::path& folder, bool holds) {
  fs::remove_all(folder);
  _exit(holds ? 0 : 1);
}

TEST_F(CommandModel, ARequestToStopLetsRunningProgramsFinishAndStartsNoMore) {
  const auto claim = [&] {
    const auto model =
        command_model({{"/bin/sh", "-c", "echo . >>count; cat; sleep 0.3"}, 20}, folder, {"x1"}, {"x1"}, 2);
    std::uintmax_t heard = 0;
    const auto on_answer = [&](std::size_t, const Answer& a) {
      if (a.ok()) ++heard;
      request_stop();
    };
    // Of two that run, the first to finish asks; the other had begun.
    const bool some = interrupted(model, 50, on_answer) && heard >= 1 && heard <= 2;
    const bool none = interrupted(model, 50, on_answer);
    leave(folder, some && none && fs::file_size(folder / "count") == 2 * heard && model({}, on_answer).empty());
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process anew: a request is for good
  EXPECT_EXIT(claim(), testing::ExitedWithCode(0), "");
}

TEST_F(CommandModel, ABatchThatIsWholeIsNotInterrupted) {
  const auto claim = [&] {
    const auto model = command_model({{"cat"}, 20}, folder, {"x1"}, {"x1"}, 1);
    leave(folder, !interrupted(model, 1, [](std::size_t, const Answer&) { request_stop(); }));
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(claim(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace beltlife
