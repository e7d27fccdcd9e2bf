// Distances from keep-outs: see keep_out.h.
#include "optimize/layout/keep_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimize/layout/loop_shape.h"

namespace beltlife {

KeepOutDistance::KeepOutDistance(const KeepOutSpec& spec) : grown_(1e-3 * spec.margin_mm) {
  if (spec.circle) {
    corners_.push_back({1e-3 * spec.circle->x_mm, 1e-3 * spec.circle->y_mm});
    grown_ += 1e-3 * spec.circle->radius_mm;
  } else if (spec.polygon) {
    for (std::size_t i = 0; i < std::min(spec.polygon->x_mm.size(), spec.polygon->y_mm.size()); ++i)
      corners_.push_back({1e-3 * spec.polygon->x_mm[i], 1e-3 * spec.polygon->y_mm[i]});
  }
}

double KeepOutDistance::of_point(Vec2 p) const {
  double nearest = std::numeric_limits<double>::max();
  bool inside = false;  // an upward ray crosses the sides an odd number of times
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()];
    nearest = std::min(nearest, point_to_segment(p, a, b));
    if ((a.x > p.x) != (b.x > p.x) && p.y < a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x)) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

double KeepOutDistance::of(const Circle& circle) const {
  return of_point({circle.x, circle.y}) - circle.radius - grown_;
}

// Outside, the nearest of span and sides. A span that enters is as deep as its deepest point: between two crossings the
// depth rises and falls (in a convex polygon once), and is searched by thirds.
double KeepOutDistance::of(const Span& span) const {
  const Vec2 way{span.to.x - span.from.x, span.to.y - span.from.y};
  double nearest = std::numeric_limits<double>::max();
  std::vector<double> cuts{0, 1};
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()], side{b.x - a.x, b.y - a.y};
    nearest = std::min(nearest, std::abs(segment_gap(span.from, span.to, a, b)));
    const double cross = way.x * side.y - way.y * side.x;
    const double t = cross == 0 ? 0 : ((a.x - span.from.x) * side.y - (a.y - span.from.y) * side.x) / cross;
    if (t > 0 && t < 1) cuts.push_back(t);
  }
  const auto at = [&](double t) { return of_point({span.from.x + t * way.x, span.from.y + t * way.y}); };
  std::sort(cuts.begin(), cuts.end());
  double deepest = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    double low = cuts[i], high = cuts[i + 1];
    if (at(0.5 * (low + high)) >= 0) continue;
    for (int k = 0; k < 40; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (at(a) < at(b))
        high = b;
      else
        low = a;
    }
    deepest = std::min(deepest, at(0.5 * (low + high)));
  }
  return (deepest < 0 ? deepest : nearest) - grown_;
}

}  // namespace beltlife
