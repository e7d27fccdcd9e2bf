// Owns the command check: layout, statics, step limits and names of a scene; runs nothing.
#include <fmt/format.h>

#include <numbers>

#include "results/commands/commands.h"
#include "results/course/loaded_scene.h"
#include "results/course/shared_options.h"
#include "results/text/print.h"
#include "results/text/print_statics.h"
#include "results/text/table.h"
#include "sim/eval/quantities.h"
#include "sim/kernels/kernel.h"
#include "sim/run.h"
#include "sim/scene/pitch_line.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi;

nlohmann::json layout_json(const Model& m, const Layout& layout, double unstretched) {
  nlohmann::json j{{"arm_angle_rad", layout.arm_angle},  {"path_length_mm", 1e3 * layout.route.length},
                   {"tension_n", layout.tension},        {"unstretched_length_m", unstretched},
                   {"pulleys", nlohmann::json::array()}, {"spans", nlohmann::json::array()}};
  for (int p = 0; p < m.pulleys; ++p) {
    j["pulleys"].push_back({{"name", m.body_name[p]},
                            {"pitch_diameter_mm", pitch_diameter_mm(m.scene, m.scene.pulley[p])},
                            {"wrap_deg", layout.route.wrap[p] * degree}});
    if (m.scene.pulley[p].effective_diameter_mm)
      j["pulleys"].back()["effective_diameter_mm"] = *m.scene.pulley[p].effective_diameter_mm;
    j["spans"].push_back(
        {{"name", span_name(m.scene, static_cast<std::size_t>(p))}, {"length_mm", 1e3 * layout.route.spans[p].length}});
  }
  return j;
}

void print_layout(const Model& m) {
  const StaticState& s = m.statics;
  const bool effective = has_effective_diameters(m.scene), arm = m.tensioner.pulley >= 0;
  // Of a drive without an arm both states are the same.
  std::vector<std::string> header{"pulley", "side"};
  if (effective) header.push_back("effective dia mm");
  for (const char* name : {"pitch dia mm", "x mm", "y mm"}) header.push_back(name);
  if (arm) header.push_back("wrap deg placed");
  header.push_back(arm ? "wrap deg at rest" : "wrap deg");
  if (arm) header.push_back("span to next mm placed");
  header.push_back(arm ? "span to next mm at rest" : "span to next mm");
  Table table(header);
  for (int p = 0; p < m.pulleys; ++p) {
    const PulleySpec& spec = m.scene.pulley[p];
    std::vector<std::string> row{m.body_name[p], std::string(enum_name(spec.side))};
    if (effective) row.push_back(spec.effective_diameter_mm ? fmt::format("{:.2f}", *spec.effective_diameter_mm) : "-");
    row.push_back(fmt::format("{:.2f}", pitch_diameter_mm(m.scene, spec)));
    row.push_back(fixed_text(1e3 * s.balance.route.circles[p].x, 2));
    row.push_back(fixed_text(1e3 * s.balance.route.circles[p].y, 2));
    if (arm) row.push_back(fmt::format("{:.1f}", s.placed.route.wrap[p] * degree));
    row.push_back(fmt::format("{:.1f}", s.balance.route.wrap[p] * degree));
    if (arm) row.push_back(fmt::format("{:.1f}", 1e3 * s.placed.route.spans[p].length));
    row.push_back(fmt::format("{:.1f}", 1e3 * s.balance.route.spans[p].length));
    table.row(row);
  }
  fmt::print("{}\n", table.text(0));
  Table numbers(arm ? std::vector<std::string>{"", "placed", "at rest"} : std::vector<std::string>{"", "at rest"});
  const auto add = [&](const char* what, double placed, double rest) {
    if (arm)
      numbers.row({what, fixed_text(placed, 1), fixed_text(rest, 1)});
    else
      numbers.row({what, fixed_text(rest, 1)});
  };
  add("belt path mm", 1e3 * s.placed.route.length, 1e3 * s.balance.route.length);
  add("tension N", s.placed.tension, s.balance.tension);
  add("unstretched length mm", 1e3 * s.placed_unstretched_length, 1e3 * s.unstretched_length);
  if (arm) add("arm angle deg", 0, s.balance.arm_angle * degree);
  fmt::print("{}\n", numbers.text(0));
  if (const auto length = m.scene.belt.effective_length_mm)
    fmt::print("effective belt length {:g} mm, {:.1f} mm along the cord\n\n", *length,
               *length + 2 * std::numbers::pi * m.scene.belt.effective_line_differential_mm.value_or(0));
  if (arm)
    fmt::print(
        "placed: the arm as the scene places it, with the belt that would be at rest there (the scene's own belt "
        "would carry {:.0f} N)\n\n",
        s.placed_strain_tension);
}

