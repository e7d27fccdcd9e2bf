// Owns the command simulate: the whole profile or single ranges, and what was recorded of them.
#include <fmt/format.h>

#include <cmath>

#include "results/commands/scene_runs.h"
#include "results/commands/stretch_run.h"
#include "results/text/print.h"

namespace beltlife {

int run_simulate(const CommandOptions& o) {
  if (!o.sweep.empty()) return run_sweep(o);
  const LoadedScene l = load_scene(o.scenes.at(0), o);
  if (l.file.scene.event && !o.each_range && o.ranges.empty()) return run_event(l, o);
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
    fmt::print("{}\n", json_text(j));
  } else {
    fmt::print("{}{}{:.3g} s simulated in {:.3g} s, {} steps of {:.4g} s, {} with {} elements\n", text,
               settling_lines(l, records), simulated, wall, steps, records.front().step_s,
               enum_name(l.file.scene.solver.scheme), l.model.belt.nodes);
    if (o.profile) fmt::print("\n{}", text_of(times, l.model.belt.nodes));
  }
  return failed ? 3 : 0;
}

}  // namespace beltlife
