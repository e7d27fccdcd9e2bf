// The optimisation's problem: its scene, its quantities, its checks; see layout_search.h.
#include "optimize/layout_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "optimize/design_problem.h"
#include "optimize/layout/layout_base.h"
#include "optimize/layout_search_check.h"

namespace beltlife {
namespace {

/// What restating the scene takes from it, to be solved for.
bool is_solved_for(const std::string& path) {
  for (const char* solved : {"belt.unstretched_length_mm", "belt.effective_length_mm", "belt.measuring_tension_n",
                             "belt.length_catalogue_mm", "tensioner.spring_torque_n_m"})
    if (path == solved || path.starts_with(std::string(solved) + ".")) return true;
  return false;
}

bool is_life(const std::string& quantity) { return quantity.ends_with("life_h"); }

}  // namespace

void LayoutSearch::prepare(Spec& spec, const DriverOptions& options, ReadLog& log) {
  if (options.seed) spec.optimization.seed = static_cast<std::int64_t>(*options.seed);
  for (const ParameterSpec& p : spec.problem.parameter) spec.start_given.push_back(p.start.has_value());
  if (log.problems.empty()) check_optimization(spec, log);
  if (!spec.problem.command) return;
  const auto need = [&](const std::string& quantity) {
    auto& names = spec.problem.quantities;
    if (!quantity.empty() && std::find(names.begin(), names.end(), quantity) == names.end()) names.push_back(quantity);
  };
  need(spec.objective.quantity);
  if (spec.pareto) need(spec.pareto->quantity);
  for (const ConstraintSpec& c : spec.constraint) need(c.quantity);
}

LayoutSearch::LayoutSearch(const LoadedProblem& problem, const Spec& spec, ReadLog& log)
    : problem_(problem), spec_(spec) {
  if (!problem_.scene) return;
  restate_scene(log);
  if (!log.problems.empty()) return;
  const SceneSpec& scene = problem_.scene->file.scene;
  check_optimization_on(spec_, scene, log);
  add_quantities(log);
}

void LayoutSearch::restate_scene(ReadLog& log) {
  SceneFile& file = problem_.scene->file;
  const SpecPath hold = SpecPath{}.child("layout").child("hold_pretension");
  if (!spec_.layout || spec_.layout->hold_pretension) {
    for (std::size_t i = 0; i < spec_.problem.parameter.size(); ++i)
      if (is_solved_for(spec_.problem.parameter[i].path)) {
        const SpecPath at = SpecPath{}.child("parameter").element(i).child("path");
        log.add(at, log.line(at.place), spec_.problem.parameter[i].path + " is solved for while the pretension is held",
                "belt.pretension_n, or layout.hold_pretension = false");
      }
    if (!log.problems.empty()) return;
    if (file.scene.ring) {
      log.add(hold, log.line(hold.place), "the scene is a ring, which has no layout", "a scene with pulleys");
      return;
    }
    try {
      file.scene = layout_base(file.scene);
      problem_.scene->model = compile(file.scene);
    } catch (const BadInput& bad) {
      const Problem& p = bad.problems().front();
      log.add(hold, log.line(hold.place), "the pretension of " + file.path.string() + " cannot be held: " + p.what,
              "false, or " + p.allowed);
      return;
    }
  }
  // Starts that the file leaves open are where the scene, as it is varied, has them.
  for (std::size_t i = 0; i < problem_.spec.parameter.size(); ++i)
    if (!spec_.start_given[i]) problem_.spec.parameter[i].start.reset();
  ReadLog unread = log;
  check_against_scene(problem_.spec, file.scene, quantity_names(problem_.scene->model), unread);
  if (unread.problems.size() > log.problems.size()) {
    log = unread;
    return;
  }
  complete_starts(problem_.spec, &file.scene);
  spec_.problem = problem_.spec;
}

void LayoutSearch::add_quantities(ReadLog& log) {
  const std::vector<std::string> known = quantity_names(problem_.scene->model);
  auto& names = problem_.spec.quantities;
  bool lives = false;
  const auto need = [&](const std::string& quantity, const SpecPath& path) {
    if (std::find(known.begin(), known.end(), quantity) == known.end()) {
      if (!log.is_faulty(path.place))
        log.add(path, log.line(path.place), fmt::format("no quantity '{}'{}", quantity, did_you_mean(quantity, known)),
                "the names that beltlife check --json lists");
      return;
    }
    lives = lives || is_life(quantity);
    if (std::find(names.begin(), names.end(), quantity) == names.end()) names.push_back(quantity);
  };
  need(spec_.objective.quantity, SpecPath{}.child("objective").child("quantity"));
  if (spec_.pareto) need(spec_.pareto->quantity, SpecPath{}.child("pareto").child("quantity"));
  for (std::size_t i = 0; i < spec_.constraint.size(); ++i)
    need(spec_.constraint[i].quantity, SpecPath{}.child("constraint").element(i).child("quantity"));
  if (!lives) return;
  // What the life is made of, of the ranges that are run anyway.
  const SceneSpec& scene = problem_.scene->file.scene;
  const std::vector<std::string> run = ranges_for(scene, names);
  for (const RangeSpec& range : scene.range) {
    if (!run.empty() && std::find(run.begin(), run.end(), range.name) == run.end()) continue;
    need(range.name + ".log10_life_h", {});
    for (const PulleySpec& p : scene.pulley)
      for (const char* stress : {"sigma_m_mpa", "sigma_a_mpa"})
        need(fmt::format("{}.pulley.{}.{}", range.name, p.name, stress), {});
  }
}

StudyHead LayoutSearch::head() const {
  StudyHead head;
  head.lanes = "drives";
  head.parameters = DesignProblem(problem_, spec_).columns();
  head.quantities = problem_.spec.quantities;
  return head;
}

PointModel LayoutSearch::model(int threads) const {
  DriveModelOptions options;
  options.threads = threads;
  return model_of(problem_, DesignProblem(problem_, spec_).columns(), problem_.spec.quantities, options);
}

}  // namespace beltlife
