// Owns what is recorded of a running drive: samples of all channels; of evaluated windows passes, energy, history,
// frames.
#pragma once

#include <memory>
#include <vector>

#include "sim/energy.h"
#include "sim/observe/frame_taker.h"
#include "sim/observe/pass_tracker.h"
#include "sim/observe/sensors.h"
#include "sim/plan.h"
#include "sim/record.h"

namespace beltlife {

/// Buffers are reserved up front, those of frames as a window opens; recording allocates nothing.
class Recorder {
 public:
  /// Model, plan and record must outlive it. `frames` of the moving drive are kept at the end of each window.
  Recorder(const Model& model, const RunPlan& plan, RunRecord& record, int frames = 0);

  /// Whether an evaluated window is open.
  bool open() const { return open_; }
  /// One sample of every channel.
  void sample(const DriveView& s);
  /// Closes and opens windows whose edges have come; true if one was closed.
  bool turn(const DriveView& s);
  /// Ends the open window, if any, whole or broken off.
  void close(const DriveView& s, bool complete);
  /// After a contact search.
  void searched(const DriveView& s);
  /// Energy, passes and the travelling element, in an open window; `sample`: a sample is taken at this instant too.
  void observe(const DriveView& s, bool sample);

 private:
  const Model& model_;
  const RunPlan& plan_;
  RunRecord& record_;
  Sensors sensors_;
  FrameTaker frames_;
  std::vector<std::unique_ptr<PassTracker>> trackers_;
  std::size_t next_ = 0;  // window that is open or comes next
  bool open_ = false;
  StoredEnergy begin_;
  double last_observed_ = 0, last_history_ = 0;
};

}  // namespace beltlife
