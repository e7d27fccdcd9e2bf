// Owns the command check: layout, statics, step limits and names of a scene; runs nothing.
#include <fmt/format.h>

#include <numbers>

#include "results/loaded_scene.h"
#include "results/print.h"
#include "results/print_statics.h"
#include "results/table.h"
#include "sim/eval/summary.h"
#include "sim/kernels/kernel.h"
#include "sim/run.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi;

nlohmann::json layout_json(const Model& m, const Layout& layout, double unstretched) {
  nlohmann::json j{{"arm_angle_rad", layout.arm_angle},  {"path_length_mm", 1e3 * layout.route.length},
                   {"tension_n", layout.tension},        {"unstretched_length_m", unstretched},
                   {"pulleys", nlohmann::json::array()}, {"spans", nlohmann::json::array()}};
  for (int p = 0; p < m.pulleys; ++p) {
    j["pulleys"].push_back({{"name", m.body_name[p]}, {"wrap_deg", layout.route.wrap[p] * degree}});
    j["spans"].push_back(
        {{"name", span_name(m.scene, static_cast<std::size_t>(p))}, {"length_mm", 1e3 * layout.route.spans[p].length}});
  }
  return j;
}

void print_layout(const Model& m) {
  const StaticState& s = m.statics;
  Table table({"pulley", "side", "x mm", "y mm", "wrap deg placed", "at rest", "span to next mm placed", "at rest"});
  for (int p = 0; p < m.pulleys; ++p)
    table.row({m.body_name[p], std::string(enum_name(m.scene.pulley[p].side)),
               fmt::format("{:.2f}", 1e3 * s.balance.route.circles[p].x),
               fmt::format("{:.2f}", 1e3 * s.balance.route.circles[p].y),
               fmt::format("{:.1f}", s.placed.route.wrap[p] * degree),
               fmt::format("{:.1f}", s.balance.route.wrap[p] * degree),
               fmt::format("{:.1f}", 1e3 * s.placed.route.spans[p].length),
               fmt::format("{:.1f}", 1e3 * s.balance.route.spans[p].length)});
  fmt::print("{}\n", table.text(0));
  Table numbers({"", "placed", "at rest"});
  numbers.row({"belt path mm", fmt::format("{:.1f}", 1e3 * s.placed.route.length),
               fmt::format("{:.1f}", 1e3 * s.balance.route.length)});
  numbers.row({"tension N", fmt::format("{:.1f}", s.placed.tension), fmt::format("{:.1f}", s.balance.tension)});
  numbers.row({"unstretched length mm", fmt::format("{:.1f}", 1e3 * s.placed_unstretched_length),
               fmt::format("{:.1f}", 1e3 * s.unstretched_length)});
  if (m.tensioner.pulley >= 0) numbers.row({"arm angle rad", "0.0000", fmt::format("{:.4f}", s.balance.arm_angle)});
  fmt::print("{}\n", numbers.text(0));
  if (m.tensioner.pulley >= 0)
    fmt::print(
        "placed: the arm as the scene places it, with the belt that would be at rest there (this belt would carry "
        "{:.0f} N)\n\n",
        s.placed_strain_tension);
}

}  // namespace

int run_check(const CommandOptions& o) {
  const LoadedScene l = load_scene(o.scenes.at(0), o);
  const Model& m = l.model;
  const auto limits = step_limits(m, m.scene.solver.scheme);
  const auto program = force_program(m);
  if (o.json) {
    nlohmann::json j{{"scene", o.scenes[0]},
                     {"scheme", enum_name(m.scene.solver.scheme)},
                     {"elements", m.belt.nodes},
                     {"stable_step_s", stable_step(m, m.scene.solver.scheme)},
                     {"step_s", run_step(m)},
                     {"kernels", nlohmann::json::array()},
                     {"quantities", quantity_names(m)},
                     {"parameters", number_paths(l.file.scene)},
                     {"step_limits", nlohmann::json::array()}};
    for (const Kernel& k : program) j["kernels"].push_back(k.name);
    for (const StepLimit& limit : limits)
      j["step_limits"].push_back({{"name", limit.name}, {"formula", limit.formula}, {"limit_s", limit.limit_s}});
    if (m.pulleys > 0) {
      j["printed"] = layout_json(m, m.statics.placed, m.statics.placed_unstretched_length);
      j["static"] = layout_json(m, m.statics.balance, m.statics.unstretched_length);
      j["clearances"] = nlohmann::json::array();
      for (const Clearance& c : clearances(m.scene, m.statics.balance.route))
        j["clearances"].push_back({{"name", c.name}, {"value", c.value}, {"unit", c.unit}});
      add_statics(m, j);
    }
    fmt::print("{}\n", json_text(j));
    return 0;
  }
  fmt::print("{}{}\n\n", o.scenes[0], m.scene.title.empty() ? "" : ": " + m.scene.title);
  if (m.pulleys > 0) {
    print_layout(m);
    const auto all = clearances(m.scene, m.statics.balance.route);
    const Clearance* tightest = nullptr;
    for (const Clearance& c : all)
      if (c.unit == "mm" && (!tightest || c.value < tightest->value)) tightest = &c;
    if (tightest) fmt::print("tightest clearance: {}, {:.1f} mm\n\n", tightest->name, tightest->value);
    fmt::print("{}", statics_text(m));
  }
  Table table({"step limit", "s", "formula"});
  for (const StepLimit& limit : limits) table.row({limit.name, fmt::format("{:.3g}", limit.limit_s), limit.formula});
  fmt::print("{}\nscheme {}, {} elements, step {:.4g} s (stable up to {:.4g})\nkernels:", table.text(0),
             enum_name(m.scene.solver.scheme), m.belt.nodes, run_step(m), limits.front().limit_s);
  for (std::size_t i = 0; i < program.size(); ++i) fmt::print("{} {}", i ? "," : "", program[i].name);
  fmt::print("\n{} quantities can be studied; --json lists them\n", quantity_names(m).size());
  return 0;
}

}  // namespace beltlife
