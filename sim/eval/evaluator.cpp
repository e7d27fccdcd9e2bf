// Batches of points in packs: see evaluator.h.
#include "sim/eval/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <map>
#include <mutex>

#include "sim/eval/parallel_for.h"
#include "sim/eval/point.h"
#include "sim/eval/run_ranges.h"
#include "sim/eval/settling.h"
#include "sim/lanes/run_pack.h"
#include "sim/life/loads.h"
#include "sim/range_models.h"
#include "sim/scene/spec_writer.h"

namespace beltlife {
namespace {

/// A drive in the conditions of its ranges, at an address that lasts.
struct Drive {
  explicit Drive(const SceneSpec& scene) : built(compile(scene)), models(built) {}
  Drive(const Drive&) = delete;
  Model built;
  RangeModels models;
};

/// One range of one drive that is not in the memo.
struct Task {
  std::string key;
  std::shared_ptr<const Model> model;  ///< in the range's condition
  RunPlan plan;
  std::shared_ptr<RangeResult> result;
  std::vector<std::size_t> points;  ///< that wait for it
};

/// What lanes have in common: whoever differs here cannot run in lockstep.
std::string pack_key(const Task& t) {
  const Model& m = *t.model;
  std::string key =
      fmt::format("{} {} {:a} {:a} {:a} {} {} {} {}", enum_name(m.scene.solver.scheme), m.belt.nodes, run_step(m),
                  m.scene.solver.sample_rate_hz, t.plan.end_s, m.pulleys, m.bodies, m.tensioner.pulley, m.driver.body);
  if (t.plan.settled_within) key += fmt::format(" {:a}", *t.plan.settled_within);
  for (const Kernel& k : force_program(m)) key += fmt::format(" {}", k.name);
  // Early end reads all records of a pack by the names of its first drive.
  for (const std::string& name : m.body_name) key += " " + name;
  if (m.scene.output) key += " " + m.scene.output->body;
  return key;
}

RangeResult result_of(const Model& model, const RunPlan& plan, RunRecord&& record) {
  RangeResult r;
  r.name = plan.name;
  r.status = record.status;
  r.step_s = record.step_s;
  r.simulated_s = record.simulated_s;
  if (plan.settled_within) keep_last_window(model, record);
  r.settling_change = record.settling_change;
  const WindowRecord& window = record.windows.back();
  if (window.last_sample <= window.first_sample) return r;
  r.summary = summarise(model, record, window);
  r.load = range_load(model.scene, model.statics.unstretched_length, record, window);
  return r;
}

std::vector<RunOutcome> run_tasks(const std::vector<Task*>& tasks, const EvaluatorOptions& o) {
  RunOptions options;
  options.windows_only = true;
  const Model& first = *tasks.front()->model;
  if (const auto tolerance = tasks.front()->plan.settled_within)
    options.enough = [&first, tolerance](const RunRecord& record) { return settled(first, record, *tolerance); };
  if (first.scene.solver.scheme != Scheme::linearly_implicit) {
    std::vector<RunOutcome> out;
    for (const Task* t : tasks) out.push_back(run(*t->model, t->plan, options));
    return out;
  }
  std::vector<PackMember> members;
  for (const Task* t : tasks) members.push_back({t->model.get(), &t->plan});
  return run_pack(members, o.use, options);
}

// Of this thread, so that what others run beside it does not count.
double processor_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string over_budget(const RangeModels& models, const std::vector<RunPlan>& plans, std::optional<double> budget) {
  if (!budget) return "";
  for (const RunPlan& plan : plans) {
    const Model& model = models.of(plan.condition);
    if (const double steps = plan.end_s / run_step(model) * (model.scene.solver.scheme == Scheme::thesis ? 2 : 1);
        steps > *budget)
      return fmt::format(
          "range {} needs {:.3g} force evaluations at its step of {:.3g} s, more than the budget of {:.3g}", plan.name,
          steps, run_step(model), *budget);
  }
  return "";
}

// Once more at half the step, which a failure of the step itself survives.
RangeResult retry(const Task& t, const EvaluatorOptions& o) {
  SceneSpec scene = t.model->scene;
  scene.solver.step_s = 0.5 * run_step(*t.model);
  Task again{t.key, std::make_shared<const Model>(compile(scene, t.model->condition)), t.plan, nullptr, {}};
  auto outcomes = run_tasks({&again}, o);
  RangeResult r = result_of(*again.model, again.plan, std::move(outcomes.front().record));
  r.retried = true;
  return r;
}

std::vector<std::vector<Task*>> packs_of(std::vector<Task>& tasks, const EvaluatorOptions& o) {
  std::map<std::string, std::vector<Task*>> alike;
  for (Task& t : tasks) alike[pack_key(t)].push_back(&t);
  const bool shared = o.use == LaneUse::drives;
  std::vector<std::vector<Task*>> packs;
  for (auto& [key, group] : alike) {
    const bool lanes_at_work = shared && group.front()->model->scene.solver.scheme == Scheme::linearly_implicit;
    const std::size_t size = lanes_at_work ? lanes : 1;
    for (std::size_t i = 0; i < group.size(); i += size)
      packs.emplace_back(group.begin() + static_cast<std::ptrdiff_t>(i),
                         group.begin() + static_cast<std::ptrdiff_t>(std::min(i + size, group.size())));
  }
  const auto cost = [](const std::vector<Task*>& pack) {
    const Model& m = *pack.front()->model;
    return pack.front()->plan.end_s / run_step(m) * static_cast<double>(m.belt.nodes);
  };
  std::stable_sort(packs.begin(), packs.end(), [&](const auto& a, const auto& b) { return cost(a) > cost(b); });
  return packs;
}

// A run may be another range's of the same speed and condition; what it cost is counted once.
std::shared_ptr<const RangeResult> named(const std::shared_ptr<const RangeResult>& result, const std::string& name,
                                         bool pays) {
  if (result->name == name && pays) return result;
  auto copy = std::make_shared<RangeResult>(*result);
  copy->name = copy->load.name = name;
  if (!copy->summary.name.empty()) copy->summary.name = name;
  if (!pays) copy->processor_s = 0;
  return copy;
}

void finish(const SceneSpec& scene, const std::vector<std::string>& names, PointResult& point) {
  std::vector<RangeLoad> loads;
  std::vector<RangeSummary> summaries;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const RangeResult& r = *point.ranges[i];
    if (!r.summary.name.empty())  // else it failed before its window
      for (Quantity& q : quantities_of(r.summary)) point.quantities.push_back(std::move(q));
    RangeLoad load = r.load;
    load.name = names[i];
    for (const RangeSpec& range : scene.range)
      if (range.name == names[i]) load.duty_share = range.duty_share;
    if (r.ok()) {
      for (Quantity& q : quantities_of(load, range_life(load, scene.fatigue))) point.quantities.push_back(std::move(q));
      summaries.push_back(r.summary);
    }
    loads.push_back(std::move(load));
  }
  if (!point.ok()) {
    point.life.error = "no life: not every range ran to its end";
    point.life.life_h = point.life.log10_life_h = std::nan("");
    return;
  }
  point.life = duty_cycle_life(loads, scene.fatigue);
  for (Quantity& q : duty_quantities(summaries, point.life)) point.quantities.push_back(std::move(q));
}

}  // namespace

