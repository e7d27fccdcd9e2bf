// Owns the layout of a scene: orientation of the loop, static balance of the tensioner, feasibility in words.
#pragma once

#include <string>
#include <vector>

#include "sim/route/arm_stops.h"
#include "sim/route/route.h"
#include "sim/scene/scene.h"

namespace beltlife {

/// A signed, named distance: negative means the layout cannot be built, or breaks a limit that it is held to.
struct Clearance {
  std::string name;   ///< "pulleys drive and idler_2", "wrap on idler_5", "belt drive-idler_2 and pulley crank"
  double value = 0;   ///< in `unit`
  std::string unit;   ///< "mm", "deg", "N"; empty: a bare number
  std::string words;  ///< the refusal, where value < 0
  std::string key;    ///< scene field to look at first
};

/// The drive at one arm position. Angles in rad, counterclockwise positive, 0 where the scene places the arm.
struct Layout {
  double arm_angle = 0;
  Route route;
  double tension = 0;               ///< uniform static tension, N
  double length_per_arm_angle = 0;  ///< d(path length)/d(arm angle), m/rad; 0 without tensioner
  ArmStop stop = ArmStop::none;     ///< against which the arm rests
};

/// Both readings of a layout: as the scene places the arm, and in balance.
struct StaticState {
  int orientation = 1;                   ///< +1: the scene's pulley order runs counterclockwise round the loop
  double unstretched_length = 0;         ///< m, given or solved
  Layout placed;                         ///< arm as placed; its tension is what balances the spring there
  double placed_unstretched_length = 0;  ///< m, of the belt that would be at rest with the arm as placed
  double placed_strain_tension = 0;  ///< N, what the belt of `unstretched_length` would carry with the arm as placed
  Layout balance;                    ///< arm at rest (frictionless)
  double spring_torque = 0;          ///< N m, of the tensioner's spring with the arm as placed, given or solved
};

/// Circles of the scene for a path of this orientation with the arm turned by `arm_angle`.
std::vector<Circle> circles_of(const SceneSpec& scene, int orientation, double arm_angle);

/// Every signed distance of a layout, in m and degrees, whether feasible or not.
std::vector<Clearance> clearances(const SceneSpec& scene, const Route& route);

/// Solves the static balance; where the scene leaves the tensioner's torque open, it is solved for the pretension at
/// the arm's rest, which is as placed, or where the belt of the given length has that tension. Throws BadInput, naming
/// in words every clearance that is negative, or a belt length or torque for which no balance exists. Not for scenes
/// with a ring.
StaticState solve_statics(const SceneSpec& scene, std::string_view file = "scene");

/// "drive-idler_2": the span from pulley i to the next.
std::string span_name(const SceneSpec& scene, std::size_t i);

}  // namespace beltlife
