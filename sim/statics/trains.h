// Owns the shafts, gears and torque tables beside the belt as a steady drive sees them: fixed speed ratios.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// Bodies that springs and gears join turn at fixed ratios; a train holds one pulley at most.
struct Trains {
  Trains(const Model& model, double driven_body_speed);

  /// N m that the belt must give to a pulley, in its running sense, at a speed in rad/s: minus all torque tables of its
  /// train, referred to the pulley.
  /// A one-way spring that would have to pull is released, and what lies beyond it left out.
  double load_on(const Model& model, int pulley, double speed) const;

  /// Springs of the pulley's train that overrun at that load, as indices.
  std::vector<int> released(const Model& model, int pulley, double speed) const;

  std::optional<std::string> error;  ///< in words, where the speeds of the drive do not follow from the driver's
  int driver_pulley = 0;             ///< the pulley in the driven body's train
  double driver_speed = 0;           ///< rad/s, of that pulley
  std::vector<int> pulley_of;        ///< by body, -1: none
};

}  // namespace beltlife
