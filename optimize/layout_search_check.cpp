// The checks of an optimisation's file: see layout_search_check.h.
#include "optimize/layout_search_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "optimize/layout/layout_limits.h"

namespace beltlife {
namespace {

constexpr std::size_t most_combinations = 64;

void complain(ReadLog& log, const SpecPath& path, std::string what, std::string allowed) {
  if (!log.is_faulty(path.place)) log.add(path, log.line(path.place), std::move(what), std::move(allowed));
}

SpecPath in_list(const char* list, std::size_t i, const char* key) {
  return SpecPath{}.child(list).element(i).child(key);
}

void check_constraints(const OptimizationSpec& spec, ReadLog& log) {
  for (std::size_t i = 0; i < spec.constraint.size(); ++i) {
    const ConstraintSpec& c = spec.constraint[i];
    if (!c.lower && !c.upper)
      complain(log, in_list("constraint", i, "upper"), "missing: this holds nothing", "lower, upper or both");
    if (c.lower && c.upper && *c.lower > *c.upper)
      complain(log, in_list("constraint", i, "lower"), fmt::format("{:g} is above upper ({:g})", *c.lower, *c.upper),
               "lower below upper");
  }
}

void check_choices(const OptimizationSpec& spec, ReadLog& log) {
  std::size_t combinations = 1;
  const std::vector<std::string> paths = spec.problem.paths();
  for (std::size_t i = 0; i < spec.choice.size(); ++i) {
    const ChoiceSpec& c = spec.choice[i];
    const SpecPath at = in_list("choice", i, "values");
    if (c.values.empty()) complain(log, at, "is empty", "what may be chosen");
    for (std::size_t k = 0; k < c.values.size(); ++k)
      if (std::find(c.values.begin(), c.values.begin() + static_cast<std::ptrdiff_t>(k), c.values[k]) !=
          c.values.begin() + static_cast<std::ptrdiff_t>(k))
        complain(log, at, "'" + c.values[k] + "' stands here twice", "different values");
    const bool twice = std::any_of(spec.choice.begin(), spec.choice.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const ChoiceSpec& other) { return other.path == c.path; });
    if (twice || std::find(paths.begin(), paths.end(), c.path) != paths.end())
      complain(log, in_list("choice", i, "path"), c.path + " is varied already", "another path");
    combinations = std::min(combinations * std::max<std::size_t>(c.values.size(), 1), most_combinations + 1);
  }
  if (combinations > most_combinations)
    complain(log, SpecPath{}.child("choice"), fmt::format("there are more than {} combinations", most_combinations),
             "fewer choices: each combination is searched by itself");
}

/// The entries of [[scatter]] checked as if they were parameters, and told under their own name.
ProblemSpec as_parameters(const OptimizationSpec& spec) {
  ProblemSpec p;
  p.scene = "scene";
  for (const ScatterSpec& s : spec.scatter) {
    ParameterSpec& q = p.parameter.emplace_back();
    q.path = s.path;
    q.lower = s.lower;
    q.upper = s.upper;
    q.distribution = s.distribution;
  }
  return p;
}

template <class Check>
void check_as_parameters(ReadLog& log, Check check) {
  const std::string mine = "scatter", theirs = "parameter";
  ReadLog other;
  other.file = log.file;
  for (const auto& [place, line] : log.lines)
    if (place.starts_with(mine)) other.lines[theirs + place.substr(mine.size())] = line;
  for (const std::string& place : log.faulty)
    if (place.starts_with(mine)) other.faulty.insert(theirs + place.substr(mine.size()));
  check(other);
  for (Problem p : other.problems) {
    if (p.key.starts_with(theirs)) p.key = mine + p.key.substr(theirs.size());
    log.problems.push_back(std::move(p));
  }
  for (const std::string& place : other.faulty)
    if (place.starts_with(theirs)) log.faulty.insert(mine + place.substr(theirs.size()));
}

void check_robust(const OptimizationSpec& spec, ReadLog& log) {
  if (spec.robust && spec.scatter.empty())
    complain(log, SpecPath{}.child("robust"), "nothing scatters", "at least one [[scatter]]");
  if (!spec.robust && !spec.scatter.empty())
    complain(log, SpecPath{}.child("scatter"), "without effect: the file has no table [robust]", "[robust]");
  const std::vector<std::string> paths = spec.problem.paths();
  for (std::size_t i = 0; i < spec.scatter.size(); ++i)
    if (std::find(paths.begin(), paths.end(), spec.scatter[i].path) != paths.end())
      complain(log, in_list("scatter", i, "path"), spec.scatter[i].path + " is a parameter", "what is no parameter");
  check_as_parameters(log, [&](ReadLog& other) { check_problem(as_parameters(spec), other); });
}

/// Every search pays for one design at least.
void check_budget(const OptimizationSpec& spec, ReadLog& log) {
  double least = spec.pareto ? spec.pareto->steps + 2 : 1;
  for (const ChoiceSpec& c : spec.choice) least *= static_cast<double>(std::max<std::size_t>(c.values.size(), 1));
  if (spec.robust) least *= spec.robust->samples;
  if (spec.optimization.budget < least)
    complain(log, SpecPath{}.child("optimization").child("budget"),
             fmt::format("{} simulations do not pay for one design of every search", spec.optimization.budget),
             fmt::format("at least {:g}: combinations of choices x searches of a front x robust.samples", least));
}

void refuse_without_scene(const OptimizationSpec& spec, ReadLog& log) {
  const auto refuse = [&](bool given, const char* table) {
    if (given) complain(log, SpecPath{}.child(table), "is of a scene, and there is none", "a file that names a scene");
  };
  refuse(spec.layout.has_value(), "layout");
  refuse(spec.fidelity.has_value(), "fidelity");
  refuse(spec.robust.has_value(), "robust");
}

}  // namespace

