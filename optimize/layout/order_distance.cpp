// Distance of natural frequencies from orders: see order_distance.h.
#include "optimize/layout/order_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/modes/modes.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

OrderDistance nearest(const Modes& modes, const std::vector<double>& orders) {
  OrderDistance least{100, orders.front(), std::numeric_limits<double>::infinity()};
  if (!modes.loop.balanced) return {};
  for (const ArmModes& arm : modes.arms)
    for (const Mode& mode : arm.modes)
      for (const double order : orders) {
        const double excited = order * modes.range.crank_rpm / 60;
        const double percent = excited > 0 ? 100 * std::abs(mode.frequency_hz - excited) / excited : 100;
        if (percent < least.percent) least = {percent, order, mode.frequency_hz};
      }
  return least;
}

}  // namespace

std::vector<OrderDistance> order_distances(const SceneSpec& scene, const std::vector<double>& orders, bool can_run) {
  std::vector<OrderDistance> all(scene.range.size());
  if (!can_run) return all;
  try {
    const Model model = compile(scene);
    std::map<double, OrderDistance> of_speed;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const RangeSpec& range = scene.range[i];
      if (!of_speed.contains(range.crank_rpm)) of_speed[range.crank_rpm] = nearest(solve_modes(model, range), orders);
      all[i] = of_speed[range.crank_rpm];
    }
  } catch (const BadInput&) {
    return std::vector<OrderDistance>(scene.range.size());
  }
  return all;
}

}  // namespace beltlife
