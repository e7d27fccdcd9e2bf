// The part of a page that is of stability: steps predicted and observed, and extreme cases; see study_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"
#include "studies/pages.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr double alarming_residual = 0.02;
constexpr const char* scene_case = "as the scene";

Cell share_cell(double share) { return {percent_text(share), std::abs(share) > alarming_residual}; }
/// Zero stands for a step that was not found.
std::string step_text(double seconds) { return seconds > 0 ? digits_text(seconds) : "-"; }

/// Of a divergence: when and where. What limits the step has a column of its own.
std::string shortened(const std::string& why) { return why.substr(0, why.find(": step ")); }

std::vector<std::string> schemes_of(const json& steps) {
  std::vector<std::string> names;
  for (const json& r : steps)
    if (const std::string name = text_in(r, "scheme"); std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

std::string ratios_of(const json& steps) {
  std::string words;
  for (const std::string& scheme : schemes_of(steps)) {
    double low = INFINITY, high = 0;
    for (const json& r : steps)
      if (const double ratio = number_in(r, "observed_over_predicted"); text_in(r, "scheme") == scheme && ratio > 0) {
        low = std::min(low, ratio);
        high = std::max(high, ratio);
      }
    if (high > 0)
      words += fmt::format("{}{} <strong>{} to {}</strong>", words.empty() ? "" : "; ", html_escaped(scheme),
                           digits_text(low), digits_text(high));
  }
  return words;
}

std::string lead_of(const json& steps, const json& extremes) {
  std::string words;
  if (!steps.empty()) {
    std::set<std::pair<std::string, std::string>> cases;
    for (const json& r : steps) cases.emplace(text_in(r, "case"), text_in(r, "value"));
    words = fmt::format("The longest stable step was sought in {} with {}. ", count_text(cases.size(), "case"),
                        count_text(schemes_of(steps).size(), "scheme"));
    if (const std::string ratios = ratios_of(steps); !ratios.empty())
      words += "Observed over predicted: " + ratios + ". ";
    const auto lost =
        std::count_if(steps.begin(), steps.end(), [](const json& r) { return !(number_in(r, "observed_s") > 0); });
    if (lost > 0)
      words +=
          fmt::format("<span class=\"alarm\">In {} of {} rows no stable step was found.</span> ", lost, steps.size());
  }
  std::string bad;
  std::size_t count = 0;
  for (const json& r : extremes)
    if (text_in(r, "state") != "ok") {
      bad +=
          (bad.empty() ? "" : ", ") + html_escaped(text_in(r, "case")) + " (" + html_escaped(text_in(r, "state")) + ")";
      ++count;
    }
  if (count > 0)
    words += fmt::format("<a class=\"alarm\" href=\"#extremes\">{} of {} extreme cases did not end ok</a>: {}.", count,
                         extremes.size(), bad);
  else if (!extremes.empty())
    words += extremes.size() == 1 ? "The extreme case ended ok."
                                  : fmt::format("All {} extreme cases ended ok.", extremes.size());
  return words.empty() ? "The study had no cases." : words;
}

/// The scene's own value of what is varied, which is a point of its curve too; NaN if the scene cannot be asked.
double own_value(const StudyRecord& record, const std::string& path) {
  try {
    return get_number(parse_scene(record.head.scene_text, "scene"), path);
  } catch (const BadInput&) {
    return NAN;
  }
}

std::string chart_of(const StudyRecord& record, const json& steps, const std::string& path) {
  const std::string unit = unit_of_name(path);
  MarkedChart chart{"steps-" + id_of(path), "", unit.empty() ? path : path + ", " + unit, "step, s", true, true};
  const double own = own_value(record, path);
  std::size_t i = 0;
  bool zero = false;
  for (const std::string& scheme : schemes_of(steps)) {
    std::map<double, std::pair<double, double>> by_value;
    for (const json& r : steps) {
      if (text_in(r, "scheme") != scheme) continue;
      const std::string name = text_in(r, "case"), value = text_in(r, "value");
      if (name == scene_case && value.empty() && std::isfinite(own))
        by_value.try_emplace(own, number_in(r, "predicted_s"), number_in(r, "observed_s"));
      else if (name == path)
        by_value[std::strtod(value.c_str(), nullptr)] = {number_in(r, "predicted_s"), number_in(r, "observed_s")};
    }
    constexpr int marks[] = {7, 4, 8, 12, 3};
    MarkedChart::Series predicted{scheme + ", predicted", {}, {}}, observed{scheme + ", observed", {}, {}};
    for (const auto& [value, s] : by_value) {
      zero = zero || value == 0;
      predicted.x.push_back(value);
      predicted.y.push_back(s.first);
      observed.x.push_back(value);
      observed.y.push_back(s.second);
    }
    predicted.colour = observed.colour = safe_colour(i);
    predicted.mark = 0;
    predicted.dash = static_cast<int>(i % 5) + 1;
    observed.mark = marks[i++ % std::size(marks)];
    observed.size = 1.5;
    observed.dash = 0;
    chart.series.push_back(std::move(predicted));
    chart.series.push_back(std::move(observed));
  }
  const std::string svg = svg_of(chart);
  if (svg.empty()) return "";
  return "<div><h3>" + html_escaped(path) + "</h3>\n" + svg +
         (zero ? "<p>A value of 0 has no place on the axis; the table has it.</p>" : "") + "</div>\n";
}

std::string steps_section(const StudyRecord& record, const json& steps) {
  if (steps.empty()) return "";
  std::vector<std::string> paths;
  std::vector<Row> rows;
  for (const json& r : steps) {
    const std::string name = text_in(r, "case");
    const bool varied = !text_in(r, "value").empty();
    if (varied && std::find(paths.begin(), paths.end(), name) == paths.end()) paths.push_back(name);
    const double observed = number_in(r, "observed_s"), residual = number_in(r, "residual");
    rows.push_back({name, varied ? text_in(r, "value") : "-", text_in(r, "scheme"),
                    step_text(number_in(r, "predicted_s")),
                    Cell(observed > 0 ? digits_text(observed) : "-", !(observed > 0)),
                    step_text(number_in(r, "observed_over_predicted")), observed > 0 ? share_cell(residual) : Cell("-"),
                    text_in(r, "limited_by"), step_text(number_in(r, "beyond_s")), shortened(text_in(r, "why"))});
  }
  std::string charts;
  for (const std::string& path : paths) charts += chart_of(record, steps, path);
  std::string html = "<section id=\"steps\"><h2>Longest stable step</h2>\n<p>Short trials in range " +
                     html_escaped(text_in(record.answer, "range")) +
                     ". A trial is stable if it ends and accounts for its energy. Lines are predictions, marks are "
                     "what trials found; the scene's own value stands among the others.</p>\n";
  html += "<div class=\"charts\">" + charts + "</div>\n";
  html += html_table("study-steps-words",
                     {"case", "value", "scheme", "predicted s", "observed s", "observed over predicted",
                      "residual there %", "prediction limited by", "unstable at s", "beyond it"},
                     rows);
  return html + "<p>In colour: more than 2 % of the energy not accounted for, or no stable step found.</p></section>\n";
}

std::string extremes_section(const json& extremes) {
  if (extremes.empty()) return "";
  std::vector<Row> rows;
  for (const json& r : extremes) {
    const std::string state = text_in(r, "state");
    const bool ok = state == "ok";
    rows.push_back({text_in(r, "case"), Cell(state, !ok), step_text(number_in(r, "step_s")),
                    ok ? share_cell(number_in(r, "residual")) : Cell("-"),
                    ok ? percent_text(number_in(r, "drift")) : "-", digits_text(number_in(r, "processor_s"), 2),
                    setting_text(text_in(r, "settings")), ok ? "-" : text_in(r, "reason")});
  }
  return "<section id=\"extremes\"><h2>Extreme cases</h2>\n<p>Run as scenes are, with the scene's scheme unless a case "
         "brings its own. Residual is "
         "the energy not accounted for; drift the largest change of a span's mean tension between the halves of the "
         "window.</p>\n" +
         html_table("study-extremes-words",
                    {"case", "ended", "step s", "residual %", "drift %", "processor s", "settings", "reason"}, rows) +
         "</section>\n";
}

}  // namespace

StudyPart stability_part(const StudyRecord& record) {
  const json &steps = part_of(record.answer, "steps"), &extremes = part_of(record.answer, "extremes");
  StudyPart part;
  part.lead = lead_of(steps, extremes);
  part.key_numbers = {{"range", text_in(record.answer, "range")},
                      {"rows of steps", std::to_string(steps.size())},
                      {"extreme cases", std::to_string(extremes.size())}};
  part.sections = {{"steps", "Stable steps", steps_section(record, steps)},
                   {"extremes", "Extreme cases", extremes_section(extremes)}};
  return part;
}

}  // namespace beltlife
