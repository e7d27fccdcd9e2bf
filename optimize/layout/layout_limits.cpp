// Limits of a layout: see layout_limits.h.
#include "optimize/layout/layout_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimize/layout/keep_out.h"
#include "optimize/layout/order_distance.h"
#include "optimize/layout/placed_layout.h"
#include "sim/statics/take_up.h"

namespace beltlife {
namespace {

constexpr double degree = std::numbers::pi / 180, mm = 1e-3;

class Limits {
 public:
  Limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, RunningDetail detail)
      : scene_(scene),
        spec_(spec),
        detail_(detail),
        layout_(place_layout(scene)),
        shape_(layout_.shape),
        count_(scene.pulley.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const std::string& name = scene.pulley[i].name;
      span_.push_back("belt " + span_name(scene, i));
      const bool on_arm = scene.tensioner && scene.tensioner->pulley == name && scene.tensioner->arm_angle_deg;
      key_.push_back(on_arm ? "tensioner.arm_angle_deg" : "pulley." + name + ".x_mm");
    }
  }

  std::vector<Clearance> run() {
    pulleys();
    wraps_and_spans();
    belt();
    arm();
    length();
    box();
    keep_outs();
    if (layout_.arm && spec_.take_up) take_up();
    if (spec_.wants_quasi_static()) running();
    if (spec_.modes) modes();
    return std::move(out_);
  }

 private:
  const std::string& pulley(std::size_t i) const { return scene_.pulley[i].name; }

  // `words` are asked for where the limit is broken alone: a search asks for many layouts.
  template <class Words>
  void add(std::string name, double value, const char* unit, std::string key, Words words) {
    out_.push_back({std::move(name), value, unit, value < 0 ? words() : std::string(), std::move(key)});
  }

