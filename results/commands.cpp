// The commands check, simulate, life: see commands.h.
#include "results/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <optional>

#include "results/print.h"
#include "results/print_statics.h"
#include "results/progress.h"
#include "results/results_file.h"
#include "results/table.h"
#include "sim/eval/run_ranges.h"
#include "sim/life/loads.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/speed_csv.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi;

// A scene ready to run.
struct Loaded {
  SceneFile file;
  Model model;
  std::optional<MeasuredSpeed> measured;
  std::string out;  // result file, empty: none
  const MeasuredSpeed* speed() const { return measured ? &*measured : nullptr; }
};

std::string out_of(const std::string& scene, const CommandOptions& o) {
  if (o.out.empty() || o.scenes.size() == 1) return o.out;
  const std::filesystem::path path = o.out;
  return path.parent_path() /
         (path.stem().string() + "_" + std::filesystem::path(scene).stem().string() + path.extension().string());
}

// A measurement that misses part of the profile would run on at its last speed. One sampling interval is forgiven.
void refuse_short(const MeasuredSpeed& measured, const SceneSpec& scene, const std::string& file) {
  if (scene.range.empty()) return;
  const auto& t = measured.time_s;
  const double wanted = plan_profile(scene, &measured).end_s;
  if (t.front() <= t[1] - t.front() && t.back() + (t.back() - t[t.size() - 2]) >= wanted) return;
  throw BadInput(
      {Problem{file, 0, "driver.speed_csv",
               fmt::format("covers {:g} to {:g} s, the profile runs from 0 to {:g} s", t.front(), t.back(), wanted),
               "a measurement of the whole profile, or shorter profile.hold_s, or fewer ranges"}});
}

// Elements longer than a fifth of a radius touch a pulley with one or two nodes at a time.
void warn_coarse(const Model& m) {
  if (m.pulleys == 0) return;
  const auto smallest = std::min_element(m.pulley_radius.begin(), m.pulley_radius.end());
  if (m.belt.element_length <= *smallest / 5) return;
  fmt::print(stderr,
             "warning: elements of {:.1f} mm are coarse for pulley {}; contact forces and life need at least {:.0f} "
             "elements\n",
             1e3 * m.belt.element_length, m.body_name[static_cast<std::size_t>(smallest - m.pulley_radius.begin())],
             std::ceil(5 * m.belt.unstretched_length / *smallest));
}

Loaded load(const std::string& path, const CommandOptions& o) {
  Loaded l{read_scene(path, o.settings), {}, {}, out_of(path, o)};
  if (!l.out.empty()) check_writable(l.out);
  try {
    l.model = compile(l.file.scene, path);
  } catch (const BadInput& bad) {
    throw located(l.file, bad);
  }
  if (l.file.scene.driver && l.file.scene.driver->speed_csv) {
    const auto csv = l.file.path.parent_path() / *l.file.scene.driver->speed_csv;
    l.measured = read_speed_csv(csv);
    refuse_short(*l.measured, l.file.scene, csv.string());
  }
  warn_coarse(l.model);
  return l;
}

// A path may hold bytes that are no UTF-8; JSON cannot, and shows a replacement character.
std::string text_of(const nlohmann::json& j) { return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace); }

// A measured speed is what counts, not the speed that a range is named after.
void warn_of_speed(const std::vector<RunPlan>& plans, const SceneSpec& scene) {
  for (const RunPlan& plan : plans)
    for (const Window& window : plan.windows)
      for (const RangeSpec& range : scene.range)
        if (range.name == window.range && std::abs(window.crank_rpm - range.crank_rpm) > 0.05 * range.crank_rpm)
          fmt::print(stderr, "warning: range {} is stated at {:g} r/min, the measured speed in its window is {:.0f}\n",
                     range.name, range.crank_rpm, window.crank_rpm);
}

double seconds_of(const std::vector<RunPlan>& plans) {
  return std::accumulate(plans.begin(), plans.end(), 0.0, [](double sum, const RunPlan& p) { return sum + p.end_s; });
}

