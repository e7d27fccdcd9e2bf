// Owns where the scene places a pulley: at its own coordinates, or at the end of the tensioner's arm.
#pragma once

#include <cmath>
#include <numbers>

#include "sim/scene/scene.h"

namespace beltlife {

/// Centre of a pulley, mm.
struct PulleyPlace {
  double x_mm = 0;
  double y_mm = 0;
};

/// Where the pulley is placed: x_mm, y_mm, or, of the pulley on an arm that is given by its angle and length, the arm's
/// end. Everything that wants a placed centre asks here.
inline PulleyPlace pulley_place(const SceneSpec& scene, const PulleySpec& pulley) {
  const auto& arm = scene.tensioner;
  if (!arm || !arm->arm_angle_deg || !arm->arm_length_mm || arm->pulley != pulley.name)
    return {pulley.x_mm, pulley.y_mm};
  const double angle = *arm->arm_angle_deg * (std::numbers::pi / 180);
  return {arm->pivot_x_mm + *arm->arm_length_mm * std::cos(angle),
          arm->pivot_y_mm + *arm->arm_length_mm * std::sin(angle)};
}

}  // namespace beltlife
