// Pictures of a layout search: see optimize_charts.h.
#include "optimize/pages/optimize_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "calibrate/pages/calibrate_charts.h"
#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::optional<std::size_t> column_of(const StudyRecord& record, const std::string& quantity) {
  const auto& names = record.head.quantities;
  const auto at = std::find(names.begin(), names.end(), quantity);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

double value_of(const StudyPoint& p, std::size_t column) {
  return p.answer.ok() && column < p.answer.values.size() ? p.answer.values[column] : none;
}

/// Whether the search itself asked for the point: after the check, before the replicates.
bool of_search(const StudyPoint& p, const json& answer) {
  const double check = number_in(answer, "check_simulations"), search = number_in(answer, "search_simulations");
  const auto number = static_cast<double>(p.number);
  return number >= check && number < check + search;
}

std::string objective_of(const json& answer) { return text_in(part_of(answer, "objective"), "quantity"); }

}  // namespace

std::string history_chart(const std::string& id, const StudyRecord& record) {
  const json &answer = record.answer, &history = part_of(answer, "history");
  const auto at = numbers_of_list(part_of(history, "simulations")),
             best = numbers_of_list(part_of(history, "objective"));
  MarkedChart::Series steps{"best so far", {}, {}, {}, "#0072b2", 0};
  double low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < std::min(at.size(), best.size()); ++k) {
    if (!std::isfinite(at[k]) || !std::isfinite(best[k])) continue;
    if (!steps.y.empty()) steps.x.push_back(at[k]), steps.y.push_back(steps.y.back());
    steps.x.push_back(at[k]);
    steps.y.push_back(best[k]);
    low = std::min(low, best[k]);
    high = std::max(high, best[k]);
  }
  MarkedChart chart{id, "", "simulations of the search", with_unit(objective_of(answer))};
  MarkedChart::Series marks{"a simulation, limits kept or not", {}, {}, {}, "#999999", 7, 0, 0.6};
  const auto column = column_of(record, objective_of(answer));
  const double check = number_in(answer, "check_simulations"), reach = high > low ? high - low : INFINITY;
  for (const StudyPoint& p : record.points) {
    const double v = column ? value_of(p, *column) : none;
    // A few far out would press all others into a line.
    if (!of_search(p, answer) || !(v > low - reach && v < high + reach)) continue;
    marks.x.push_back(static_cast<double>(p.number) - check + 1);
    marks.y.push_back(v);
  }
  chart.series = {std::move(marks), std::move(steps)};
  return svg_of(chart);
}

std::string lives_chart(const std::string& id, const json& lives) {
  Bars chart{id, "life, h", {}, {}, true};
  const json& best = part_of(lives, "best");
  if (!best.is_object()) return "";
  for (const auto& [range, life] : best.items()) chart.rows.push_back(range);
  for (const char* which : {"start", "best"}) {
    Bars::Layer layer{which, {}};
    const auto hours = [](const json& life, const char* key) {
      const double log = number_in(life, key);
      return std::abs(log) < 100 ? std::pow(10, log) : none;
    };
    for (const std::string& range : chart.rows) {
      const json& life = part_of(part_of(lives, which), range);
      layer.values.push_back(hours(life, "mean"));
      layer.low.push_back(hours(life, "low"));
      layer.high.push_back(hours(life, "high"));
    }
    if (std::any_of(layer.values.begin(), layer.values.end(), [](double v) { return std::isfinite(v); }))
      chart.layers.push_back(std::move(layer));
  }
  return chart.layers.empty() ? "" : svg_of(chart);
}

std::string fidelity_chart(const std::string& id, const StudyRecord& record) {
  const json& answer = record.answer;
  const auto column = column_of(record, objective_of(answer));
  const double check = number_in(answer, "check_simulations");
  if (!column || !(check > 0)) return "";
  std::map<Point, std::vector<const StudyPoint*>> layouts;  // by all but the settings of the run
  for (const StudyPoint& p : record.points)
    if (static_cast<double>(p.number) < check && !p.settings.empty())
      layouts[Point(p.settings.begin() + 1, p.settings.end())].push_back(&p);
  MarkedChart chart{id, "", "coarse: " + with_unit(objective_of(answer)), "fine"};
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

std::string front_chart(const std::string& id, const StudyRecord& record) {
  const json &answer = record.answer, &pareto = part_of(answer, "pareto"), &front = part_of(pareto, "front");
  const std::string first = objective_of(answer), second = text_in(pareto, "quantity");
  const auto x = column_of(record, first), y = column_of(record, second);
  MarkedChart chart{id, "", with_unit(first), with_unit(second)};
  MarkedChart::Series line{"front", {}, {}, {}, "#0072b2", 7, 3, 1.2}, all{"a simulation", {}, {}, {}, "#999999", 7, 0};
  all.size = 0.6;
  double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  const auto hold = [&](double a, double b) {
    low_x = std::min(low_x, a), high_x = std::max(high_x, a);
    low_y = std::min(low_y, b), high_y = std::max(high_y, b);
  };
  if (front.is_array())
    for (const json& j : front) {
      const double a = number_in(j, "objective"), b = number_in(j, "second");
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      line.x.push_back(a);
      line.y.push_back(b);
      line.names.push_back(digits_text(number_in(j, "point"), 9));
      hold(a, b);
    }
  if (line.x.empty()) return "";
  const json& start = part_of(answer, "start");
  MarkedChart::Series from{
      "start", {number_in(start, "objective")}, {number_in(part_of(start, "quantities"), second)}, {}, "#d55e00", 5, 0,
      1.2};
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
