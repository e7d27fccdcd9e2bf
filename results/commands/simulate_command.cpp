// Owns the command simulate: the whole profile or single ranges, and what was recorded of them.
#include <fmt/format.h>

#include <cmath>

#include "results/commands/commands.h"
#include "results/commands/simulate_options.h"
#include "results/course/scene_runs.h"
#include "results/course/shared_options.h"
#include "results/text/print.h"

namespace beltlife {
namespace {

std::vector<RunPlan> plans_for(const LoadedScene& l, const SimulateOptions& o) {
  const bool whole = !o.each_range && o.ranges.empty() && !l.file.scene.range.empty();
  if (!whole) return plans_of(l.file.scene, o.ranges, l.speed());
  if (l.measured && l.measured->speed_rpm.front() > 1)
    throw BadInput({Problem{
        *l.file.scene.driver->speed_csv, 0, "driver.speed_csv",
        fmt::format("starts at {:g} r/min, but the drive starts from rest", l.measured->speed_rpm.front()),
        "a measurement that starts from rest, or single ranges (--range, --each-range), which ramp up to it"}});
  return {plan_profile(l.file.scene, l.speed())};
}

std::vector<KernelTime> summed_times(const std::vector<RunOutcome>& outcomes) {
  std::vector<KernelTime> times;
  for (const RunOutcome& outcome : outcomes) {
    if (times.empty()) times.resize(outcome.kernel_times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i].name = outcome.kernel_times[i].name;
      times[i].seconds += outcome.kernel_times[i].seconds;
      times[i].calls += outcome.kernel_times[i].calls;
    }
  }
  return times;
}

int run_simulate(const SimulateOptions& o) {
  if (!o.sweep.empty()) return run_sweep(o);
  const LoadedScene l = load_scene(o.scene, o.settings, o.out);
  if (l.file.scene.event && !o.each_range && o.ranges.empty()) return run_event(l, o);
  const auto plans = plans_for(l, o);
  double wall = 0;
  auto outcomes = run_all(l, plans, o, wall);
  const std::vector<KernelTime> times = summed_times(outcomes);
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
    fmt::print("{}\n", json_text(j));
  } else {
    fmt::print("{}{}{:.3g} s simulated in {:.3g} s, {} steps of {:.4g} s, {} with {} elements\n", text,
               settling_lines(l, records), simulated, wall, steps, records.front().step_s,
               enum_name(l.file.scene.solver.scheme), l.model.belt.nodes);
    if (o.profile) fmt::print("\n{}", text_of(times, l.model.belt.nodes));
  }
  return failed ? 3 : 0;
}

}  // namespace

void add_simulate_command(CommandLine& line) {
  auto o = std::make_shared<SimulateOptions>();
  Command command = line.command(
      "simulate",
      "run the profile, single ranges, a run-up or an event; print tensions, slip, hub loads, spectra and energy");
  range_flags(command, *o);
  command.input("scene", o->scene, "scene file (TOML)")
      .flag("--each-range", o->each_range, "every range alone, in parallel, instead of the profile")
      .flag("--profile", o->profile, "print the time spent in each kernel")
      .text("--sweep", o->sweep, "FROM:TO:SECONDS",
            "run through crank speeds, e.g. 600:2200:60 (r/min, r/min, s), and print the output's orders over them")
      .excludes("--sweep", "--range")
      .excludes("--sweep", "--each-range")
      .footer(
          "Examples:\n"
          "  beltlife simulate sim/scenes/baseline.toml --range B100 --set profile.hold_s=1.5\n"
          "  beltlife simulate sim/scenes/accessory_drive.toml --each-range --json > accessory.json\n"
          "  beltlife simulate sim/scenes/baseline.toml --sweep 600:2200:60 --out sweep.h5\n"
          "  beltlife simulate sim/scenes/sudden_stop.toml")
      .runs(o, run_simulate);
}

}  // namespace beltlife
