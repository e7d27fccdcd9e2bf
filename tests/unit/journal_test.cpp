// Owns the claims about the log of a study: nothing lost by a kill, nothing evaluated twice, damage named in words.
#include "results/journal/journal.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "tests/unit/study_fixture.h"

namespace beltlife::study_test {
namespace {

/// A log of `count` example points.
std::string example_log(const fs::path& path, std::size_t count) {
  Journal journal(path, example_head());
  for (std::size_t i = 0; i < count; ++i) journal.append(example_point(i));
  return text_of(path);
}

/// Does `action` in a process of its own and returns what that refused.
std::string refusal_of_child(const fs::path& folder, const std::function<void()>& action) {
  const fs::path words = folder / "words";
  const pid_t child = fork();
  if (child == 0) {
    write_text(words, refusal(action));
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  return text_of(words);
}

using JournalFile = InFolder;

TEST_F(JournalFile, KeepsHeadPointsAndAnswer) {
  const nlohmann::json answer = {{"mean", 0.1}, {"nothing", std::nan("")}};
  {
    Journal journal(log, example_head());
    for (const std::size_t number : {1, 0, 4, 2}) journal.append(example_point(number));
    journal.finish(answer);
    EXPECT_EQ(journal.record().points[3].number, 4u) << "points stand by number";
  }
  const StudyRecord record = read_journal(log);
  expect_same(record.head, example_head());
  ASSERT_EQ(record.points.size(), 4u);
  for (const StudyPoint& p : record.points) EXPECT_EQ(bits_of(p), bits_of(example_point(p.number)));
  EXPECT_EQ(record.points[0].answer.processor_s, 0.25);
  EXPECT_EQ(record.answer.dump(), R"({"mean":0.1,"nothing":null})");
}

TEST_F(JournalFile, KeepsEveryBitOfEveryNumber) {
  std::vector<double> values{-0.0, 5e-324, -2.2250738585072009e-308, std::numeric_limits<double>::max(), 0.1};
  std::mt19937_64 random(1);
  while (values.size() < 20000) {
    const std::uint64_t bits = values.size() % 4 ? random() : random() & 0x800fffffffffffffULL;  // a quarter denormal
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  StudyHead head = example_head();
  head.parameters.assign(values.size(), "p");
  head.quantities.assign(values.size(), "q");
  const StudyPoint point{0, point_of(values), {PointState::ok, "", values, 1e-9}};
  Journal(log, head).append(point);
  EXPECT_EQ(bits_of(read_journal(log).points.at(0)), bits_of(point));
}

TEST_F(JournalFile, KeepsReasonsThatAreNoText) {
  StudyPoint point = example_point(2);
  point.answer.reason = std::string("bytes \xff\xfe and a zero \0.", 23);
  std::string kept;
  {
    Journal journal(log, example_head());
    journal.append(point);
    kept = journal.record().points[0].answer.reason;
  }
  EXPECT_EQ(read_journal(log).points[0].answer.reason, kept) << "the same now and later";
}

TEST_F(JournalFile, IsReadCompressedAsWellButNotGoneOnWith) {
  const std::string text = example_log(log, 3);
  const fs::path packed = folder / "study.jsonl.gz";
  gzFile out = gzopen(packed.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  expect_same_history(read_journal(packed), read_journal(log));
  expect_words(refusal([&] { Journal(packed, example_head()); }), {"compressed", "gunzip"});
  write_text(packed, text_of(packed).substr(0, 200));
  expect_words(refusal([&] { read_journal(packed); }), {"cannot be read to its end"});
}

TEST_F(JournalFile, CutShortAnywhereInItsLastLineGoesOnFromTheLineBefore) {
  const std::string whole = example_log(log, 3);
  const std::size_t begin = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = begin; size < whole.size(); ++size) {
    write_text(log, whole.substr(0, size));
    EXPECT_EQ(read_journal(log).points.size(), 2u);
    Journal journal(log, example_head());
    EXPECT_EQ(journal.record().points.size(), 2u);
    journal.append(example_point(2));
    ASSERT_EQ(text_of(log), whole) << size;
  }
}

TEST_F(JournalFile, CutShortAnywhereInItsHeadIsBegunAnew) {
  const std::string head = example_log(log, 0);
  for (std::size_t size = 0; size < head.size(); size += size < 30 ? 1 : 13) {
    write_text(log, head.substr(0, size));
    EXPECT_NE(refusal([&] { read_journal(log); }), "");
    Journal journal(log, example_head());
    EXPECT_TRUE(journal.record().points.empty());
    ASSERT_EQ(text_of(log), head) << size;
  }
}

TEST_F(JournalFile, WithRubbishForALastLineGoesOn) {
  const std::string whole = example_log(log, 2);
  write_text(log, whole + std::string(100, '\0') + "\n");
  EXPECT_EQ(read_journal(log).points.size(), 2u);
  Journal(log, example_head());
  EXPECT_EQ(text_of(log), whole + std::string(100, '\0') + "\n") << "nothing is cut off before something is written";
  Journal(log, example_head()).append(example_point(2));
  EXPECT_EQ(read_journal(log).points.size(), 3u);
}

TEST_F(JournalFile, DamagedInItsMiddleIsRefusedWithTheLine) {
  const std::string whole = example_log(log, 3);
  const auto refused = [&](const std::string& was, const std::string& becomes) {
    std::string text = whole;
    text.replace(text.find(was), was.size(), becomes);
    write_text(log, text);
    const std::string words = refusal([&] { read_journal(log); });
    EXPECT_EQ(words, refusal([&] { Journal(log, example_head()); }));
    EXPECT_EQ(text_of(log), text) << "left as it was";
    return words;
  };
  expect_words(refused("{\"point\":1", "{\"po"), {"study.jsonl:3:", "neither a point nor an answer"});
  expect_words(refused("{\"point\":1", "{\"point\":0"), {"study.jsonl:3:", "point 0 a second time"});
  expect_words(refused("{\"point\":1", "{\"point\":\"1\""), {"study.jsonl:3:", "neither"});
  expect_words(refused("\"infeasible\"", "\"tired\""), {"study.jsonl:4:", "unknown state 'tired'"});
  expect_words(refused("[0.1,", "["), {"study.jsonl:2:", "1 settings", "2 parameters"});
  expect_words(refused("[1.0,-0.0]", "[1.0]"), {"study.jsonl:2:", "1 values instead of 2"});
  expect_words(refused("\"beltlife_journal\":1", "\"beltlife_journal\":2"), {"format 2"});
  expect_words(refused("\"driver\"", "\"drover\""), {"study.jsonl:1:", "head"});
}

TEST_F(JournalFile, ThatIsNoneIsRefusedAndLeftAlone) {
  for (const std::string text : {"x", "{\"beltlife\"", "{}\n", "time_s,speed_rpm\n0,1\n", "\x89HDF\r\n"}) {
    write_text(log, text);
    expect_words(refusal([&] { read_journal(log); }), {"not the log of a study"});
    expect_words(refusal([&] { Journal(log, example_head()); }), {"not the log of a study"});
    EXPECT_EQ(text_of(log), text);
  }
  expect_words(refusal([&] { read_journal(folder / "none"); }), {"none", "No such file"});
  expect_words(refusal([&] { read_journal(folder); }), {"is a directory"});
}

TEST_F(JournalFile, ThatCannotBeWrittenIsRefused) {
  for (const fs::path& path : {fs::path("/proc/study.jsonl"), folder / "missing/study.jsonl", folder, log / "below"})
    expect_words(refusal([&] { Journal(path, example_head()); }), {"no log can be written here", path.c_str()});
  expect_words(refusal([&] { Journal("/dev/null", example_head()); }), {"not a regular file"});
  EXPECT_EQ(files(), 0);
}

TEST_F(JournalFile, IsLockedAgainstASecondWriter) {
  const Journal journal(log, example_head());
  expect_words(refusal([&] { Journal(log, example_head()); }), {"being written by another process"});
  EXPECT_EQ(read_journal(log).points.size(), 0u) << "but may be read";
}

TEST_F(JournalFile, OfAnotherStudyIsRefusedNamingTheFirstDifference) {
  example_log(log, 1);
  const auto refused = [&](const std::function<void(StudyHead&)>& change) {
    StudyHead head = example_head();
    change(head);
    const std::string words = refusal([&] { Journal(log, head); });
    expect_words(words, {"study.jsonl:1:", "another --out, or delete the log"});
    return words;
  };
  const auto replaced = [](std::string& text, const std::string& was, const std::string& becomes) {
    text.replace(text.find(was), was.size(), becomes);
  };
  expect_words(refused([](StudyHead& h) { h.driver = "calibrate"; }), {"by study noise, now it is calibrate"});
  expect_words(refused([](StudyHead& h) { h.version = "2.0"; }), {"by version 1.2.3, now it is 2.0"});
  expect_words(refused([](StudyHead& h) { h.lanes = "arcs"; }), {"drives, now it is arcs"});
  expect_words(refused([&](StudyHead& h) { replaced(h.scene_text, "= 0.6", "= 0.5"); }),
               {"another scene: the log was made with belt.friction_front = 0.6, now it is 0.5"});
  expect_words(refused([&](StudyHead& h) { replaced(h.scene_text, "x_mm = 1", "x_mm = 2"); }),
               {"made with pulley.crank.x_mm = 1, now it is 2"});
  expect_words(refused([&](StudyHead& h) { replaced(h.scene_text, "ribs = 6\n", ""); }),
               {"made with belt.ribs = 6, where there is now belt.friction_front = 0.6"});
  expect_words(refused([](StudyHead& h) { h.scene_text += "y_mm = 2\n"; }),
               {"made with nothing more, where there is now pulley.crank.y_mm = 2"});
  expect_words(refused([](StudyHead& h) { h.scene_text.clear(); }), {"with format = 1, where there is now nothing"});
  expect_words(refused([&](StudyHead& h) { replaced(h.study_text, "= 0.1", "= 0.2"); }),
               {"another study", "parameter.belt.friction_front.lower = 0.1, now it is 0.2"});
  expect_words(refused([](StudyHead& h) { h.parameters[1] = "belt.ribs"; }),
               {"parameter 2 of the log is solver.scheme, now it is belt.ribs"});
  expect_words(refused([](StudyHead& h) { h.quantities.pop_back(); }), {"log10_life_h is missing"});
  expect_words(refused([](StudyHead& h) { h.quantities.emplace_back("life_h"); }), {"life_h is new"});
}

TEST_F(JournalFile, OfAnotherRevisionIsGoneOnWithAfterAWarning) {
  example_log(log, 1);
  StudyHead head = example_head();
  head.revision = "def";
  testing::internal::CaptureStderr();
  {
    const Journal journal(log, head);
    EXPECT_EQ(journal.record().points.size(), 1u);
  }
  const std::string words = testing::internal::GetCapturedStderr();
  expect_words(words, {"warning", "revision abc", "def"});
  EXPECT_EQ(std::count(words.begin(), words.end(), '\n'), 1);
}

TEST_F(JournalFile, WritesTheSameAnswerOnceAndAnotherOneAfterIt) {
  example_log(log, 1);
  const nlohmann::json first = {{"mean", 1.0}, {"none", std::nan("")}}, second = {{"mean", 2.0}};
  for (int i = 0; i < 3; ++i) Journal(log, example_head()).finish(first);
  const std::string once = text_of(log);
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 3) << "head, point, answer";
  Journal(log, example_head()).finish(second);
  EXPECT_EQ(read_journal(log).answer, second);
}

TEST_F(JournalFile, OnAFullDiskSaysWhatIsSafeAndGoesOnOnceThereIsRoom) {
  // A limit on file size stands for the full disk; its signal has to be ignored for the write to fail instead.
  const std::string words = refusal_of_child(folder, [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{.rlim_cur = 4096, .rlim_max = RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &small);
    Journal journal(log, example_head());
    for (std::size_t i = 0;; ++i) journal.append(example_point(i));
  });
  const std::string text = text_of(log);
  EXPECT_LT(text.size(), 4096u);
  EXPECT_EQ(text.back(), '\n') << "part of a line was left behind";
  const std::size_t safe = read_journal(log).points.size();
  EXPECT_GT(safe, 10u);
  expect_words(words, {("the " + std::to_string(safe) + " points before it are safe").c_str(), "File too large",
                       "free space and run the same command again: it goes on"});
  Journal(log, example_head()).append(example_point(safe));
  EXPECT_EQ(read_journal(log).points.size(), safe + 1);
}

TEST_F(JournalFile, ThatCannotHoldItsHeadIsNotLeftBehind) {
  const std::string words = refusal_of_child(folder, [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{.rlim_cur = 256, .rlim_max = RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &small);
    Journal(log, example_head());
  });
  EXPECT_FALSE(fs::exists(log));
}

}  // namespace
}  // namespace beltlife::study_test
