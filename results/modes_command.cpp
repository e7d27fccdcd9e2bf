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

#include "results/commands.h"
#include "results/print.h"
#include "results/table.h"
#include "sim/modes/campbell.h"
#include "sim/scene/scene_io.h"
#include "sim/signal/spectrum.h"

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

// A string of gnuplot's in single quotes, where only they are special; no line break may end the command.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "'";
}

std::string line_style(const FrequencyCurve& curve, int color) {
  if (!curve.arm) return fmt::format("lc {} lw 1 dt 3", color);
  return fmt::format("lc {} lw 2 dt {}", color, *curve.arm == ArmState::stuck ? 2 : 1);
}

std::string map_script(const Model& m, const Campbell& diagram, const std::vector<Crossing>& found) {
  const double first = diagram.crank_rpm.front(), last = diagram.crank_rpm.back();
  const double top = default_orders().back() * last / 60;
  std::string s =
      "set terminal svg size 1200,760 dynamic noenhanced background rgb 'white'\n"
      "set xlabel 'crank speed, r/min'\nset ylabel 'frequency, Hz'\nset key outside right top noenhanced\n"
      "set grid lc rgb '#e6e6e6'\nset rmargin 46\n";
  s += fmt::format("set title {} offset 0,0.8\nset xrange [{}:{}]\nset yrange [0:{}]\n", quoted(m.scene.title), first,
                   last, top);
  std::string labelled;  // ranges at the same speed share a line
  for (const RangeSpec& range : m.scene.range) {
    const std::string at = fmt::format("{:g}", range.crank_rpm);
    s += fmt::format("set arrow from {0},0 to {0},{1} nohead lc rgb '#dddddd' lw 6 back\n", at, top);
    if (labelled.find(fmt::format("<{}>", at)) == labelled.npos)
      s += fmt::format("set label {} at {},{} center offset 0,0.7 font ',11' tc rgb '#555555'\n", quoted(range.name),
                       at, top);
    labelled += fmt::format("<{}>", at);
  }
  for (const double order : default_orders()) {
    s += fmt::format("set arrow from {},{} to {},{} nohead lc rgb '#999999' lw 0.6 back\n", first, order * first / 60,
                     last, order * last / 60);
    s += fmt::format("set label '{:g}' at {},{} right offset -0.3,0.4 font ',10' tc rgb '#666666'\n", order, last,
                     order * last / 60);
  }
  s += "$near << EOD\n";
  for (const Crossing& c : found)
    if (c.near) s += fmt::format("{} {}\n", c.crank_rpm, c.frequency_hz);
  s += "EOD\n";
  for (std::size_t i = 0; i < diagram.curves.size(); ++i) {
    s += fmt::format("$c{} << EOD\n", i);
    for (std::size_t k = 0; k < diagram.crank_rpm.size(); ++k)
      s += fmt::format("{} {}\n", diagram.crank_rpm[k], diagram.curves[i].frequency_hz[k]);
    s += "EOD\n";
  }
  s += "plot ";
  for (std::size_t i = 0; i < diagram.curves.size(); ++i)
    s += fmt::format("$c{} with lines {} title {}, ", i, line_style(diagram.curves[i], static_cast<int>(i % 8) + 1),
                     quoted(diagram.curves[i].name));
  // gnuplot stops at an empty data block.
  const bool any = std::any_of(found.begin(), found.end(), [](const Crossing& c) { return c.near.has_value(); });
  return s + (any ? "$near with points pt 7 ps 0.5 lc rgb 'black' title 'crossing near a range'\n" : "1/0 notitle\n");
}

