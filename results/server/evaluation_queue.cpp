// The waiting line before a model: see evaluation_queue.h.
#include "results/server/evaluation_queue.h"

#include <algorithm>
#include <utility>

namespace beltlife {

EvaluationQueue::EvaluationQueue(std::function<PointModel()> make_model, EvaluationQueueOptions options)
    : make_model_(std::move(make_model)), options_(options), worker_([this] { work(); }) {}

EvaluationQueue::~EvaluationQueue() {
  close();
  worker_.join();
}

Answer EvaluationQueue::evaluate(const Point& point) {
  std::future<Answer> answer;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) throw Interrupted();
    answer = waiting_.emplace_back(Caller{point, {}}).answer.get_future();
    around_ = std::max(around_, waiting_.size() + at_work_);
  }
  changed_.notify_all();
  return answer.get();
}

void EvaluationQueue::close() {
  std::vector<Caller> refused;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    refused.swap(waiting_);
  }
  changed_.notify_all();
  for (Caller& caller : refused) caller.answer.set_exception(std::make_exception_ptr(Interrupted()));
}

std::size_t EvaluationQueue::batches() const {
  const std::lock_guard lock(mutex_);
  return batches_;
}

void EvaluationQueue::work() {
  for (auto batch = next_batch(); !batch.empty(); batch = next_batch()) run(batch);
}

std::vector<EvaluationQueue::Caller> EvaluationQueue::next_batch() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
  // Those just answered come back within a round trip; without them batches would alternate between few and many.
  changed_.wait_for(lock, options_.gather, [&] { return closed_ || waiting_.size() >= around_; });
  if (!waiting_.empty()) ++batches_;
  around_ = at_work_ = waiting_.size();
  return std::exchange(waiting_, {});
}

void EvaluationQueue::run(std::vector<Caller>& batch) {
  std::vector<Point> points;
  for (const Caller& caller : batch) points.push_back(caller.point);
  std::vector<bool> answered(batch.size(), false);
  const auto let_go = [&](std::size_t i) {
    if (answered[i]) return false;
    const std::lock_guard lock(mutex_);
    --at_work_;
    answered[i] = true;
    return true;
  };
  std::exception_ptr trouble;
  try {
    if (!model_ || asked_ + batch.size() > options_.remembered) {
      model_ = make_model_();
      asked_ = 0;
    }
    asked_ += batch.size();
    const auto answers = model_(points, [&](std::size_t i, const Answer& answer) {
      if (let_go(i)) batch[i].answer.set_value(answer);
    });
    for (std::size_t i = 0; i < batch.size(); ++i)  // a model need not tell early
      if (let_go(i)) batch[i].answer.set_value(answers.at(i));
  } catch (...) {
    trouble = std::current_exception();
    model_ = nullptr;
  }
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (let_go(i)) batch[i].answer.set_exception(trouble);
}

}  // namespace beltlife
