// Owns the map of natural frequencies over crank speed with its rays of orders, as a gnuplot script.
#pragma once

#include <string>

#include "sim/eval/solved_drive.h"

namespace beltlife {

/// A drawing of its own: every order, every curve in its own style with a key beside. `modes` needs curves.
std::string map_script(const SceneSpec& scene, const DriveModes& modes);

/// For a page, where tables beside it give the numbers: one colour a kind of vibration, only the orders and crossings
/// that can resonate.
std::string small_map_script(const SceneSpec& scene, const DriveModes& modes);

}  // namespace beltlife
