// Owns the quasi-static solution of a range: steady running at the mean speed, without ripple or vibration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/life/life.h"
#include "sim/model.h"

namespace beltlife {

struct QuasiStaticSpan {
  std::string name;
  double tension = 0;                        ///< N, as the simulator's sensors give it: with the centrifugal part
  double tension_low = 0, tension_high = 0;  ///< N, between the arm's two friction limits
};

struct QuasiStaticPulley {
  std::string name;
  double speed = 0;                            ///< rad/s, in the running sense
  double torque = 0;                           ///< N m, of the belt on the pulley, in the running sense
  double wrap = 0;                             ///< rad
  double hub_x = 0, hub_y = 0;                 ///< N, force of the belt on the pulley
  double hub_load = 0;                         ///< N
  double hub_load_low = 0, hub_load_high = 0;  ///< N, between the arm's two friction limits
  std::optional<double> slip_safety;           ///< friction x wrap over what the torque takes; none without torque
  bool slips = false;                          ///< turning, and slip_safety below 1: the belt could not hold this
  double bending_loss = 0;                     ///< W, with the contact that lets the belt sink
  double creep_loss = 0;                       ///< W, sliding where the tension changes
  double rigid_loss = 0;                       ///< W, closed form of a pulley that holds the belt rigidly
};

struct QuasiStaticRange {
  std::string name;
  double crank_rpm = 0;
  std::optional<std::string> error;  ///< in words, where there is no solution; the rest is then empty
  double belt_speed = 0;             ///< m/s, of the unstretched belt: length that passes in a second
  double centrifugal = 0;            ///< N, m' v^2: what the tensions hold of the belt's own mass
  std::optional<double> arm_angle;   ///< rad; none without tensioner
  std::optional<double> arm_angle_low, arm_angle_high;  ///< rad, between the friction limits
  ArmStop arm_stop = ArmStop::none;                     ///< on which the arm rests, without friction
  std::vector<std::string> released;                    ///< one-way springs that overrun
  bool band_incomplete = false;        ///< one friction limit was not solved: the lows and highs lie too close together
  std::vector<std::string> remarks;    ///< in words: slipping pulleys, the arm's stop, released springs, open bands
  std::vector<QuasiStaticSpan> spans;  ///< scene order, span i from pulley i to the next
  std::vector<QuasiStaticPulley> pulleys;  ///< scene order
  double driver_power = 0;                 ///< W into the drive
  double table_power = 0;                  ///< W into the drive
  double loss = 0;                         ///< W, bending and creep of all pulleys
};

/// Solves one range: span tensions and arm angle from the torque tables at the speeds of creep, the belt's length and
/// the arm's balance. README.md has the equations and what is left out. The model is of the range's condition; else
/// std::logic_error is thrown, here and below.
QuasiStaticRange solve_quasi_static(const Model& model, const RangeSpec& range);

/// Loads for life.h from a solution: steady tensions, normal forces T' l0/R of the tighter side times a peak factor,
/// tangential forces at the friction limit of the leaving side where a pulley carries torque. An estimate: no ripple,
/// no vibration, so no alternating tension beyond the one from span to span.
RangeLoad estimated_load(const Model& model, const RangeSpec& range, const QuasiStaticRange& solution);

/// Largest normal force of a pass over T' l0/R of the tighter side, as sampled at 1000 Hz and as resolved: medians of
/// the three front pulleys of the baseline drive at B100 without ripple, 512 elements, 2026-11-22 (1.34, 1.22, 1.15
/// and 2.05, 1.84, 2.59 on drive, crank, tensioner).
inline constexpr double sampled_peak_factor = 1.22, resolved_peak_factor = 2.05;

}  // namespace beltlife
