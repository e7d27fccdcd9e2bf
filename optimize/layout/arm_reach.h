// Owns how far a tensioner's arm can turn and still hold a belt.
#pragma once

#include <optional>

#include "optimize/layout/loop_shape.h"
#include "sim/route/arm_stops.h"

namespace beltlife {

/// The arm of one layout. Angles in rad, counterclockwise from where the scene places the arm.
struct ArmOfLayout {
  std::vector<Circle> circles;  ///< as placed
  std::size_t pulley = 0;       ///< on the arm
  Vec2 pivot;                   ///< m
  ArmStops stops;
  double spring_torque = 0;             ///< N m as placed, counterclockwise
  double spring_rate = 0;               ///< N m/rad
  std::optional<double> tension_limit;  ///< N; absent: the reach is that of the geometry and the stops alone

  /// Circles with the arm turned, into `turned`.
  void turn(double angle, std::vector<Circle>& turned) const;
  /// d(path length)/d(arm angle), m/rad, of the loop with the arm turned.
  double leverage(const LoopShape& shape) const;
  /// Tension that balances the spring, N.
  double tension(const LoopShape& shape, double angle) const {
    return (spring_torque - spring_rate * angle) / leverage(shape);
  }
};

/// One end of the reach.
struct ReachEnd {
  double angle = 0;    ///< rad
  double length = 0;   ///< of the path, m
  double tension = 0;  ///< N
};

struct ArmReach {
  ReachEnd low, high;  ///< clockwise and counterclockwise end
};

/// The ends of the turning from `rest`: where the loop can no longer be built, a stop is met, turning on would change
/// the path the other way (a toggle), and, with a tension limit, where the spring has run out or the belt passes the
/// limit. Looked for in steps of 2 degrees, up to half a turn. Where the loop at rest cannot be built both ends are
/// there.
ArmReach arm_reach(const ArmOfLayout& arm, double rest);

}  // namespace beltlife
