// Owns the waiting line before a model: callers from many threads, gathered into batches for one model.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "sim/eval/point.h"

namespace beltlife {

struct EvaluationQueueOptions {
  /// How long a batch waits for callers that were there lately and are expected back. A lone caller never waits.
  std::chrono::duration<double> gather{0.005};
  std::size_t remembered = 10000;  ///< points after which the model is made anew, so that its memo stays finite
};

/// One batch at a time goes to the model, with all who wait, so that drives share vector lanes and no more threads are
/// at work than the model itself uses. Answers do not depend on batches, because a PointModel's do not.
class EvaluationQueue {
 public:
  EvaluationQueue(std::function<PointModel()> make_model, EvaluationQueueOptions options = {});
  ~EvaluationQueue();  ///< closes, and waits for the batch at work

  /// Blocks until the point is answered; from any thread. Throws Interrupted once the queue is closed, and what the
  /// model throws.
  Answer evaluate(const Point& point);

  /// Whoever waits, and whoever comes, gets Interrupted; the batch at work goes on.
  void close();

  std::size_t batches() const;  ///< handed to the model so far

 private:
  struct Caller {
    Point point;
    std::promise<Answer> answer;
  };

  void work();
  std::vector<Caller> next_batch();
  void run(std::vector<Caller>& batch);

  std::function<PointModel()> make_model_;
  EvaluationQueueOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Caller> waiting_;
  bool closed_ = false;
  std::size_t batches_ = 0;
  std::size_t at_work_ = 0;  ///< callers of the batch at work that have no answer yet
  std::size_t around_ = 1;   ///< most callers at once since that batch began: so many are expected for the next
  PointModel model_;
  std::size_t asked_ = 0;  ///< points that the model has seen
  std::thread worker_;     ///< the last member: it uses the others
};

}  // namespace beltlife
