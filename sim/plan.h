// Owns what is run: a speed profile over time and the windows of it that are evaluated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/speed_profile.h"

namespace beltlife {

/// A stretch of a run that is evaluated.
struct Window {
  std::string range;
  double crank_rpm = 0;
  double duty_share = 0;
  double begin_s = 0, end_s = 0;
  /// Record forces per belt pass and those on a travelling element: what stresses need, and megabytes a minute.
  bool contact_forces = true;
};

struct RunPlan {
  std::string name;
  SpeedProfile profile;
  std::vector<Window> windows;
  double end_s = 0;
  /// Windows are stretches of one hold, of which the last one run is kept; the run ends once two agree within this.
  std::optional<double> settled_within = {};
  /// Of the drive that runs it: that of the range; the base one where no single range is run.
  DriveCondition condition = {};
};

/// A measured speed of the driven body: time (s, increasing) and speed (r/min, positive in the running sense).
struct MeasuredSpeed {
  std::vector<double> time_s, speed_rpm;
};

/// One range alone: settle at rest, ramp, hold; the last evaluate_s of the hold is the window. With a measured speed
/// the hold plays the stretch of it in which the whole profile holds this range.
RunPlan plan_range(const SceneSpec& scene, const RangeSpec& range, const MeasuredSpeed* measured = nullptr);

/// All ranges one after the other: settle, ramp, then holds with transitions between; one window a range. One drive
/// runs through all of them, in the base condition.
RunPlan plan_profile(const SceneSpec& scene, const MeasuredSpeed* measured = nullptr);

/// As plan_range, with every stretch of evaluate_s of the hold as a window, one behind the other, so that the run can
/// end early. The last window is that of plan_range.
RunPlan plan_blocks(const SceneSpec& scene, const RangeSpec& range, const MeasuredSpeed* measured = nullptr);

/// A steady change of the driven body's speed.
struct SweepSpec {
  double from_rpm = 0, to_rpm = 0;
  double seconds = 0;
};

/// Settle at rest, ramp to the first speed, hold it as long as a range holds before it is evaluated, then sweep. One
/// window, "sweep", over the sweep, without contact forces. The scene has a driver.
RunPlan plan_sweep(const SceneSpec& scene, const SweepSpec& sweep);

/// The scene's event, preceded by settling at rest and, unless it starts from there, by ramp and hold at its first
/// speed. One window, "event", over the event, without contact forces. The scene has an event.
RunPlan plan_event(const SceneSpec& scene);

/// A scene without ranges: settle and hold, with one window named "rest".
RunPlan plan_rest(const SceneSpec& scene);

}  // namespace beltlife
