// Owns the drawing of a drive to scale.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// What drawings of several drives share, so that they can be laid beside each other.
struct SharedDrawing {
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;  ///< m, the stretch of the plane that is drawn
  double slack_n = 1e9, tight_n = -1e9;                       ///< tensions of the first and the last colour
  const Model* beneath = nullptr;                             ///< another drive, dashed beneath this one; null: none
  double beneath_arm = 0;                                     ///< rad, angle of its arm
};
/// Widens plane and colours until the drive finds room.
void make_room(SharedDrawing& shared, const Model& model, double arm_angle, const std::vector<double>& span_tension_n);

/// The drive with the arm at `arm_angle` (rad from where the scene places it), spans and arcs coloured by
/// `span_tension_n` (mean, one a span in scene order; an arc takes the mean of its neighbours), pulleys labelled. One
/// SVG element; every id in it begins with `id`.
std::string layout_svg(const Model& model, double arm_angle, const std::vector<double>& span_tension_n,
                       const std::string& id);
/// The same, of several.
std::string layout_svg(const Model& model, double arm_angle, const std::vector<double>& span_tension_n,
                       const std::string& id, const SharedDrawing& shared);

}  // namespace beltlife
