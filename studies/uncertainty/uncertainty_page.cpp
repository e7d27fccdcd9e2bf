// The part of a page that is of uncertainty: distributions, percentiles, chance to miss a target; see study_parts.h.
#include "studies/uncertainty/uncertainty_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr std::size_t most_charts = 12, most_steps = 400, told_quantities = 4;
constexpr double most_bins = 60;

bool ends_in(const std::string& name, const std::string& last) { return name == last || name.ends_with("." + last); }

/// A quantity as its charts show it: lives in hours on a logarithmic axis, however they are recorded.
struct ShownScatter {
  std::string name;
  const QuantityScatter* answer = nullptr;
  bool logarithm = false, life = false;
  std::vector<double> values;  ///< of the points that are ok, sorted, as recorded

  double shown(double v) const { return logarithm ? std::pow(10.0, v) : v; }
  std::string axis() const { return life ? "life, h" : with_unit(name); }
};

std::vector<ShownScatter> scatters_of(const StudyRecord& record, const UncertaintyAnswer& answer) {
  std::vector<ShownScatter> all;
  for (std::size_t q = 0; q < record.head.quantities.size(); ++q) {
    const std::string& name = record.head.quantities[q];
    const auto found = answer.quantities.find(name);
    if (found == answer.quantities.end()) continue;
    ShownScatter s{name,
                   &found->second,
                   ends_in(name, "log10_life_h"),
                   ends_in(name, "log10_life_h") || ends_in(name, "life_h"),
                   {}};
    for (const StudyPoint& p : record.points)
      if (p.answer.ok() && q < p.answer.values.size() && std::isfinite(p.answer.values[q]))
        s.values.push_back(p.answer.values[q]);
    std::sort(s.values.begin(), s.values.end());
    all.push_back(std::move(s));
  }
  return all;
}

/// Percentiles by size of their names.
std::vector<std::pair<double, std::string>> percents_of(const QuantityScatter& quantity) {
  std::vector<std::pair<double, std::string>> all;
  for (const auto& [key, value] : quantity.percentiles) all.emplace_back(std::strtod(key.c_str(), nullptr), key);
  std::sort(all.begin(), all.end());
  return all;
}

std::string unit_text(const ShownScatter& s) {
  const std::string unit = unit_of_name(s.name);
  return unit.empty() ? "" : " " + html_escaped(unit);
}

/// Written out: 15200 rather than 1.52e+04.
std::string hours_text(double hours) { return hours >= 1 && hours < 1e7 ? html_rounded(hours, 3) : digits_text(hours); }

/// " (95 %: a to b)"; empty where there is no interval.
template <class Text>
std::string interval_in_words(const Estimate& e, double confidence, const Text& text) {
  if (std::isnan(e.low) && std::isnan(e.high)) return "";
  return fmt::format(" ({} %: {} to {})", digits_text(100 * confidence), text(e.low), text(e.high));
}

std::string share_text(double share) { return digits_text(100 * share); }

std::string told_of(const UncertaintyAnswer& answer, const ShownScatter& s) {
  const QuantityScatter& q = *s.answer;
  const std::string whose = html_escaped(s.name);
  std::string words;
  if (q.b10_life_h && q.b10_life_h->value > 0)
    words += fmt::format("Nine of ten live longer than <strong>{} h</strong>{}: {}. ", hours_text(q.b10_life_h->value),
                         interval_in_words(*q.b10_life_h, answer.confidence, hours_text), whose);
  if (q.missing_target && q.missing_target->value >= 0)
    words += fmt::format("Less than {} h is reached with a probability of <strong>{} %</strong>{}. ",
                         digits_text(answer.target_life_h.value_or(not_known), 6), share_text(q.missing_target->value),
                         interval_in_words(*q.missing_target, answer.confidence, share_text));
  const auto percents = percents_of(q);
  if (s.life || percents.size() < 2) return words;
  const auto& [low, low_key] = percents.front();
  const auto& [high, high_key] = percents.back();
  return words + fmt::format("{} % of the points have {} between <strong>{}</strong> and <strong>{}</strong>{}. ",
                             digits_text(high - low), whose, digits_text(q.percentiles.at(low_key), 4),
                             digits_text(q.percentiles.at(high_key), 4), unit_text(s));
}

