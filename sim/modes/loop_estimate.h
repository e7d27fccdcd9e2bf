// Owns the estimate of a drive in steady running that its linearisation starts from: arm angle, span tensions, mesh.
#pragma once

#include <vector>

#include "sim/model.h"

namespace beltlife {

/// The drive at a constant crank speed without slip, bending loss, bearing friction or dry friction at the arm.
struct LoopEstimate {
  double crank_rpm = 0;
  double belt_speed = 0;            ///< v, m/s
  double arm_angle = 0;             ///< rad, from where the scene places the arm
  Route route;                      ///< at that angle
  std::vector<double> tension;      ///< of each span, centrifugal part included, N
  double centrifugal = 0;           ///< the part of it that presses on no pulley, rho v^2, N
  std::vector<bool> gear_engaged;   ///< per gear pair: it carries a mean torque, or has no backlash
  std::vector<double> train_force;  ///< per pulley: force with which its train drives the belt onward, N
  bool slack = false;               ///< some span would have to push: the numbers mean little there
  bool balanced = true;             ///< false: no arm angle balances these tensions, the one at rest was kept
};

/// Torque tables at the speeds of running without slip give each pulley's effective tension, the driven body closes the
/// sum, and two unknowns are left, the mean tension and the arm angle: belt length and balance of the arm give both.
/// The one place to put a better quasi-static solution.
LoopEstimate estimate_loop(const Model& model, double crank_rpm);

}  // namespace beltlife
