// The sections that pages of all studies have: failures, points, provenance; see study_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr std::size_t listed_failures = 50, listed_reasons = 20, most_quantities = 6, most_parameters = 4,
                      most_marks = 1000;

/// A reason without its numbers, so that the same mishap at another time or place counts as the same; "idler_3" stays.
std::string kind_of_reason(const std::string& reason) {
  static const std::regex number(R"(\b\d+(\.\d+)?(e[+-]?\d+)?\b)");
  return std::regex_replace(reason, number, "...");
}

bool varies(const std::vector<double>& v) {
  return std::any_of(v.begin(), v.end(), [&](double x) { return x != v.front(); });
}

/// Settings of the parameter in the points that are ok; empty unless all are numbers and some differ.
std::vector<double> numbers_of(const std::vector<const StudyPoint*>& points, std::size_t parameter) {
  std::vector<double> v;
  for (const StudyPoint* p : points) {
    if (parameter >= p->settings.size() || !std::holds_alternative<double>(p->settings[parameter])) return {};
    v.push_back(number_of(p->settings[parameter]));
  }
  return varies(v) ? v : std::vector<double>{};
}

std::string folded(const char* id, const char* summary, const std::string& text) {
  if (text.empty()) return "";
  return fmt::format("<details id=\"{}\"><summary>{}</summary><pre>{}</pre></details>\n", id, summary,
                     html_escaped(text));
}

}  // namespace

Section failures_section(const StudyRecord& record, const std::string& note) {
  std::map<std::pair<PointState, std::string>, std::pair<std::size_t, std::size_t>> reasons;  // count, first number
  std::vector<Row> rows;
  std::size_t failed = 0;
  for (const StudyPoint& p : record.points) {
    if (p.answer.ok()) continue;
    ++reasons.try_emplace({p.answer.state, kind_of_reason(p.answer.reason)}, 0, p.number).first->second.first;
    if (++failed > listed_failures) continue;
    Row row{std::to_string(p.number), std::string(to_string(p.answer.state))};
    for (const Setting& s : p.settings) row.push_back(setting_text(s));
    row.push_back(p.answer.reason);
    rows.push_back(std::move(row));
  }
  if (failed == 0) return {"failures", "", ""};
  std::vector<std::pair<std::size_t, Row>> counted;
  for (const auto& [what, times] : reasons)
    counted.push_back(
        {times.first,
         {std::to_string(times.first), std::string(to_string(what.first)), std::to_string(times.second), what.second}});
  std::stable_sort(counted.begin(), counted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Row> groups;
  for (const auto& [count, row] : counted)
    if (groups.size() < listed_reasons) groups.push_back(row);
  Row header{"point", "state"};
  for (const std::string& name : record.head.parameters) header.push_back(name);
  header.push_back("reason");
  std::string html = "<section id=\"failures\"><h2>Points that are not ok</h2>\n<p>" +
                     fmt::format("{} of {}. ", failed, record.points.size()) + note + "</p>\n";
  html += html_table("failures-by-reason-words", {"points", "state", "the first", "reason"}, groups);
  if (counted.size() > groups.size())
    html += fmt::format("<p>{} rarer reasons are left out.</p>\n", counted.size() - groups.size());
  html += fmt::format("<details><summary>{}</summary>\n",
                      failed > listed_failures ? fmt::format("The first {}", listed_failures) : "All of them");
  html += html_table("failures-words", header, rows) + "</details></section>\n";
  return {"failures", "Points not ok", html};
}

Section points_section(const StudyRecord& record) {
  std::vector<const StudyPoint*> points;
  for (const StudyPoint& p : record.points)
    if (p.answer.ok()) points.push_back(&p);
  if (points.empty()) return {"points", "", ""};
  struct Column {
    std::string name;
    std::vector<double> values;
  };
  std::vector<Column> parameters;
  std::size_t varied = 0;
  for (std::size_t i = 0; i < record.head.parameters.size(); ++i)
    if (std::vector<double> v = numbers_of(points, i); !v.empty() && ++varied <= most_parameters)
      parameters.push_back({record.head.parameters[i], std::move(v)});
  std::string charts;
  const std::size_t shown = std::min(record.head.quantities.size(), most_quantities);
  // Every so manyth point: thousands of marks say no more, but weigh.
  const std::size_t every = (points.size() + most_marks - 1) / most_marks;
  for (std::size_t q = 0; q < shown; ++q)
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      MarkedChart chart{fmt::format("points-{}-{}", q, i), record.head.quantities[q], with_unit(parameters[i].name),
                        unit_of_name(record.head.quantities[q])};
      chart.width = 400, chart.height = 260;
      MarkedChart::Series marks;
      marks.colour = safe_colour(q), marks.dash = 0, marks.size = 0.7;
      for (std::size_t k = 0; k < points.size(); k += every) {
        if (q >= points[k]->answer.values.size()) continue;
        marks.x.push_back(parameters[i].values[k]);
        marks.y.push_back(points[k]->answer.values[q]);
      }
      chart.series.push_back(std::move(marks));
      charts += svg_of(chart);
    }
  if (charts.empty()) return {"points", "", ""};
  std::string words = "Quantities against parameters, all points that are ok";
  if (every > 1) words = fmt::format("Quantities against parameters, one in {} of the points that are ok", every);
  if (varied > parameters.size())
    words += fmt::format("; the first {} of {} parameters that vary", parameters.size(), varied);
  if (shown < record.head.quantities.size())
    words += fmt::format("; the first {} of {} quantities", shown, record.head.quantities.size());
  return {"points", "Points",
          "<section id=\"points\"><h2>Points</h2>\n<p>" + words + ".</p>\n<details open><summary>Charts</summary>\n" +
              "<div class=\"charts\">" + charts + "</div></details></section>\n"};
}

Section study_provenance_section(const StudyRecord& record, const std::string& name) {
  const StudyHead& h = record.head;
  std::vector<Row> rows{{"file", name},
                        {"command", h.command_line},
                        {"study", h.study_path},
                        {"scene", h.scene_path.empty() ? "none: another program answers" : h.scene_path},
                        {"beltlife", h.version + " (" + h.revision + "), " + h.compiler}};
  if (!h.lanes.empty()) rows.push_back({"vector lanes hold", h.lanes == "arcs" ? "arcs of one drive" : h.lanes});
  return {"provenance", "How these numbers came about",
          "<section id=\"provenance\"><h2>How these numbers came about</h2>\n" +
              html_table("provenance-table", {"", ""}, rows) + folded("study", "Study file", h.study_text) +
              folded("scene", "Scene", h.scene_text) + "</section>\n"};
}

}  // namespace beltlife
