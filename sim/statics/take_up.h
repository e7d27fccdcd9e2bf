// Owns the take-up of a tensioner: which belt lengths it can hold, and how tight each would be.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// One arm position, at rest and without friction.
struct TakeUpRow {
  std::string name;               ///< longest, as placed, at rest, shortest
  double arm_angle = 0;           ///< rad, counterclockwise from where the scene places the arm
  double path_length = 0;         ///< m, along the pulleys' contact radii
  double unstretched_length = 0;  ///< m, of the belt that is at rest there
  double tension = 0;             ///< N, with which the spring balances it
  std::string reason;             ///< what ends the reach here; empty within it
};

/// Belt strain beyond which take_up() looks no further: a drive is not meant to hold a belt this tight.
inline constexpr double take_up_strain = 0.01;

/// Rows from the longest belt to the shortest; none without a tensioner that can turn.
std::vector<TakeUpRow> take_up(const Model& model);

}  // namespace beltlife
