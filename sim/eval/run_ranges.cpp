// Ranges in parallel: see run_ranges.h.
#include "sim/eval/run_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "sim/eval/parallel_for.h"
#include "sim/eval/settling.h"
#include "sim/range_models.h"
#include "sim/scene/scene_io.h"

namespace beltlife {

std::vector<RunPlan> plans_of(const SceneSpec& scene, const std::vector<std::string>& names,
                              const MeasuredSpeed* measured) {
  std::vector<Problem> problems;
  std::string known;
  for (const auto& range : scene.range) known += (known.empty() ? "" : ", ") + range.name;
  for (const auto& name : names)
    if (std::none_of(scene.range.begin(), scene.range.end(), [&](const auto& range) { return range.name == name; }))
      problems.push_back({"--range", 0, name, "the scene has no range of this name",
                          known.empty() ? "none: the scene has no ranges" : known});
  if (!problems.empty()) throw BadInput(std::move(problems));
  if (scene.range.empty()) return {plan_rest(scene)};
  std::vector<RunPlan> plans;
  for (const auto& range : scene.range)
    if (names.empty() || std::find(names.begin(), names.end(), range.name) != names.end())
      plans.push_back(scene.profile.settled_within ? plan_blocks(scene, range, measured)
                                                   : plan_range(scene, range, measured));
  return plans;
}

std::vector<RunOutcome> run_plans(const Model& drive, const std::vector<RunPlan>& plans, int threads,
                                  const std::function<void(double)>& progress, bool profile_kernels, int frames) {
  const RangeModels models(drive);
  std::vector<std::size_t> order(plans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return plans[a].end_s > plans[b].end_s; });
  std::vector<RunOutcome> outcomes(plans.size());
  std::vector<double> done(plans.size(), 0.0);
  std::mutex mutex;
  parallel_for(static_cast<int>(plans.size()), threads, [&](int k) {
    const std::size_t i = order[static_cast<std::size_t>(k)];
    const Model& model = models.of(plans[i].condition);
    RunOptions options;
    options.profile_kernels = profile_kernels;
    options.frames = frames;
    const auto tell = [&, i](double time) {
      const std::lock_guard lock(mutex);
      done[i] = time;
      progress(std::accumulate(done.begin(), done.end(), 0.0));
    };
    if (progress) options.progress = tell;
    const std::optional<double> tolerance = plans[i].settled_within;
    if (tolerance) options.enough = [&](const RunRecord& record) { return settled(model, record, *tolerance); };
    outcomes[i] = run(model, plans[i], options);
    if (!tolerance) return;
    keep_last_window(model, outcomes[i].record);
    if (progress) tell(plans[i].end_s);  // what need not be run is done
  });
  return outcomes;
}

}  // namespace beltlife
