// Checks of the table [layout] against the scene: see layout_limits.h.
#include <fmt/format.h>

#include <algorithm>

#include "optimize/layout/layout_limits.h"

namespace beltlife {
namespace {

void complain(ReadLog& log, const SpecPath& path, std::string what, std::string allowed) {
  if (log.is_faulty(path.place)) return;
  log.problems.push_back({log.file, log.line(path.place), path.shown, std::move(what), std::move(allowed)});
}

void check_keep_out(const KeepOutSpec& k, ReadLog& log, const SpecPath& path) {
  if (log.is_faulty(path.child("circle").place) || log.is_faulty(path.child("polygon").place)) return;
  if (k.circle.has_value() == k.polygon.has_value())
    return complain(log, path.child("circle"), k.circle ? "polygon is given too" : "missing table",
                    "exactly one of circle, polygon");
  if (!k.polygon) return;
  const SpecPath x = path.child("polygon").child("x_mm"), y = path.child("polygon").child("y_mm");
  if (log.is_faulty(x.place) || log.is_faulty(y.place)) return;
  if (k.polygon->x_mm.size() != k.polygon->y_mm.size())
    complain(log, y, fmt::format("has {} entries, x_mm has {}", k.polygon->y_mm.size(), k.polygon->x_mm.size()),
             "lists of one length");
  else if (k.polygon->x_mm.size() < 3)
    complain(log, x, fmt::format("{} corners enclose nothing", k.polygon->x_mm.size()), "at least 3");
}

}  // namespace

void check_layout_limits(const LayoutLimitsSpec& spec, const SceneSpec& scene, ReadLog& log, const SpecPath& path) {
  std::vector<std::string> names;
  for (const PulleySpec& p : scene.pulley) names.push_back(p.name);
  for (std::size_t i = 0; i < spec.wrap.size(); ++i) {
    const SpecPath where = path.child("wrap").element(i).child("pulley");
    const std::string& name = spec.wrap[i].pulley;
    if (std::find(names.begin(), names.end(), name) == names.end())
      complain(log, where, fmt::format("there is no pulley '{}'{}", name, did_you_mean(name, names)), joined(names));
    for (std::size_t j = 0; j < i; ++j)
      if (spec.wrap[j].pulley == name) complain(log, where, "this pulley has a limit already", "one limit a pulley");
  }
  for (std::size_t i = 0; i < spec.keep_out.size(); ++i) {
    const KeepOutSpec& k = spec.keep_out[i];
    const SpecPath where = path.child("keep_out").element(i, k.name);
    for (std::size_t j = 0; j < i; ++j)
      if (spec.keep_out[j].name == k.name)
        complain(log, where.child("name"), "there is another keep-out of this name", "a unique name");
    check_keep_out(k, log, where);
  }
  if (const auto& b = spec.box) {
    const SpecPath where = path.child("box");
    if (!(b->x_min_mm < b->x_max_mm))
      complain(log, where.child("x_max_mm"), "does not exceed x_min_mm", "a box with an inside");
    if (!(b->y_min_mm < b->y_max_mm))
      complain(log, where.child("y_max_mm"), "does not exceed y_min_mm", "a box with an inside");
  }
  if (spec.min_unstretched_length_mm && spec.max_unstretched_length_mm &&
      *spec.min_unstretched_length_mm > *spec.max_unstretched_length_mm)
    complain(log, path.child("max_unstretched_length_mm"), "is less than min_unstretched_length_mm",
             "a range of lengths");
  if (!scene.tensioner && (spec.take_up || spec.travel_deg))
    complain(log, path.child(spec.take_up ? "take_up" : "travel_deg"), "needs a tensioner, and there is none",
             "a scene with a [tensioner]");
  if (scene.range.empty() && spec.of_running())
    complain(log,
             path.child(spec.travel_deg        ? "travel_deg"
                        : spec.min_slip_safety ? "min_slip_safety"
                        : spec.max_hub_load_n  ? "max_hub_load_n"
                                               : "modes"),
             "needs operating ranges, and there are none", "a scene with [[range]]");
}

}  // namespace beltlife
