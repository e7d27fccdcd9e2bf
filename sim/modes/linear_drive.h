// Owns the drive linearised about steady running: mass, stiffness and damping matrices and what their rows stand for.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "sim/modes/operating_point.h"

namespace beltlife {

/// What the tensioner arm does in small vibrations: it turns freely (dry friction overcome), it is held by dry friction
/// through the friction's anchor spring, it cannot turn because the scene locks it, or there is none.
enum class ArmState { free, stuck, locked, none };
std::string_view name_of(ArmState arm);

/// The states that this drive's arm can be in.
std::vector<ArmState> arm_states(const Model& model);

struct LinearOptions {
  /// Let the belt creep on its pulleys as far as the contact's springs let it, as in the simulator: the friction
  /// anchors tangentially, the penalty radially. False: no belt moves on its pulley, so that a free span is EA/length.
  bool contact_compliance = true;
  /// Longest piece of belt between two of its coordinates, m.
  double piece = 0.04;
};

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
