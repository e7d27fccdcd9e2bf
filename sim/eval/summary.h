// Owns the reduction of an evaluated window to the numbers that tables, JSON and drivers read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/record.h"
#include "sim/signal/bands.h"

namespace beltlife {

struct OrderLine {
  double order = 0;
  double hz = 0;          ///< at the range's mean speed of the driven body
  double speed_rpm = 0;   ///< amplitude; not a number where the window cannot tell the order (Nyquist, length)
  double torque_n_m = 0;  ///< likewise
};

/// What the orders leave between two frequencies, as the amplitude of the sine of the same power; not a number where
/// the window cannot tell (Nyquist, length).
struct BandLine {
  Band band;
  double speed_rpm = 0;
  double torque_n_m = 0;
};

/// The two outputs that are compared with measurements.
struct OutputSummary {
  std::string body;
  double speed_rpm_mean = 0, speed_rpm_min = 0, speed_rpm_max = 0;
  double torque_n_m_mean = 0, torque_n_m_min = 0, torque_n_m_max = 0;
  /// Where the spectrum is highest; not a number in a window too short for one.
  double speed_peak_hz = 0, torque_peak_hz = 0;
  std::vector<OrderLine> orders;
  std::vector<BandLine> bands;  ///< octave_bands, in their order
};

struct SpanSummary {
  std::string name;
  double tension_n_mean = 0, tension_n_min = 0, tension_n_max = 0;
  double deflection_mm_min = 0, deflection_mm_max = 0;
};

struct PulleySummary {
  std::string name;
  double speed_rpm_mean = 0;
  std::optional<double> slip_percent;  ///< mean, behind the driven pulley; none if what is driven is no pulley
  double hub_load_n = 0;               ///< mean of the magnitude
  double hub_load_n_max = 0;
  double hub_direction_deg = 0;  ///< of the mean vector, counterclockwise from x
  double torque_n_m_mean = 0;
};

struct RangeSummary {
  std::string name;
  double crank_rpm = 0;
  bool complete = false;
  std::optional<OutputSummary> output;
  std::vector<SpanSummary> spans;
  std::vector<PulleySummary> pulleys;
  std::vector<double> power_w;  ///< by Energy: mean power over the window
  double energy_residual = 0;   ///< of the throughput
  /// Largest change of a span's mean tension from the first half of the window to the second, of its mean: a drive
  /// that has not settled shows here.
  double drift = 0;
  std::optional<double> arm_angle_mean, arm_angle_min, arm_angle_max;  ///< rad
};

RangeSummary summarise(const Model& model, const RunRecord& run, const WindowRecord& window);

}  // namespace beltlife