std::string lead_of(const UncertaintyAnswer& answer, const std::vector<ShownScatter>& all) {
  std::string words = error_words(answer);
  for (std::size_t i = 0; i < std::min(all.size(), told_quantities); ++i) words += told_of(answer, all[i]);
  if (answer.failed_share > 0)
    words += fmt::format("<span class=\"alarm\">{} % of the points failed</span> and are missing here. ",
                         percent_text(answer.failed_share));
  return words;
}

/// By Freedman and Diaconis; where half of the points are the same, by the root of their number.
std::size_t bins_of(const std::vector<double>& axis) {
  const std::size_t n = axis.size();
  const double range = axis.back() - axis.front(), middle = axis[(3 * n) / 4] - axis[n / 4];
  const double count = static_cast<double>(n);
  const double bins = middle > 0 ? range / (2 * middle / std::cbrt(count)) : std::sqrt(count);
  return static_cast<std::size_t>(std::clamp(std::ceil(bins), 1.0, most_bins));
}

MarkedChart::Series upright(double x, double top, const std::string& label, int dash) {
  return {label, {x, x}, {0, top}, {}, "#d55e00", 0, dash, 1};
}

/// What stands upright in both charts of a life.
void add_marks(MarkedChart& chart, const ShownScatter& s, const UncertaintyAnswer& answer, double top) {
  if (!s.life) return;
  const double target = answer.target_life_h.value_or(0), b10 = s.answer->b10_life_h ? s.answer->b10_life_h->value : 0;
  if (target > 0) chart.series.push_back(upright(target, top, fmt::format("target {} h", digits_text(target, 6)), 1));
  if (b10 > 0) chart.series.push_back(upright(b10, top, "B10", 2));
}

std::string histogram_of(const std::string& id, const ShownScatter& s, const UncertaintyAnswer& answer) {
  // On the axis as it is drawn: bins of a life are equally wide in its logarithm.
  const bool log = s.life && s.shown(s.values.front()) > 0;
  std::vector<double> axis;
  for (const double v : s.values) axis.push_back(log ? std::log10(s.shown(v)) : v);
  const std::size_t bins = bins_of(axis);
  const double low = axis.front(), width = (axis.back() - low) / static_cast<double>(bins);
  std::vector<double> counts(bins, 0);
  for (const double v : axis) ++counts[std::min(bins - 1, static_cast<std::size_t>((v - low) / width))];
  MarkedChart chart{id, "", s.axis(), fmt::format("of {}", count_text(axis.size(), "point")), log};
  MarkedChart::Series outline{"", {}, {}};
  outline.mark = 0, outline.colour = safe_colour(0), outline.filled = true;
  const auto add = [&](double x, double y) {
    outline.x.push_back(log ? std::pow(10.0, x) : x);
    outline.y.push_back(y);
  };
  add(low, 0);
  for (std::size_t b = 0; b < bins; ++b) {
    add(low + width * static_cast<double>(b), counts[b]);
    add(low + width * static_cast<double>(b + 1), counts[b]);
  }
  add(low + width * static_cast<double>(bins), 0);
  chart.series.push_back(std::move(outline));
  add_marks(chart, s, answer, *std::max_element(counts.begin(), counts.end()));
  return svg_of(chart);
}

std::string exceedance_of(const std::string& id, const ShownScatter& s, const UncertaintyAnswer& answer) {
  MarkedChart chart{id, "", s.axis(), s.life ? "live longer, %" : "lie above, %",
                    s.life && s.shown(s.values.front()) > 0};
  MarkedChart::Series curve{"", {s.shown(s.values.front())}, {100}};
  curve.mark = 0, curve.colour = safe_colour(0);
  const std::size_t n = s.values.size(), every = (n + most_steps - 1) / most_steps;
  for (std::size_t i = (n - 1) % every; i < n; i += every) {
    const double x = s.shown(s.values[i]);
    curve.x.insert(curve.x.end(), {x, x});
    curve.y.insert(curve.y.end(), {curve.y.back(), 100 * static_cast<double>(n - 1 - i) / static_cast<double>(n)});
  }
  chart.series.push_back(std::move(curve));
  add_marks(chart, s, answer, 100);
  return svg_of(chart);
}

std::string hours_interval(const Interval& log10) {
  return hours_text(std::pow(10, log10.low)) + " to " + hours_text(std::pow(10, log10.high));
}

