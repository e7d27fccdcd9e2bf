// A run from rest to the end of its plan: see run.h.
#include "sim/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "sim/divergence.h"
#include "sim/lanes/run_pack.h"
#include "sim/observe/recorder.h"

namespace beltlife {
namespace {

constexpr double observation_s = 5e-6;  // entry peaks last 1e-4 s and more
constexpr double check_s = 1e-4;        // divergence is seen within this

}  // namespace

double run_step(const Model& model) {
  const SolverSpec& solver = model.scene.solver;
  const double wanted = solver.step_s.value_or(stable_step(model, solver.scheme));
  return 1 / (solver.sample_rate_hz * std::ceil(1 / (solver.sample_rate_hz * wanted) - 1e-9));
}

std::vector<std::string> kernel_names(const Model& model) {
  if (model.scene.solver.scheme == Scheme::linearly_implicit) return LaneSimulator::kernel_names(model);
  std::vector<std::string> names;
  for (const Kernel& k : force_program(model)) names.push_back(k.name);
  return names;
}

RunOutcome run(const Model& model, const RunPlan& plan, const RunOptions& options) {
  if (model.scene.solver.scheme == Scheme::linearly_implicit)
    return std::move(run_pack({{&model, &plan}}, LaneUse::arcs, options).front());
  require_condition(model, plan.condition);
  RunOutcome out;
  RunRecord& record = out.record;
  const double h = run_step(model);
  Simulator s(model, plan.profile, model.scene.solver.scheme, h);
  s.profile_kernels(options.profile_kernels);
  Recorder recorder(model, plan, record, options.frames);
  record.step_s = h;

  const auto steps_of = [&](double seconds) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(seconds / h));
  };
  const auto per_sample = static_cast<std::int64_t>(std::llround(1 / (model.scene.solver.sample_rate_hz * h)));
  const auto per_observation = std::min(per_sample, steps_of(observation_s)), per_check = steps_of(check_s);
  const auto last = static_cast<std::int64_t>(std::llround(plan.end_s / h));
  std::int64_t next_sample = per_sample, next_observation = per_observation, next_check = per_check, refresh = -1;
  const auto start = std::chrono::steady_clock::now();

  std::optional<RunStatus> failed;
  while (s.state().step < last && !failed) {
    const std::int64_t until = std::min({last, next_sample, next_observation, next_check});
    while (s.state().step < until) {
      s.advance();
      if (s.state().refresh_step != refresh) {
        refresh = s.state().refresh_step;
        recorder.searched(s.view());
      }
    }
    const std::int64_t now = s.state().step;
    const bool sample = now >= next_sample || now == last;
    if (now >= next_check) {
      failed = failure(s.view());
      next_check += per_check;
    }
    if (recorder.open()) recorder.observe(s.view(), sample);
    if (now >= next_observation) next_observation = now + per_observation;
    if (sample) {
      if (!failed && (!options.windows_only || recorder.open())) recorder.sample(s.view());
      if (recorder.turn(s.view()) && options.enough && options.enough(record)) break;
      next_sample += per_sample;
      next_observation = now + per_observation;
      if (options.progress) options.progress(s.time());
    }
  }
  if (failed) {
    record.status = *failed;
    recorder.close(s.view(), false);
  }
  record.simulated_s = s.time();
  record.steps = s.state().step;
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.kernel_times = s.kernel_times();
  return out;
}

}  // namespace beltlife
