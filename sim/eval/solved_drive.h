// Owns what is solved of a drive without running it: statics of every range, take-up, estimated life, modes, map.
#pragma once

#include <vector>

#include "sim/modes/campbell.h"
#include "sim/statics/quasi_static.h"
#include "sim/statics/take_up.h"

namespace beltlife {

struct DriveStatics {
  std::vector<TakeUpRow> take_up;        ///< none without a tensioner that can turn
  std::vector<QuasiStaticRange> ranges;  ///< scene order; none without pulleys
  Life estimate;                         ///< over the ranges that have a solution; an error if one has none
};

struct DriveModes {
  std::vector<Modes> points;  ///< a range each; "rest" for a drive without ranges; none without pulleys
  Campbell map;
  std::vector<Crossing> crossings;
};

struct SolvedDrive {
  Model model;
  DriveStatics statics;
  DriveModes modes;
};

DriveStatics drive_statics(const Model& model);
DriveModes drive_modes(const Model& model);
SolvedDrive solve_drive(const Model& model);

/// Whether the driven body's speed has this order; every order, if the scene does not say.
bool has_order(const SceneSpec& scene, double order);
/// Whether a crossing is near a range, of an order that the driven body has, and of a mode that is not damped away.
bool can_resonate(const Crossing& crossing, const SceneSpec& scene);

}  // namespace beltlife
