// Owns the limits of a layout as numbers that a search can follow, without simulating.
#pragma once

#include <vector>

#include "optimize/layout/layout_spec.h"
#include "optimize/layout/running_limits.h"
#include "sim/route/layout.h"
#include "sim/scene/spec_reader.h"

namespace beltlife {

/// A limit with what is asked for. `value` of a Clearance is what is left to the bound, negative beyond it.
struct LayoutLimit : Clearance {
  double bound = 0;
  bool at_most = false;  ///< the bound is an upper one

  /// What the layout has, in the limit's unit.
  double measured() const { return at_most ? bound - value : bound + value; }
};

/// Every limit as a signed distance: what there is less what is wanted, negative where the limit is broken. Number,
/// order and names depend on the pulleys' names, on the ranges, on the way the belt's length is stated and on the spec
/// alone, so that limit k of one layout is limit k of any other. In this order, with their units:
///   pulleys A and B                 mm   gap of the circles, for every pair
///   wrap on A                       deg  below minus the wanted wrap: the belt would pass A on its other side
///   span A-B                        mm   length; below minus the wanted length: A and B overlap so that there is none
///   belt A-B and pulley C           mm   gap, for every pulley that the span does not touch
///   belt A-B and belt C-D           mm   gap, for every pair; crossing spans: minus the least that would part them.
///                                        Spans that share a pulley may touch but not cross
///   arm at rest                     mm   0, or minus the missing belt; not where the scene is balanced_as_placed
///   arm leverage                    mm   path per radian
///   shortest belt, longest belt     mm   unstretched length
///   box and pulley A                mm
///   keep-out K and pulley A         mm   then its spans: keep-out K and belt A-B
///   take-up longer, shorter         mm   unstretched lengths that the arm can hold (spring, stops, 1 % strain)
///   travel lengthening, shortening  deg  from then on quasi-static
///   slip safety in R                -    smallest of all pulleys, at most 100; for every range
///   hub load in R                   N
///   modes in R                      %    distance of the nearest natural frequency from an order
/// The layout is that of the arm at rest. A layout that cannot be built still has all numbers, continued so that they
/// say by how much: circles that overlap so far that no tangent exists are joined by the limit of one. Quasi-static
/// limits of a layout that cannot be built, or that the quasi-static solution refuses, are those of no travel, of a
/// slip safety of 0, of twice the permitted load; take-up limits then count from no reach. Nothing for a ring. Never
/// throws for a valid scene.
std::vector<LayoutLimit> layout_limits(const SceneSpec& scene, const LayoutLimitsSpec& spec,
                                       RunningDetail detail = RunningDetail::with_bending_loss);

/// Appends what is contradictory in the spec to log.problems: names that are no pulley of the scene, keep-outs without
/// a shape, boxes without an inside. `path` is where the table stands.
void check_layout_limits(const LayoutLimitsSpec& spec, const SceneSpec& scene, ReadLog& log,
                         const SpecPath& path = {"layout", "layout"});

}  // namespace beltlife
