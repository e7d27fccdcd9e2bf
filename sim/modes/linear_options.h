// Owns what the user of a linearised drive chooses: the state of the tensioner arm, and how the belt is cut.
#pragma once

#include <string_view>
#include <vector>

#include "sim/model.h"

namespace beltlife {

/// What the tensioner arm does in small vibrations: it turns freely (dry friction overcome), it is held by dry friction
/// through the friction's anchor spring, it cannot turn because the scene locks it, or there is none.
enum class ArmState { free, stuck, locked, none };
std::string_view name_of(ArmState arm);

/// The states that this drive's arm can be in.
std::vector<ArmState> arm_states(const Model& model);

struct LinearOptions {
  /// Let the belt creep on its pulleys as far as the contact's springs let it, as in the simulator: the friction
  /// anchors tangentially, the penalty radially. False: no belt moves on its pulley, so that a free span is EA/length.
  bool contact_compliance = true;
  /// Longest piece of belt between two of its coordinates, m.
  double piece = 0.04;
};

}  // namespace beltlife