bool PointResult::ok() const {
  return problems.empty() && !ranges.empty() &&
         std::all_of(ranges.begin(), ranges.end(), [](const auto& r) { return r && r->ok(); });
}

std::string simulation_key(const SceneSpec& scene, const std::string& range) {
  SceneSpec seen = scene;
  seen.title.clear();
  seen.fatigue = {};
  // The predicted step of the explicit schemes looks at the fastest range.
  if (scene.solver.step_s || scene.solver.scheme == Scheme::linearly_implicit)
    std::erase_if(seen.range, [&](const RangeSpec& r) { return r.name != range; });
  for (RangeSpec& r : seen.range) {
    r.duty_share = 0;
    if (seen.range.size() == 1) r.name = "any";  // two ranges of one speed and condition are one run
  }
  std::string key = (seen.range.size() == 1 ? "" : range + "\n") + write_scene(seen);
  for (const RangeSpec& r : scene.range)  // which no scene as text holds
    if (r.name == range) key += write_spec(r.condition);
  return key;
}

/// What a batch asks for and has so far, by point.
struct Evaluator::Batch {
  explicit Batch(const std::vector<SceneSpec>& scenes)
      : points(scenes), results(scenes.size()), names(scenes.size()), keys(scenes.size()), missing(scenes.size(), 0) {}
  const std::vector<SceneSpec>& points;
  std::vector<PointResult> results;
  std::vector<std::vector<std::string>> names, keys;  ///< of its ranges
  std::vector<std::size_t> missing;                   ///< ranges that are to be run
  std::vector<Task> tasks;
  std::unordered_map<std::string, std::size_t> pending;  ///< key -> task
};

