// Owns the operating point about which a drive is linearised: arm angle, span tensions, which teeth are engaged.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// The drive at a constant crank speed, in its model's condition. Tensions and arm angle are the quasi-static
/// solution's (statics/), with dry friction at the arm at the middle of its band. Where there is none, see `instead`.
struct OperatingPoint {
  double crank_rpm = 0;
  double belt_speed = 0;           ///< v, m/s, of the unstretched belt
  double arm_angle = 0;            ///< rad, from where the scene places the arm
  Route route;                     ///< at that angle
  std::vector<double> tension;     ///< of each span, centrifugal part included, N
  double centrifugal = 0;          ///< the part of it that presses on no pulley, N
  std::vector<bool> gear_engaged;  ///< per gear pair: it carries a mean torque, or has no backlash
  std::vector<bool> released;      ///< per torsional spring: one-way, and it overruns
  bool on_stop = false;            ///< the arm leans on one of its stops
  bool slack = false;              ///< some span would have to push: the numbers mean little there
  bool balanced = true;            ///< false: a running drive without a quasi-static solution
  std::string instead;             ///< what stands in for the quasi-static solution and why, in words; empty: nothing
};

/// A drive that stands, or that no driver turns, is at its static balance. A running drive that the quasi-static
/// solution refuses (pulleys joined by shafts, a slack span, no balance) is taken without its torques: the tension at
/// rest everywhere, and at a tensioner that turns the centrifugal part on top, because its spring sets what presses.
OperatingPoint operating_point(const Model& model, double crank_rpm);

}  // namespace beltlife
