// Owns the table of targets for speed and accuracy against what this run measures: JSON, and a table for people.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "sim/eval/evaluator.h"
#include "sim/lanes/run_pack.h"
#include "sim/route/layout.h"
#include "tests/bench/target_drives.h"

namespace beltlife::bench {
namespace {

constexpr double thesis_step_s = 3e-7;  // and elements: table 3.5 of the thesis
constexpr int thesis_elements = 513;

Json eight_drives(const Settings& settings, Targets& targets) {
  Json rows = Json::array();
  std::vector<std::vector<Drive>> packs;
  std::vector<std::function<void()>> works;
  for (const std::optional<double> step : {std::optional<double>(), std::optional(1e-3 / 30)}) {
    auto& drives = packs.emplace_back();
    for (int i = 0; i < lanes; ++i) {
      SceneSpec scene = baseline(settings, Scheme::linearly_implicit, step);
      scene.belt.friction_front = 0.60 - 0.01 * i;
      drives.emplace_back(scene);
    }
  }
  for (auto& drives : packs)
    works.emplace_back([&drives] {
      std::vector<PackMember> members;
      for (const Drive& d : drives) members.push_back({&d.model, &d.plan});
      auto outcomes = run_pack(members, LaneUse::drives);
      for (std::size_t i = 0; i < drives.size(); ++i) drives[i].take(std::move(outcomes[i]));
    });
  const std::vector<Cost> costs = costs_of(settings.quick ? 1 : 3, works);
  for (std::size_t i = 0; i < packs.size(); ++i) {
    const RunRecord& record = packs[i].front().record;
    const double simulated = lanes * record.simulated_s;
    rows.push_back({{"step_s", record.step_s},
                    {"simulated_s_per_cpu_s", simulated / costs[i].cpu_s},
                    {"simulated_s_per_wall_s", simulated / costs[i].wall_s}});
    targets.add(fmt::format("eight drives in lanes, {:.3g} s: simulated s per s and core", record.step_s), true, 4, 8,
                simulated / costs[i].cpu_s);
  }
  return rows;
}

double ns_per_node_step(const Drive& d, const Cost& cost) {
  return cost.cpu_s * 1e9 / static_cast<double>(d.record.steps) / d.model.belt.nodes;
}

Json thesis_scheme(const Settings& settings, Targets& targets) {
  SceneSpec scene = baseline(settings, Scheme::thesis, thesis_step_s, true);
  scene.belt.elements = thesis_elements;
  std::vector<Drive> drives{Drive(scene)};
  const Cost cost = costs_of(settings.quick ? 1 : 3, runs_of(drives)).front();
  const double ns = ns_per_node_step(drives.front(), cost) / 2;  // two evaluations a step
  targets.add("thesis scheme: ns per node and evaluation", false, 10, {}, ns);
  return {{"step_s", drives.front().record.step_s}, {"elements", thesis_elements}, {"ns_per_node_evaluation", ns}};
}

void leave_out_train(SceneSpec& s) {
  s.body.clear();
  s.torsional_spring.clear();
  s.gear_pair.clear();
  s.torque.clear();
  s.output.reset();
}

// The arm's pulley turns where the arm would hold it at rest, so that the belt is as tight as before.
void leave_out_tensioner(SceneSpec& s) {
  const StaticState statics = solve_statics(s);
  const auto circles = circles_of(s, statics.orientation, statics.balance.arm_angle);
  for (std::size_t p = 0; p < s.pulley.size(); ++p) {
    if (s.pulley[p].name != s.tensioner->pulley) continue;
    s.pulley[p].x_mm = 1e3 * circles[p].x;
    s.pulley[p].y_mm = 1e3 * circles[p].y;
  }
  s.tensioner.reset();
}

Json leaving_out(const Settings& settings, Targets& targets) {
  struct Variant {
    const char* name;
    void (*change)(SceneSpec&);
  };
  const Variant variants[] = {
      {"everything", [](SceneSpec&) {}},
      {"without bending damping", [](SceneSpec& s) { s.belt.bending_damping_n_m2_s = 0; }},
      {"without gears, shafts, bodies and tables", leave_out_train},
      {"without tensioner", leave_out_tensioner},
      {"without any of these",
       [](SceneSpec& s) {
         s.belt.bending_damping_n_m2_s = 0;
         leave_out_train(s);
         leave_out_tensioner(s);
       }},
      {"everything, and bending stiffness", [](SceneSpec& s) { s.belt.bending_stiffness_n_m2 = 2; }}};
  std::vector<Drive> drives;
  for (const Variant& v : variants) {
    SceneSpec scene = baseline(settings, Scheme::linearly_implicit, {}, true);
    v.change(scene);
    drives.emplace_back(scene);
  }
  const std::vector<Cost> costs = costs_of(settings.quick ? 3 : 5, runs_of(drives));
  std::vector<double> ns;
  Json rows = Json::array();
  for (std::size_t i = 0; i < drives.size(); ++i) {
    ns.push_back(ns_per_node_step(drives[i], costs[i]));
    rows.push_back({{"scene", variants[i].name},
                    {"kernels", kernel_names(drives[i].model).size()},
                    {"step_s", drives[i].record.step_s},
                    {"ns_per_node_step", ns[i]}});
  }
  targets.add("leaving out: everything over the least", true, 1.5, {}, ns[0] / *std::min_element(ns.begin(), ns.end()));
  return rows;
}

Json energy(const Settings& settings, Targets& targets) {
  const SceneSpec scene = baseline(settings, Scheme::linearly_implicit, {});
  const Model model = compile(scene);
  Json rows = Json::array();
  double largest = 0;
  for (const RunOutcome& outcome : run_plans(model, plans_of(scene, {}, nullptr), 1)) {
    const WindowRecord& window = outcome.record.windows.front();
    if (!outcome.record.status.ok()) throw std::runtime_error(window.range + " failed: " + outcome.record.status.cause);
    const double residual = 100 * window.energy.relative_residual();
    largest = std::max(largest, std::abs(residual));
    rows.push_back({{"range", window.range}, {"step_s", outcome.record.step_s}, {"residual_percent", residual}});
  }
  targets.add("energy residual, worst of all ranges, %", false, 0.5, {}, largest);
  return rows;
}

Json threads(const Settings& settings, Targets& targets) {
  std::vector<SceneSpec> points(2 * lanes, baseline(settings, Scheme::linearly_implicit, {}, true));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].belt.friction_front = 0.6 - 0.005 * static_cast<double>(i);
  const auto batch = [&](int count) {
    EvaluatorOptions options;
    options.threads = count;
    options.ranges = {range};
    for (const PointResult& r : Evaluator(options).evaluate(points))  // a new one: nothing is in its memo
      if (!r.ok()) throw std::runtime_error("a point of the batch failed");
  };
  const auto costs = costs_of(settings.quick ? 1 : 5, {[&] { batch(1); }, [&] { batch(2); }});
  const double ratio = costs[0].wall_s / costs[1].wall_s;
  targets.add("two threads over one, wall", true, 1.9, {}, ratio);
  Json rows = Json::array();  // processor over wall time: how many cores the machine had to give
  for (int i = 0; i < 2; ++i)
    rows.push_back({{"threads", i + 1}, {"wall_s", costs[i].wall_s}, {"cores_had", costs[i].cpu_s / costs[i].wall_s}});
  return {{"points", points.size()}, {"runs", rows}, {"ratio", ratio}};
}

std::string cell(const Json& j) {
  if (j.is_null() || (j.is_number_float() && std::isnan(j.get<double>()))) return "-";
  if (j.is_number_float()) return fmt::format("{:.4g}", j.get<double>());
  if (j.is_boolean()) return j.get<bool>() ? "yes" : "no";
  return j.is_string() ? j.get<std::string>() : j.dump();
}

void print_rows(const std::string& title, const Json& rows) {
  fmt::print(stderr, "\n{}\n", title);
  for (const Json& row : rows) {
    std::string line;
    for (const auto& [key, value] : row.items())
      if (!value.is_object()) line += fmt::format("  {} {}", key, cell(value));
    fmt::print(stderr, "{}\n", line);
  }
}

void print_table(const Json& all) {
  fmt::print(stderr, "{:66}{:>10}{:>8}{:>10}{:>5}{:>9}{:>5}\n", "target", "", "", "measured", "met", "stretch", "met");
  for (const Json& t : all["targets"])
    fmt::print(stderr, "{:66}{:>10}{:>8}{:>10}{:>5}{:>9}{:>5}\n", cell(t["name"]), cell(t["bound"]), cell(t["target"]),
               cell(t["measured"]), cell(t["met"]), cell(t["stretch"]), cell(t["stretch_met"]));
  print_rows("steps against the reference", all["accuracy"]["steps"]);
  print_rows("leaving out", all["leaving_out"]);
  print_rows("energy", all["energy"]);
  print_rows("threads", all["threads"]["runs"]);
}

int measure(const Settings& settings) {
  Targets targets;
  Json all{{"machine", machine()}, {"quick", settings.quick}, {"range", range}, {"targets", {}}};
  all["elements"] = baseline(settings, Scheme::linearly_implicit, {}).belt.elements;
  all["accuracy"] = accuracy(settings, targets);
  all["eight_drives"] = eight_drives(settings, targets);
  all["thesis_scheme"] = thesis_scheme(settings, targets);
  all["leaving_out"] = leaving_out(settings, targets);
  all["energy"] = energy(settings, targets);
  all["threads"] = threads(settings, targets);
  all["machine"]["load_average_at_end"] = load_average();
  all["targets"] = targets.list;
  print_table(all);
  fmt::print("{}\n", all.dump(2));
  return 0;
}

}  // namespace
}  // namespace beltlife::bench

int main(int argc, char** argv) {
  beltlife::bench::Settings settings;
  CLI::App app("Measures the targets for speed and accuracy on the baseline");
  app.add_flag("--quick", settings.quick, "short profile, few repetitions, no reference: for work on this program");
  app.add_option("--reference", settings.reference,
                 "file that the reference is kept in, and taken from if it is there");
  CLI11_PARSE(app, argc, argv);
  try {
    return beltlife::bench::measure(settings);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 1;
  }
}