// Runs all plans; `wall_s` gets the time that it took, on however many threads.
std::vector<RunOutcome> run_all(const Loaded& l, const std::vector<RunPlan>& plans, const CommandOptions& o,
                                double& wall_s) {
  if (l.measured) warn_of_speed(plans, l.file.scene);
  Progress progress(l.file.path.stem().string(), seconds_of(plans), "s simulated", o.quiet);
  const auto start = std::chrono::steady_clock::now();
  auto outcomes = run_plans(
      l.model, plans, o.threads, [&](double done) { progress(done); }, o.profile);
  wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcomes;
}

std::vector<RangeLoad> loads_of(const Loaded& l, const std::vector<RunRecord>& records) {
  std::vector<RangeLoad> loads;
  if (l.file.scene.range.empty()) return loads;
  for (const RunRecord& run : records)
    for (const WindowRecord& window : run.windows)
      if (window.complete) loads.push_back(range_load(l.file.scene, l.model.statics.unstretched_length, run, window));
  return loads;
}

// A duty cycle of which a range failed has no life: that of the rest would look like an answer.
Life life_of(const Loaded& l, const std::vector<RangeLoad>& loads, const std::vector<RunRecord>& records) {
  Life life = duty_cycle_life(loads, l.file.scene.fatigue);
  std::string failed;
  for (const RunRecord& run : records)
    for (const WindowRecord& window : run.windows)
      if (!window.complete) failed += (failed.empty() ? "" : ", ") + window.range;
  if (!failed.empty()) {
    life.error = "no life over the duty cycle without its range(s) " + failed;
    life.life_h = life.log10_life_h = std::nan("");
  }
  return life;
}

void write_file(const Loaded& l, const std::vector<RunRecord>& records, const Life* life, const CommandOptions& o) {
  if (l.out.empty()) return;
  const Provenance from{o.version,
                        o.command_line,
                        l.file.path.string(),
                        write_scene(l.file.scene),
                        o.compiler,
                        o.revision,
                        std::string(enum_name(l.file.scene.solver.scheme)),
                        l.model.belt.nodes};
  write_results(l.out, from, records, life);
  if (!o.quiet) fmt::print(stderr, "wrote {}\n", l.out);
}

std::vector<RunRecord> records_of(std::vector<RunOutcome>&& outcomes) {
  std::vector<RunRecord> records;
  for (RunOutcome& outcome : outcomes) records.push_back(std::move(outcome.record));
  return records;
}

// Failures on standard error; whether there were any.
bool report_failures(const std::vector<RunRecord>& records, const std::vector<RunPlan>& plans) {
  bool failed = false;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!records[i].status.ok()) {
      failed = true;
      fmt::print(stderr, "{}: {}\n", plans[i].name, text_of(records[i].status));
    }
    if (records[i].friction_overdamped_s > 0)
      fmt::print(stderr,
                 "{}: during {:.3g} s of the windows the step was too long for the friction slope, which then "
                 "dissipates too much; "
                 "set a shorter solver.step_s\n",
                 plans[i].name, records[i].friction_overdamped_s);
  }
  return failed;
}

nlohmann::json json_of_runs(const std::vector<RunRecord>& records, const std::vector<RunPlan>& plans) {
  nlohmann::json runs = nlohmann::json::array();
  for (std::size_t i = 0; i < records.size(); ++i) {
    runs.push_back(json_of(records[i].status));
    runs.back()["run"] = plans[i].name;
  }
  return runs;
}

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

std::vector<RangeSummary> summaries_of(const Loaded& l, const std::vector<RunRecord>& records) {
  std::vector<RangeSummary> summaries;
  for (const RunRecord& run : records)
    for (const WindowRecord& window : run.windows) {
      if (window.last_sample <= window.first_sample) continue;
      summaries.push_back(summarise(l.model, run, window));
      if (summaries.back().drift > 0.03)
        fmt::print(stderr,
                   "{}: not settled: a span's mean tension changes by {:.0f} % within the window; try a longer "
                   "profile.hold_s\n",
                   window.range, 100 * summaries.back().drift);
    }
  return summaries;
}

