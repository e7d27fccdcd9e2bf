// Owns the statement of a drive from which its layout can be varied.
#pragma once

#include "sim/scene/scene.h"

namespace beltlife {

/// The same drive, stated so that moving its pulleys leaves the tension at rest alone: the arm's pulley is placed where
/// the arm rests (by its own coordinates, or by arm_angle_deg where the scene uses that), the stops are counted from
/// there, pretension_n is the tension at rest, balanced_as_placed is true, and the belt's length and the spring's
/// torque are left to be solved for. Without tensioner the length gives way to pretension_n alone. The scene must be
/// valid and without a ring. Throws BadInput where there is no layout or no tension to keep: see solve_statics(); or
/// where the arm rests on a stop, which then carries an unknown share of the torque.
SceneSpec layout_base(const SceneSpec& scene);

}  // namespace beltlife
