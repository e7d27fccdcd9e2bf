// Pictures of a layout search: see optimize_charts.h.
#include "optimize/pages/optimize_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"

namespace beltlife {
namespace {

std::optional<std::size_t> column_of(const StudyRecord& record, const std::string& quantity) {
  const auto& names = record.head.quantities;
  const auto at = std::find(names.begin(), names.end(), quantity);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

double value_of(const StudyPoint& p, std::size_t column) {
  return p.answer.ok() && column < p.answer.values.size() ? p.answer.values[column] : not_known;
}

/// Whether the search itself asked for the point: after the check, before the replicates.
bool of_search(const StudyPoint& p, const SearchAnswer& answer) {
  const auto number = static_cast<std::int64_t>(p.number);
  return number >= answer.check_simulations && number < answer.check_simulations + answer.search_simulations;
}

/// A logarithm of hours as hours.
double hours_of(double log) { return std::abs(log) < 100 ? std::pow(10, log) : not_known; }

Bars::Layer lives_layer(const char* which, const std::vector<std::string>& ranges, const RangeLives* lives) {
  Bars::Layer layer{which, {}};
  for (const std::string& range : ranges) {
    const bool known = lives && lives->contains(range);
    const ReplicateMean life = known ? lives->at(range) : ReplicateMean{};
    layer.values.push_back(hours_of(life.mean));
    layer.low.push_back(hours_of(life.low));
    layer.high.push_back(hours_of(life.high));
  }
  return layer;
}

}  // namespace

std::string history_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer) {
  const std::vector<std::int64_t>& at = answer.history.simulations;
  const std::vector<double>& best = answer.history.objective;
  MarkedChart::Series steps{"best so far", {}, {}, {}, "#0072b2", 0};
  double low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < std::min(at.size(), best.size()); ++k) {
    if (!std::isfinite(best[k])) continue;
    const auto x = static_cast<double>(at[k]);
    if (!steps.y.empty()) steps.x.push_back(x), steps.y.push_back(steps.y.back());
    steps.x.push_back(x);
    steps.y.push_back(best[k]);
    low = std::min(low, best[k]);
    high = std::max(high, best[k]);
  }
  MarkedChart chart{id, "", "simulations of the search", with_unit(answer.objective.quantity)};
  MarkedChart::Series marks{"a simulation, limits kept or not", {}, {}, {}, "#999999", 7, 0, 0.6};
  const auto column = column_of(record, answer.objective.quantity);
  const double check = static_cast<double>(answer.check_simulations), reach = high > low ? high - low : INFINITY;
  for (const StudyPoint& p : record.points) {
    const double v = column ? value_of(p, *column) : not_known;
    // A few far out would press all others into a line.
    if (!of_search(p, answer) || !(v > low - reach && v < high + reach)) continue;
    marks.x.push_back(static_cast<double>(p.number) - check + 1);
    marks.y.push_back(v);
  }
  chart.series = {std::move(marks), std::move(steps)};
  return svg_of(chart);
}

std::string lives_chart(const std::string& id, const LivesAnswer& lives) {
  if (!lives.best.value) return "";
  Bars chart{id, "life, h", {}, {}, true};
  for (const auto& [range, life] : *lives.best.value) chart.rows.push_back(range);
  const RangeLives* start = lives.start && lives.start->value ? &*lives.start->value : nullptr;
  for (Bars::Layer layer :
       {lives_layer("start", chart.rows, start), lives_layer("best", chart.rows, &*lives.best.value)})
    if (std::any_of(layer.values.begin(), layer.values.end(), [](double v) { return std::isfinite(v); }))
      chart.layers.push_back(std::move(layer));
  return chart.layers.empty() ? "" : svg_of(chart);
}

std::string fidelity_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer) {
  const auto column = column_of(record, answer.objective.quantity);
  if (!column || answer.check_simulations <= 0) return "";
  std::map<Point, std::vector<const StudyPoint*>> layouts;  // by all but the settings of the run
  for (const StudyPoint& p : record.points)
    if (static_cast<std::int64_t>(p.number) < answer.check_simulations && !p.settings.empty())
      layouts[Point(p.settings.begin() + 1, p.settings.end())].push_back(&p);
  MarkedChart chart{id, "", "coarse: " + with_unit(answer.objective.quantity), "fine"};
  MarkedChart::Series marks{"", {}, {}, {}, safe_colour(0), 7, 0};
  for (const auto& [layout, pair] : layouts) {
    if (pair.size() != 2) continue;  // several draws a layout: which belongs to which is not in the log
    const bool in_order = pair[0]->number < pair[1]->number;  // the coarse ones are run first
    marks.x.push_back(value_of(*pair[in_order ? 0 : 1], *column));
    marks.y.push_back(value_of(*pair[in_order ? 1 : 0], *column));
  }
  chart.series = {std::move(marks)};
  return svg_of(chart);
}

std::string front_chart(const std::string& id, const StudyRecord& record, const SearchAnswer& answer) {
  if (!answer.pareto) return "";
  const std::string first = answer.objective.quantity, second = answer.pareto->quantity;
  const auto x = column_of(record, first), y = column_of(record, second);
  MarkedChart chart{id, "", with_unit(first), with_unit(second)};
  MarkedChart::Series line{"front", {}, {}, {}, "#0072b2", 7, 3, 1.2}, all{"a simulation", {}, {}, {}, "#999999", 7, 0};
  all.size = 0.6;
  double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  const auto hold = [&](double a, double b) {
    low_x = std::min(low_x, a), high_x = std::max(high_x, a);
    low_y = std::min(low_y, b), high_y = std::max(high_y, b);
  };
  for (const FrontDesign& design : answer.pareto->front) {
    if (!std::isfinite(design.objective) || !std::isfinite(design.second)) continue;
    line.x.push_back(design.objective);
    line.y.push_back(design.second);
    line.names.push_back(std::to_string(design.point));
    hold(design.objective, design.second);
  }
  if (line.x.empty()) return "";
  const auto& quantities = answer.start.quantities.value;
  const bool known = quantities && quantities->contains(second);
  MarkedChart::Series from{
      "start", {answer.start.objective}, {known ? quantities->at(second) : not_known}, {}, "#d55e00", 5, 0, 1.2};
  if (std::isfinite(from.x[0]) && std::isfinite(from.y[0])) hold(from.x[0], from.y[0]);
  const double reach_x = std::max(high_x - low_x, 1e-9), reach_y = std::max(high_y - low_y, 1e-9);
  for (const StudyPoint& p : record.points) {
    if (!x || !y || !of_search(p, answer)) continue;
    const double a = value_of(p, *x), b = value_of(p, *y);
    if (!(a > low_x - reach_x && a < high_x + reach_x && b > low_y - reach_y && b < high_y + reach_y)) continue;
    all.x.push_back(a);
    all.y.push_back(b);
  }
  chart.series = {std::move(all), std::move(line), std::move(from)};
  return svg_of(chart);
}

}  // namespace beltlife