void check_optimization(const OptimizationSpec& spec, ReadLog& log) {
  if (spec.problem.parameter.empty())
    complain(log, SpecPath{}.child("parameter"), "missing: there is nothing to vary", "at least one [[parameter]]");
  for (std::size_t i = 0; i < spec.problem.parameter.size(); ++i) {
    const ParameterSpec& p = spec.problem.parameter[i];
    if (!p.lower || !p.upper)
      complain(log, in_list("parameter", i, p.lower ? "upper" : "lower"), "missing: a search goes from bound to bound",
               "lower and upper");
    if (p.distribution)
      complain(log, in_list("parameter", i, "distribution"), "without effect: parameters are set, they do not scatter",
               "[[scatter]]");
  }
  check_constraints(spec, log);
  check_choices(spec, log);
  check_robust(spec, log);
  if (spec.fidelity && spec.fidelity->settings.empty())
    complain(log, SpecPath{}.child("fidelity").child("settings"), "is empty", "at least one PATH=VALUE");
  if (spec.pareto && spec.pareto->quantity == spec.objective.quantity)
    complain(log, SpecPath{}.child("pareto").child("quantity"), "is the objective itself", "another quantity");
  check_budget(spec, log);
  if (!spec.problem.scene && spec.problem.command) refuse_without_scene(spec, log);
}

void check_optimization_on(const OptimizationSpec& spec, const SceneSpec& scene, ReadLog& log) {
  if (spec.layout) check_layout_limits(spec.layout->limits, scene, log);
  for (std::size_t i = 0; i < spec.choice.size(); ++i)
    for (const std::string& value : spec.choice[i].values) {
      SceneSpec trial = scene;
      try {
        set_field(trial, spec.choice[i].path + "=" + value);
      } catch (const BadInput& bad) {
        const Problem& p = bad.problems().front();
        complain(log, in_list("choice", i, "path"), p.key + ": " + p.what, p.allowed);
      }
    }
  if (spec.fidelity)
    for (const std::string& setting : spec.fidelity->settings) {
      SceneSpec trial = scene;
      try {
        set_field(trial, setting);
        const std::string path = setting.substr(0, setting.find('='));
        const std::vector<std::string> varied = spec.problem.paths();
        if (std::find(varied.begin(), varied.end(), path) != varied.end())
          complain(log, SpecPath{}.child("fidelity").child("settings"), path + " is a parameter",
                   "what is no parameter");
      } catch (const BadInput& bad) {
        const Problem& p = bad.problems().front();
        complain(log, SpecPath{}.child("fidelity").child("settings"), p.key + ": " + p.what, p.allowed);
      }
    }
  check_as_parameters(log, [&](ReadLog& other) { check_against_scene(as_parameters(spec), scene, {}, other); });
}

}  // namespace beltlife
