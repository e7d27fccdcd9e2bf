// Owns the command modes: natural frequencies and crossings as tables, as JSON, and as a Campbell diagram by gnuplot.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "results/commands/commands.h"
#include "results/course/shared_options.h"
#include "results/pages/campbell_chart.h"
#include "results/pages/gnuplot.h"
#include "results/text/print.h"
#include "results/text/table.h"
#include "sim/eval/solved_drive.h"
#include "sim/range_models.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

std::string hertz(double f) { return fmt::format("{:.2f}", f); }

bool has_gnuplot() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder.empty() ? "." : folder) / "gnuplot").c_str(), X_OK) == 0) return true;
  return false;
}

// The script goes to gnuplot's standard input; the drawing appears whole or not at all.
void draw_map(const std::string& file, const std::string& script) {
  const std::string part = file + ".part";
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  std::FILE* gnuplot = popen("gnuplot >/dev/null 2>&1", "w");
  int code = -1;
  if (gnuplot) {
    const std::string whole = fmt::format("set output {}\n{}", gnuplot_quoted(part), script);
    const bool sent = std::fwrite(whole.data(), 1, whole.size(), gnuplot) == whole.size();
    code = pclose(gnuplot);
    if (!sent) code = -1;
  }
  std::signal(SIGPIPE, before);
  std::error_code error;
  if (code == 0) fs::rename(part, file, error);
  if (code != 0 || error) {
    fs::remove(part, error);
    throw BadInput({Problem{file, 0, "--map", "gnuplot could not draw the map",
                            "a file in a folder that can be written to, and gnuplot 5 (apt-get install gnuplot-nox)"}});
  }
}

// Shapes are those of the undamped mode; a damped one has a phase at each body and shows its energy only.
nlohmann::json energy_json(const Model& m, const EnergyShares& energy) {
  nlohmann::json j{{"arm", energy.arm}, {"belt", energy.belt}, {"bodies", nlohmann::json::object()}};
  for (int b = 0; b < m.bodies; ++b) j["bodies"][m.body_name[b]] = energy.body[b];
  return j;
}

nlohmann::json json_of(const Model& m, const Mode& mode) {
  nlohmann::json j{{"frequency_hz", mode.frequency_hz},
                   {"energy", energy_json(m, mode.energy)},
                   {"shape", {{"arm", mode.arm_shape}, {"bodies", nlohmann::json::object()}}}};
  for (int b = 0; b < m.bodies; ++b) j["shape"]["bodies"][m.body_name[b]] = mode.body_shape[b];
  return j;
}

nlohmann::json json_of(const Model& m, const DampedMode& mode) {
  return {{"frequency_hz", mode.frequency_hz},
          {"damping_ratio", mode.damping_ratio},
          {"energy", energy_json(m, mode.energy)}};
}

nlohmann::json json_of(const Model& m, const Modes& modes) {
  const OperatingPoint& loop = modes.loop;
  nlohmann::json j{{"crank_rpm", modes.range.crank_rpm},
                   {"belt_speed_m_s", loop.belt_speed},
                   {"arm_angle_rad", loop.arm_angle},
                   {"balanced", loop.balanced},
                   {"instead", loop.instead},
                   {"slack", loop.slack},
                   {"rotational", nlohmann::json::object()},
                   {"spans", nlohmann::json::array()},
                   {"gears", nlohmann::json::array()},
                   {"centrifugal_n", loop.centrifugal}};
  for (std::size_t g = 0; g < loop.gear_engaged.size(); ++g)
    j["gears"].push_back({{"name", m.scene.gear_pair[g].name}, {"engaged", bool(loop.gear_engaged[g])}});
  for (const ArmModes& arm : modes.arms) {
    auto& list = j["rotational"][std::string(name_of(arm.arm))] = nlohmann::json::array();
    auto& damped = j["damped"][std::string(name_of(arm.arm))] = nlohmann::json::array();
    for (const DampedMode& mode : arm.damped) damped.push_back(json_of(m, mode));
    for (const Mode& mode : arm.modes) list.push_back(json_of(m, mode));
  }
  for (const SpanModes& s : modes.spans)
    j["spans"].push_back({{"name", s.name},
                          {"length_mm", 1e3 * s.length},
                          {"tension_n", s.tension},
                          {"wave_speed_m_s", s.wave_speed},
                          {"frequency_hz", {s.frequency_hz[0], s.frequency_hz[1]}}});
  return j;
}

