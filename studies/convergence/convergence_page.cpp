// The part of a page that is of convergence: error against run time by group, the cheapest settings; see study_parts.h.
#include "studies/convergence/convergence_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr const char* logarithmic = "log10 life";  // the group whose errors are differences of a logarithm
constexpr const char* implicit_scheme = "linearly_implicit";
constexpr std::array bounds{"1 %", "5 %"};
constexpr double vague_band = 0.05;  // a reference that may be off by more judges no setting

using Settings = std::vector<SettingAnswer>;

double error_of(const std::optional<GroupErrors>& errors, const std::string& group) {
  if (!errors) return not_known;
  const auto at = errors->find(group);
  return at == errors->end() ? not_known : at->second.error;
}

double band_of(const ConvergenceAnswer& answer, const std::string& group) {
  return error_of(answer.reference_band, group);
}

const CheapestSetting* best_of(const ConvergenceAnswer& answer, const std::string& group, const std::string& bound) {
  const auto of_group = answer.cheapest.find(group);
  if (of_group == answer.cheapest.end()) return nullptr;
  const auto at = of_group->second.find(bound);
  return at == of_group->second.end() || !at->second.value ? nullptr : &*at->second.value;
}

/// Whether the study ran the explicit schemes at the stable step itself (factor 1); its file as written says so.
bool has_stable_steps(const std::string& study_text) {
  constexpr std::string_view key = "explicit_factors = [";
  const std::size_t at = study_text.find(key);
  if (at == study_text.npos) return false;
  for (const char* c = study_text.c_str() + at + key.size(); *c && *c != ']';) {
    char* end = nullptr;
    const double factor = std::strtod(c, &end);
    if (end == c) {
      ++c;
      continue;
    }
    if (factor == 1) return true;
    c = end;
  }
  return false;
}

/// Indices of the explicit schemes' settings at the stable step: on each mesh the longest.
std::set<std::size_t> at_stable_step(const StudyRecord& record, const Settings& settings) {
  std::set<std::size_t> found;
  if (!has_stable_steps(record.head.study_text)) return found;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const SettingAnswer& s = settings[i];
    if (s.scheme == implicit_scheme) continue;
    const bool longest = std::none_of(settings.begin(), settings.end(), [&](const SettingAnswer& o) {
      return o.scheme == s.scheme && o.elements == s.elements && o.step_s > s.step_s;
    });
    if (longest) found.insert(i);
  }
  return found;
}

/// One curve for each scheme and mesh: colour by scheme, mark and dash by mesh.
std::vector<MarkedChart::Series> curves_of(const Settings& settings, const std::string& group,
                                           const std::set<std::size_t>& stable) {
  std::vector<std::string> schemes;
  std::vector<int> meshes;
  const auto index = [](auto& list, const auto& what) {
    const auto at = std::find(list.begin(), list.end(), what);
    if (at != list.end()) return static_cast<std::size_t>(at - list.begin());
    list.push_back(what);
    return list.size() - 1;
  };
  struct Curve {
    std::size_t scheme, mesh;
    std::vector<const SettingAnswer*> settings;
  };
  std::vector<Curve> curves;
  MarkedChart::Series rings{"at its stable step", {}, {}};
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const SettingAnswer& s = settings[i];
    const std::size_t scheme = index(schemes, s.scheme), mesh = index(meshes, s.elements);
    auto curve = std::find_if(curves.begin(), curves.end(),
                              [&](const Curve& c) { return c.scheme == scheme && c.mesh == mesh; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{scheme, mesh, {}});
    curve->settings.push_back(&s);
    if (stable.contains(i)) {
      rings.x.push_back(s.processor_s);
      rings.y.push_back(100 * error_of(s.errors, group));
    }
  }
  std::vector<MarkedChart::Series> all;
  for (Curve& c : curves) {
    std::sort(c.settings.begin(), c.settings.end(),
              [](const SettingAnswer* a, const SettingAnswer* b) { return a->step_s < b->step_s; });
    constexpr int marks[] = {7, 5, 9, 11, 13, 3};
    MarkedChart::Series series{fmt::format("{}, {}", schemes[c.scheme], meshes[c.mesh]), {}, {}};
    for (const SettingAnswer* s : c.settings) {
      series.x.push_back(s->processor_s);
      series.y.push_back(100 * error_of(s->errors, group));
      series.names.push_back(fmt::format("{:.2g}", 1e6 * s->step_s));
    }
    series.colour = safe_colour(c.scheme);
    series.mark = marks[c.mesh % std::size(marks)];
    series.dash = static_cast<int>(c.mesh % 5) + 1;
    all.push_back(std::move(series));
  }
  rings.mark = 6, rings.size = 2.2, rings.dash = 0;
  all.push_back(std::move(rings));
  return all;
}

