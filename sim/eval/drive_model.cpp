// The belt simulator as a model: see drive_model.h.
#include "sim/eval/drive_model.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <unordered_map>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

std::string text_of(const RunStatus& status, const std::string& range) {
  std::string words = fmt::format("range {}: {} after {:.4g} s", range, to_string(status.state), status.time_s);
  if (!status.where.empty()) words += " at " + status.where;
  if (!status.cause.empty()) words += ": " + status.cause;
  return words;
}

Answer answer_of(const PointResult& result, const std::vector<std::string>& wanted) {
  Answer a;
  for (const auto& range : result.ranges) a.processor_s += range->processor_s;
  if (!result.problems.empty()) {
    const Problem& first = result.problems.front();
    a.state = PointState::infeasible;
    a.reason = (first.key.empty() ? "" : first.key + ": ") + first.what;
    return a;
  }
  if (!result.over_budget.empty()) {
    a.state = PointState::timed_out;
    a.reason = result.over_budget;
    return a;
  }
  for (const auto& range : result.ranges) {
    if (range->ok()) continue;
    a.state = PointState::diverged;
    a.reason = text_of(range->status, range->name);
    return a;
  }
  std::unordered_map<std::string_view, double> known;
  for (const Quantity& q : result.quantities) known[q.name] = q.value;
  for (const std::string& name : wanted) {
    const auto found = known.find(name);
    if (found != known.end() && std::isfinite(found->second)) {
      a.values.push_back(found->second);
      continue;
    }
    a.values.clear();
    a.reason = fmt::format("{} has no finite value{}", name, result.life.error ? ": " + *result.life.error : "");
    return a;
  }
  a.state = PointState::ok;
  return a;
}

}  // namespace

std::vector<std::string> ranges_for(const SceneSpec& scene, const std::vector<std::string>& quantities) {
  std::vector<std::string> ranges;
  std::size_t covered = 0;
  for (const RangeSpec& range : scene.range) {
    std::size_t of_range = 0;
    for (const std::string& q : quantities) of_range += q.starts_with(range.name + ".");
    if (of_range > 0) ranges.push_back(range.name);
    covered += of_range;
  }
  return covered < quantities.size() || ranges.size() == scene.range.size() ? std::vector<std::string>{} : ranges;
}

SceneSpec scene_at(const SceneSpec& base, const std::vector<std::string>& paths, const Point& point) {
  SceneSpec scene = base;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (paths[i] == settings_column) {
      std::istringstream lines(std::get<std::string>(point[i]));
      for (std::string setting; std::getline(lines, setting);) set_field(scene, setting);
    }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i] == settings_column || paths[i] == repeat_column) continue;
    if (const double* number = std::get_if<double>(&point[i]))
      set_number(scene, paths[i], *number);
    else
      set_field(scene, paths[i] + "=" + std::get<std::string>(point[i]));
  }
  validate(scene);
  return scene;
}

PointModel drive_model(SceneSpec base, std::vector<std::string> paths, std::vector<std::string> quantities,
                       DriveModelOptions o) {
  EvaluatorOptions options;
  options.threads = o.threads;
  options.use = o.use;
  options.retry = o.retry;
  options.ranges = ranges_for(base, quantities);
  options.step_budget = o.step_budget;
  options.measured = o.measured;
  auto evaluator = std::make_shared<Evaluator>(std::move(options));  // a std::function is copied, its memo is not
  return [=](const std::vector<Point>& points, const OnAnswer& on_answer) {
    std::vector<Answer> answers(points.size());
    std::vector<SceneSpec> scenes;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < points.size(); ++i) {
      try {
        scenes.push_back(scene_at(base, paths, points[i]));
        index.push_back(i);
      } catch (const BadInput& bad) {
        PointResult refused;
        refused.problems = bad.problems();
        answers[i] = answer_of(refused, quantities);
        if (on_answer) on_answer(i, answers[i]);
      }
    }
    evaluator->evaluate(scenes, [&](std::size_t k, const PointResult& result) {
      answers[index[k]] = answer_of(result, quantities);
      if (on_answer) on_answer(index[k], answers[index[k]]);
    });
    return answers;
  };
}

}  // namespace beltlife
