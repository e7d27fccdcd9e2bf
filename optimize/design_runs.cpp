// Simulations of designs: see design_runs.h.
#include "optimize/design_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "optimize/scatter_draws.h"

namespace beltlife {
namespace {

std::size_t column_of(const DesignProblem& design, const std::string& quantity) {
  const auto& names = design.problem().spec.quantities;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), quantity) - names.begin());
}

/// Linear between neighbours; share 0 is the smallest.
double percentile_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(below);
  return below + 1 < values.size() ? values[below] + rest * (values[below + 1] - values[below]) : values.back();
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

DesignRuns::DesignRuns(const DesignProblem& design, StudyRun& run) : design_(design), run_(run) {
  const OptimizationSpec& spec = design.spec();
  objective_ = column_of(design, spec.objective.quantity);
  if (spec.pareto) second_ = column_of(design, spec.pareto->quantity);
  for (const ConstraintSpec& c : spec.constraint)
    for (const bool upper : {false, true}) {
      const auto& bound = upper ? c.upper : c.lower;
      if (!bound) continue;
      const double size = *bound == 0 ? 1 : std::abs(*bound);
      bounds_.push_back({c.name.empty() ? c.quantity : c.name, c.quantity, *bound, upper, c.scale.value_or(size)});
      columns_.push_back(column_of(design, c.quantity));
    }
  for (const LayoutLimit& limit : design.running_limits(design.start()))
    running_scales_.push_back(design.scale_of(limit));
  if (spec.robust) draws_ = scatter_draws(spec.scatter, spec.robust->samples, spec.optimization.seed);
}

int DesignRuns::replicates() const {
  const auto& scene = design_.problem().scene;
  const bool differ = !draws_.empty() || (scene && scene->file.scene.driver);
  return differ ? design_.spec().optimization.replicates : 1;
}

std::vector<std::string> DesignRuns::settings_of(RunLevel level) const {
  const OptimizationSpec& spec = design_.spec();
  std::vector<std::string> lines;
  if (level.coarse && spec.fidelity) lines = spec.fidelity->settings;
  const auto& scene = design_.problem().scene;
  if (level.replicate > 0 && scene && scene->file.scene.driver) {
    // By the golden section: phases a whole fraction of a turn apart would be the same run for an order they divide.
    const double turns = level.replicate * (std::numbers::phi - 1);
    const double turn = 2 * std::numbers::pi * (turns - std::floor(turns));
    lines.push_back(fmt::format("driver.phase_rad={}", scene->file.scene.driver->phase_rad + turn));
  }
  if (draws_.empty()) return {joined_lines(lines)};
  const auto draws = level.replicate == 0 ? draws_
                                          : scatter_draws(spec.scatter, spec.robust->samples,
                                                          spec.optimization.seed + 7919 * level.replicate);
  std::vector<std::string> all;
  for (const auto& row : draws) {
    std::vector<std::string> more = lines;
    for (std::size_t k = 0; k < row.size(); ++k) more.push_back(fmt::format("{}={}", spec.scatter[k].path, row[k]));
    all.push_back(joined_lines(more));
  }
  return all;
}

std::vector<double> DesignRuns::constraints_of(const std::vector<double>& values) const {
  std::vector<double> left;
  for (std::size_t i = 0; i < bounds_.size(); ++i)
    left.push_back(bounds_[i].upper ? bounds_[i].bound - values[columns_[i]] : values[columns_[i]] - bounds_[i].bound);
  return left;
}

Outcome DesignRuns::outcome_of(const std::vector<Point>& points, const std::vector<Answer>& answers) const {
  Outcome o;
  o.point = points.front();
  for (std::size_t i = 0; i < answers.size(); ++i) {
    o.state = answers[i].state;
    if (o.ok()) continue;
    o.reason = answers[i].reason;
    o.point = points[i];
    return o;
  }
  const OptimizationSpec& spec = design_.spec();
  const double share = spec.robust ? spec.robust->percentile / 100 : 0;
  const auto from_bad_end = [&](auto value, bool larger_is_better) {
    std::vector<double> all;
    for (const Answer& a : answers) all.push_back(larger_is_better ? value(a) : -value(a));
    return larger_is_better ? percentile_of(all, share) : -percentile_of(all, share);
  };
  o.values.assign(answers.front().values.size(), 0);
  for (const Answer& a : answers)
    for (std::size_t q = 0; q < o.values.size(); ++q) o.values[q] += a.values[q];
  for (double& v : o.values) v /= static_cast<double>(answers.size());
  o.objective = from_bad_end([&](const Answer& a) { return a.values[objective_]; }, spec.objective.maximize);
  if (second_) o.second = from_bad_end([&](const Answer& a) { return a.values[*second_]; }, spec.pareto->maximize);
  for (std::size_t i = 0; i < bounds_.size(); ++i)
    o.constraints.push_back(from_bad_end([&](const Answer& a) { return constraints_of(a.values)[i]; }, true));
  return o;
}

std::vector<Outcome> DesignRuns::evaluate(const std::vector<Candidate>& candidates, RunLevel level,
                                          const std::string& what) {
  const std::vector<std::string> settings = settings_of(level);
  std::vector<Point> points;
  for (const Candidate& c : candidates)
    for (const std::string& lines : settings) points.push_back(design_.point(c, lines));
  const std::vector<Answer> answers = run_.evaluate(points, what);
  asked_.insert(points.begin(), points.end());
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i * settings.size());
    const auto to = from + static_cast<std::ptrdiff_t>(settings.size());
    Outcome o =
        outcome_of({points.begin() + from, points.begin() + to}, {answers.begin() + from, answers.begin() + to});
    if (o.ok())
      for (const LayoutLimit& limit : design_.running_limits(candidates[i])) o.constraints.push_back(limit.value);
    outcomes.push_back(std::move(o));
  }
  return outcomes;
}

std::vector<double> DesignRuns::scaled(const Outcome& outcome) const {
  std::vector<double> s;
  for (std::size_t i = 0; i < outcome.constraints.size(); ++i)
    s.push_back(outcome.constraints[i] / (i < bounds_.size() ? bounds_[i].scale : running_scales_[i - bounds_.size()]));
  return s;
}

bool DesignRuns::feasible(const Candidate& c, const Outcome& outcome) const {
  return outcome.ok() && shortfall(outcome.constraints) == 0 && shortfall(design_.geometry(c)) == 0;
}

std::size_t DesignRuns::number_of(const Point& point) const {
  for (const StudyPoint& p : run_.record().points)
    if (p.settings == point) return p.number;
  throw std::logic_error("optimize: a point that was never asked");
}

}  // namespace beltlife
