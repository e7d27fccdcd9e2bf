// Owns the claims about a model with a journal: killed at any time it goes on as if nothing had been, on any threads.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "sim/eval/parallel_for.h"
#include "tests/unit/study_fixture.h"

namespace beltlife::study_test {
namespace {

StudyHead toy_head() {
  StudyHead head = example_head();
  head.parameters = {"x", "y"};
  head.quantities = {"height"};
  return head;
}

/// A hilly function, infeasible on one side; slow by a random time.
Answer toy_answer(const Point& point, std::mt19937& random) {
  const double x = number_of(point[0]), y = number_of(point[1]);
  const double wait = 1e-4 * (1 + random() % 4);
  std::this_thread::sleep_for(std::chrono::duration<double>(wait));
  if (x > 2) return {PointState::infeasible, "x is beyond 2", {}, wait};
  return {PointState::ok, "", {std::sin(3 * x) * std::cos(2 * y) - 0.1 * (x * x + y * y)}, wait};
}

/// A model on threads of its own (a forked child cannot use those of OpenMP) that writes down which points it is asked
/// for before it answers them.
PointModel toy_model(int threads, const fs::path& asked, unsigned seed) {
  return [=](const std::vector<Point>& points, const OnAnswer& on_answer) {
    const int file = ::open(asked.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    std::vector<Answer> answers(points.size());
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    const auto work = [&](unsigned thread) {
      std::mt19937 random(seed + thread);
      for (std::size_t i; (i = next++) < points.size();) {
        std::ostringstream line;
        line << std::hexfloat << number_of(points[i][0]) << " " << number_of(points[i][1]) << "\n";
        EXPECT_EQ(::write(file, line.str().data(), line.str().size()), static_cast<ssize_t>(line.str().size()));
        answers[i] = toy_answer(points[i], random);
        const std::lock_guard lock(mutex);
        on_answer(i, answers[i]);
      }
    };
    std::vector<std::thread> workers;
    for (int t = 0; t < threads; ++t) workers.emplace_back(work, static_cast<unsigned>(t));
    for (std::thread& worker : workers) worker.join();
    ::close(file);
    return answers;
  };
}

/// A search whose next batch depends on the answers so far, with the best point asked for once more in every batch.
StudyRecord toy_driver(const fs::path& log, int threads, const fs::path& asked, unsigned seed) {
  Journal journal(log, toy_head());
  JournaledModel model(toy_model(threads, asked, seed), journal);
  std::mt19937 random(5);
  std::vector<double> best{1.9, 0.3};
  double height = -1e9;
  for (int generation = 0; generation < 25; ++generation) {
    std::vector<Point> batch{point_of(best)};
    for (int i = 0; i < 7; ++i) {
      const auto step = [&] {
        return std::pow(0.9, generation) * (static_cast<double>(random()) / 4294967296.0 - 0.5);
      };
      batch.push_back(point_of({best[0] + step(), best[1] + step()}));
    }
    const auto answers = model.evaluate(batch);
    for (std::size_t i = 0; i < batch.size(); ++i)
      if (answers[i].ok() && answers[i].values[0] > height) {
        height = answers[i].values[0];
        best = {number_of(batch[i][0]), number_of(batch[i][1])};
      }
  }
  journal.finish({{"best", best}, {"height", height}});
  return journal.record();
}

std::set<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.insert(line);
  return lines;
}

std::set<std::string> settings_of(const StudyRecord& record) {
  std::set<std::string> settings;
  for (const StudyPoint& p : record.points) {
    std::ostringstream line;
    line << std::hexfloat << number_of(p.settings[0]) << " " << number_of(p.settings[1]);
    settings.insert(line.str());
  }
  return settings;
}

using Journaled = InFolder;

TEST_F(Journaled, StudyKilledTwentyTimesIsTheStudyThatWasNot) {
  const StudyRecord undisturbed = toy_driver(folder / "undisturbed.jsonl", 2, folder / "undisturbed.txt", 1);
  EXPECT_EQ(undisturbed.points.size(), 25u * 7 + 1) << "the best point is remembered";
  std::mt19937 random(3);
  int kills = 0, gains = 0;
  unsigned idle = 0;  ///< rounds in a row that gained no point: the next child lives longer, however busy the machine
  std::size_t before = 0;
  for (unsigned round = 0; kills < 20; ++round) {
    ASSERT_LT(round, 200u);
    const auto known =
        fs::exists(log) && fs::file_size(log) > 0 ? settings_of(read_journal(log)) : std::set<std::string>{};
    const fs::path asked = folder / ("asked_" + std::to_string(round));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        toy_driver(log, 2, asked, round);
      } catch (...) {
        _exit(1);
      }
      _exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds((1 + idle) * (1000 + random() % 5000)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    kills += WIFSIGNALED(status);
    for (const std::string& line : lines_of(asked))
      EXPECT_FALSE(known.contains(line)) << line << " was in the log and is evaluated again";
    ++idle;
    if (!fs::exists(log) || fs::file_size(log) == 0) continue;
    const std::size_t points = read_journal(log).points.size();
    EXPECT_GE(points, before);
    gains += points > before;
    if (points > before) idle = 0;
    before = points;
    if (WIFSIGNALED(status)) continue;
    expect_same_history(read_journal(log), undisturbed);  // it was faster than the kills: once more from the start
    fs::remove(log);
    before = 0;
  }
  EXPECT_GT(gains, 0) << "no kill met a study at work";
  expect_same_history(toy_driver(log, 2, folder / "last", 99), undisturbed);
  expect_same_history(read_journal(log), undisturbed);
}

TEST_F(Journaled, StudyOnTwoThreadsIsThatOnOne) {
  expect_same_history(toy_driver(log, 1, folder / "a", 1), toy_driver(folder / "other", 2, folder / "b", 7));
}

TEST_F(Journaled, FinishedStudyIsReplayedWithoutEvaluating) {
  const StudyRecord first = toy_driver(log, 2, folder / "first", 1);
  const std::string text = text_of(log);
  expect_same_history(toy_driver(log, 2, folder / "second", 2), first);
  EXPECT_FALSE(fs::exists(folder / "second"));
  EXPECT_EQ(text_of(log), text);
}

/// The sum of the settings, of points in batches as they come; answers in reverse order.
struct Sum {
  std::vector<std::size_t> batches;
  std::vector<Answer> operator()(const std::vector<Point>& points, const OnAnswer& on_answer) {
    batches.push_back(points.size());
    std::vector<Answer> answers;
    for (const Point& p : points) answers.push_back({PointState::ok, "", {number_of(p[0]) + number_of(p[1])}, 0});
    for (std::size_t i = points.size(); i-- > 0;) on_answer(i, answers[i]);
    return answers;
  }
};

TEST_F(Journaled, PointsAskedForTwiceAreEvaluatedOnceAndNumberedByTheFirstAsking) {
  Journal journal(log, toy_head());
  Sum sum;
  JournaledModel model(std::ref(sum), journal);
  model.evaluate({point_of({1, 2})});
  std::vector<std::size_t> heard;
  const auto answers =
      model.evaluate({point_of({3, 4}), point_of({1, 2}), point_of({3, 4}), point_of({0.0, 5}), point_of({-0.0, 5})},
                     [&](std::size_t i, const Answer&) { heard.push_back(i); });
  EXPECT_EQ(sum.batches, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(heard, (std::vector<std::size_t>{1, 4, 3, 0, 2})) << "what is remembered first";
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(answers[i].values[0], (std::vector<double>{7, 3, 7, 5, 5})[i]);
  EXPECT_EQ(model.evaluated(), 4u);
  EXPECT_EQ(model.remembered(), 2u);
  std::vector<double> first;
  for (const StudyPoint& p : journal.record().points) first.push_back(number_of(p.settings[0]));
  EXPECT_EQ(first, (std::vector<double>{1, 3, 0, -0.0}));
}

TEST_F(Journaled, PointIsOnDiskBeforeAnybodyHearsOfIt) {
  Journal journal(log, toy_head());
  Sum sum;
  JournaledModel model(std::ref(sum), journal);
  std::size_t heard = 0;
  model.evaluate({point_of({1, 2}), point_of({3, 4})},
                 [&](std::size_t, const Answer&) { EXPECT_EQ(read_journal(log).points.size(), ++heard); });
  EXPECT_EQ(heard, 2u);
}

TEST_F(Journaled, ModelThatTellsNobodyIsRecordedAllTheSame) {
  Journal journal(log, toy_head());
  JournaledModel model(
      [](const std::vector<Point>& points, const OnAnswer&) {
        return std::vector<Answer>(points.size(), Answer{PointState::ok, "", {1}, 0});
      },
      journal);
  EXPECT_EQ(model.evaluate({point_of({1, 2}), point_of({1, 3})}).size(), 2u);
  EXPECT_EQ(read_journal(log).points.size(), 2u);
}

TEST_F(Journaled, InterruptedBatchKeepsWhatItHasAndItsNumbers) {
  bool stop = true;
  const auto one_then_stop = [&](const std::vector<Point>& points, const OnAnswer& on_answer) {
    Sum sum;
    if (!stop) return sum(points, on_answer);
    on_answer(1, {PointState::ok, "", {number_of(points[1][0]) + number_of(points[1][1])}, 0});
    throw Interrupted();
  };
  const std::vector<Point> batch{point_of({1, 2}), point_of({3, 4}), point_of({5, 6})};
  Journal journal(log, toy_head());
  JournaledModel model(one_then_stop, journal);
  EXPECT_THROW(model.evaluate(batch), Interrupted);
  EXPECT_EQ(read_journal(log).points.at(0).number, 1u);
  stop = false;
  model.evaluate(batch);
  const StudyRecord record = read_journal(log);
  ASSERT_EQ(record.points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(record.points[i].settings, batch[i]);
}

TEST_F(Journaled, LogOfAnotherCourseIsRefused) {
  {
    Journal journal(log, toy_head());
    JournaledModel model(Sum(), journal);
    model.evaluate({point_of({1, 2}), point_of({3, 4})});
  }
  const auto refused = [&](const std::vector<Point>& points) {
    Journal journal(log, toy_head());
    JournaledModel model(Sum(), journal);
    return refusal([&] { model.evaluate(points); });
  };
  expect_words(refused({point_of({3, 4})}), {"point 1 is asked for as point 0", "another course"});
  expect_words(refused({point_of({1, 2}), point_of({5, 6})}), {"point 1 has other settings", "another course"});
  EXPECT_EQ(refused({point_of({1, 2}), point_of({3, 4}), point_of({5, 6})}), "");
}

TEST_F(Journaled, PointThatCannotBeWrittenStopsABatchThatRunsOnThreads) {
  Journal journal(log, toy_head());
  const auto threaded = [](const std::vector<Point>& points, const OnAnswer& on_answer) {
    std::vector<Answer> answers(points.size());
    std::mutex mutex;
    parallel_for(static_cast<int>(points.size()), 2, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      // What does not fit the head cannot be appended; a full disk throws from the same place.
      answers[k] = {PointState::ok, "", std::vector<double>(i == 2 ? 2 : 1), 0};
      const std::lock_guard lock(mutex);
      on_answer(k, answers[k]);
    });
    return answers;
  };
  JournaledModel model(threaded, journal);
  std::vector<Point> batch;
  for (int i = 0; i < 5; ++i) batch.push_back(point_of({0, static_cast<double>(i)}));
  EXPECT_THROW(model.evaluate(batch), std::logic_error);
  EXPECT_EQ(read_journal(log).points.size(), 4u) << "the others are safe";
}

}  // namespace
}  // namespace beltlife::study_test