void Evaluator::ask_for(std::size_t i, Batch& batch) {
  const SceneSpec& point = batch.points[i];
  std::shared_ptr<const Drive> drive;
  std::vector<RunPlan> plans;
  try {
    drive = std::make_shared<const Drive>(point);
    plans = plans_of(point, options_.ranges, options_.measured);
  } catch (const BadInput& bad) {
    batch.results[i].problems = bad.problems();
    return;
  }
  batch.results[i].over_budget = over_budget(drive->models, plans, options_.step_budget);
  if (!batch.results[i].over_budget.empty()) return;
  for (const RunPlan& plan : plans) {
    batch.names[i].push_back(plan.name);
    batch.keys[i].push_back(simulation_key(point, plan.name));
    if (options_.measured)  // which stretch of it is played
      for (std::size_t r = 0; r < point.range.size() && point.range[r].name != plan.name; ++r)
        batch.keys[i].back() += "# behind another range\n";
    const std::string& key = batch.keys[i].back();
    if (memo_.contains(key)) {
      ++reused_;
      continue;
    }
    const auto [at, fresh] = batch.pending.emplace(key, batch.tasks.size());
    if (fresh) {
      ++simulations_;
      batch.tasks.push_back({key, {drive, &drive->models.of(plan.condition)}, plan, nullptr, {}});
    } else {
      ++reused_;
    }
    batch.tasks[at->second].points.push_back(i);
    ++batch.missing[i];
  }
}

std::vector<PointResult> Evaluator::evaluate(const std::vector<SceneSpec>& points,
                                             const std::function<void(std::size_t, const PointResult&)>& on_finished) {
  Batch batch(points);
  for (std::size_t i = 0; i < points.size(); ++i) ask_for(i, batch);

  std::mutex mutex;
  std::atomic<bool> lost = false;
  const auto complete = [&](std::size_t i) {
    const auto &keys = batch.keys[i], &names = batch.names[i];
    for (std::size_t r = 0; r < keys.size(); ++r)
      batch.results[i].ranges.push_back(named(memo_.at(keys[r]), names[r], paid_.insert(keys[r]).second));
    finish(points[i], names, batch.results[i]);
    if (on_finished) on_finished(i, batch.results[i]);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (batch.names[i].empty()) {  // refused
      if (on_finished) on_finished(i, batch.results[i]);
    } else if (batch.missing[i] == 0) {
      complete(i);
    }
  }
  auto packs = packs_of(batch.tasks, options_);
  parallel_for(static_cast<int>(packs.size()), options_.threads, [&](int p) {
    if (stop_requested() || lost) return;
    const auto& pack = packs[static_cast<std::size_t>(p)];
    const double begun = processor_s();
    auto outcomes = run_tasks(pack, options_);
    const double share = (processor_s() - begun) / static_cast<double>(pack.size());
    for (std::size_t k = 0; k < pack.size(); ++k) {
      Task& t = *pack[k];
      auto result = std::make_shared<RangeResult>(result_of(*t.model, t.plan, std::move(outcomes[k].record)));
      const double before = processor_s();
      if (!result->ok() && options_.retry) *result = retry(t, options_);
      result->processor_s = share + processor_s() - before;
      t.result = std::move(result);
    }
    const std::lock_guard lock(mutex);
    try {
      for (Task* t : pack) {
        memo_[t->key] = t->result;
        for (std::size_t i : t->points)
          if (--batch.missing[i] == 0) complete(i);
      }
    } catch (...) {
      lost = true;  // nobody keeps the results: no use in making more
      throw;
    }
  });
  const auto waits = [](std::size_t missing) { return missing > 0; };
  if (std::any_of(batch.missing.begin(), batch.missing.end(), waits)) throw Interrupted();
  return std::move(batch.results);
}

}  // namespace beltlife
