// The run of a sweep or an event: see stretch_run.h.
#include "results/commands/stretch_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "results/course/scene_runs.h"
#include "results/text/print.h"

namespace beltlife {

StretchRun run_stretch(const LoadedScene& l, const RunPlan& plan, const SimulateOptions& o) {
  StretchRun out;
  auto outcomes = run_all(l, {plan}, o, out.wall_s);
  out.kernel_times = std::move(outcomes.front().kernel_times);
  auto records = records_of(std::move(outcomes));
  out.failed = report_failures(records, {plan});
  out.record = std::move(records.front());
  out.window = std::move(out.record.windows.front());
  out.record.windows.clear();
  const double observed = std::min(out.window.end_s, out.record.simulated_s) - out.window.begin_s;
  for (const double joule : out.window.energy.joule) out.power_w.push_back(observed > 0 ? joule / observed : 0.0);
  const double residual = std::abs(out.window.energy.relative_residual());
  if (residual > 0.02)
    fmt::print(stderr,
               "{}: {:.1f} % of the energy that went through is not accounted for: the step is too long for this "
               "drive; set a shorter solver.step_s\n",
               plan.name, 100 * residual);
  return out;
}

nlohmann::json json_of(const StretchRun& run, const RunPlan& plan) {
  nlohmann::json j{{"status", run.failed ? "failed" : "ok"},
                   {"runs", json_of_runs({run.record}, {plan})},
                   {"wall_s", run.wall_s},
                   {"simulated_s", run.record.simulated_s},
                   {"steps", run.record.steps},
                   {"step_s", run.record.step_s},
                   {"power_w", json_of_powers(run.power_w)},
                   {"energy_residual", finite(run.window.energy.relative_residual())}};
  for (const KernelTime& t : run.kernel_times)
    j["kernel_times"].push_back({{"name", t.name}, {"seconds", t.seconds}, {"calls", t.calls}});
  return j;
}

std::string closing_text(const StretchRun& run, const LoadedScene& l, const SimulateOptions& o) {
  std::string text = power_text(run.power_w, run.window.energy.relative_residual());
  text += fmt::format("\n{:.3g} s simulated in {:.3g} s, {} steps of {:.4g} s, {} with {} elements\n",
                      run.record.simulated_s, run.wall_s, run.record.steps, run.record.step_s,
                      enum_name(l.file.scene.solver.scheme), l.model.belt.nodes);
  if (o.profile) text += "\n" + text_of(run.kernel_times, l.model.belt.nodes);
  return text;
}

}  // namespace beltlife
