// Owns how far a drive's natural frequencies are from the orders that excite it.
#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace beltlife {

/// The rotational natural frequency of a range that is nearest to an order of the crank, the arm free or stuck.
struct OrderDistance {
  double percent = 0;  ///< |frequency - order's| / order's; at most 100, as of a drive without such frequencies
  double order = 0;
  double frequency_hz = 0;  ///< 0: the drive cannot run so
};

/// One entry a range; of a drive that cannot run (`can_run` false, or refused by compile()) zeros. Some 30 ms for every
/// speed and condition.
std::vector<OrderDistance> order_distances(const SceneSpec& scene, const std::vector<double>& orders, bool can_run);

}  // namespace beltlife
