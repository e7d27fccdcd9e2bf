// The loop of a design for a drawing: see layout_answer.h.
#include "optimize/layout/placed_layout.h"
#include "optimize/layout_answer.h"
#include "sim/route/layout.h"

namespace beltlife {
namespace {

std::array<double, 2> in_mm(Vec2 p) { return {1e3 * p.x, 1e3 * p.y}; }

/// What stands around the drive, as the search's file has it.
void add_surroundings(const LayoutLimitsSpec& limits, DrawnLayout& drawn) {
  if (const auto& b = limits.box) drawn.box = {b->x_min_mm, b->x_max_mm, b->y_min_mm, b->y_max_mm};
  for (const KeepOutSpec& k : limits.keep_out) {
    DrawnKeepOut out{k.name, k.margin_mm, {}, {}};
    if (k.circle) out.circle = {k.circle->x_mm, k.circle->y_mm, k.circle->radius_mm};
    if (k.polygon) out.polygon = {k.polygon->x_mm, k.polygon->y_mm};
    if (!drawn.keep_outs) drawn.keep_outs.emplace();
    drawn.keep_outs->push_back(std::move(out));
  }
}

}  // namespace

OrNull<DrawnLayout> layout_of(const DesignProblem& design, const Candidate& c) {
  if (!design.has_layout()) return {};
  const SceneSpec scene = design.scene(c);
  if (scene.ring || scene.pulley.size() < 2) return {};
  const PlacedLayout placed = place_layout(scene);
  const LoopShape& shape = placed.shape;
  DrawnLayout drawn;
  for (std::size_t i = 0; i < scene.pulley.size(); ++i) {
    const Circle& circle = shape.circles[i];
    drawn.pulleys.push_back({scene.pulley[i].name, 1e3 * circle.x, 1e3 * circle.y, 2e3 * circle.radius,
                             std::string(enum_name(scene.pulley[i].side))});
    drawn.spans.push_back({span_name(scene, i), in_mm(shape.spans[i].from), in_mm(shape.spans[i].to)});
  }
  if (const auto& arm = scene.tensioner) drawn.tensioner = {arm->pulley, arm->pivot_x_mm, arm->pivot_y_mm};
  if (design.spec().layout) add_surroundings(design.spec().layout->limits, drawn);
  drawn.path_length_mm = 1e3 * shape.length;
  drawn.tension_n = placed.tension;
  drawn.unstretched_length_mm = 1e3 * placed.unstretched_length;
  return {std::move(drawn)};
}

}  // namespace beltlife
