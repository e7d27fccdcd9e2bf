// Running a scene and what follows from it: see scene_runs.h.
#include "results/course/scene_runs.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "results/text/print.h"
#include "results/text/progress.h"
#include "sim/range_models.h"

namespace beltlife {
namespace {

// A measured speed is what counts, not the speed that a range is named after.
void warn_of_speed(const std::vector<RunPlan>& plans, const SceneSpec& scene) {
  for (const RunPlan& plan : plans)
    for (const Window& window : plan.windows) {
      if (plan.settled_within && &window != &plan.windows.back()) continue;  // stretches of one hold
      for (const RangeSpec& range : scene.range)
        if (range.name == window.range && std::abs(window.crank_rpm - range.crank_rpm) > 0.05 * range.crank_rpm)
          fmt::print(stderr, "warning: range {} is stated at {:g} r/min, the measured speed in its window is {:.0f}\n",
                     range.name, range.crank_rpm, window.crank_rpm);
    }
}

double seconds_of(const std::vector<RunPlan>& plans) {
  return std::accumulate(plans.begin(), plans.end(), 0.0, [](double sum, const RunPlan& p) { return sum + p.end_s; });
}

void refuse_long_step(const LoadedScene& l, const Model& m) {
  const StepLimit limit = step_limits(m, l.file.scene.solver.scheme).front();
  const double step = run_step(m);
  if (step <= limit.limit_s * (1 + 1e-9)) return;
  throw located(
      l.file,
      BadInput({Problem{l.file.path.string(), 0, "solver.step_s",
                        fmt::format("{:.3g} s is longer than the limit of {} ({:.3g} s) with the scheme {}", step,
                                    limit.name, limit.limit_s, enum_name(l.file.scene.solver.scheme)),
                        fmt::format("at most {:.3g}, none for the predicted step, or --force", limit.limit_s)}}));
}

}  // namespace

std::vector<RunOutcome> run_all(const LoadedScene& l, const std::vector<RunPlan>& plans, const RangeOptions& o,
                                double& wall_s) {
  if (!o.force) {
    const RangeModels models(l.model);
    for (const RunPlan& plan : plans) refuse_long_step(l, models.of(plan.condition));
  }
  if (l.measured) warn_of_speed(plans, l.file.scene);
  Progress progress(l.file.path.stem().string(), seconds_of(plans), "s simulated", o.quiet);
  const auto start = std::chrono::steady_clock::now();
  auto outcomes = run_plans(
      l.model, plans, o.threads, [&](double done) { progress(done); }, o.profile, l.out.empty() ? 0 : o.frames);
  wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcomes;
}

std::vector<RangeLoad> loads_of(const LoadedScene& l, const std::vector<RunRecord>& records) {
  std::vector<RangeLoad> loads;
  if (l.file.scene.range.empty()) return loads;
  for (const RunRecord& run : records)
    for (const WindowRecord& window : run.windows)
      if (window.complete) loads.push_back(range_load(l.file.scene, l.model.statics.unstretched_length, run, window));
  return loads;
}

Life life_of(const LoadedScene& l, const std::vector<RangeLoad>& loads, const std::vector<RunRecord>& records) {
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

void write_file(const LoadedScene& l, const std::vector<RunRecord>& records, const Life* life, const CommonOptions& o,
                const RunExtras& extras) {
  if (l.out.empty()) return;
  const Provenance from{o.program.version,
                        o.program.command_line,
                        l.file.path.string(),
                        write_scene(l.file.scene),
                        o.program.compiler,
                        o.program.revision,
                        std::string(enum_name(l.file.scene.solver.scheme)),
                        l.model.belt.nodes};
  write_results(l.out, from, records, life, l.solved ? &*l.solved : nullptr, extras);
  if (!o.quiet) fmt::print(stderr, "wrote {}\n", l.out);
}

std::vector<RunRecord> records_of(std::vector<RunOutcome>&& outcomes) {
  std::vector<RunRecord> records;
  for (RunOutcome& outcome : outcomes) records.push_back(std::move(outcome.record));
  return records;
}

std::string settling_lines(const LoadedScene& l, const std::vector<RunRecord>& records) {
  std::string lines;
  for (const RunRecord& run : records)
    if (const std::string words = settling_text(run, l.file.scene.profile); !words.empty())
      lines += run.windows.front().range + ": " + words + "\n";
  return lines.empty() ? "" : lines + "\n";
}

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
    runs.back()["simulated_s"] = records[i].simulated_s;
    if (!plans[i].settled_within) continue;
    runs.back()["planned_s"] = plans[i].end_s;
    runs.back()["settling_change"] = finite(records[i].settling_change.value_or(std::nan("")));
  }
  return runs;
}

std::vector<RangeSummary> summaries_of(const LoadedScene& l, const std::vector<RunRecord>& records) {
  std::vector<RangeSummary> summaries;
  for (const RunRecord& run : records)
    for (const WindowRecord& window : run.windows) {
      if (window.last_sample <= window.first_sample) continue;
      summaries.push_back(summarise(l.model, run, window));
      if (std::abs(summaries.back().energy_residual) > 0.02)
        fmt::print(stderr,
                   "{}: {:.1f} % of the energy that went through is not accounted for: the step is too long for this "
                   "drive; set a shorter solver.step_s\n",
                   window.range, 100 * std::abs(summaries.back().energy_residual));
      if (summaries.back().drift > 0.03)
        fmt::print(stderr,
                   "{}: not settled: a span's mean tension changes by {:.0f} % within the window; try a longer "
                   "profile.hold_s\n",
                   window.range, 100 * summaries.back().drift);
    }
  return summaries;
}

}  // namespace beltlife
