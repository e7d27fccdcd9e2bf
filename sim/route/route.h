// Owns the belt path over circles: tangents, wraps, length and its derivative.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

struct Vec2 {
  double x = 0;
  double y = 0;
};

/// A pulley as the path sees it. turn = +1: the path goes round it counterclockwise, -1: clockwise.
struct Circle {
  double x = 0, y = 0, radius = 0;
  int turn = 1;
};

/// Free span from circle i to circle i + 1 (cyclic).
struct Span {
  Vec2 from, to;      ///< tangent points, m
  Vec2 direction;     ///< unit vector
  double length = 0;  ///< m
};

/// The path in the order of the circles, whatever way the belt runs. Lengths in m, angles in rad.
struct Route {
  std::vector<Circle> circles;
  std::vector<Span> spans;   ///< span i leads from circle i to circle i + 1
  std::vector<double> wrap;  ///< arc on circle i, in [0, 2 pi)
  double length = 0;

  /// Whether the path closes as a simple loop (total turning 2 pi).
  bool simple = false;
};

/// Tangents and wraps. Returns false (and leaves `route` unspecified) if two neighbouring circles overlap so that no
/// tangent of the wanted kind exists.
bool make_route(const std::vector<Circle>& circles, Route& route);

/// Derivative of the path length with respect to a displacement of circle i: the tensions of a taut belt of unit
/// tension pull it back by just this vector.
Vec2 length_gradient(const Route& route, std::size_t i);

/// A point of the path at arc position s in [0, length), measured from the start of span 0's first tangent point;
/// on circles at the circle's radius less `sink[i]` (how deep a tight belt lies in circle i). `circle` is set to the
/// circle's index or -1 on a span.
Vec2 point_at(const Route& route, double s, const std::vector<double>& sink, int& circle);

}  // namespace beltlife