  void pulleys() {
    std::size_t k = 0;
    const double least = spec_.min_pulley_clearance_mm;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j) {
        const double gap = shape_.circle_gap[k++] / mm;
        add("pulleys " + pulley(i) + " and " + pulley(j), gap - least, "mm", key_[j], [&] {
          return gap < 0 ? fmt::format("pulleys {} and {} overlap by {:.1f} mm", pulley(i), pulley(j), -gap)
                         : fmt::format("pulleys {} and {} are {:.1f} mm apart, less than {:g} mm", pulley(i), pulley(j),
                                       gap, least);
        });
      }
  }

  void wraps_and_spans() {
    for (std::size_t i = 0; i < count_; ++i) {
      double least = spec_.min_wrap_deg;
      for (const WrapLimitSpec& w : spec_.wrap)
        if (w.pulley == pulley(i)) least = w.min_deg;
      const double wrap = shape_.wrap[i] / degree;
      add("wrap on " + pulley(i), wrap - least, "deg", key_[i], [&] {
        return wrap < 0
                   ? fmt::format("the wrap on {} vanishes: the belt would pass it on its {} side by {:.1f} degrees",
                                 pulley(i), scene_.pulley[i].side == Side::front ? "back" : "front", -wrap)
                   : fmt::format("the wrap on {} is {:.1f} degrees, less than {:g}", pulley(i), wrap, least);
      });
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const double length = shape_.tangent_reach[i] / mm;
      add("span " + span_name(scene_, i), length - spec_.min_span_mm, "mm", key_[(i + 1) % count_], [&] {
        return length <= 0 ? fmt::format("no belt can run between {} and {}, which overlap", pulley(i),
                                         pulley((i + 1) % count_))
                           : fmt::format("the span {} is {:.1f} mm long, less than {:g} mm", span_name(scene_, i),
                                         length, spec_.min_span_mm);
      });
    }
  }

  void belt() {
    const double least = spec_.min_belt_clearance_mm;
    std::size_t k = 0;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < count_; ++j) {
        if (j == i || j == (i + 1) % count_) continue;
        const double gap = shape_.span_circle_gap[k++] / mm;
        add(span_[i] + " and pulley " + pulley(j), gap - least, "mm", key_[j], [&] {
          return gap < 0 ? fmt::format("the {} runs through pulley {} by {:.1f} mm", span_[i], pulley(j), -gap)
                         : fmt::format("the {} passes pulley {} at {:.1f} mm, less than {:g} mm", span_[i], pulley(j),
                                       gap, least);
        });
      }
    k = 0;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j) {
        const bool neighbours = j == i + 1 || (j + 1) % count_ == i;
        const double gap = shape_.span_gap[k++] / mm;
        add(span_[i] + " and " + span_[j], gap - (neighbours ? 0 : least), "mm", key_[j], [&] {
          return gap < 0 ? fmt::format("the belt would cross itself: {} runs through {}", span_[i], span_[j])
                         : fmt::format("the {} comes within {:.1f} mm of {}, less than {:g} mm", span_[i], gap,
                                       span_[j], least);
        });
      }
  }

  void arm() {
    if (!layout_.arm) return;
    if (!rests_as_placed(scene_))
      add("arm at rest", layout_.missing > 0 ? -layout_.missing / mm : 0, "mm", "belt", [&] {
        return fmt::format("the arm finds no rest: at least {:.1f} mm of belt are too much or missing",
                           layout_.missing / mm);
      });
    const double leverage = std::abs(layout_.arm->leverage(shape_)) / mm;
    add("arm leverage", leverage - spec_.min_arm_leverage_mm, "mm", "tensioner.pivot_x_mm", [&] {
      return fmt::format("turning the arm by a radian changes the belt path by {:.1f} mm, less than {:g} mm", leverage,
                         spec_.min_arm_leverage_mm);
    });
  }

  void length() {
    const double length = layout_.unstretched_length / mm;
    if (const auto& least = spec_.min_unstretched_length_mm)
      add("shortest belt", length - *least, "mm", "pulley",
          [&] { return fmt::format("the belt is {:.1f} mm long, less than {:g} mm", length, *least); });
    if (const auto& most = spec_.max_unstretched_length_mm)
      add("longest belt", *most - length, "mm", "pulley",
          [&] { return fmt::format("the belt is {:.1f} mm long, more than {:g} mm", length, *most); });
  }

  void box() {
    if (!spec_.box) return;
    const LayoutBoxSpec& b = *spec_.box;
    for (std::size_t i = 0; i < count_; ++i) {
      const Circle& c = shape_.circles[i];
      const double x = c.x / mm, y = c.y / mm;
      const double inside = std::min({x - b.x_min_mm, b.x_max_mm - x, y - b.y_min_mm, b.y_max_mm - y}) - c.radius / mm;
      add("box and pulley " + pulley(i), inside, "mm", key_[i],
          [&] { return fmt::format("pulley {} leaves the box by {:.1f} mm", pulley(i), -inside); });
    }
  }

  void keep_outs() {
    for (const KeepOutSpec& k : spec_.keep_out) {
      const KeepOutDistance distance(k);
      for (std::size_t i = 0; i < count_; ++i) {
        const double gap = distance.of(shape_.circles[i]) / mm;
        add("keep-out " + k.name + " and pulley " + pulley(i), gap, "mm", key_[i],
            [&] { return fmt::format("pulley {} is {:.1f} mm too near to {}", pulley(i), -gap, k.name); });
      }
      for (std::size_t i = 0; i < count_; ++i) {
        const double gap = distance.of(shape_.spans[i]) / mm;
        add("keep-out " + k.name + " and " + span_[i], gap, "mm", key_[i],
            [&] { return fmt::format("the {} is {:.1f} mm too near to {}", span_[i], -gap, k.name); });
      }
    }
  }

  // The ends of the arm's reach, within which the belt is tight and stretched by no more than take_up() allows.
  const ArmReach& reach() {
    if (!reach_) {
      ArmOfLayout tight = *layout_.arm;
      tight.tension_limit = take_up_strain * scene_.belt.axial_stiffness_n;
      reach_ = arm_reach(tight, layout_.rest);
    }
    return *reach_;
  }

  void take_up() {
    const auto unstretched = [&](const ReachEnd& end) {
      const double tension = std::isfinite(end.tension) ? end.tension : 0;  // no leverage: no reach either
      return end.length / (1 + std::max(tension, 0.0) / scene_.belt.axial_stiffness_n);
    };
    const bool can_turn = shape_.can_be_built() && layout_.missing == 0;
    const double low = can_turn ? unstretched(reach().low) : 0, high = can_turn ? unstretched(reach().high) : 0;
    const double longer = can_turn ? (std::max(low, high) - layout_.unstretched_length) / mm : 0;
    const double shorter = can_turn ? (layout_.unstretched_length - std::min(low, high)) / mm : 0;
    add("take-up longer", longer - spec_.take_up->longer_mm, "mm", "tensioner.pivot_x_mm", [&] {
      return fmt::format("the arm holds belts up to {:.1f} mm longer, not {:g} mm", longer, spec_.take_up->longer_mm);
    });
    add("take-up shorter", shorter - spec_.take_up->shorter_mm, "mm", "tensioner.pivot_x_mm", [&] {
      return fmt::format("the arm holds belts up to {:.1f} mm shorter, not {:g} mm", shorter,
                         spec_.take_up->shorter_mm);
    });
  }

  void running() {
    const std::vector<RunningLimits> ranges =
        running_limits(scene_, layout_, layout_.arm && spec_.travel_deg ? reach() : ArmReach{},
                       spec_.travel_deg || spec_.max_hub_load_n, detail_);
    const auto cannot = [](const std::string& range) { return "the drive has no steady running in range " + range; };
    if (layout_.arm && spec_.travel_deg) {
      const auto least = [&](double RunningLimits::*side) {
        double travel = std::numbers::pi;
        for (const RunningLimits& r : ranges) travel = std::min(travel, r.solved ? r.*side : 0);
        return travel / degree;
      };
      for (const auto& [name, side] :
           {std::pair{"lengthening", &RunningLimits::lengthening}, {"shortening", &RunningLimits::shortening}}) {
        const double travel = least(side);
        add(fmt::format("travel {}", name), travel - *spec_.travel_deg, "deg", "tensioner.pivot_x_mm", [&] {
          return fmt::format("the arm has {:.1f} degrees of travel left that are {} the belt path, less than {:g}",
                             travel, name, *spec_.travel_deg);
        });
      }
    }
    for (std::size_t r = 0; r < ranges.size() && spec_.min_slip_safety; ++r) {
      const double safety = ranges[r].solved ? ranges[r].slip_safety : 0;
      const std::string& name = scene_.range[r].name;
      add("slip safety in " + name, safety - *spec_.min_slip_safety, "", "belt.friction_front", [&] {
        return ranges[r].solved ? fmt::format("the slip safety in range {} is {:.2f}, less than {:g}", name, safety,
                                              *spec_.min_slip_safety)
                                : cannot(name);
      });
    }
    for (std::size_t r = 0; r < ranges.size() && spec_.max_hub_load_n; ++r) {
      const double load = ranges[r].solved ? ranges[r].hub_load : 2 * *spec_.max_hub_load_n;
      const std::string& name = scene_.range[r].name;
      add("hub load in " + name, *spec_.max_hub_load_n - load, "N", "belt.pretension_n", [&] {
        return ranges[r].solved ? fmt::format("a hub carries {:.0f} N in range {}, more than {:g} N", load, name,
                                              *spec_.max_hub_load_n)
                                : cannot(name);
      });
    }
  }

  void modes() {
    const bool can_run = shape_.can_be_built() && layout_.missing == 0;
    const auto distances = order_distances(scene_, spec_.modes->orders, can_run);
    for (std::size_t r = 0; r < distances.size(); ++r) {
      const OrderDistance& d = distances[r];
      const std::string& name = scene_.range[r].name;
      add("modes in " + name, d.percent - spec_.modes->min_distance_percent, "%", "belt.axial_stiffness_n", [&] {
        return d.frequency_hz > 0 ? fmt::format(
                                        "a natural frequency of {:.1f} Hz is {:.1f} % away from order {:g} in range "
                                        "{}, less than {:g} %",
                                        d.frequency_hz, d.percent, d.order, name, spec_.modes->min_distance_percent)
                                  : "the drive has no steady running in range " + name;
      });
    }
  }

  const SceneSpec& scene_;
  const LayoutLimitsSpec& spec_;
  const RunningDetail detail_;
  const PlacedLayout layout_;
  const LoopShape& shape_;
  const std::size_t count_;
  std::vector<std::string> span_, key_;
  std::optional<ArmReach> reach_;
  std::vector<Clearance> out_;
};

}  // namespace

std::vector<Clearance> layout_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, RunningDetail detail) {
  if (scene.ring || scene.pulley.size() < 2) return {};
  return Limits(scene, spec, detail).run();
}

}  // namespace beltlife
