// Owns when a frame of the moving drive is taken, and what it holds.
#pragma once

#include "sim/plan.h"
#include "sim/record.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

/// Takes frames over the last two revolutions of the driven body in a window: a whole cycle of the half order, so that
/// they close to a loop. Only looks at a drive that is observed anyway, so that a run's results do not depend on it.
class FrameTaker {
 public:
  /// `count` frames a window; none: it does nothing. The model must outlive it.
  FrameTaker(const Model& model, int count) : model_(model), count_(count) {}

  /// Begins a window; makes room in `frames`.
  void open(const Window& window, const SpeedProfile& profile, Frames& frames);
  /// Adds a frame if one is due.
  void observe(const DriveView& s, Frames& frames);

 private:
  /// Due time of the next frame, s; infinity after the last.
  double due() const;

  const Model& model_;
  int count_, next_ = 0;
  double begin_s_ = 0, end_s_ = 0;  // of what the frames cover
};

}  // namespace beltlife
