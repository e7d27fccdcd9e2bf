// The checks of study files: see study_input.h.
#include "sim/eval/study_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

SpecPath field(std::size_t parameter, std::string_view key) {
  return SpecPath{}.child("parameter").element(parameter).child(key);
}

void complain(ReadLog& log, const SpecPath& path, std::string what, std::string allowed = "") {
  if (!log.is_faulty(path.place)) log.add(path, log.line(path.place), std::move(what), std::move(allowed));
}

void check_distribution(const ParameterSpec& p, const SpecPath& path, ReadLog& log) {
  const DistributionSpec& d = *p.distribution;
  const std::string kind(enum_name(d.kind));
  const bool by_moments = d.kind == DistributionKind::normal || d.kind == DistributionKind::lognormal;
  if (by_moments != d.mean.has_value())
    complain(log, path.child("mean"), by_moments ? "missing: " + kind + " needs it" : kind + " has none");
  if (by_moments != d.standard_deviation.has_value())
    complain(log, path.child("standard_deviation"), by_moments ? "missing: " + kind + " needs it" : kind + " has none");
  if (d.mode && d.kind != DistributionKind::triangular) complain(log, path.child("mode"), kind + " has none");
  if (d.kind == DistributionKind::lognormal && d.mean && *d.mean <= 0)
    complain(log, path.child("mean"), fmt::format("{} is out of limits", *d.mean), "above 0");
  if (!by_moments && (!p.lower || !p.upper))
    complain(log, path.child("kind"), kind + " needs the parameter's bounds", "lower and upper");
  const std::optional<double> inside = d.mode ? d.mode : d.mean;
  if (inside && ((p.lower && *inside < *p.lower) || (p.upper && *inside > *p.upper)))
    complain(log, path.child(d.mode ? "mode" : "mean"),
             fmt::format("{} is not between the parameter's bounds", *inside));
}

void check_parameter(const ParameterSpec& p, std::size_t i, ReadLog& log) {
  if (p.lower && p.upper && *p.lower >= *p.upper)
    complain(log, field(i, "lower"), fmt::format("{} is not below upper ({})", *p.lower, *p.upper));
  if (p.start && ((p.lower && *p.start < *p.lower) || (p.upper && *p.start > *p.upper)))
    complain(log, field(i, "start"), fmt::format("{} is not between the bounds", *p.start),
             fmt::format("from {} to {}", p.lower.value_or(-INFINITY), p.upper.value_or(INFINITY)));
  if (p.log && (!p.lower || *p.lower <= 0))
    complain(log, field(i, "lower"), "log = true needs a positive lower bound", "above 0");
  if (p.distribution) check_distribution(p, field(i, "distribution"), log);
}

template <class Names>
void refuse_twice(const Names& names, const std::function<SpecPath(std::size_t)>& path, ReadLog& log) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty() && std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
                                 names.begin() + static_cast<std::ptrdiff_t>(i))
      complain(log, path(i), fmt::format("'{}' stands here twice", names[i]));
}

bool settable(SceneSpec& scene, const std::string& path, double value) {
  try {
    set_number(scene, path, value);
    return true;
  } catch (const BadInput&) {
    return false;
  }
}

}  // namespace

void check_problem(const ProblemSpec& problem, ReadLog& log) {
  const SpecPath root;
  if (problem.scene && problem.command)
    complain(log, root.child("command"), "the file gives a scene as well", "exactly one of scene, [command]");
  if (problem.scene && problem.scene->empty()) complain(log, root.child("scene"), "names no file", "a scene file");
  if (!problem.scene && !problem.command && !log.is_faulty("scene") && !log.is_faulty("command"))
    complain(log, root.child("scene"), "missing: there is nothing to evaluate", "exactly one of scene, [command]");
  if (problem.command && (problem.command->run.empty() || problem.command->run[0].empty()))
    complain(log, root.child("command").child("run"), "names no program", "[\"program\", \"argument\", ...]");
  for (std::size_t i = 0; i < problem.parameter.size(); ++i) check_parameter(problem.parameter[i], i, log);
  refuse_twice(
      problem.paths(), [](std::size_t i) { return field(i, "path"); }, log);
  refuse_twice(
      problem.quantities, [&](std::size_t) { return root.child("quantities"); }, log);
  for (const std::string& q : problem.quantities)
    if (q.empty()) complain(log, root.child("quantities"), "a quantity has no name");
}

void check_against_scene(const ProblemSpec& problem, const SceneSpec& scene, const std::vector<std::string>& quantities,
                         ReadLog& log) {
  for (std::size_t i = 0; i < problem.parameter.size(); ++i) {
    const ParameterSpec& p = problem.parameter[i];
    if (log.is_faulty(field(i, "path").place)) continue;
    SceneSpec trial = scene;
    const auto try_value = [&](std::optional<double> value, std::string_view key) {
      if (!value || log.is_faulty(field(i, key).place)) return;
      try {
        set_number(trial, p.path, *value);
      } catch (const BadInput& bad) {
        const Problem& problem = bad.problems().front();
        complain(log, field(i, key), p.path + ": " + problem.what, problem.allowed);
      }
    };
    try {
      get_number(scene, p.path);
    } catch (const BadInput& bad) {
      if (p.start && settable(trial, p.path, *p.start)) continue;  // optional, and absent in this scene
      const Problem& problem = bad.problems().front();
      complain(log, field(i, "path"), p.path + " " + problem.what, problem.allowed);
      continue;
    }
    try_value(p.lower, "lower");
    try_value(p.upper, "upper");
    try_value(p.start, "start");
  }
  for (const std::string& q : problem.quantities)
    if (std::find(quantities.begin(), quantities.end(), q) == quantities.end())
      complain(log, SpecPath{}.child("quantities"), fmt::format("no quantity '{}'{}", q, did_you_mean(q, quantities)),
               "the names that beltlife check --json lists");
}

void complete_starts(ProblemSpec& problem, const SceneSpec* scene) {
  for (ParameterSpec& p : problem.parameter) {
    if (p.start) continue;
    if (scene) {
      p.start = get_number(*scene, p.path);
      if (p.lower) p.start = std::max(*p.start, *p.lower);
      if (p.upper) p.start = std::min(*p.start, *p.upper);
    } else if (p.distribution && p.distribution->mean) {
      p.start = p.distribution->mean;
    } else if (p.lower && p.upper) {
      p.start = p.log ? std::sqrt(*p.lower * *p.upper) : 0.5 * (*p.lower + *p.upper);
    }
  }
}

}  // namespace beltlife
