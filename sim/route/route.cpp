// Belt path over circles: see route.h.
#include "sim/route/route.h"

#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// Directed common tangent: with u its direction and n its left normal, a circle that is passed counterclockwise
// (turn +1) lies to the left, so its tangent point is c - turn r n. Hence (c2 - c1).n = turn2 r2 - turn1 r1.
bool tangent(const Circle& a, const Circle& b, Span& span) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double offset = b.turn * b.radius - a.turn * a.radius;
  const double d2 = dx * dx + dy * dy;
  if (!(d2 > offset * offset)) return false;
  span.length = std::sqrt(d2 - offset * offset);
  span.direction = {(dx * span.length + dy * offset) / d2, (dy * span.length - dx * offset) / d2};
  const Vec2 n{-span.direction.y, span.direction.x};
  span.from = {a.x - a.turn * a.radius * n.x, a.y - a.turn * a.radius * n.y};
  span.to = {b.x - b.turn * b.radius * n.x, b.y - b.turn * b.radius * n.y};
  return true;
}

}  // namespace

bool make_route(const std::vector<Circle>& circles, Route& route) {
  const std::size_t count = circles.size();
  route.circles = circles;
  route.spans.resize(count);
  route.wrap.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    if (!tangent(circles[i], circles[(i + 1) % count], route.spans[i])) return false;
  route.length = 0;
  double turning = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 in = route.spans[(i + count - 1) % count].direction, out = route.spans[i].direction;
    const double angle = circles[i].turn * std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
    route.wrap[i] = angle < 0 ? angle + two_pi : angle;
    turning += circles[i].turn * route.wrap[i];
    route.length += route.spans[i].length + circles[i].radius * route.wrap[i];
  }
  route.simple = std::abs(std::abs(turning) - two_pi) < 1e-6;
  return true;
}

Vec2 length_gradient(const Route& route, std::size_t i) {
  const std::size_t count = route.spans.size();
  const Vec2 in = route.spans[(i + count - 1) % count].direction, out = route.spans[i].direction;
  return {in.x - out.x, in.y - out.y};
}

Vec2 point_at(const Route& route, double s, const std::vector<double>& sink, int& circle) {
  const std::size_t count = route.spans.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Span& span = route.spans[i];
    if (s < span.length) {
      circle = -1;
      return {span.from.x + s * span.direction.x, span.from.y + s * span.direction.y};
    }
    s -= span.length;
    const std::size_t j = (i + 1) % count;
    const Circle& c = route.circles[j];
    const double arc = c.radius * route.wrap[j];
    if (s < arc || i + 1 == count) {
      const double angle = std::atan2(span.to.y - c.y, span.to.x - c.x) + c.turn * s / c.radius;
      circle = static_cast<int>(j);
      const double r = c.radius - sink[j];
      return {c.x + r * std::cos(angle), c.y + r * std::sin(angle)};
    }
    s -= arc;
  }
  circle = -1;
  return route.spans[0].from;
}

}  // namespace beltlife