// The script goes to gnuplot's standard input; the drawing appears whole or not at all.
void draw_map(const std::string& file, const std::string& script) {
  const std::string part = file + ".part";
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  std::FILE* gnuplot = popen("gnuplot >/dev/null 2>&1", "w");
  int code = -1;
  if (gnuplot) {
    const std::string whole = fmt::format("set output {}\n{}", quoted(part), script);
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
  const LoopEstimate& loop = modes.loop;
  nlohmann::json j{{"crank_rpm", modes.range.crank_rpm},
                   {"belt_speed_m_s", loop.belt_speed},
                   {"arm_angle_rad", loop.arm_angle},
                   {"balanced", loop.balanced},
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

// What can resonate near a range: orders that the driven body's speed has, if the scene says so, and modes that are not
// damped away.
bool worth_printing(const Crossing& c, const SceneSpec& scene) {
  constexpr double damped_away = 0.3;
  if (!c.near || c.damping_ratio > damped_away) return false;
  if (!scene.driver || scene.driver->speed_csv || scene.driver->harmonic.empty()) return true;
  return std::any_of(scene.driver->harmonic.begin(), scene.driver->harmonic.end(),
                     [&](const HarmonicSpec& h) { return h.order == c.order; });
}

void print_crossings(const std::vector<Crossing>& found, const SceneSpec& scene) {
  Table table({"order", "r/min", "Hz", "mode", "within 5 % of"});
  std::size_t near = 0, printed = 0;
  for (const Crossing& c : found) {
    if (c.near) ++near;
    if (!worth_printing(c, scene)) continue;
    ++printed;
    table.row(
        {fmt::format("{:g}", c.order), fmt::format("{:.0f}", c.crank_rpm), hertz(c.frequency_hz), c.mode, *c.near});
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
    if (p.loop.slack) fmt::print("{}: a span is slack by this estimate; its numbers mean little\n", p.range.name);
    if (!p.loop.balanced)
      fmt::print("{}: no arm angle balances these torques; the arm is taken where it rests\n", p.range.name);
    for (std::size_t g = 0; g < p.loop.gear_engaged.size(); ++g)
      if (!p.loop.gear_engaged[g])
        fmt::print("{}: gear pair {} carries no mean torque, its teeth are taken as apart\n", p.range.name,
                   m.scene.gear_pair[g].name);
  }
}

}  // namespace

int run_modes(const CommandOptions& o) {
  if (!o.map.empty() && !has_gnuplot())
    throw BadInput({Problem{o.map, 0, "--map", "gnuplot draws the map and is not installed",
                            "apt-get install gnuplot-nox, or no --map"}});
  const SceneFile file = read_scene(o.scenes.at(0), o.settings);
  Model m;
  try {
    m = compile(file.scene, o.scenes[0]);
  } catch (const BadInput& bad) {
    throw located(file, bad);
  }
  std::vector<Modes> points;
  std::string nothing;
  if (m.pulleys == 0) {
    nothing = "a ring without pulleys has no rotational modes and no free spans: there is nothing to solve";
  } else {
    for (const RangeSpec& range : m.scene.range) points.push_back(solve_modes(m, range));
    if (points.empty()) points.push_back(solve_modes(m, {"rest", 0, 0}));
  }
  const Campbell diagram = campbell(m);
  const auto found = crossings(diagram, m.scene.range);

  if (o.json) {
    nlohmann::json j{{"scene", o.scenes[0]},
                     {"ranges", nlohmann::json::object()},
                     {"map", json_of(diagram)},
                     {"crossings", json_of(found)}};
    if (!nothing.empty()) j["nothing_to_solve"] = nothing;
    for (const Modes& p : points) j["ranges"][p.range.name] = json_of(m, p);
    fmt::print("{}\n", j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}{}\n\n", o.scenes[0], m.scene.title.empty() ? "" : ": " + m.scene.title);
    if (!nothing.empty()) fmt::print("{}\n", nothing);
    if (!points.empty()) {
      for (std::size_t arm = 0; arm < points.front().arms.size(); ++arm) {
        print_rotational(m, points, arm, true);
        print_rotational(m, points, arm, false);
      }
      print_transverse(points);
      print_doubts(points, m);
      if (!diagram.crank_rpm.empty()) print_crossings(found, m.scene);
    }
  }
  if (o.map.empty()) return 0;
  if (diagram.curves.empty()) {
    if (!o.quiet) fmt::print(stderr, "no map: there are no natural frequencies over a range of speeds\n");
    return 0;
  }
  draw_map(o.map, map_script(m, diagram, found));
  if (!o.quiet) fmt::print(stderr, "wrote {}\n", o.map);
  return 0;
}

}  // namespace beltlife
