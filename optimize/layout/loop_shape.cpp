// Signed distances of a loop: see loop_shape.h.
#include "optimize/layout/loop_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

constexpr double two_pi = 2 * std::numbers::pi, degree = std::numbers::pi / 180;

// The tangent of route.cpp, continued: an offset larger than the distance of the centres counts as equal to it.
double tangent(const Circle& a, const Circle& b, Span& span) {
  const double offset = b.turn * b.radius - a.turn * a.radius;
  double dx = b.x - a.x, dy = b.y - a.y, d = std::hypot(dx, dy), reach = 0;
  if (d > std::abs(offset)) {
    const double d2 = dx * dx + dy * dy;
    reach = span.length = std::sqrt(d2 - offset * offset);
    span.direction = {(dx * span.length + dy * offset) / d2, (dy * span.length - dx * offset) / d2};
  } else {
    reach = d - std::abs(offset);
    if (d == 0) dx = d = 1;  // no direction is better than another
    const double side = offset < 0 ? -1 : 1;
    span.length = 0;
    span.direction = {side * dy / d, -side * dx / d};
  }
  const Vec2 n{-span.direction.y, span.direction.x};
  span.from = {a.x - a.turn * a.radius * n.x, a.y - a.turn * a.radius * n.y};
  span.to = {b.x - b.turn * b.radius * n.x, b.y - b.turn * b.radius * n.y};
  return reach;
}

double squared_distance(Vec2 p, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, px = p.x - a.x, py = p.y - a.y, d2 = dx * dx + dy * dy;
  const double t = d2 > 0 ? std::clamp((px * dx + py * dy) / d2, 0.0, 1.0) : 0;
  const double x = px - t * dx, y = py - t * dy;
  return x * x + y * y;
}

// Wraps between 0 and a full turn make the whole loop turn once, one way or the other. If they do not, wraps have
// vanished and show as almost full turns: the largest of the sense that turns too much are read as negative.
bool sign_wraps(LoopShape& s) {
  const std::size_t count = s.circles.size();
  double turning = 0;
  for (std::size_t i = 0; i < count; ++i) turning += s.circles[i].turn * s.wrap[i];
  const int turns = static_cast<int>(std::lround(turning / two_pi));
  if (turns == 1 || turns == -1) return true;
  std::vector<std::size_t> best;
  double least = 0;
  for (int wanted : {1, -1}) {
    const int sense = turns > wanted ? 1 : -1;
    const auto excess = static_cast<std::size_t>(std::abs(turns - wanted));
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < count; ++i)
      if (s.circles[i].turn == sense) candidates.push_back(i);
    if (candidates.size() < excess) continue;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](std::size_t a, std::size_t b) { return s.wrap[a] > s.wrap[b]; });
    candidates.resize(excess);
    double missing = 0;
    for (std::size_t i : candidates) missing += two_pi - s.wrap[i];
    if (!best.empty() && missing >= least) continue;
    best = std::move(candidates);
    least = missing;
  }
  for (std::size_t i : best) s.wrap[i] -= two_pi;
  return false;
}

}  // namespace

double point_to_segment(Vec2 p, Vec2 a, Vec2 b) { return std::sqrt(squared_distance(p, a, b)); }

double segment_gap(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 from, Vec2 to, Vec2 p) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  const double gap = std::sqrt(std::min(
      {squared_distance(a, c, d), squared_distance(b, c, d), squared_distance(c, a, b), squared_distance(d, a, b)}));
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0 ? -gap : gap;
}

void make_loop_shape(const std::vector<Circle>& circles, LoopShape& s) {
  const std::size_t count = circles.size();
  s.circles = circles;
  s.spans.resize(count);
  s.tangent_reach.resize(count);
  s.wrap.resize(count);
  s.closes = true;
  for (std::size_t i = 0; i < count; ++i) {
    s.tangent_reach[i] = tangent(circles[i], circles[(i + 1) % count], s.spans[i]);
    s.closes = s.closes && s.tangent_reach[i] > 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 in = s.spans[(i + count - 1) % count].direction, out = s.spans[i].direction;
    const double angle = circles[i].turn * std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
    s.wrap[i] = angle < 0 ? angle + two_pi : angle;
  }
  s.closes = sign_wraps(s) && s.closes;
  s.length = 0;
  for (std::size_t i = 0; i < count; ++i) s.length += s.spans[i].length + circles[i].radius * s.wrap[i];

  s.circle_gap.clear();
  s.span_circle_gap.clear();
  s.span_gap.clear();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Circle &a = circles[i], &b = circles[j];
      s.circle_gap.push_back(std::hypot(a.x - b.x, a.y - b.y) - a.radius - b.radius);
      s.span_gap.push_back(segment_gap(s.spans[i].from, s.spans[i].to, s.spans[j].from, s.spans[j].to));
    }
    for (std::size_t j = 0; j < count; ++j)
      if (j != i && j != (i + 1) % count)
        s.span_circle_gap.push_back(point_to_segment({circles[j].x, circles[j].y}, s.spans[i].from, s.spans[i].to) -
                                    circles[j].radius);
  }
}

bool LoopShape::can_be_built() const {
  const auto clear = [](const std::vector<double>& gaps) {
    return std::all_of(gaps.begin(), gaps.end(), [](double gap) { return gap >= 0; });
  };
  return closes && clear(circle_gap) && clear(span_circle_gap) && clear(span_gap);
}

double LoopShape::violation() const {
  double sum = 0;
  const auto add = [&](const std::vector<double>& values, double unit) {
    for (double v : values) sum += std::max(-v, 0.0) / unit;
  };
  add(circle_gap, 1e-3);
  add(tangent_reach, 1e-3);
  add(wrap, degree);
  add(span_circle_gap, 1e-3);
  add(span_gap, 1e-3);
  return sum;
}

}  // namespace beltlife
