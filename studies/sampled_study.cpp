// What the kinds of study that sample their parameters share: see sampled_study.h.
#include "studies/sampled_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

SpecPath parameter_path(std::size_t i) { return SpecPath{}.child("parameter").element(i); }

void refuse_none(const ProblemSpec& problem, ReadLog& log) {
  if (problem.parameter.empty())
    log.add(SpecPath{}.child("parameter"), 0, "missing: there is nothing to vary", "at least one [[parameter]]");
}

}  // namespace

std::vector<std::string> life_quantity(const Model&) { return {"log10_life_h"}; }

void check_scatter(const ProblemSpec& problem, ReadLog& log) {
  refuse_none(problem, log);
  for (std::size_t i = 0; i < problem.parameter.size(); ++i) {
    const ParameterSpec& p = problem.parameter[i];
    if (p.distribution || (p.lower && p.upper)) continue;
    const SpecPath path = parameter_path(i).child(p.lower ? "upper" : "lower");
    log.add(path, log.line(path.place), "missing: how " + p.path + " scatters is not known",
            "lower and upper, or a distribution");
  }
}

void check_bounds(const ProblemSpec& problem, ReadLog& log) {
  refuse_none(problem, log);
  for (std::size_t i = 0; i < problem.parameter.size(); ++i) {
    const ParameterSpec& p = problem.parameter[i];
    if (p.lower && p.upper) continue;
    const SpecPath path = parameter_path(i).child(p.lower ? "upper" : "lower");
    log.add(path, log.line(path.place), "missing: this kind of study goes from bound to bound", "lower and upper");
  }
}

StudyHead sampled_head(const LoadedProblem& problem) {
  StudyHead head;
  head.lanes = "drives";
  head.parameters = problem.spec.paths();
  head.quantities = problem.spec.quantities;
  return head;
}

PointModel sampled_model(const LoadedProblem& problem, int threads) {
  return model_of(problem, problem.spec.paths(), problem.spec.quantities, {.threads = threads});
}

std::vector<Point> points_of(const Rows& rows) {
  std::vector<Point> points;
  for (const auto& row : rows) points.push_back(point_of(row));
  return points;
}

Rows whole_groups(const std::vector<Answer>& answers, std::size_t size, std::size_t quantity) {
  Rows rows;
  for (std::size_t i = 0; i + size <= answers.size(); i += size) {
    const auto from = answers.begin() + static_cast<std::ptrdiff_t>(i);
    const auto to = from + static_cast<std::ptrdiff_t>(size);
    if (!std::all_of(from, to, [](const Answer& a) { return a.ok(); })) continue;
    auto& row = rows.emplace_back();
    std::transform(from, to, std::back_inserter(row), [&](const Answer& a) { return a.values[quantity]; });
  }
  return rows;
}

std::string cell(double number, int digits) {
  return std::isfinite(number) ? fmt::format("{:.{}g}", number, digits) : "-";
}

std::string in_unit(const std::string& quantity) {
  const std::string unit = unit_of_name(quantity);
  return unit.empty() ? "" : " in " + unit;
}

}  // namespace beltlife