struct CheckOptions : CommonOptions {
  std::string scene;
};

nlohmann::json json_of(const LoadedScene& l, const std::string& path) {
  const Model& m = l.model;
  nlohmann::json j{{"scene", path},
                   {"scheme", enum_name(m.scene.solver.scheme)},
                   {"elements", m.belt.nodes},
                   {"stable_step_s", stable_step(m, m.scene.solver.scheme)},
                   {"step_s", run_step(m)},
                   {"kernels", nlohmann::json::array()},
                   {"quantities", quantity_names(m)},
                   {"parameters", number_paths(l.file.scene)},
                   {"step_limits", nlohmann::json::array()}};
  for (const std::string& name : kernel_names(m)) j["kernels"].push_back(name);
  for (const StepLimit& limit : step_limits(m, m.scene.solver.scheme))
    j["step_limits"].push_back({{"name", limit.name}, {"formula", limit.formula}, {"limit_s", limit.limit_s}});
  if (m.pulleys > 0) {
    j["printed"] = layout_json(m, m.statics.placed, m.statics.placed_unstretched_length);
    j["static"] = layout_json(m, m.statics.balance, m.statics.unstretched_length);
    j["clearances"] = nlohmann::json::array();
    for (const Clearance& c : clearances(m.scene, m.statics.balance.route))
      j["clearances"].push_back({{"name", c.name}, {"value", c.value}, {"unit", c.unit}});
    add_statics(m, j);
  }
  return j;
}

void print_tightest(const Model& m) {
  const auto all = clearances(m.scene, m.statics.balance.route);
  const Clearance* tightest = nullptr;
  for (const Clearance& c : all)
    if (c.unit == "mm" && (!tightest || c.value < tightest->value)) tightest = &c;
  if (tightest) fmt::print("tightest clearance: {}, {:.1f} mm\n\n", tightest->name, tightest->value);
}

void print_solver(const Model& m) {
  const auto limits = step_limits(m, m.scene.solver.scheme);
  Table table({"step limit", "s", "formula"});
  for (const StepLimit& limit : limits) table.row({limit.name, fmt::format("{:.3g}", limit.limit_s), limit.formula});
  fmt::print("{}\nscheme {}, {} elements, step {:.4g} s (limit {:.4g})\nkernels:", table.text(0),
             enum_name(m.scene.solver.scheme), m.belt.nodes, run_step(m), limits.front().limit_s);
  const auto kernels = kernel_names(m);
  for (std::size_t i = 0; i < kernels.size(); ++i) fmt::print("{} {}", i ? "," : "", kernels[i]);
  fmt::print("\n{} quantities can be studied; --json lists them\n", quantity_names(m).size());
}

int run_check(const CheckOptions& o) {
  const LoadedScene l = load_scene(o.scene, o.settings);
  const Model& m = l.model;
  if (o.json) {
    fmt::print("{}\n", json_text(json_of(l, o.scene)));
    return 0;
  }
  fmt::print("{}{}\n\n", o.scene, m.scene.title.empty() ? "" : ": " + m.scene.title);
  if (m.pulleys > 0) {
    print_layout(m);
    print_tightest(m);
    fmt::print("{}", statics_text(m));
  } else {
    fmt::print("a ring without pulleys has no layout and no statics\n\n");
  }
  print_solver(m);
  return 0;
}

}  // namespace

void add_check_command(CommandLine& line) {
  auto o = std::make_shared<CheckOptions>();
  Command command =
      line.command("check", "read a scene, solve its layout and static balance, print limits and names; runs nothing");
  common_flags(command, *o);
  command.input("scene", o->scene, "scene file (TOML)")
      .footer("Example:\n  beltlife check sim/scenes/baseline.toml --json")
      .runs(o, run_check);
}

}  // namespace beltlife
