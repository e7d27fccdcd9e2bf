// Reach of a tensioner's arm: see arm_reach.h.
#include "optimize/layout/arm_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

class Search {
 public:
  Search(const ArmOfLayout& arm, double rest) : arm_(arm), rest_(rest) {
    look(rest);
    sense_ = arm_.leverage(shape_);
  }

  ReachEnd end(double side) {
    constexpr double step = std::numbers::pi / 90;
    constexpr int steps = 90, halvings = 18;  // to 1e-7 rad
    const double stop = side > 0 ? arm_.stops.high : arm_.stops.low;
    double good = rest_, bad = rest_;
    if (holds(rest_))
      for (int i = 1; i <= steps; ++i) {
        bad = rest_ + side * step * i;
        const bool past = side * (bad - stop) >= 0;
        if (past) bad = stop;
        if (!holds(bad)) break;
        good = bad;
        if (past) break;
      }
    for (int i = 0; i < halvings && bad != good; ++i) {
      const double middle = 0.5 * (good + bad);
      (holds(middle) ? good : bad) = middle;
    }
    look(good);
    return {good, shape_.length, arm_.tension(shape_, good)};
  }

 private:
  void look(double angle) {
    arm_.turn(angle, circles_);
    make_loop_shape(circles_, shape_);
  }
  bool holds(double angle) {
    look(angle);
    if (!shape_.can_be_built() || !(arm_.leverage(shape_) * sense_ > 0)) return false;
    if (!arm_.tension_limit) return true;
    const double tension = arm_.tension(shape_, angle);
    return tension >= 0 && tension <= *arm_.tension_limit;
  }

  const ArmOfLayout& arm_;
  double rest_, sense_ = 0;
  std::vector<Circle> circles_;
  LoopShape shape_;
};

}  // namespace

void ArmOfLayout::turn(double angle, std::vector<Circle>& turned) const {
  turned = circles;
  Circle& c = turned[pulley];
  const double rx = c.x - pivot.x, ry = c.y - pivot.y, cos = std::cos(angle), sin = std::sin(angle);
  c.x = pivot.x + cos * rx - sin * ry;
  c.y = pivot.y + sin * rx + cos * ry;
}

double ArmOfLayout::leverage(const LoopShape& shape) const {
  const std::size_t count = shape.spans.size();
  const Vec2 in = shape.spans[(pulley + count - 1) % count].direction, out = shape.spans[pulley].direction;
  const Circle& c = shape.circles[pulley];
  return (c.x - pivot.x) * (in.y - out.y) - (c.y - pivot.y) * (in.x - out.x);
}

ArmReach arm_reach(const ArmOfLayout& arm, double rest) {
  Search search(arm, rest);
  return {search.end(-1), search.end(1)};
}

}  // namespace beltlife