nlohmann::json json_of(const Campbell& diagram) {
  nlohmann::json j{{"crank_rpm", diagram.crank_rpm}, {"curves", nlohmann::json::array()}};
  for (const FrequencyCurve& c : diagram.curves)
    j["curves"].push_back({{"name", c.name}, {"damping_ratio", c.damping_ratio}, {"frequency_hz", c.frequency_hz}});
  return j;
}

nlohmann::json json_of(const std::vector<Crossing>& found) {
  nlohmann::json j = nlohmann::json::array();
  for (const Crossing& c : found)
    j.push_back({{"frequency_hz", c.frequency_hz},
                 {"order", c.order},
                 {"crank_rpm", c.crank_rpm},
                 {"mode", c.mode},
                 {"damping_ratio", c.damping_ratio},
                 {"near_range", c.near ? nlohmann::json(*c.near) : nlohmann::json(nullptr)}});
  return j;
}

// Rows: modes, columns: operating points; the last columns are of the last point.
void print_rotational(const Model& m, const std::vector<Modes>& points, std::size_t arm, bool damped) {
  const ArmState state = points.front().arms[arm].arm;
  const std::string where = state == ArmState::none ? "" : fmt::format(", arm {}", name_of(state));
  std::vector<std::string> header{fmt::format("rotational{}{}, Hz", where, damped ? "" : ", without dampers")};
  std::size_t count = 0;
  for (const Modes& p : points) {
    header.push_back(p.range.name);
    count = std::max(count, damped ? p.arms[arm].damped.size() : p.arms[arm].modes.size());
  }
  if (damped) header.push_back("damping ratio");
  header.push_back("moving energy in " + points.back().range.name);
  Table table(header);
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> row{fmt::format("{} {}", damped ? "rotational" : "mode", k + 1)};
    std::string ratio, who;  // of the last point
    for (const Modes& p : points) {
      const ArmModes& at = p.arms[arm];
      ratio.assign(1, '-');
      who = ratio;
      if (damped && k < at.damped.size()) {
        row.push_back(hertz(at.damped[k].frequency_hz));
        ratio = fmt::format("{:.3f}", at.damped[k].damping_ratio);
        who = describe(m, at.damped[k].energy);
      } else if (!damped && k < at.modes.size()) {
        row.push_back(hertz(at.modes[k].frequency_hz));
        who = describe(m, at.modes[k].energy);
      } else {
        row.push_back("-");
      }
    }
    if (damped) row.push_back(ratio);
    row.push_back(who);
    table.row(row);
  }
  if (count > 0) fmt::print("{}\n", table.text(0));
}

void print_transverse(const std::vector<Modes>& points) {
  std::vector<std::string> header{"transverse 1 and 2, Hz"};
  for (const Modes& p : points) header.push_back(p.range.name);
  Table table(header);
  for (std::size_t k = 0; k < points.front().spans.size(); ++k) {
    std::vector<std::string> row{points.front().spans[k].name};
    for (const Modes& p : points)
      row.push_back(fmt::format("{:.1f} {:.1f}", p.spans[k].frequency_hz[0], p.spans[k].frequency_hz[1]));
    table.row(row);
  }
  fmt::print("{}\n", table.text(0));
}

void print_crossings(const std::vector<Crossing>& found, const SceneSpec& scene) {
  Table table({"order", "r/min", "Hz", "damping ratio", "mode", "within 5 % of"});
  std::size_t near = 0, printed = 0;
  for (const Crossing& c : found) {
    if (c.near) ++near;
    if (!can_resonate(c, scene)) continue;
    ++printed;
    table.row({fmt::format("{:g}", c.order), fmt::format("{:.0f}", c.crank_rpm), hertz(c.frequency_hz),
               fmt::format("{:.3f}", c.damping_ratio), c.mode, *c.near});
  }
  if (printed > 0) fmt::print("{}\n", table.text(0));
  fmt::print(
      "{} crossings with orders 0.5 to 9 over the speeds of the ranges, {} of them within 5 % of a range; listed are "
      "the "
      "{} of these\nwhose order the driver's speed has and whose damping ratio is below 0.3; --json lists all\n",
      found.size(), near, printed);
}

void print_doubts(const std::vector<Modes>& points, const Model& m) {
  for (const Modes& p : points) {
    if (!p.loop.instead.empty()) fmt::print("{}: {}\n", p.range.name, p.loop.instead);
    if (p.loop.slack) fmt::print("{}: a span is slack; its numbers mean little\n", p.range.name);
    for (std::size_t g = 0; g < p.loop.gear_engaged.size(); ++g)
      if (!p.loop.gear_engaged[g])
        fmt::print("{}: gear pair {} carries no mean torque, its teeth are taken as apart\n", p.range.name,
                   m.scene.gear_pair[g].name);
  }
}

