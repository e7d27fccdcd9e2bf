// Limits of a layout: see layout_limits.h.
#include "optimize/layout/layout_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimize/layout/keep_out.h"
#include "optimize/layout/limits_of_running.h"
#include "optimize/layout/placed_layout.h"

namespace beltlife {
namespace {

constexpr double degree = std::numbers::pi / 180, mm = 1e-3;

/// The limits that the geometry alone decides.
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

  std::vector<LayoutLimit> run() {
    pulleys();
    wraps_and_spans();
    belt();
    arm();
    length();
    box();
    keep_outs();
    add_limits_of_running(scene_, spec_, layout_, detail_, limits_);
    return limits_.take();
  }

 private:
  const std::string& pulley(std::size_t i) const { return scene_.pulley[i].name; }

  void pulleys() {
    std::size_t k = 0;
    const double least = spec_.min_pulley_clearance_mm;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j) {
        const double gap = shape_.circle_gap[k++] / mm;
        limits_.at_least("pulleys " + pulley(i) + " and " + pulley(j), gap, least, "mm", key_[j], [&] {
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
      limits_.at_least("wrap on " + pulley(i), wrap, least, "deg", key_[i], [&] {
        return wrap < 0
                   ? fmt::format("the wrap on {} vanishes: the belt would pass it on its {} side by {:.1f} degrees",
                                 pulley(i), scene_.pulley[i].side == Side::front ? "back" : "front", -wrap)
                   : fmt::format("the wrap on {} is {:.1f} degrees, less than {:g}", pulley(i), wrap, least);
      });
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const double length = shape_.tangent_reach[i] / mm;
      limits_.at_least("span " + span_name(scene_, i), length, spec_.min_span_mm, "mm", key_[(i + 1) % count_], [&] {
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
        limits_.at_least(span_[i] + " and pulley " + pulley(j), gap, least, "mm", key_[j], [&] {
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
        limits_.at_least(span_[i] + " and " + span_[j], gap, neighbours ? 0 : least, "mm", key_[j], [&] {
          return gap < 0 ? fmt::format("the belt would cross itself: {} runs through {}", span_[i], span_[j])
                         : fmt::format("the {} comes within {:.1f} mm of {}, less than {:g} mm", span_[i], gap,
                                       span_[j], least);
        });
      }
  }

  void arm() {
    if (!layout_.arm) return;
    if (!rests_as_placed(scene_))
      limits_.at_least("arm at rest", layout_.missing > 0 ? -layout_.missing / mm : 0, 0, "mm", "belt", [&] {
        return fmt::format("the arm finds no rest: at least {:.1f} mm of belt are too much or missing",
                           layout_.missing / mm);
      });
    const double leverage = std::abs(layout_.arm->leverage(shape_)) / mm;
    limits_.at_least("arm leverage", leverage, spec_.min_arm_leverage_mm, "mm", "tensioner.pivot_x_mm", [&] {
      return fmt::format("turning the arm by a radian changes the belt path by {:.1f} mm, less than {:g} mm", leverage,
                         spec_.min_arm_leverage_mm);
    });
  }

  void length() {
    const double length = layout_.unstretched_length / mm;
    if (const auto& least = spec_.min_unstretched_length_mm)
      limits_.at_least("shortest belt", length, *least, "mm", "pulley",
                       [&] { return fmt::format("the belt is {:.1f} mm long, less than {:g} mm", length, *least); });
    if (const auto& most = spec_.max_unstretched_length_mm)
      limits_.at_most("longest belt", length, *most, "mm", "pulley",
                      [&] { return fmt::format("the belt is {:.1f} mm long, more than {:g} mm", length, *most); });
  }

  void box() {
    if (!spec_.box) return;
    const LayoutBoxSpec& b = *spec_.box;
    for (std::size_t i = 0; i < count_; ++i) {
      const Circle& c = shape_.circles[i];
      const double x = c.x / mm, y = c.y / mm;
      const double inside = std::min({x - b.x_min_mm, b.x_max_mm - x, y - b.y_min_mm, b.y_max_mm - y}) - c.radius / mm;
      limits_.at_least("box and pulley " + pulley(i), inside, 0, "mm", key_[i],
                       [&] { return fmt::format("pulley {} leaves the box by {:.1f} mm", pulley(i), -inside); });
    }
  }

  void keep_outs() {
    for (const KeepOutSpec& k : spec_.keep_out) {
      const KeepOutDistance distance(k);
      for (std::size_t i = 0; i < count_; ++i) {
        const double gap = distance.of(shape_.circles[i]) / mm;
        limits_.left_of("keep-out " + k.name + " and pulley " + pulley(i), gap, k.margin_mm, "mm", key_[i],
                        [&] { return fmt::format("pulley {} is {:.1f} mm too near to {}", pulley(i), -gap, k.name); });
      }
      for (std::size_t i = 0; i < count_; ++i) {
        const double gap = distance.of(shape_.spans[i]) / mm;
        limits_.left_of("keep-out " + k.name + " and " + span_[i], gap, k.margin_mm, "mm", key_[i],
                        [&] { return fmt::format("the {} is {:.1f} mm too near to {}", span_[i], -gap, k.name); });
      }
    }
  }

  const SceneSpec& scene_;
  const LayoutLimitsSpec& spec_;
  const RunningDetail detail_;
  const PlacedLayout layout_;
  const LoopShape& shape_;
  const std::size_t count_;
  std::vector<std::string> span_, key_;
  LimitList limits_;
};

}  // namespace

std::vector<LayoutLimit> layout_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec, RunningDetail detail) {
  if (scene.ring || scene.pulley.size() < 2) return {};
  return Limits(scene, spec, detail).run();
}

}  // namespace beltlife
