// The study of kind sobol: see sobol_study.h.
#include "studies/sobol/sobol_study.h"

#include <fmt/format.h>

#include <cmath>

#include "results/text/print.h"
#include "results/text/table.h"
#include "studies/openturns/openturns_inputs.h"
#include "studies/sampled_study.h"
#include "studies/sobol/sobol_indices.h"

namespace beltlife {
namespace {

/// Widths shrink with the root of the number of rows.
void judge(QuantityShares& q, const SobolIndices& s, const std::vector<std::string>& paths, std::size_t used,
           const SobolSettings& settings) {
  std::size_t widest = 0;
  for (std::size_t p = 1; p < s.total.size(); ++p)
    if (s.total[p].width() > s.total[widest].width()) widest = p;
  q.widest_interval = s.total[widest].width();
  q.widest_parameter = paths[widest];
  q.converged = q.widest_interval <= settings.convergence_width;
  // What failed this time fails next time: the rows to ask for are more than the rows to use.
  const double asked = settings.samples, growth = std::pow(q.widest_interval / settings.convergence_width, 2);
  if (used > 0) q.samples_needed = std::ceil(asked * growth);
}

QuantityShares shares_of(const SobolIndices& s, const std::vector<std::string>& paths, std::size_t used,
                         const SobolSettings& settings) {
  QuantityShares q;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    q.first[paths[p]] = {s.first[p]};
    q.total[paths[p]] = {s.total[p]};
  }
  q.sum_first = {s.sum_first};
  q.mean = s.mean;
  q.variance = s.variance;
  judge(q, s, paths, used, settings);
  return q;
}

}  // namespace

std::vector<std::string> SobolStudy::quantities(const Model& m) { return life_quantity(m); }

SobolStudy::SobolStudy(const LoadedProblem& problem, const SobolSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  check_scatter(problem.spec, log);
}

StudyHead SobolStudy::head() const { return sampled_head(problem_); }
PointModel SobolStudy::model(int threads) const { return sampled_model(problem_, threads); }

SobolAnswer SobolStudy::solve(StudyRun& run) const {
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

  SobolAnswer answer;
  answer.parameters = problem_.spec.paths();
  answer.confidence = settings_.confidence;
  answer.convergence_width = settings_.convergence_width;
  answer.rows = std::ssize(base);
  std::size_t used = 0;
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    const Rows values = whole_groups(answers, d + 2, q);
    used = values.size();
    if (used < 3) continue;
    const SobolIndices s = sobol_indices(values, {settings_.confidence, settings_.bootstrap, settings_.seed});
    answer.quantities[problem_.spec.quantities[q]] = shares_of(s, answer.parameters, used, settings_);
  }
  answer.rows_used = static_cast<std::int64_t>(used);
  if (used < 3) answer.error = fmt::format("only {} of {} base rows are whole: no indices", used, base.size());
  return answer;
}

std::string SobolStudy::text(const SobolAnswer& answer) {
  if (answer.error) return *answer.error + "\n";
  const std::int64_t rows = answer.rows, used = answer.rows_used;
  const std::vector<std::string>& paths = answer.parameters;
  std::string words = fmt::format(
      "Shares of the variance with {:g} % intervals: first, by the parameter alone; total, with its interactions.\n"
      "{} base rows of {} points",
      100 * answer.confidence, rows, paths.size() + 2);
  words += used == rows ? ".\n"
                        : fmt::format(
                              "; {} with a failed point were left out, {} used. If failures favour some\n"
                              "values, these indices are those of what did not fail.\n",
                              rows - used, used);
  const auto interval = [](const Estimate& e) {
    if (!std::isfinite(e.low)) return std::string("none");
    return fixed_text(e.low, 3) + " .. " + fixed_text(e.high, 3);
  };
  const auto number = [](double v) { return std::isfinite(v) ? fixed_text(v, 3) : std::string("-"); };
  for (const auto& [name, q] : answer.quantities) {
    words += fmt::format("\n{}: mean {}, standard deviation {:.3g}{}\n\n", name, cell(q.mean, 5), std::sqrt(q.variance),
                         in_unit(name));
    if (!std::isfinite(q.widest_interval)) {
      words += "It does not vary, or too few rows are whole: no indices.\n";
      continue;
    }
    Table table({"parameter", "first", "interval", "total", "interval"});
    for (const std::string& p : paths) {
      const Share &first = q.first.at(p), &total = q.total.at(p);
      table.row({p, number(first.value), interval(first), number(total.value), interval(total)});
    }
    table.row({"sum", number(q.sum_first.value), interval(q.sum_first)});
    words += table.text();
    words += fmt::format(
        "\n{}: the widest interval of a total index, that of {}, is {:.2g} wide; {:.2g} is asked for.\n",
        q.converged ? "Converged" : "Not converged", q.widest_parameter, q.widest_interval, answer.convergence_width);
    if (!q.converged && std::isfinite(q.samples_needed))
      words += fmt::format("About samples = {:.0f} ({:.0f} points) would be needed: widths shrink with its root.\n",
                           q.samples_needed, q.samples_needed * static_cast<double>(paths.size() + 2));
  }
  return words;
}

}  // namespace beltlife