std::string orders_of(const ConvergenceAnswer& answer, const std::string& group) {
  std::string words;
  const auto orders = answer.orders.find(group);
  if (orders != answer.orders.end())
    for (const auto& [scheme, o] : orders->second) {
      std::string of;
      if (o.step) of += fmt::format("{} in the step", digits_text(*o.step, 2));
      if (o.mesh) of += fmt::format("{}{} in the mesh", of.empty() ? "" : " and ", digits_text(*o.mesh, 2));
      if (!of.empty()) words += fmt::format("{}{}: {}", words.empty() ? "" : "; ", html_escaped(scheme), of);
    }
  return words.empty() ? "No order was observed." : "Observed orders. " + words + ".";
}

std::string charts_section(const StudyRecord& record, const ConvergenceAnswer& answer) {
  const Settings& settings = answer.settings;
  const std::set<std::size_t> stable = at_stable_step(record, settings);
  std::string charts;
  for (const std::string& group : answer.groups) {
    MarkedChart chart{"errors-" + id_of(group),
                      "",
                      "processor time, s",
                      group == logarithmic ? "error, hundredths of a decade" : "error, %",
                      true,
                      true,
                      curves_of(settings, group, stable)};
    chart.levels.push_back({"reference's own band", 100 * band_of(answer, group), 2});
    chart.levels.push_back({"noise floor", 100 * error_of(answer.noise_floor, group), 3});
    const std::string svg = svg_of(chart);
    charts += "<div><h3>" + html_escaped(group) + "</h3>\n" + (svg.empty() ? "<p>No error above zero.</p>\n" : svg) +
              "<p>" + orders_of(answer, group) + "</p></div>\n";
  }
  if (charts.empty() || !answer.reference) return "";
  return "<section id=\"errors\"><h2>Error against run time</h2>\n<p>The largest error of each group of quantities, "
         "against " +
         html_escaped(*answer.reference) +
         ", which has none itself and stands in no chart. A curve is a scheme on a mesh; numbers at its points are "
         "steps in microseconds. Below the dashed lines errors say nothing: there, the reference's own uncertainty and "
         "the scatter between crank phases are as large." +
         (stable.empty() ? "" : " Rings: an explicit scheme at its predicted stable step.") +
         "</p>\n<div class=\"charts\">" + charts + "</div></section>\n";
}

/// An error as a cell; a setting without one has failed, or the group was not judged.
std::string error_text(const std::optional<GroupErrors>& errors, const std::string& group) {
  const double error = error_of(errors, group);
  return std::isnan(error) ? (errors ? "not judged" : "failed") : percent_text(error);
}

std::string settings_section(const ConvergenceAnswer& answer) {
  Row header{"scheme", "elements", "step s", "steps", "evaluations", "processor s", "simulated s per s"};
  for (const std::string& g : answer.groups) header.push_back(g + " %");
  header.push_back("ended");
  std::vector<Row> rows;
  for (const SettingAnswer& s : answer.settings) {
    const bool reference = s.name == answer.reference;
    Row row{s.scheme,
            std::to_string(s.elements),
            digits_text(s.step_s),
            html_number(s.steps),
            html_number(s.evaluations),
            digits_text(s.processor_s),
            digits_text(s.simulated_s_per_s)};
    for (const std::string& g : answer.groups) row.push_back(reference ? "0" : error_text(s.errors, g));
    row.push_back(s.failure ? Cell(*s.failure, true) : Cell(reference ? "ok, the reference" : "ok"));
    rows.push_back(std::move(row));
  }
  for (const auto& [name, errors] :
       {std::pair{"reference's own band", &answer.reference_band}, {"noise floor", &answer.noise_floor}}) {
    if (!*errors) continue;
    Row row{name, "", "", "", "", "", ""};
    for (const std::string& g : answer.groups) row.push_back(error_text(*errors, g));
    row.push_back("");
    rows.push_back(std::move(row));
  }
  return "<section id=\"settings\"><h2>Settings</h2>\n<p>Errors of log10 life are in hundredths of a decade.</p>\n" +
         html_table("study-settings-words", header, rows) + "</section>\n";
}

