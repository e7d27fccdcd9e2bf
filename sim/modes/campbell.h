// Owns natural frequencies over crank speed and where orders of the crank's rotation meet them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/modes/modes.h"

namespace beltlife {

/// One natural frequency over the crank speeds of its diagram.
struct FrequencyCurve {
  std::string name;                  ///< "rotational 2, arm free", "transverse 1 of crank-idler"
  std::optional<ArmState> arm;       ///< of a rotational mode; none: transverse
  std::vector<double> frequency_hz;  ///< at each crank speed
  double damping_ratio = 0;          ///< the least over these speeds; 0 of a span
};

struct Campbell {
  std::vector<double> crank_rpm;  ///< increasing
  std::vector<std::string>
      states;  ///< at each speed: teeth engaged, vibrations counted; a change is a jump of the curves
  std::vector<FrequencyCurve> curves;
};

/// From 5 % below the slowest range to 5 % above the fastest, at all speeds in the model's condition. Empty without
/// ranges or pulleys. Rotational modes are the damped ones; those that lie above the highest order everywhere are left
/// out.
Campbell campbell(const Model& model, int points = 31, const ModesOptions& options = {});

/// An order of the crank's rotation meets a natural frequency.
struct Crossing {
  double frequency_hz = 0;
  double order = 0;                 ///< cycles per revolution of the driven body
  double crank_rpm = 0;             ///< where they meet
  std::string mode;                 ///< name of the curve
  double damping_ratio = 0;         ///< of the curve
  std::optional<std::string> near;  ///< the nearest range, if its speed is within 5 %
};

/// Sorted by order, then speed. Orders are those tracked by default, 0.5 to 9 by halves.
std::vector<Crossing> crossings(const Campbell& diagram, const std::vector<RangeSpec>& ranges);

}  // namespace beltlife