// Of what a life is: of the whole duty cycle only if all its ranges were run.
std::string life_over(const std::vector<std::string>& ranges) {
  if (ranges.empty()) return "the duty cycle";
  std::string names;
  for (const auto& name : ranges) names += (names.empty() ? "" : ", ") + name;
  return (ranges.size() == 1 ? "range " : "ranges ") + names + " alone";
}

std::string heading(const Loaded& l) {
  return l.file.path.stem().string() + (l.file.scene.title.empty() ? "" : ": " + l.file.scene.title) + "\n";
}

// One line of the comparison: the lives in the ranges of the first scene, then over the duty cycle.
std::vector<std::string> comparison_row(const Loaded& l, const Life& life, const std::vector<RangeSpec>& ranges) {
  std::vector<std::string> row{l.file.path.stem().string()};
  for (const RangeSpec& range : ranges) {
    const auto found =
        std::find_if(life.ranges.begin(), life.ranges.end(), [&](const RangeLife& r) { return r.name == range.name; });
    row.push_back(found == life.ranges.end() ? "-" : number_text(found->life_h, "{:.4g}"));
  }
  row.push_back(number_text(life.life_h, "{:.4g}"));
  row.push_back(number_text(life.log10_life_h, "{:.2f}"));
  return row;
}

}  // namespace

int run_check(const CommandOptions& o) {
  const Loaded l = load(o.scenes.at(0), o);
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
    fmt::print("{}\n", text_of(j));
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

int run_simulate(const CommandOptions& o) {
  const Loaded l = load(o.scenes.at(0), o);
  const bool whole = !o.each_range && o.ranges.empty() && !l.file.scene.range.empty();
  const auto plans =
      whole ? std::vector<RunPlan>{plan_profile(l.file.scene, l.speed())} : plans_of(l.file.scene, o.ranges, l.speed());
  if (whole && l.measured && l.measured->speed_rpm.front() > 1)
    throw BadInput({Problem{
        *l.file.scene.driver->speed_csv, 0, "driver.speed_csv",
        fmt::format("starts at {:g} r/min, but the drive starts from rest", l.measured->speed_rpm.front()),
        "a measurement that starts from rest, or single ranges (--range, --each-range), which ramp up to it"}});
  double wall = 0;
  auto outcomes = run_all(l, plans, o, wall);
  std::vector<KernelTime> times;
  for (const RunOutcome& outcome : outcomes) {
    if (times.empty()) times.resize(outcome.kernel_times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i].name = outcome.kernel_times[i].name;
      times[i].seconds += outcome.kernel_times[i].seconds;
      times[i].calls += outcome.kernel_times[i].calls;
    }
  }
  const auto records = records_of(std::move(outcomes));
  const auto loads = loads_of(l, records);
  const Life life = loads.empty() ? Life{} : life_of(l, loads, records);
  write_file(l, records, loads.empty() ? nullptr : &life, o);
  const bool failed = report_failures(records, plans);

  double simulated = 0, residual = 0;
  std::int64_t steps = 0;
  nlohmann::json ranges = nlohmann::json::object();
  std::string text;
  for (const RunRecord& run : records) {
    simulated += run.simulated_s;
    steps += run.steps;
  }
  for (const RangeSummary& summary : summaries_of(l, records)) {
    if (std::abs(summary.energy_residual) > std::abs(residual)) residual = summary.energy_residual;
    ranges[summary.name] = json_of(summary);
    text += text_of(summary) + "\n";
  }
  if (o.json) {
    nlohmann::json j{{"status", failed ? "failed" : "ok"},
                     {"runs", json_of_runs(records, plans)},
                     {"wall_s", wall},
                     {"simulated_s", simulated},
                     {"steps", steps},
                     {"step_s", records.front().step_s},
                     {"energy_residual", finite(residual)},
                     {"ranges", ranges}};
    for (const KernelTime& t : times)
      j["kernel_times"].push_back({{"name", t.name}, {"seconds", t.seconds}, {"calls", t.calls}});
    fmt::print("{}\n", text_of(j));
  } else {
    fmt::print("{}{:.3g} s simulated in {:.3g} s, {} steps of {:.4g} s, {} with {} elements\n", text, simulated, wall,
               steps, records.front().step_s, enum_name(l.file.scene.solver.scheme), l.model.belt.nodes);
    if (o.profile) fmt::print("\n{}", text_of(times, l.model.belt.nodes));
  }
  return failed ? 3 : 0;
}

