// The study of kind uncertainty: see uncertainty_study.h.
#include "studies/uncertainty/uncertainty_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/text/table.h"
#include "studies/openturns/openturns_inputs.h"
#include "studies/sampled_study.h"
#include "studies/uncertainty/order_statistics.h"

namespace beltlife {
namespace {

double end_of(std::optional<double> bound) { return bound.value_or(not_known); }
Interval interval_of(const Bounds& b) { return {end_of(b.low), end_of(b.high)}; }
Estimate estimate_of(double value, const Bounds& b) { return {value, end_of(b.low), end_of(b.high)}; }

/// Where the quantile of all points would lie if those that failed were all below, or all above, the rest.
Bounds failed_at_an_end(const std::vector<double>& sorted, double share, std::size_t failed) {
  const auto whole = static_cast<double>(sorted.size()), lost = static_cast<double>(failed);
  const double below = (share * (whole + lost) - lost) / whole, above = share * (whole + lost) / whole;
  Bounds b;
  if (below >= 0) b.low = percentile(sorted, below);
  if (above <= 1) b.high = percentile(sorted, above);
  return b;
}

bool ends_in(const std::string& name, const std::string& last) { return name == last || name.ends_with("." + last); }

}  // namespace

void UncertaintySettings::check(ReadLog& log) const {
  const SpecPath at = SpecPath{}.child("study").child("percentiles");
  if (log.is_faulty(at.place)) return;
  if (percentiles.empty()) log.add(at, log.line(at.place), "is empty", "percentiles above 0 and below 100");
  if (std::find(percentiles.begin(), percentiles.end(), 100) != percentiles.end())
    log.add(at, log.line(at.place), "a sample has no 100th percentile", "above 0 and below 100");
}

std::vector<std::string> UncertaintyStudy::quantities(const Model& m) { return life_quantity(m); }

UncertaintyStudy::UncertaintyStudy(const LoadedProblem& problem, const UncertaintySettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  check_scatter(problem.spec, log);
  correlation_ = correlation_of(settings.correlation, problem.spec.paths(), log);
}

StudyHead UncertaintyStudy::head() const { return sampled_head(problem_); }
PointModel UncertaintyStudy::model(int threads) const { return sampled_model(problem_, threads); }

QuantityScatter UncertaintyStudy::scatter(const std::string& quantity, std::vector<double> values,
                                          std::size_t failed) const {
  std::sort(values.begin(), values.end());
  const Moments m = moments_of(values);
  QuantityScatter q;
  q.mean = m.mean;
  q.standard_deviation = m.standard_deviation;
  q.standard_error = m.standard_deviation / std::sqrt(static_cast<double>(values.size()));
  if (failed > 0) q.percentiles_by_failures.emplace();
  for (const double p : settings_.percentiles) {
    const std::string key = fmt::format("{}", p);
    q.percentiles[key] = percentile(values, p / 100);
    q.percentile_intervals[key] = interval_of(percentile_interval(values, p / 100, settings_.confidence));
    if (failed > 0) (*q.percentiles_by_failures)[key] = interval_of(failed_at_an_end(values, p / 100, failed));
  }
  const bool logarithm = ends_in(quantity, "log10_life_h");
  if (!logarithm && !ends_in(quantity, "life_h")) return q;
  for (double& v : values) v = logarithm ? std::pow(10, v) : v;
  q.b10_life_h = {estimate_of(percentile(values, 0.1), percentile_interval(values, 0.1, settings_.confidence))};
  if (!settings_.target_life_h) return q;
  const auto missed = static_cast<std::size_t>(
      std::lower_bound(values.begin(), values.end(), *settings_.target_life_h) - values.begin());
  const auto share = [&](std::size_t hits, std::size_t of) {
    return static_cast<double>(hits) / static_cast<double>(of);
  };
  q.missing_target = {
      estimate_of(share(missed, values.size()), share_interval(missed, values.size(), settings_.confidence)),
      share(missed, values.size() + failed), share(missed + failed, values.size() + failed)};
  return q;
}

UncertaintyAnswer UncertaintyStudy::solve(StudyRun& run) const {
  const std::vector<ParameterSpec>& parameters = problem_.spec.parameter;
  const Rows cube =
      unit_design(settings_.method, static_cast<std::size_t>(settings_.samples), parameters.size(), settings_.seed);
  const std::vector<Answer> answers = run.evaluate(points_of(Inputs(parameters, correlation_).at(cube)), "uncertainty");

  UncertaintyAnswer answer;
  answer.samples = std::ssize(answers);
  answer.confidence = settings_.confidence;
  answer.target_life_h = settings_.target_life_h;
  std::size_t used = 0;
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    std::vector<double> values;
    for (const auto& row : whole_groups(answers, 1, q)) values.push_back(row[0]);
    used = values.size();
    const std::string& name = problem_.spec.quantities[q];
    if (used > 1) answer.quantities[name] = scatter(name, std::move(values), answers.size() - used);
  }
  answer.failed_share = 1 - static_cast<double>(used) / static_cast<double>(answers.size());
  if (used < 2) answer.error = fmt::format("only {} of {} points are ok", used, answers.size());
  return answer;
}

