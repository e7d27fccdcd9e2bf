// Owns the drive linearised about steady running: mass, stiffness and damping matrices and what their rows stand for.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/modes/linear_options.h"
#include "sim/modes/operating_point.h"

namespace beltlife {

/// M q'' + C q' + K q = 0; C holds the viscous dampers (belt, shafts, teeth, arm, PID driver) and no dry friction.
/// Coordinates: turns of the free bodies, arm angle, travel of points of the belt.
struct LinearDrive {
  Eigen::MatrixXd mass;       ///< kg m^2, kg; symmetric, positive
  Eigen::MatrixXd stiffness;  ///< N m/rad, N/m; symmetric
  Eigen::MatrixXd damping;    ///< N m s/rad, N s/m; symmetric
  std::vector<int> body_row;  ///< row of each body, -1: it does not vibrate
  int arm_row = -1;           ///< row of the arm, -1: it does not turn
  int belt_row = 0;           ///< first row of the belt
};

LinearDrive linearise(const Model& model, const OperatingPoint& loop, ArmState arm, const LinearOptions& options = {});

}  // namespace beltlife
