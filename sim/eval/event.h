// Owns what is made of an event (a start, an acceleration, a stop): extremes of every part with their times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/record.h"

namespace beltlife {

/// A value and when it occurred, s since the event began.
struct Timed {
  double value = 0;
  double time_s = 0;
};

/// Highest and lowest of a sampled channel.
struct TimedExtent {
  Timed high, low;
};

struct EventSpan {
  std::string name;
  TimedExtent tension_n;
  double slack_s = 0;  ///< how long it held less than slack_share of the tension at rest
};

struct EventPulley {
  std::string name;
  TimedExtent speed_rpm;
  Timed slip_m_s;            ///< of the largest absolute value; positive: the belt runs ahead of the pulley
  double sliding_s = 0;      ///< how long the belt slid faster than sliding_m_s
  double slip_energy_j = 0;  ///< that friction took here
  Timed hub_load_n;          ///< largest
};

/// A torsional spring (N m) or a gear pair (N).
struct EventLoad {
  std::string name;
  TimedExtent load;
};

struct EventArm {
  TimedExtent angle_rad;
  Timed rate_rad_s;               ///< of the largest absolute value
  std::optional<Timed> stop_n_m;  ///< largest absolute torque of the stops; none of an arm without them
  double on_stop_s = 0;
};

struct EventSummary {
  double duration_s = 0;  ///< that was run
  bool complete = false;
  TimedExtent driver_rpm, driver_torque_n_m;
  std::optional<TimedExtent> output_rpm, output_torque_n_m;
  std::vector<EventSpan> spans;  ///< scene order, like the following
  std::vector<EventPulley> pulleys;
  std::vector<EventLoad> springs, gears;
  std::optional<EventArm> arm;
  double energy_residual = 0;  ///< of the throughput
};

inline constexpr double slack_share = 0.01;
/// Five times the friction law's default speed of saturation; creep of a belt that holds is a tenth of it.
inline constexpr double sliding_m_s = 0.1;

/// `window` is that of plan_event, closed; the model's scene has an event. Times are resolved to a sample.
EventSummary summarise_event(const Model& model, const RunRecord& run, const WindowRecord& window);

}  // namespace beltlife