int run_life(const CommandOptions& o) {
  if (!o.details.empty()) check_writable(o.details);
  std::string details;
  std::vector<Loaded> drives;  // all inputs are checked before the first is run
  std::vector<std::vector<RunPlan>> plans_of_drive;
  for (const auto& path : o.scenes) {
    drives.push_back(load(path, o));
    if (drives.back().file.scene.range.empty())
      throw BadInput(
          {Problem{path, 0, "range", "the scene has no operating range, so no life", "at least one [[range]]"}});
    for (std::size_t i = 0; i + 1 < drives.size(); ++i)
      if (!drives[i].out.empty() && drives[i].out == drives.back().out)
        throw BadInput({Problem{path, 0, "--out", "its results would overwrite those of " + o.scenes[i],
                                "scenes with different file names"}});
    plans_of_drive.push_back(plans_of(drives.back().file.scene, o.ranges, drives.back().speed()));
  }
  bool failed = false;
  nlohmann::json all = nlohmann::json::array();
  std::vector<std::string> header{"life h"};
  for (const RangeSpec& range : drives.front().file.scene.range) header.push_back(range.name);
  const std::string over = life_over(o.ranges);
  header.push_back(o.ranges.empty() ? "duty cycle" : "these ranges");
  header.push_back("log10");
  Table comparison(header);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const Loaded& l = drives[i];
    const auto& plans = plans_of_drive[i];
    double wall = 0;
    const auto records = records_of(run_all(l, plans, o, wall));
    const auto loads = loads_of(l, records);
    const Life life = life_of(l, loads, records);
    write_file(l, records, loads.empty() ? nullptr : &life, o);
    const bool bad = report_failures(records, plans) || life.error;
    failed = failed || bad;
    nlohmann::json j = json_of(life);
    j["runs"] = json_of_runs(records, plans);
    for (const RangeLoad& load : loads) j["ranges"][load.name]["loads"] = json_of(load);
    j["scene"] = l.file.path.string();
    j["status"] = bad ? "failed" : "ok";
    j["partial"] = !o.ranges.empty();
    comparison.row(comparison_row(l, life, drives.front().file.scene.range));
    const auto summaries = summaries_of(l, records);
    details += heading(l) + "\n";
    for (const RangeSummary& summary : summaries) {
      details += text_of(summary) + "\n";
      if (summary.complete) j["ranges"][summary.name]["power_w"] = json_of(summary)["power_w"];
    }
    if (!o.json) fmt::print("{}\n{}\n{}\n", heading(l), loss_table(summaries), text_of(life, over));
    if (o.flank_for_life_h > 0) {
      const auto height = flank_height_for_life(loads, l.file.scene.fatigue, o.flank_for_life_h);
      if (height) j["flank_height_mm_for_life"] = *height;
      if (!o.json)
        fmt::print("{}\n\n",
                   height ? fmt::format("fatigue.flank_height_mm = {:.4f} gives {:g} h", *height, o.flank_for_life_h)
                          : fmt::format("no flank height between 0.05 and 10 mm gives {:g} h", o.flank_for_life_h));
    }
    all.push_back(std::move(j));
  }
  if (!o.details.empty() && !(std::ofstream(o.details) << details << std::flush))
    throw BadInput({Problem{o.details, 0, "", "cannot be written", "free space on the disk, or a path elsewhere"}});
  if (o.json)
    fmt::print("{}\n", text_of(all.size() == 1 ? all[0] : nlohmann::json{{"scenes", all}}));
  else if (drives.size() > 1)
    fmt::print("{}", comparison.text(0));
  return failed ? 3 : 0;
}

}  // namespace beltlife