namespace {

std::string interval_words(double low, double high) {
  if (!std::isfinite(low) && !std::isfinite(high)) return "none: too few points";
  return fmt::format("{} .. {}", cell(low, 5), cell(high, 5));
}

std::string percentile_table(const QuantityScatter& q) {
  std::vector<double> order;
  for (const auto& [key, value] : q.percentiles) order.push_back(std::stod(key));
  std::sort(order.begin(), order.end());
  std::vector<std::string> header{"percentile", "value", "interval"};
  if (q.percentiles_by_failures) header.emplace_back("by failures");
  Table table(header);
  for (const double p : order) {
    const std::string key = fmt::format("{}", p);
    const Interval& interval = q.percentile_intervals.at(key);
    std::vector<std::string> row{key, cell(q.percentiles.at(key), 5), interval_words(interval.low, interval.high)};
    if (q.percentiles_by_failures) {
      const Interval& b = q.percentiles_by_failures->at(key);
      row.push_back(cell(b.low, 5) + " .. " + cell(b.high, 5));
    }
    table.row(std::move(row));
  }
  return table.text();
}

}  // namespace

std::string UncertaintyStudy::text(const UncertaintyAnswer& answer) {
  if (answer.error) return *answer.error + "\n";
  std::string words = fmt::format("Scatter over {} points; intervals of {:g} % by order statistics.\n", answer.samples,
                                  100 * answer.confidence);
  const double lost = answer.failed_share;
  if (lost > 0)
    words += fmt::format(
        "{:.2g} % of the points failed and are missing from all that follows; by failures: where a percentile would\n"
        "be if they all lay below, or all above, the rest (-: anywhere).\n",
        100 * lost);
  for (const auto& [name, q] : answer.quantities) {
    words += fmt::format("\n{}{}: mean {} +- {} (standard error), standard deviation {}\n\n", name, in_unit(name),
                         cell(q.mean, 5), cell(q.standard_error, 2), cell(q.standard_deviation, 3));
    words += percentile_table(q);
    if (q.b10_life_h)
      words += fmt::format("\nB10 life: nine of ten live longer than {} h (interval {}).\n",
                           cell(q.b10_life_h->value, 4), interval_words(q.b10_life_h->low, q.b10_life_h->high));
    if (!q.missing_target) continue;
    const auto percent = [](double share) { return fmt::format("{:.2g}", 100 * share); };
    const MissedTarget& m = *q.missing_target;
    words += fmt::format("Probability of less than {} h: {} % (Wilson's interval {} .. {} %",
                         cell(answer.target_life_h.value_or(not_known), 6), percent(m.value), percent(m.low),
                         percent(m.high));
    words += lost > 0 ? fmt::format("; {} % if every failed point misses it).\n", percent(m.if_failed_miss)) : ").\n";
  }
  return words;
}

}  // namespace beltlife