std::string table_of(const std::string& id, const ShownScatter& s) {
  const auto& failures = s.answer->percentiles_by_failures;
  const std::string unit = unit_of_name(s.name).empty() ? "" : ", " + unit_of_name(s.name);
  const std::string too_few = "too few points";
  Row header{"percentile", "value" + unit, "interval" + unit};
  if (s.logarithm) header.insert(header.end(), {"life, h", "interval, h"});
  if (failures) header.push_back("by failures" + unit);
  const auto interval_of = [](const std::map<std::string, Interval>& all, const std::string& key) {
    const auto at = all.find(key);
    return at == all.end() ? Interval{} : at->second;
  };
  std::vector<Row> rows;
  for (const auto& [percent, key] : percents_of(*s.answer)) {
    const double value = s.answer->percentiles.at(key);
    const Interval interval = interval_of(s.answer->percentile_intervals, key);
    const bool none = std::isnan(interval.low) && std::isnan(interval.high);
    Row row{key, digits_text(value, 5), none ? too_few : interval_text(interval.low, interval.high, 5)};
    if (s.logarithm) {
      row.push_back(hours_text(std::pow(10, value)));
      row.push_back(none ? too_few : hours_interval(interval));
    }
    if (failures) {
      const Interval ends = interval_of(*failures, key);
      row.push_back(std::isnan(ends.low) && std::isnan(ends.high) ? "anywhere" : interval_text(ends.low, ends.high, 5));
    }
    rows.push_back(std::move(row));
  }
  return rows.empty() ? "" : html_table(id, header, rows);
}

std::string quantity_html(const ShownScatter& s, const UncertaintyAnswer& answer, std::size_t index) {
  const QuantityScatter& q = *s.answer;
  std::string html = fmt::format("<h3>{}</h3>\n<p>Mean {} (standard error {}), standard deviation {}{}.",
                                 html_escaped(s.name), digits_text(q.mean, 5), digits_text(q.standard_error, 2),
                                 digits_text(q.standard_deviation), unit_text(s));
  if (q.b10_life_h && q.b10_life_h->value > 0)
    html += fmt::format(" B10 life: {} h{}.", hours_text(q.b10_life_h->value),
                        interval_in_words(*q.b10_life_h, answer.confidence, hours_text));
  if (q.missing_target && q.missing_target->value >= 0) {
    const MissedTarget& m = *q.missing_target;
    html +=
        fmt::format(" Probability of less than {} h: {} %{}", digits_text(answer.target_life_h.value_or(not_known), 6),
                    share_text(m.value), interval_in_words(m, answer.confidence, share_text));
    if (answer.failed_share > 0)
      html += fmt::format("; {} % if every point that failed holds it, {} % if every one misses it",
                          share_text(m.if_failed_hold), share_text(m.if_failed_miss));
    html += ".";
  }
  html += "</p>\n";
  if (!s.values.empty() && s.values.front() == s.values.back())
    html += "<p>It does not vary: no charts.</p>\n";
  else if (!s.values.empty() && index < most_charts)
    html += "<div class=\"charts\">" + histogram_of(fmt::format("histogram-{}", index), s, answer) +
            exceedance_of(fmt::format("exceedance-{}", index), s, answer) + "</div>\n";
  return html + table_of(fmt::format("study-percentiles-{}", index), s);
}

}  // namespace

StudyPart uncertainty_part(const StudyRecord& record, const UncertaintyAnswer& answer) {
  const std::vector<ShownScatter> all = scatters_of(record, answer);
  StudyPart part;
  part.lead = lead_of(answer, all);
  part.key_numbers = {{"samples", std::to_string(answer.samples)},
                      {"confidence, %", digits_text(100 * answer.confidence)}};
  if (answer.target_life_h) part.key_numbers.push_back({"target, h", digits_text(*answer.target_life_h, 6)});
  if (all.empty()) return part;
  std::string html =
      "<section id=\"scatter\"><h2>Scatter by quantity</h2>\n<p>Histograms count the points; the curves beside them "
      "say how many lie above. Intervals of percentiles are by order statistics, that of a probability is Wilson's.";
  if (answer.failed_share > 0)
    html += " By failures: where a percentile would be if all points that failed lay below, or all above, the rest.";
  html += "</p>\n";
  for (std::size_t i = 0; i < all.size(); ++i) html += quantity_html(all[i], answer, i);
  part.sections.push_back({"scatter", "Scatter", html + "</section>\n"});
  return part;
}

}  // namespace beltlife
