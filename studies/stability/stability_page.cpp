// The part of a page that is of stability: steps predicted and observed, and extreme cases; see study_parts.h.
#include "studies/stability/stability_page.h"

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

namespace beltlife {
namespace {

constexpr double alarming_residual = 0.02;
constexpr const char* scene_case = "as the scene";

Cell share_cell(double share) { return {percent_text(share), std::abs(share) > alarming_residual}; }
/// Zero stands for a step that was not found.
std::string step_text(double seconds) { return seconds > 0 ? digits_text(seconds) : "none"; }

/// Of a divergence: when and where. What limits the step has a column of its own.
std::string shortened(const std::string& why) { return why.substr(0, why.find(": step ")); }

std::vector<std::string> schemes_of(const std::vector<StableStep>& steps) {
  std::vector<std::string> names;
  for (const StableStep& r : steps)
    if (std::find(names.begin(), names.end(), r.scheme) == names.end()) names.push_back(r.scheme);
  return names;
}

std::string ratios_of(const std::vector<StableStep>& steps) {
  std::string words;
  for (const std::string& scheme : schemes_of(steps)) {
    double low = INFINITY, high = 0;
    for (const StableStep& r : steps)
      if (const double ratio = r.observed_over_predicted; r.scheme == scheme && ratio > 0) {
        low = std::min(low, ratio);
        high = std::max(high, ratio);
      }
    if (high > 0)
      words += fmt::format("{}{} <strong>{} to {}</strong>", words.empty() ? "" : "; ", html_escaped(scheme),
                           digits_text(low), digits_text(high));
  }
  return words;
}

std::string lead_of(const std::vector<StableStep>& steps, const std::vector<ExtremeCase>& extremes) {
  std::string words;
  if (!steps.empty()) {
    std::set<std::pair<std::string, std::string>> cases;
    for (const StableStep& r : steps) cases.emplace(r.name, r.value);
    words = fmt::format("The longest stable step was sought in {} with {}. ", count_text(cases.size(), "case"),
                        count_text(schemes_of(steps).size(), "scheme"));
    if (const std::string ratios = ratios_of(steps); !ratios.empty())
      words += "Observed over predicted: " + ratios + ". ";
    const auto lost =
        std::count_if(steps.begin(), steps.end(), [](const StableStep& r) { return !(r.observed_s > 0); });
    if (lost > 0)
      words +=
          fmt::format("<span class=\"alarm\">In {} of {} rows no stable step was found.</span> ", lost, steps.size());
  }
  std::string bad;
  std::size_t count = 0;
  for (const ExtremeCase& r : extremes)
    if (r.state != "ok") {
      bad += (bad.empty() ? "" : ", ") + html_escaped(r.name) + " (" + html_escaped(r.state) + ")";
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

std::string chart_of(const StudyRecord& record, const std::vector<StableStep>& steps, const std::string& path) {
  const std::string unit = unit_of_name(path);
  MarkedChart chart{"steps-" + id_of(path), "", unit.empty() ? path : path + ", " + unit, "step, s", true, true};
  const double own = own_value(record, path);
  std::size_t i = 0;
  bool zero = false;
  for (const std::string& scheme : schemes_of(steps)) {
    std::map<double, std::pair<double, double>> by_value;
    for (const StableStep& r : steps) {
      if (r.scheme != scheme) continue;
      if (r.name == scene_case && r.value.empty() && std::isfinite(own))
        by_value.try_emplace(own, r.predicted_s, r.observed_s);
      else if (r.name == path)
        by_value[std::strtod(r.value.c_str(), nullptr)] = {r.predicted_s, r.observed_s};
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

Row row_of(const StableStep& r) {
  const bool found = r.observed_s > 0;
  return {r.name,
          r.value.empty() ? "the scene's own" : r.value,
          r.scheme,
          step_text(r.predicted_s),
          Cell(step_text(r.observed_s), !found),
          step_text(r.observed_over_predicted),
          found ? share_cell(r.residual) : Cell("no stable step"),
          r.limited_by,
          step_text(r.beyond_s),
          shortened(r.why)};
}

std::string steps_section(const StudyRecord& record, const StabilityAnswer& answer) {
  const std::vector<StableStep>& steps = answer.steps;
  if (steps.empty()) return "";
  std::vector<std::string> paths;
  std::vector<Row> rows;
  for (const StableStep& r : steps) {
    if (!r.value.empty() && std::find(paths.begin(), paths.end(), r.name) == paths.end()) paths.push_back(r.name);
    rows.push_back(row_of(r));
  }
  std::string charts;
  for (const std::string& path : paths) charts += chart_of(record, steps, path);
  std::string html = "<section id=\"steps\"><h2>Longest stable step</h2>\n<p>Short trials in range " +
                     html_escaped(answer.range) +
                     ". A trial is stable if it ends and accounts for its energy. Lines are predictions, marks are "
                     "what trials found; the scene's own value stands among the others.</p>\n";
  html += "<div class=\"charts\">" + charts + "</div>\n";
  html += html_table("study-steps-words",
                     {"case", "value", "scheme", "predicted s", "observed s", "observed over predicted",
                      "residual there %", "prediction limited by", "unstable at s", "beyond it"},
                     rows);
  return html + "<p>In colour: more than 2 % of the energy not accounted for, or no stable step found.</p></section>\n";
}

std::string extremes_section(const std::vector<ExtremeCase>& extremes) {
  if (extremes.empty()) return "";
  std::vector<Row> rows;
  for (const ExtremeCase& r : extremes) {
    const bool ok = r.state == "ok";
    rows.push_back({r.name, Cell(r.state, !ok), step_text(r.step_s), ok ? share_cell(r.residual) : Cell("did not end"),
                    ok ? percent_text(r.drift) : "did not end", digits_text(r.processor_s, 2), setting_text(r.settings),
                    ok ? "ran to its end" : r.reason});
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

StudyPart stability_part(const StudyRecord& record, const StabilityAnswer& answer) {
  StudyPart part;
  part.lead = lead_of(answer.steps, answer.extremes);
  part.key_numbers = {{"range", answer.range},
                      {"rows of steps", std::to_string(answer.steps.size())},
                      {"extreme cases", std::to_string(answer.extremes.size())}};
  part.sections = {{"steps", "Stable steps", steps_section(record, answer)},
                   {"extremes", "Extreme cases", extremes_section(answer.extremes)}};
  return part;
}

}  // namespace beltlife
