// The loop of a design for a drawing: see layout_answer.h.
#include "optimize/layout/placed_layout.h"
#include "optimize/layout_answer.h"
#include "sim/route/layout.h"

namespace beltlife {

using nlohmann::json;

json layout_of(const DesignProblem& design, const Candidate& c) {
  if (!design.has_layout()) return nullptr;
  const SceneSpec scene = design.scene(c);
  if (scene.ring || scene.pulley.size() < 2) return nullptr;
  const PlacedLayout placed = place_layout(scene);
  const LoopShape& shape = placed.shape;
  const auto in_mm = [](Vec2 p) { return json::array({1e3 * p.x, 1e3 * p.y}); };
  json j;
  for (std::size_t i = 0; i < scene.pulley.size(); ++i) {
    const Circle& circle = shape.circles[i];
    j["pulleys"].push_back({{"name", scene.pulley[i].name},
                            {"x_mm", 1e3 * circle.x},
                            {"y_mm", 1e3 * circle.y},
                            {"diameter_mm", 2e3 * circle.radius},
                            {"side", enum_name(scene.pulley[i].side)}});
    j["spans"].push_back(
        {{"name", span_name(scene, i)}, {"from_mm", in_mm(shape.spans[i].from)}, {"to_mm", in_mm(shape.spans[i].to)}});
  }
  if (scene.tensioner)
    j["tensioner"] = {{"pulley", scene.tensioner->pulley},
                      {"pivot_x_mm", scene.tensioner->pivot_x_mm},
                      {"pivot_y_mm", scene.tensioner->pivot_y_mm}};
  if (design.spec().layout) {
    const LayoutLimitsSpec& limits = design.spec().layout->limits;
    if (const auto& b = limits.box)
      j["box"] = {
          {"x_min_mm", b->x_min_mm}, {"x_max_mm", b->x_max_mm}, {"y_min_mm", b->y_min_mm}, {"y_max_mm", b->y_max_mm}};
    for (const KeepOutSpec& k : limits.keep_out) {
      json out{{"name", k.name}, {"margin_mm", k.margin_mm}};
      if (k.circle)
        out["circle"] = {{"x_mm", k.circle->x_mm}, {"y_mm", k.circle->y_mm}, {"radius_mm", k.circle->radius_mm}};
      if (k.polygon) out["polygon"] = {{"x_mm", k.polygon->x_mm}, {"y_mm", k.polygon->y_mm}};
      j["keep_outs"].push_back(std::move(out));
    }
  }
  j["path_length_mm"] = 1e3 * shape.length;
  j["tension_n"] = placed.tension;
  j["unstretched_length_mm"] = 1e3 * placed.unstretched_length;
  return j;
}

}  // namespace beltlife
