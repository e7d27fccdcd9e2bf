// Owns what is made of a run through a range of speeds: orders of the output over crank speed, and modes beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/modes/campbell.h"
#include "sim/plan.h"
#include "sim/record.h"

namespace beltlife {

/// One quantity of the output.
struct SweepChannel {
  std::string name;  ///< of the channel, e.g. "drive_shaft.speed_rpm"
  std::string unit;
  std::vector<std::vector<double>> amplitude;  ///< [order][place]; not a number above half the sampling rate
};

struct Sweep {
  SweepSpec asked;
  double begin_s = 0, end_s = 0;       ///< of the sweep, in the run's time
  bool complete = false;               ///< false: the run failed before the sweep ended
  double window_revolutions = 0;       ///< of the driven body, under one window
  std::vector<double> time_s;          ///< centre of each window, "place" above
  std::vector<double> crank_rpm;       ///< mean speed there
  std::vector<double> orders;          ///< equally spaced
  std::vector<SweepChannel> channels;  ///< speed and torque of the output
  EnergyAccount energy;                ///< over the sweep
  Campbell modes;                      ///< natural frequencies over the sweep's speeds
  std::vector<Crossing> crossings;     ///< where orders meet them; near no range
};

/// Where an order is largest.
struct SweepPeak {
  double order = 0;
  double amplitude = 0;
  double crank_rpm = 0;
  double frequency_hz = 0;
  std::optional<Crossing> near;  ///< what the order meets within 10 % of the speed: the nearest rotational
                                 ///< mode, else the nearest of a span
};

/// The fastest change that order tracking follows: of the lowest speed, over one window there.
inline constexpr double largest_sweep_change = 0.1;
/// The shortest such sweep, s; speeds above 0.
double shortest_sweep_s(double from_rpm, double to_rpm);

/// Orders of the output over the sweep. `window` is that of plan_sweep, closed. The model has a driver and an output.
Sweep sweep_of(const Model& model, const SweepSpec& asked, const RunRecord& run, const WindowRecord& window);

/// Of orders 0.5 to 9 by halves, those that are anywhere below half the sampling rate.
std::vector<SweepPeak> peaks_of(const Sweep& sweep, const SweepChannel& channel);

}  // namespace beltlife
