// Owns the given speed of the driven body over time: mean speed by straight pieces, and harmonics over its angle.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace beltlife {

/// Piecewise linear table over an increasing abscissa.
struct Table1 {
  std::vector<double> x, y;
  /// Linear between entries, held above the last; below the first, proportional to x; 0 for x <= 0.
  double operator()(double at) const;
};

/// One order of rotation: speed += amplitude(mean speed) cos(order angle + phase). Speeds in rad/s.
struct Harmonic {
  double order = 0;
  double phase = 0;
  Table1 amplitude;
};

/// Speed, angle and acceleration of the driven body in its running sense, SI units. Before the first knot the first
/// speed holds, after the last the last.
class SpeedProfile {
 public:
  struct Knot {
    double time = 0;   ///< s
    double speed = 0;  ///< mean speed, rad/s
    double angle = 0;  ///< integral of the mean speed from the first knot, rad
  };

  SpeedProfile() = default;
  /// `times` increasing, s; `speeds` rad/s. Angles are integrated exactly.
  SpeedProfile(const std::vector<double>& times, const std::vector<double>& speeds,
               std::vector<Harmonic> harmonics = {}, double phase = 0);

  struct Value {
    double mean = 0;          ///< rad/s
    double angle = 0;         ///< nominal (of the mean speed), rad
    double speed = 0;         ///< with harmonics, rad/s
    double acceleration = 0;  ///< of `speed`, rad/s^2 (the amplitudes' own change left out)
  };
  Value at(double time) const;
  double speed(double time) const { return at(time).speed; }
  const std::vector<Knot>& knots() const { return knots_; }

 private:
  std::vector<Knot> knots_;
  std::vector<Harmonic> harmonics_;
  double phase_ = 0;
};

/// Harmonics of a driver spec in SI units, scaled by ripple_scale.
std::vector<Harmonic> harmonics_of(const DriverSpec& driver);

}  // namespace beltlife
