// The study of kind surrogate: see surrogate_study.h.
#include "studies/surrogate/surrogate_study.h"

#include <fmt/format.h>

#include <cmath>

#include "results/text/print.h"
#include "results/text/table.h"
#include "studies/sampled_study.h"
#include "studies/sobol/sobol_indices.h"

namespace beltlife {
namespace {

constexpr double usable_q2 = 0.9;      // a tenth of the variance unexplained
constexpr double most_terms = 3000;    // beyond, choosing among them takes minutes
constexpr std::size_t few_points = 8;  // fewer say nothing, whatever the fit
constexpr std::size_t sampled_rows = 4096;

/// Indices of a surrogate that has none of its own, from its values. Its own error is not in them.
void add_sampled_indices(Surrogate& s, const std::vector<ParameterSpec>& parameters, std::int64_t seed) {
  const std::size_t d = parameters.size();
  const Inputs inputs(parameters);
  Rows values;
  for (const auto& unit : saltelli_rows(unit_design(SamplingMethod::sobol_sequence, sampled_rows, 2 * d, seed))) {
    if (values.empty() || values.back().size() == d + 2) values.emplace_back();
    values.back().push_back(s.predict(inputs.at({unit})[0]));
  }
  const SobolIndices indices = sobol_indices(values, {.resamples = 0, .seed = seed});
  for (std::size_t p = 0; p < d; ++p) {
    s.first.push_back(indices.first[p].value);
    s.total.push_back(indices.total[p].value);
  }
}

}  // namespace

std::vector<std::string> SurrogateStudy::quantities(const Model& m) { return life_quantity(m); }

SurrogateStudy::SurrogateStudy(const LoadedProblem& problem, const SurrogateSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  check_scatter(problem.spec, log);
  const double terms = chaos_terms(problem.spec.parameter.size(), settings.degree);
  const SpecPath path = SpecPath{}.child("study").child("degree");
  if (settings.method == SurrogateMethod::chaos && terms > most_terms)
    log.add(path, log.line(path.place),
            fmt::format("{} has {:.0f} terms in {} parameters", settings.degree, terms, problem.spec.parameter.size()),
            fmt::format("a degree with at most {:.0f}", most_terms));
}

StudyHead SurrogateStudy::head() const { return sampled_head(problem_); }
PointModel SurrogateStudy::model(int threads) const { return sampled_model(problem_, threads); }

SurrogateAnswer SurrogateStudy::solve(StudyRun& run) const {
  const std::vector<ParameterSpec>& parameters = problem_.spec.parameter;
  const std::vector<std::string> paths = problem_.spec.paths();
  const bool chaos = settings_.method == SurrogateMethod::chaos;
  Rows rows = Inputs(parameters)
                  .at(unit_design(SamplingMethod::sobol_sequence, static_cast<std::size_t>(settings_.samples),
                                  paths.size(), settings_.seed));
  const std::vector<double> nominal = problem_.start();
  rows.push_back(nominal);
  const std::vector<Answer> answers = run.evaluate(points_of(rows), "surrogate");

  Rows at;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    if (answers[i].ok()) at.push_back(rows[i]);
  SurrogateAnswer answer;
  answer.parameters = paths;
  answer.method = enum_name(settings_.method);
  answer.samples = settings_.samples;
  answer.samples_used = std::ssize(at);
  if (at.size() < few_points) {
    answer.error = fmt::format("only {} of {} points are ok: too few to fit to", at.size(), settings_.samples);
    return answer;
  }
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    std::vector<double> values;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      if (answers[i].ok()) values.push_back(answers[i].values[q]);
    Surrogate s =
        chaos ? chaos_surrogate(parameters, at, values, settings_.degree) : kriging_surrogate(parameters, at, values);
    if (s.first.empty()) add_sampled_indices(s, parameters, settings_.seed);
    QuantitySurrogate& found = answer.quantities[problem_.spec.quantities[q]];
    found.q2 = s.q2;
    found.usable = s.q2 >= usable_q2;
    found.terms = static_cast<std::int64_t>(s.terms);
    for (std::size_t p = 0; p < paths.size(); ++p) {
      found.first[paths[p]] = s.first[p];
      found.total[paths[p]] = s.total[p];
    }
    found.nominal.predicted = s.predict(nominal);
    if (answers.back().ok()) found.nominal.simulated = answers.back().values[q];
  }
  return answer;
}

std::string SurrogateStudy::text(const SurrogateAnswer& answer) {
  if (answer.error) return *answer.error + "\n";
  std::string words = fmt::format(
      "{}, fitted to {} of {} points; Q2: share of the variance that is predicted at points left out in turn.\n",
      answer.method == "chaos" ? "Polynomial chaos" : "Kriging", answer.samples_used, answer.samples);
  const auto number = [](double v) { return std::isfinite(v) ? fixed_text(v, 3) : std::string("-"); };
  for (const auto& [name, q] : answer.quantities) {
    if (!std::isfinite(q.q2)) {
      words += fmt::format("\n{} does not vary.\n", name);
      continue;
    }
    words += fmt::format("\n{}: Q2 = {}, {}; {} coefficients.\nNominal point{}: {} predicted, {} simulated.\n\n", name,
                         fixed_text(q.q2, 4), q.usable ? "usable" : "not usable (below 0.9)", q.terms, in_unit(name),
                         cell(q.nominal.predicted, 6), cell(q.nominal.simulated, 6));
    Table table({"parameter", "first", "total"});
    for (const std::string& p : answer.parameters) table.row({p, number(q.first.at(p)), number(q.total.at(p))});
    words += table.text();
  }
  return words;
}

}  // namespace beltlife
