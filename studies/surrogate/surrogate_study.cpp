// The study of kind surrogate: see surrogate_study.h.
#include "studies/surrogate/surrogate_study.h"

#include <fmt/format.h>

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

nlohmann::json SurrogateStudy::solve(StudyRun& run) const {
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
  nlohmann::json answer;
  answer["parameters"] = paths;
  answer["method"] = enum_name(settings_.method);
  answer["samples"] = settings_.samples;
  answer["samples_used"] = at.size();
  if (at.size() < few_points) {
    answer["error"] = fmt::format("only {} of {} points are ok: nothing to learn from", at.size(), settings_.samples);
    return answer;
  }
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    std::vector<double> values;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      if (answers[i].ok()) values.push_back(answers[i].values[q]);
    Surrogate s =
        chaos ? chaos_surrogate(parameters, at, values, settings_.degree) : kriging_surrogate(parameters, at, values);
    if (s.first.empty()) add_sampled_indices(s, parameters, settings_.seed);
    nlohmann::json j{{"q2", finite(s.q2)}, {"usable", s.q2 >= usable_q2}, {"terms", s.terms}};
    for (std::size_t p = 0; p < paths.size(); ++p) {
      j["first"][paths[p]] = finite(s.first[p]);
      j["total"][paths[p]] = finite(s.total[p]);
    }
    j["nominal"]["predicted"] = finite(s.predict(nominal));
    j["nominal"]["simulated"] = answers.back().ok() ? nlohmann::json(answers.back().values[q]) : nlohmann::json();
    answer["quantities"][problem_.spec.quantities[q]] = std::move(j);
  }
  return answer;
}

std::string SurrogateStudy::text(const nlohmann::json& answer) {
  if (answer.contains("error")) return answer["error"].get<std::string>() + "\n";
  const std::vector<std::string> paths = answer["parameters"];
  const bool chaos = answer["method"] == "chaos";
  std::string words = fmt::format(
      "{}, learnt from {} of {} points; Q2: share of the variance foretold at points left out in turn.\n",
      chaos ? "Polynomial chaos" : "Kriging", answer["samples_used"].get<int>(), answer["samples"].get<int>());
  for (const auto& [name, q] : answer["quantities"].items()) {
    if (q["q2"].is_null()) {
      words += fmt::format("\n{} does not vary.\n", name);
      continue;
    }
    words += fmt::format("\n{}: Q2 = {}, {}; {} coefficients.\nNominal point{}: {} foretold, {} simulated.\n\n", name,
                         fixed_text(q["q2"], 4), q["usable"].get<bool>() ? "usable" : "not usable (below 0.9)",
                         q["terms"].get<int>(), in_unit(name), cell(q["nominal"]["predicted"], 6),
                         cell(q["nominal"]["simulated"], 6));
    Table table({"parameter", "first", "total"});
    const auto number = [](const nlohmann::json& v) { return v.is_null() ? std::string("-") : fixed_text(v, 3); };
    for (const std::string& p : paths) table.row({p, number(q["first"][p]), number(q["total"][p])});
    words += table.text();
  }
  return words;
}

}  // namespace beltlife
