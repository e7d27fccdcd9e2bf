// Points over MPI: see ranks.h. The only includer of mpi.h.
#ifdef BELTLIFE_MPI
#define OMPI_SKIP_MPICXX  // the C++ bindings need a library of their own
#define MPICH_SKIP_MPICXX
#include <fmt/format.h>
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

#include "results/journal/ranks.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using Bytes = std::vector<std::uint8_t>;

// What a message says. `work` without points is the end.
enum Tag { work = 1, answered, done, declined };

// CBOR keeps every bit of a double.
Bytes packed(const nlohmann::json& content) { return nlohmann::json::to_cbor(content); }

nlohmann::json packed_answer(std::size_t index, const Answer& a) {
  return {index, static_cast<int>(a.state), a.reason, a.values, a.processor_s};
}

Answer answer_in(const nlohmann::json& content) {
  return {static_cast<PointState>(content[1].get<int>()), content[2], content[3], content[4]};
}

nlohmann::json packed_points(const std::vector<Point>& points, std::size_t begin, std::size_t end) {
  auto content = nlohmann::json::array();
  for (std::size_t i = begin; i < end; ++i) {
    auto point = nlohmann::json::array();
    for (const Setting& s : points[i]) std::visit([&](const auto& value) { point.push_back(value); }, s);
    content.push_back(std::move(point));
  }
  return content;
}

std::vector<Point> points_in(const nlohmann::json& content) {
  std::vector<Point> points;
  for (const auto& settings : content) {
    Point& point = points.emplace_back();
    for (const auto& s : settings) {
      if (s.is_string())
        point.emplace_back(s.get<std::string>());
      else
        point.emplace_back(s.get<double>());
    }
  }
  return points;
}

struct Message {
  int from = 0;
  int tag = 0;
  Bytes content;
};

void send(int to, Tag tag, const Bytes& content = {}) {
  MPI_Send(content.data(), static_cast<int>(content.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

// MPI's own waiting would keep a processor busy that threads of the same machine need.
void rest() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

bool receive(Message& message) {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (!there) return false;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  message = {status.MPI_SOURCE, status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Recv(message.content.data(), size, MPI_BYTE, message.from, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return true;
}

// Processors that this process may use, shared with those on its machine that may use the very same.
int processor_share() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof mine, &mine);
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int neighbours = 0;
  MPI_Comm_size(machine, &neighbours);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(neighbours));
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, machine);
  MPI_Comm_free(&machine);
  const auto sharing = std::count_if(all.begin(), all.end(), [&](const cpu_set_t& s) { return CPU_EQUAL(&s, &mine); });
  return std::max(1, CPU_COUNT(&mine) / static_cast<int>(sharing));
}

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    int level = 0;  // answers are sent by whichever thread has one, one at a time
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    share_ = processor_share();
  }

  ~MpiRanks() override {
    if (leads())
      for (int helper = 1; helper < count_; ++helper) send(helper, work);
    else
      answer({});
    MPI_Finalize();
  }

  bool leads() const override { return rank_ == 0; }
  int count() const override { return count_; }
  int threads(int asked) const override { return asked > 0 ? asked : share_; }

  PointModel spread(PointModel local, int threads) override {
    return [this, local = std::move(local), threads](const std::vector<Point>& points, const OnAnswer& on_answer) {
      return evaluate(local, threads, points, on_answer);
    };
  }

  void answer(const PointModel& model) override {
    Message message;
    while (!ended_) {
      if (!receive(message)) {
        rest();
      } else if (message.content.empty()) {
        ended_ = true;
      } else if (model) {
        answer(model, points_in(nlohmann::json::from_cbor(message.content)));
      }
    }
  }

  void decline(const std::string& why) override {
    char machine[MPI_MAX_PROCESSOR_NAME] = "";
    int length = 0;
    MPI_Get_processor_name(machine, &length);
    const std::string words = fmt::format("process {} on {}: {}", rank_, machine, why);
    send(0, declined, Bytes(words.begin(), words.end()));
  }

 private:
  static void answer(const PointModel& model, const std::vector<Point>& points) {
    try {
      model(points, [](std::size_t i, const Answer& a) { send(0, answered, packed(packed_answer(i, a))); });
    } catch (const std::exception& bug) {  // the lead would wait for the rest
      fmt::print(stderr, "beltlife: a bug, in a process that answers points: {}\n", bug.what());
      MPI_Abort(MPI_COMM_WORLD, 4);
    }
    send(0, done);
  }

  // All that was sent out is answered when this returns or throws.
  std::vector<Answer> evaluate(const PointModel& local, int threads, const std::vector<Point>& points,
                               const OnAnswer& on_answer) {
    std::vector<Answer> answers(points.size());
    std::mutex mutex;  // of everything below that the local thread uses too
    std::size_t next = 0, handed_on = 0;
    std::vector<bool> busy(static_cast<std::size_t>(count_), false);  // helpers that have points
    const std::size_t chunk = chunk_size(points.size(), count_, threads);
    std::exception_ptr failure;
    const auto take = [&]() -> std::pair<std::size_t, std::size_t> {
      const std::lock_guard lock(mutex);
      if (failure || stop_requested()) next = points.size();
      const std::size_t begin = next;
      next = std::min(points.size(), begin + chunk);
      return {begin, next};
    };
    const auto hand_on = [&](std::size_t index, Answer a) {
      const std::lock_guard lock(mutex);
      answers[index] = std::move(a);
      ++handed_on;
      if (on_answer) on_answer(index, answers[index]);
    };
    const auto fail = [&] {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    };

    bool local_done = false;
    std::thread own([&] {
      try {
        for (auto [begin, end] = take(); begin < end; std::tie(begin, end) = take())
          local({points.begin() + begin, points.begin() + end},
                [&, first = begin](std::size_t i, const Answer& a) { hand_on(first + i, a); });
      } catch (...) {
        fail();
      }
      const std::lock_guard lock(mutex);
      local_done = true;
    });

    std::vector<std::size_t> first(static_cast<std::size_t>(count_), 0);  // of each helper's points
    const auto employ = [&](int helper) {
      const auto [begin, end] = take();
      busy[static_cast<std::size_t>(helper)] = begin < end;
      first[static_cast<std::size_t>(helper)] = begin;
      if (begin < end) send(helper, work, packed(packed_points(points, begin, end)));
    };
    for (int helper = 1; helper < count_; ++helper) employ(helper);
    const auto finished = [&] {
      const std::lock_guard lock(mutex);
      return local_done && std::find(busy.begin(), busy.end(), true) == busy.end();
    };
    for (Message message; !finished();) {
      if (!receive(message)) {
        rest();
        continue;
      }
      const auto from = static_cast<std::size_t>(message.from);
      try {
        if (message.tag == done) {
          employ(message.from);
        } else if (message.tag == answered) {
          const auto content = nlohmann::json::from_cbor(message.content);
          hand_on(first[from] + content[0].get<std::size_t>(), answer_in(content));
        } else if (message.tag == declined) {
          busy[from] = false;
          throw BadInput({Problem{"mpirun", 0, "", std::string(message.content.begin(), message.content.end()), ""}});
        }
      } catch (...) {
        fail();
      }
    }
    own.join();
    if (failure) std::rethrow_exception(failure);
    if (handed_on < points.size()) throw Interrupted();
    return answers;
  }

  int rank_ = 0, count_ = 1, share_ = 1;
  bool ended_ = false;  ///< of a helper
};

}  // namespace

std::unique_ptr<Ranks> Ranks::join() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name)) return std::make_unique<MpiRanks>();
  return nullptr;
}

}  // namespace beltlife
#endif
