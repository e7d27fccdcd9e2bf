// Distance of natural frequencies from orders: see order_distance.h.
#include "optimize/layout/order_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "sim/modes/modes.h"
#include "sim/range_models.h"
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
    const Model drive = compile(scene);
    const RangeModels models(drive);
    std::map<std::pair<const Model*, double>, OrderDistance> solved;  // by condition and speed
    for (std::size_t i = 0; i < all.size(); ++i) {
      const RangeSpec& range = scene.range[i];
      const Model& model = models.of(range.condition);
      const std::pair at(&model, range.crank_rpm);
      if (!solved.contains(at)) solved[at] = nearest(solve_modes(model, range), orders);
      all[i] = solved[at];
    }
  } catch (const BadInput&) {
    return std::vector<OrderDistance>(scene.range.size());
  }
  return all;
}

}  // namespace beltlife
