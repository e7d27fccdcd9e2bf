// The study of kind sobol: see sobol_study.h.
#include "studies/sobol/sobol_study.h"

#include <fmt/format.h>

#include <cmath>

#include "results/text/print.h"
#include "results/text/table.h"
#include "studies/sampled_study.h"
#include "studies/sobol/sobol_indices.h"

namespace beltlife {
namespace {

nlohmann::json json_of(const Estimate& e) { return json_of_estimate(e.value, e.low, e.high); }

/// Widths shrink with the root of the number of rows.
nlohmann::json verdict(const SobolIndices& s, const std::vector<std::string>& paths, std::size_t used,
                       const SobolSettings& settings) {
  std::size_t widest = 0;
  for (std::size_t p = 1; p < s.total.size(); ++p)
    if (s.total[p].width() > s.total[widest].width()) widest = p;
  const double width = s.total[widest].width();
  // What failed this time fails next time: the rows to ask for are more than the rows to use.
  const double asked = settings.samples, growth = std::pow(width / settings.convergence_width, 2);
  return {{"converged", width <= settings.convergence_width},
          {"widest_interval", finite(width)},
          {"widest_parameter", paths[widest]},
          {"samples_needed", used == 0 ? nlohmann::json() : finite(std::ceil(asked * growth))}};
}

}  // namespace

std::vector<std::string> SobolStudy::quantities(const Model& m) { return life_quantity(m); }

SobolStudy::SobolStudy(const LoadedProblem& problem, const SobolSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  check_scatter(problem.spec, log);
}

StudyHead SobolStudy::head() const { return sampled_head(problem_); }
PointModel SobolStudy::model(int threads) const { return sampled_model(problem_, threads); }

nlohmann::json SobolStudy::solve(StudyRun& run) const {
  const std::vector<ParameterSpec>& parameters = problem_.spec.parameter;
  const std::size_t d = parameters.size();
  // Each half of a row through the distributions: A and B are samples of the same parameters.
  Rows base = unit_design(settings_.method, static_cast<std::size_t>(settings_.samples), 2 * d, settings_.seed);
  const Inputs inputs(parameters);
  for (auto& row : base) {
    const auto half = row.begin() + static_cast<std::ptrdiff_t>(d);
    const Rows both = inputs.at({{row.begin(), half}, {half, row.end()}});
    row = both[0];
    row.insert(row.end(), both[1].begin(), both[1].end());
  }
  const std::vector<Answer> answers = run.evaluate(points_of(saltelli_rows(base)), "sobol");

  const std::vector<std::string> paths = problem_.spec.paths();
  nlohmann::json answer;
  answer["parameters"] = paths;
  answer["confidence"] = settings_.confidence;
  answer["convergence_width"] = settings_.convergence_width;
  answer["rows"] = base.size();
  std::size_t used = 0;
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    const Rows values = whole_groups(answers, d + 2, q);
    used = values.size();
    if (used < 3) continue;
    const SobolIndices s = sobol_indices(values, {settings_.confidence, settings_.bootstrap, settings_.seed});
    nlohmann::json j = verdict(s, paths, used, settings_);
    for (std::size_t p = 0; p < d; ++p) {
      j["first"][paths[p]] = json_of(s.first[p]);
      j["total"][paths[p]] = json_of(s.total[p]);
    }
    j["sum_first"] = json_of(s.sum_first);
    j["mean"] = s.mean;
    j["variance"] = s.variance;
    answer["quantities"][problem_.spec.quantities[q]] = std::move(j);
  }
  answer["rows_used"] = used;
  if (used < 3) answer["error"] = fmt::format("only {} of {} base rows are whole: no indices", used, base.size());
  return answer;
}

std::string SobolStudy::text(const nlohmann::json& answer) {
  const int rows = answer["rows"], used = answer["rows_used"];
  if (answer.contains("error")) return answer["error"].get<std::string>() + "\n";
  const std::vector<std::string> paths = answer["parameters"];
  std::string words = fmt::format(
      "Shares of the variance with {:g} % intervals: first, by the parameter alone; total, with its interactions.\n"
      "{} base rows of {} points",
      100 * answer["confidence"].get<double>(), rows, paths.size() + 2);
  words += used == rows ? ".\n"
                        : fmt::format(
                              "; {} with a failed point were left out, {} used. If failures favour some\n"
                              "values, these indices are those of what did not fail.\n",
                              rows - used, used);
  const auto interval = [](const nlohmann::json& e) {
    if (e["low"].is_null()) return std::string("none");
    return fixed_text(e["low"], 3) + " .. " + fixed_text(e["high"], 3);
  };
  const auto number = [](const nlohmann::json& v) { return v.is_null() ? std::string("-") : fixed_text(v, 3); };
  for (const auto& [name, q] : answer["quantities"].items()) {
    words += fmt::format("\n{}: mean {}, standard deviation {:.3g}{}\n\n", name, cell(q["mean"], 5),
                         std::sqrt(q["variance"].get<double>()), in_unit(name));
    if (q["widest_interval"].is_null()) {
      words += "It does not vary, or too few rows are whole: no indices.\n";
      continue;
    }
    Table table({"parameter", "first", "interval", "total", "interval"});
    for (const std::string& p : paths)
      table.row({p, number(q["first"][p]["value"]), interval(q["first"][p]), number(q["total"][p]["value"]),
                 interval(q["total"][p])});
    table.row({"sum", number(q["sum_first"]["value"]), interval(q["sum_first"])});
    words += table.text();
    const double width = q["widest_interval"], wanted = answer["convergence_width"];
    words +=
        fmt::format("\n{}: the widest interval of a total index, that of {}, is {:.2g} wide; {:.2g} is asked for.\n",
                    q["converged"].get<bool>() ? "Converged" : "Not converged",
                    q["widest_parameter"].get<std::string>(), width, wanted);
    if (!q["converged"].get<bool>() && !q["samples_needed"].is_null()) {
      const double needed = q["samples_needed"];
      words += fmt::format("About samples = {:.0f} ({:.0f} points) would be needed: widths shrink with its root.\n",
                           needed, needed * static_cast<double>(paths.size() + 2));
    }
  }
  return words;
}

}  // namespace beltlife
