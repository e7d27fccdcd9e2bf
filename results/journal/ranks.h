// Owns the spreading of a driver's points over the processes that mpirun (or srun) started.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/eval/point.h"

namespace beltlife {

/// The processes of one job. The first leads: it alone reads and writes the log, decides, prints. The others answer
/// the points that it sends, with a model of their own, made from the same files. Answers are those of one process, to
/// the bit, because a point's answer depends on the point alone. A process that dies ends the whole job (the launcher
/// sees to that); the same command goes on from the log.
class Ranks {
 public:
  /// Joins the job; null where the program was started by itself. Throws BadInput under a launcher with several
  /// processes if the program was built without MPI, since each would then run the same study.
  static std::unique_ptr<Ranks> join();
  /// The lead ends the others, a helper waits until it is told to; both leave the job.
  virtual ~Ranks() = default;

  virtual bool leads() const = 0;
  virtual int count() const = 0;
  /// Threads of this process: as many as asked for, or, where 0 is, its share of the processors that it may use.
  virtual int threads(int asked) const = 0;
  /// Of the lead: `local` and all helpers as one model. A helper that declined makes it throw BadInput with the
  /// helper's words. After a request to stop, what was sent out is finished, then Interrupted is thrown.
  virtual PointModel spread(PointModel local, int threads) = 0;
  /// Of a helper: answers points until the lead ends it.
  virtual void answer(const PointModel& model) = 0;
  /// Of a helper: tells the lead why this process cannot answer points, such as a file that it does not find.
  virtual void decline(const std::string& why) = 0;
};

/// How many points are handed out at once: enough to fill the lanes of all threads, but never so many that a process
/// would get nothing.
std::size_t chunk_size(std::size_t points, int processes, int threads);

}  // namespace beltlife
