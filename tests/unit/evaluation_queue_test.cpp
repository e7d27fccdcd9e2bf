// Owns the claims about the waiting line before a model: who waits together runs together, and nobody waits for
// nothing.
#include "results/server/evaluation_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace beltlife {
namespace {

using namespace std::chrono_literals;

Answer twice(const Point& p) { return {PointState::ok, "", {2 * number_of(p.at(0))}, 0}; }

/// Doubles its number, after a while that does not grow with the batch; notes the sizes of its batches.
struct SlowDoubler {
  std::chrono::milliseconds takes{20};
  std::shared_ptr<std::vector<std::size_t>> sizes = std::make_shared<std::vector<std::size_t>>();

  std::vector<Answer> operator()(const std::vector<Point>& points, const OnAnswer& on_answer) const {
    sizes->push_back(points.size());
    std::this_thread::sleep_for(takes);
    std::vector<Answer> answers;
    for (const Point& p : points) answers.push_back(twice(p));
    for (std::size_t i = 0; i < points.size(); ++i) on_answer(i, answers[i]);
    return answers;
  }
};

TEST(EvaluationQueue, GathersClientsThatComeBack) {
  const SlowDoubler model;
  EvaluationQueue queue([&] { return model; }, {.gather = 300ms});
  std::vector<std::thread> clients;
  std::atomic<int> wrong = 0;
  for (int c = 0; c < 4; ++c)
    clients.emplace_back([&, c] {
      for (int i = 0; i < 10; ++i)
        if (const double x = 100 * c + i; queue.evaluate(Point{x}).values.at(0) != 2 * x) ++wrong;
    });
  for (std::thread& t : clients) t.join();
  EXPECT_EQ(wrong, 0);
  // The first batch may be of one, and so may be the last ones, for which those are awaited who have left.
  std::size_t whole = 0;
  for (const std::size_t size : *model.sizes) whole += size == 4;
  EXPECT_GE(whole, 7u);
  EXPECT_LE(queue.batches(), 16u) << "of 40 points";
}

TEST(EvaluationQueue, NeverMakesALoneClientWait) {
  EvaluationQueue queue(
      [] {
        return [](const std::vector<Point>& points, const OnAnswer&) { return std::vector<Answer>{twice(points[0])}; };
      },
      {.gather = 10s});
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(queue.evaluate(Point{1.0 * i}).values.at(0), 2.0 * i);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s) << "a single wait takes ten seconds";
  EXPECT_EQ(queue.batches(), 20u);
}

TEST(EvaluationQueue, GivesAFailureToTheBatchThatItBroke) {
  EvaluationQueue queue([] {
    return [](const std::vector<Point>& points, const OnAnswer&) -> std::vector<Answer> {
      if (number_of(points.at(0).at(0)) < 0) throw std::runtime_error("broken");
      return {twice(points[0])};
    };
  });
  EXPECT_THROW(queue.evaluate(Point{-1.0}), std::runtime_error);
  EXPECT_EQ(queue.evaluate(Point{4.0}).values.at(0), 8) << "the next is answered";
}

TEST(EvaluationQueue, MakesItsModelAnewSoThatItsMemoryStaysFinite) {
  int made = 0;
  EvaluationQueue queue(
      [&] {
        ++made;
        return [](const std::vector<Point>& points, const OnAnswer&) { return std::vector<Answer>{twice(points[0])}; };
      },
      {.remembered = 10});
  for (int i = 0; i < 25; ++i) queue.evaluate(Point{1.0});
  EXPECT_EQ(made, 3);
}

TEST(EvaluationQueue, RefusesThoseWhoWaitWhenClosedAndFinishesTheBatchAtWork) {
  std::atomic<bool> working = false, go_on = false;
  EvaluationQueue queue([&] {
    return [&](const std::vector<Point>& points, const OnAnswer&) {
      working = true;
      while (!go_on) std::this_thread::sleep_for(1ms);
      return std::vector<Answer>{twice(points[0])};
    };
  });
  double first = 0;
  std::atomic<bool> refused = false;
  std::thread at_work([&] { first = queue.evaluate(Point{3.0}).values.at(0); });
  while (!working) std::this_thread::sleep_for(1ms);
  std::thread waiting([&] {
    try {
      queue.evaluate(Point{5.0});
    } catch (const Interrupted&) {
      refused = true;
    }
  });
  std::this_thread::sleep_for(20ms);  // long enough to stand in line; if it is not, it is refused at the door
  queue.close();
  waiting.join();
  EXPECT_TRUE(refused);
  go_on = true;
  at_work.join();
  EXPECT_EQ(first, 6);
  EXPECT_THROW(queue.evaluate(Point{1.0}), Interrupted);
}

}  // namespace
}  // namespace beltlife
