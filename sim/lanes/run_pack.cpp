// Runs of packs: see run_pack.h.
#include "sim/lanes/run_pack.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "sim/divergence.h"
#include "sim/observe/recorder.h"

namespace beltlife {
namespace {

constexpr double check_s = 1e-3;  // divergence is seen within this

}  // namespace

std::vector<RunOutcome> run_pack(const std::vector<PackMember>& members, LaneUse use, const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const double h = run_step(*members.front().model);
  const auto per_sample =
      static_cast<std::int64_t>(std::llround(1 / (members.front().model->scene.solver.sample_rate_hz * h)));
  std::vector<LaneDrive> drives;
  for (const PackMember& m : members) {
    require_condition(*m.model, m.plan->condition);
    drives.push_back({m.model, &m.plan->profile});
  }
  LaneSimulator s(drives, use, h);
  s.profile_kernels(options.profile_kernels);

  std::vector<RunOutcome> out(members.size());
  std::vector<std::unique_ptr<Recorder>> recorders;
  std::vector<std::int64_t> last;
  for (std::size_t i = 0; i < members.size(); ++i) {
    out[i].record.step_s = h;
    recorders.push_back(std::make_unique<Recorder>(*members[i].model, *members[i].plan, out[i].record, options.frames));
    last.push_back(std::llround(members[i].plan->end_s / h));
  }
  const std::int64_t end = *std::max_element(last.begin(), last.end());
  const auto running = [&](std::size_t i) { return out[i].record.steps == 0; };
  const auto finish = [&](std::size_t i) {
    out[i].record.simulated_s = s.time();
    out[i].record.steps = s.steps();
  };

  std::size_t left = members.size();
  // Whether a drive still is one is looked at with every sample, and at least every millisecond.
  const auto per_check = std::clamp<std::int64_t>(static_cast<std::int64_t>(check_s / h), 1, per_sample);
  std::int64_t next_sample = per_sample, next_check = per_check;
  while (left > 0 && s.steps() < end) {
    s.advance();
    const bool sample_all = s.steps() == next_sample, check_all = sample_all || s.steps() >= next_check;
    const bool ends = std::find(last.begin(), last.end(), s.steps()) != last.end();
    if (!check_all && !ends && !s.search_due()) continue;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const bool sample = sample_all || s.steps() == last[i], check = check_all || s.steps() == last[i];
      if (!running(i) || (!check && !(recorders[i]->open() && (check_all || s.search_due())))) continue;
      const DriveView view = s.observe(static_cast<int>(i));
      if (recorders[i]->open()) {
        recorders[i]->searched(view);
        recorders[i]->observe(view, sample);
      }
      if (!check) continue;
      const std::optional<RunStatus> failed = failure(view);
      bool enough = false;
      if (failed) {
        out[i].record.status = *failed;
        recorders[i]->close(view, false);
      } else if (sample) {
        if (!options.windows_only || recorders[i]->open()) recorders[i]->sample(view);
        enough = recorders[i]->turn(view) && options.enough && options.enough(out[i].record);
      }
      if (failed || enough || s.steps() >= last[i]) {
        finish(i);
        --left;
      }
    }
    if (check_all) next_check = s.steps() + per_check;
    s.keep_peaks(std::any_of(recorders.begin(), recorders.end(), [](const auto& r) { return r->open(); }));
    if (!sample_all) continue;
    next_sample += per_sample;
    if (options.progress) options.progress(s.time());
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (RunOutcome& o : out) o.record.wall_s = wall / static_cast<double>(members.size());
  out.front().kernel_times = s.kernel_times();
  return out;
}

}  // namespace beltlife
