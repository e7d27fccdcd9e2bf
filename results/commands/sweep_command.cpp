// The command simulate --sweep: a run through a range of crank speeds, and the orders of the output over it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "results/commands/stretch_run.h"
#include "results/course/scene_runs.h"
#include "results/text/print.h"
#include "results/text/table.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

constexpr double slowest_rpm = 1, fastest_rpm = 1e5, longest_s = 600;

[[noreturn]] void refuse(const std::string& text, std::string what, std::string allowed) {
  throw BadInput({Problem{"--sweep", 0, text, std::move(what), std::move(allowed)}});
}

bool number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

SweepSpec sweep_from(const std::string& text) {
  const std::string form = "FROM:TO:SECONDS, such as 600:2200:60: crank speeds in r/min, upwards or downwards";
  const auto first = text.find(':'), second = first == text.npos ? text.npos : text.find(':', first + 1);
  const std::string_view all = text;
  SweepSpec s;
  if (second == text.npos || !number(all.substr(0, first), s.from_rpm) ||
      !number(all.substr(first + 1, second - first - 1), s.to_rpm) || !number(all.substr(second + 1), s.seconds))
    refuse(text, "is not three numbers with colons between them", form);
  for (const double rpm : {s.from_rpm, s.to_rpm})
    if (rpm < slowest_rpm || rpm > fastest_rpm)
      refuse(text, fmt::format("{:g} r/min is out of limits", rpm),
             fmt::format("from {:g} to {:g} r/min", slowest_rpm, fastest_rpm));
  if (s.from_rpm == s.to_rpm) refuse(text, "begins and ends at one speed", "two speeds; a [[range]] for a single one");
  const double shortest = shortest_sweep_s(s.from_rpm, s.to_rpm);
  if (shortest > longest_s)
    refuse(
        text, "spans speeds that cannot be swept slowly enough within the longest sweep",
        fmt::format("a slowest speed and a span for which {:g} s are enough, such as two sweeps, one after the other",
                    longest_s));
  if (!(s.seconds >= shortest && s.seconds <= longest_s))
    refuse(
        text, fmt::format("{:g} s are too {}", s.seconds, s.seconds < shortest ? "short" : "long"),
        fmt::format("from {:g} to {:g} s: within a window of 8 revolutions the speed may change by {:g} % at the most",
                    std::ceil(10 * shortest) / 10, longest_s, 100 * largest_sweep_change));
  return s;
}

void refuse_without(const LoadedScene& l) {
  const auto lacks = [&](const char* key, const char* what, const char* allowed) {
    throw located(l.file, BadInput({Problem{l.file.path.string(), 0, key, what, allowed}}));
  };
  const SceneSpec& scene = l.file.scene;
  if (!scene.driver) lacks("driver", "--sweep needs a driven body, and there is none", "a table [driver]");
  if (!scene.output) lacks("output", "--sweep is about an output, and there is none", "a table [output]");
  if (scene.driver->speed_csv)
    lacks("driver.speed_csv", "--sweep cannot change the speed of a measurement",
          "harmonics instead; --set driver.speed_csv= takes the measurement away");
}

std::string near_text(const SweepPeak& peak) {
  if (!peak.near) return "none";
  return fmt::format("{} ({:.1f} Hz at {:.0f} r/min)", peak.near->mode, peak.near->frequency_hz, peak.near->crank_rpm);
}

std::string text_of(const Sweep& s) {
  std::string text = fmt::format(
      "Sweep from {:g} to {:g} r/min in {:g} s{}, by windows of {:g} crank revolutions: {} places\n", s.asked.from_rpm,
      s.asked.to_rpm, s.asked.seconds, s.complete ? "" : " (incomplete)", s.window_revolutions, s.crank_rpm.size());
  for (const SweepChannel& c : s.channels) {
    Table table({"order", "amplitude " + c.unit, "at r/min", "Hz", "natural frequency that it meets there"});
    for (const SweepPeak& peak : peaks_of(s, c))
      table.row({fmt::format("{:g}", peak.order), fmt::format("{:.3f}", peak.amplitude),
                 fmt::format("{:.0f}", peak.crank_rpm), fmt::format("{:.1f}", peak.frequency_hz), near_text(peak)});
    text += fmt::format("\n  {}: each order where it is largest\n{}", c.name, table.text(4));
  }
  return text + "\n";
}

nlohmann::json json_of(const Sweep& s) {
  nlohmann::json j{
      {"from_rpm", s.asked.from_rpm}, {"to_rpm", s.asked.to_rpm}, {"seconds", s.asked.seconds},
      {"begin_s", s.begin_s},         {"end_s", s.end_s},         {"complete", s.complete},
      {"time_s", s.time_s},           {"crank_rpm", s.crank_rpm}, {"window_revolutions", s.window_revolutions}};
  for (const SweepChannel& c : s.channels) {
    nlohmann::json channel{{"unit", c.unit}, {"peaks", nlohmann::json::array()}, {"cuts", nlohmann::json::object()}};
    for (const SweepPeak& peak : peaks_of(s, c)) {
      nlohmann::json line{{"order", peak.order},
                          {"amplitude", peak.amplitude},
                          {"crank_rpm", peak.crank_rpm},
                          {"frequency_hz", peak.frequency_hz},
                          {"near", nullptr}};
      if (peak.near)
        line["near"] = {{"mode", peak.near->mode},
                        {"frequency_hz", peak.near->frequency_hz},
                        {"crank_rpm", peak.near->crank_rpm},
                        {"damping_ratio", peak.near->damping_ratio}};
      channel["peaks"].push_back(std::move(line));
    }
    for (const double order : default_orders())
      for (std::size_t k = 0; k < s.orders.size(); ++k)
        if (s.orders[k] == order) {
          nlohmann::json cut = nlohmann::json::array();
          for (const double amplitude : c.amplitude[k]) cut.push_back(finite(amplitude));
          channel["cuts"][fmt::format("{:g}", order)] = std::move(cut);
        }
    j["channels"][c.name] = std::move(channel);
  }
  return j;
}

}  // namespace

int run_sweep(const SimulateOptions& o) {
  const SweepSpec asked = sweep_from(o.sweep);
  const LoadedScene l = load_scene(o.scene, o.settings, o.out);
  refuse_without(l);
  const RunPlan plan = plan_sweep(l.file.scene, asked);
  const StretchRun run = run_stretch(l, plan, o);
  const Sweep sweep = sweep_of(l.model, asked, run.record, run.window);
  write_file(l, {run.record}, nullptr, o, {&sweep, nullptr});
  if (o.json) {
    nlohmann::json j = json_of(run, plan);
    j["sweep"] = json_of(sweep);
    fmt::print("{}\n", json_text(j));
  } else {
    fmt::print("{}{}", text_of(sweep), closing_text(run, l, o));
  }
  return run.failed ? 3 : 0;
}

}  // namespace beltlife
