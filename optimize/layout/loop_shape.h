// Owns the signed distances of a belt loop that hold on when the loop cannot be built.
#pragma once

#include <vector>

#include "sim/route/route.h"

namespace beltlife {

/// The loop over circles, whether a belt could run it or not: every number is a continuous continuation of what it is
/// where one can. Lengths in m, angles in rad.
struct LoopShape {
  std::vector<Circle> circles;
  std::vector<Span> spans;            ///< where no tangent exists: of length 0, at right angles to the line of centres
  std::vector<double> tangent_reach;  ///< length of span i; where no tangent exists, minus how far the circles overlap
  std::vector<double> wrap;           ///< negative: the belt would pass the circle on its other side
  double length = 0;                  ///< of the path
  bool closes = false;                ///< all tangents exist, and no wrap is negative

  /// Distance between circles i < j, in the order (0,1), (0,2), ...; negative: they overlap.
  std::vector<double> circle_gap;
  /// Distance of span i from circle j, for the circles it does not touch: i outer, j inner, ascending.
  std::vector<double> span_circle_gap;
  /// Distance between spans i < j, ordered as the circles; negative: they cross, by so much.
  std::vector<double> span_gap;

  /// A belt can run it: what solve_statics() asks of a layout.
  bool can_be_built() const;
  /// Sum of all that is negative, in mm and degrees; 0 where nothing is.
  double violation() const;
};

/// Computes `shape` in place, so that a search over many layouts allocates once. At least two circles.
void make_loop_shape(const std::vector<Circle>& circles, LoopShape& shape);

/// Shortest distance of a point from a segment.
double point_to_segment(Vec2 p, Vec2 a, Vec2 b);
/// Shortest distance between two segments; where they cross, minus the least that frees one end.
double segment_gap(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

}  // namespace beltlife
