// Owns the energy account of a running drive: powers of every mechanism now, and what is stored now.
#pragma once

#include "sim/record.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

/// Powers (W) by mechanism from the forces of the last evaluation. `stored` is left 0; friction and the tensioner's
/// dry friction include what goes into their anchor springs.
EnergyAccount powers(const DriveView& s);

struct StoredEnergy {
  double total = 0;       ///< J, anchors included
  double anchors = 0;     ///< of it, in the friction anchors
  double arm_anchor = 0;  ///< of it, in the tensioner's friction spring
};
StoredEnergy stored_energy(const DriveView& s);

}  // namespace beltlife
