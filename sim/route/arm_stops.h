// Owns the stops of a tensioner arm: the angles at which they meet it and the torque with which they hold it.
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

#include "sim/scene/scene.h"

namespace beltlife {

/// On which stop an arm rests: the one that ends its turning in the path-lengthening or in the path-shortening sense.
enum class ArmStop { none, lengthening, shortening };

/// Angles in rad, counterclockwise from where the scene places the arm. A stop is a spring and damper that only pushes.
struct ArmStops {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double stiffness = 0;  ///< N m/rad
  double damping = 0;    ///< N m s/rad

  bool any() const { return low > -std::numeric_limits<double>::max() || high < std::numeric_limits<double>::max(); }
  /// How far the arm has turned into a stop, signed as the angle; 0 between the stops.
  double depth(double angle) const { return angle > high ? angle - high : std::min(angle - low, 0.0); }
  double elastic_torque(double angle) const { return -stiffness * depth(angle); }
  double torque(double angle, double rate) const {
    const double d = depth(angle), t = -stiffness * d - damping * rate;
    return d > 0 ? std::min(t, 0.0) : d < 0 ? std::max(t, 0.0) : 0;
  }
  /// The stop into which the arm has turned; `lengthening` is +1 where counterclockwise lengthens the path, else -1.
  ArmStop at(double angle, double lengthening) const {
    const double d = lengthening * depth(angle);
    return d > 0 ? ArmStop::lengthening : d < 0 ? ArmStop::shortening : ArmStop::none;
  }
};

inline ArmStops arm_stops_of(const TensionerSpec& spec, double lengthening) {
  constexpr double degree = std::numbers::pi / 180;
  ArmStops s;
  const auto& up = lengthening > 0 ? spec.stop_lengthening_deg : spec.stop_shortening_deg;
  const auto& down = lengthening > 0 ? spec.stop_shortening_deg : spec.stop_lengthening_deg;
  if (up) s.high = *up * degree;
  if (down) s.low = -*down * degree;
  s.stiffness = spec.stop_stiffness_n_m_per_rad;
  s.damping = spec.stop_damping_n_m_s_per_rad;
  return s;
}

}  // namespace beltlife