std::string cheapest_section(const ConvergenceAnswer& answer) {
  if (answer.cheapest.empty()) return "";
  std::vector<std::string> groups = answer.groups;
  groups.push_back("all");
  std::vector<Row> rows;
  for (const std::string& g : groups) {
    Row row{g == "all" ? "all of them" : g};
    for (const char* bound : bounds) {
      const CheapestSetting* best = best_of(answer, g, bound);
      row.push_back(best ? Cell(best->setting) : Cell("none of these", true));
      row.push_back(best ? digits_text(best->processor_s) : "");
    }
    const double band = band_of(answer, g);
    row.push_back(Cell(std::isnan(band) ? (g == "all" ? "" : "not judged") : percent_text(band), band > vague_band));
    rows.push_back(std::move(row));
  }
  return "<section id=\"cheapest\"><h2>Cheapest settings</h2>\n" +
         html_table("study-cheapest",
                    {"group", "within 1 %", "processor s", "within 5 %", "processor s", "reference's band %"}, rows) +
         "</section>\n";
}

std::string quantities_section(const StudyRecord& record, const ConvergenceAnswer& answer) {
  if (answer.quantities.empty()) return "";
  const std::set<std::string> not_judged(answer.not_judged.begin(), answer.not_judged.end());
  std::vector<Row> rows;
  for (const std::string& name : record.head.quantities) {
    const auto at = answer.quantities.find(name);
    if (at == answer.quantities.end()) continue;
    const QuantityReference& q = at->second;
    const bool judged = !not_judged.contains(name);
    rows.push_back({name, q.group, digits_text(q.reference, 5), digits_text(q.band, 2), digits_text(q.noise, 2),
                    unit_of_name(name), Cell(judged ? "yes" : "no", !judged)});
  }
  std::string html = "<section id=\"quantities\"><h2>Quantities</h2>\n";
  if (!answer.not_judged.empty()) {
    html += "<p>Not judged, because a tenth of their value or more is noise:</p>\n<ul id=\"not-judged\">";
    for (const std::string& name : answer.not_judged) html += "<li>" + html_escaped(name) + "</li>\n";
    html += "</ul>\n";
  }
  return html + "<details><summary>" + count_text(rows.size(), "value") + " of the reference</summary>\n" +
         html_table("study-quantities", {"quantity", "group", "reference", "band", "noise", "unit", "judged"}, rows) +
         "</details></section>\n";
}

std::string lead_of(const ConvergenceAnswer& answer) {
  if (answer.error) return error_words(answer);
  std::string words = fmt::format("Of {}, the cheapest that keeps all groups of quantities ",
                                  count_text(answer.settings.size(), "setting"));
  for (const char* bound : bounds) {
    const CheapestSetting* best = best_of(answer, "all", bound);
    words += fmt::format("{} {} is ", bound == bounds[0] ? "within" : "; within", bound);
    words += best ? fmt::format("<strong>{}</strong> ({} of processor time)", html_escaped(best->setting),
                                duration_text(best->processor_s))
                  : std::string("<span class=\"alarm\">none of these</span>");
  }
  const auto vague = std::count_if(answer.groups.begin(), answer.groups.end(),
                                   [&](const auto& g) { return band_of(answer, g) > vague_band; });
  if (vague > 0)
    words += fmt::format(
        ". <a class=\"alarm\" href=\"#cheapest\">The reference itself is not known to {} % in {} of {} groups</a>: "
        "finer meshes or shorter steps would tell",
        digits_text(100 * vague_band), vague, answer.groups.size());
  return words + ". ";
}

}  // namespace

StudyPart convergence_part(const StudyRecord& record, const ConvergenceAnswer& answer) {
  StudyPart part;
  part.lead = lead_of(answer);
  const auto failed = std::count_if(answer.settings.begin(), answer.settings.end(),
                                    [](const SettingAnswer& s) { return s.failure.has_value(); });
  part.key_numbers = {{"processor", answer.processor + ", one thread"},
                      {"built by", record.head.compiler + ", revision " + record.head.revision},
                      {"reference", answer.reference.value_or("none")},
                      {"simulated by each setting", duration_text(answer.simulated_s)},
                      {"settings", std::to_string(answer.settings.size())},
                      {"settings that failed", Cell(std::to_string(failed), failed > 0)},
                      {"quantities not judged", std::to_string(answer.not_judged.size())}};
  part.sections = {{"errors", "Errors", charts_section(record, answer)},
                   {"cheapest", "Cheapest", cheapest_section(answer)},
                   {"settings", "Settings", settings_section(answer)},
                   {"quantities", "Quantities", quantities_section(record, answer)}};
  return part;
}

}  // namespace beltlife
