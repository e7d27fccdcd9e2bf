// Owns the drawing of a drive to scale.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// The drive with the arm at `arm_angle` (rad from where the scene places it), spans and arcs coloured by
/// `span_tension_n` (mean, one a span in scene order; an arc takes the mean of its neighbours), pulleys labelled. One
/// SVG element; every id in it begins with `id`.
std::string layout_svg(const Model& model, double arm_angle, const std::vector<double>& span_tension_n,
                       const std::string& id);

}  // namespace beltlife