// Single ranges, as --range names them; crossings and map are over the speeds of all.
DriveModes modes_of(const Model& m, const std::vector<std::string>& names) {
  if (names.empty()) return drive_modes(m);
  std::vector<Problem> problems;
  std::string known;
  for (const RangeSpec& range : m.scene.range) known += (known.empty() ? "" : ", ") + range.name;
  for (const std::string& name : names)
    if (std::none_of(m.scene.range.begin(), m.scene.range.end(), [&](const auto& range) { return range.name == name; }))
      problems.push_back({"--range", 0, name, "the scene has no range of this name",
                          known.empty() ? "none: the scene has no ranges" : known});
  if (!problems.empty()) throw BadInput(std::move(problems));
  DriveModes modes;
  const RangeModels models(m);
  for (const RangeSpec& range : m.scene.range)
    if (m.pulleys > 0 && std::find(names.begin(), names.end(), range.name) != names.end())
      modes.points.push_back(solve_modes(models.of(range.condition), range));
  return modes;
}

struct ModesCommandOptions : CommonOptions {
  std::string scene;
  std::vector<std::string> ranges;  ///< --range
  std::string map;                  ///< --map: SVG file, empty: none
};

nlohmann::json json_of(const Model& m, const DriveModes& modes, const std::string& path, const std::string& nothing) {
  nlohmann::json j{{"scene", path},
                   {"ranges", nlohmann::json::object()},
                   {"map", json_of(modes.map)},
                   {"crossings", json_of(modes.crossings)}};
  if (!nothing.empty()) j["nothing_to_solve"] = nothing;
  for (const Modes& p : modes.points) j["ranges"][p.range.name] = json_of(m, p);
  return j;
}

void print_modes(const Model& m, const DriveModes& modes, const std::string& path, const std::string& nothing) {
  fmt::print("{}{}\n\n", path, m.scene.title.empty() ? "" : ": " + m.scene.title);
  if (!nothing.empty()) fmt::print("{}\n", nothing);
  if (modes.points.empty()) return;
  for (std::size_t arm = 0; arm < modes.points.front().arms.size(); ++arm) {
    print_rotational(m, modes.points, arm, true);
    print_rotational(m, modes.points, arm, false);
  }
  print_transverse(modes.points);
  print_doubts(modes.points, m);
  if (!modes.map.crank_rpm.empty()) print_crossings(modes.crossings, m.scene);
}

int run_modes(const ModesCommandOptions& o) {
  if (!o.map.empty() && !has_gnuplot())
    throw BadInput({Problem{o.map, 0, "--map", "gnuplot draws the map and is not installed",
                            "apt-get install gnuplot-nox, or no --map"}});
  const SceneFile file = read_scene(o.scene, o.settings);
  Model m;
  try {
    m = compile(file.scene, o.scene);
  } catch (const BadInput& bad) {
    throw located(file, bad);
  }
  const DriveModes modes = modes_of(m, o.ranges);
  const std::string nothing =
      m.pulleys == 0 ? "a ring without pulleys has no rotational modes and no free spans: there is nothing to solve"
                     : "";
  if (o.json)
    fmt::print("{}\n", json_text(json_of(m, modes, o.scene, nothing)));
  else
    print_modes(m, modes, o.scene, nothing);
  if (o.map.empty()) return 0;
  if (modes.map.curves.empty()) {
    if (!o.quiet) fmt::print(stderr, "no map: there are no natural frequencies over a range of speeds\n");
    return 0;
  }
  draw_map(o.map, map_script(m.scene, modes));
  if (!o.quiet) fmt::print(stderr, "wrote {}\n", o.map);
  return 0;
}

}  // namespace

void add_modes_command(CommandLine& line) {
  auto o = std::make_shared<ModesCommandOptions>();
  Command command = line.command(
      "modes", "natural frequencies of every range, rotational and of the spans, and their crossings with orders");
  common_flags(command, *o);
  command.input("scene", o->scene, "scene file (TOML)")
      .text("--map", o->map, "FILE.svg", "also draw frequencies over crank speed with rays of orders (needs gnuplot)")
      .texts("--range", o->ranges, "NAME", "only this operating range, without crossings and map (repeatable)")
      .excludes("--range", "--map")
      .footer(
          "Examples:\n"
          "  beltlife modes sim/scenes/baseline.toml\n"
          "  beltlife modes sim/scenes/baseline.toml --range B100\n"
          "  beltlife modes sim/scenes/accessory_drive.toml --map accessory.svg")
      .runs(o, run_modes);
}

}  // namespace beltlife
