// The part of a page that is of convergence: error against run time by group, the cheapest settings; see study_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"
#include "studies/pages.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr const char* logarithmic = "log10 life";  // the group whose errors are differences of a logarithm
constexpr const char* implicit_scheme = "linearly_implicit";
constexpr std::array bounds{"1 %", "5 %"};
constexpr double vague_band = 0.05;  // a reference that may be off by more judges no setting

double error_of(const json& setting, const std::string& group) {
  return number_in(part_of(part_of(setting, "errors"), group), "error");
}

double band_of(const json& answer, const std::string& group) {
  return number_in(part_of(part_of(answer, "reference_band"), group), "error");
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
std::set<std::size_t> at_stable_step(const StudyRecord& record, const json& settings) {
  std::set<std::size_t> found;
  if (!has_stable_steps(record.head.study_text)) return found;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const json& s = settings[i];
    if (text_in(s, "scheme") == implicit_scheme) continue;
    const bool longest = std::none_of(settings.begin(), settings.end(), [&](const json& o) {
      return text_in(o, "scheme") == text_in(s, "scheme") && number_in(o, "elements") == number_in(s, "elements") &&
             number_in(o, "step_s") > number_in(s, "step_s");
    });
    if (longest) found.insert(i);
  }
  return found;
}

/// One curve for each scheme and mesh: colour by scheme, mark and dash by mesh.
std::vector<MarkedChart::Series> curves_of(const json& settings, const std::string& group,
                                           const std::set<std::size_t>& stable) {
  std::vector<std::string> schemes;
  std::vector<double> meshes;
  const auto index = [](auto& list, const auto& what) {
    const auto at = std::find(list.begin(), list.end(), what);
    if (at != list.end()) return static_cast<std::size_t>(at - list.begin());
    list.push_back(what);
    return list.size() - 1;
  };
  struct Curve {
    std::size_t scheme, mesh;
    std::vector<const json*> settings;
  };
  std::vector<Curve> curves;
  MarkedChart::Series rings{"at its stable step", {}, {}};
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const json& s = settings[i];
    const double elements = number_in(s, "elements");
    if (std::isnan(elements)) continue;
    const std::size_t scheme = index(schemes, text_in(s, "scheme")), mesh = index(meshes, elements);
    auto curve = std::find_if(curves.begin(), curves.end(),
                              [&](const Curve& c) { return c.scheme == scheme && c.mesh == mesh; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{scheme, mesh, {}});
    curve->settings.push_back(&s);
    if (stable.contains(i)) {
      rings.x.push_back(number_in(s, "processor_s"));
      rings.y.push_back(100 * error_of(s, group));
    }
  }
  std::vector<MarkedChart::Series> all;
  for (Curve& c : curves) {
    std::sort(c.settings.begin(), c.settings.end(),
              [](const json* a, const json* b) { return number_in(*a, "step_s") < number_in(*b, "step_s"); });
    constexpr int marks[] = {7, 5, 9, 11, 13, 3};
    MarkedChart::Series series{fmt::format("{}, {:g}", schemes[c.scheme], meshes[c.mesh]), {}, {}};
    for (const json* s : c.settings) {
      series.x.push_back(number_in(*s, "processor_s"));
      series.y.push_back(100 * error_of(*s, group));
      series.names.push_back(fmt::format("{:.2g}", 1e6 * number_in(*s, "step_s")));
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

std::string orders_of(const json& answer, const std::string& group) {
  std::string words;
  const json& orders = part_of(part_of(answer, "orders"), group);
  if (orders.is_object())
    for (const auto& [scheme, o] : orders.items()) {
      std::string of;
      if (const double p = number_in(o, "step"); !std::isnan(p)) of += fmt::format("{} in the step", digits_text(p, 2));
      if (const double p = number_in(o, "mesh"); !std::isnan(p))
        of += fmt::format("{}{} in the mesh", of.empty() ? "" : " and ", digits_text(p, 2));
      if (!of.empty()) words += fmt::format("{}{}: {}", words.empty() ? "" : "; ", html_escaped(scheme), of);
    }
  return words.empty() ? "No order was observed." : "Observed orders. " + words + ".";
}

std::string charts_section(const StudyRecord& record, const json& settings) {
  const std::set<std::size_t> stable = at_stable_step(record, settings);
  std::string charts;
  for (const std::string& group : texts_in(record.answer, "groups")) {
    MarkedChart chart{"errors-" + id_of(group),
                      "",
                      "processor time, s",
                      group == logarithmic ? "error, hundredths of a decade" : "error, %",
                      true,
                      true,
                      curves_of(settings, group, stable)};
    const auto level = [&](const char* key, const char* label, int dash) {
      chart.levels.push_back({label, 100 * number_in(part_of(part_of(record.answer, key), group), "error"), dash});
    };
    level("reference_band", "reference's own band", 2);
    level("noise_floor", "noise floor", 3);
    const std::string svg = svg_of(chart);
    charts += "<div><h3>" + html_escaped(group) + "</h3>\n" + (svg.empty() ? "<p>No error above zero.</p>\n" : svg) +
              "<p>" + orders_of(record.answer, group) + "</p></div>\n";
  }
  if (charts.empty() || part_of(record.answer, "reference").is_null()) return "";
  return "<section id=\"errors\"><h2>Error against run time</h2>\n<p>The largest error of each group of quantities, "
         "against " +
         html_escaped(text_in(record.answer, "reference")) +
         ", which has none itself and stands in no chart. A curve is a scheme on a mesh; numbers at its points are "
         "steps in microseconds. Below the dashed lines errors say nothing: there, the reference's own uncertainty and "
         "the scatter between crank phases are as large." +
         (stable.empty() ? "" : " Rings: an explicit scheme at its predicted stable step.") +
         "</p>\n<div class=\"charts\">" + charts + "</div></section>\n";
}

std::string settings_section(const json& answer, const json& settings) {
  const std::vector<std::string> groups = texts_in(answer, "groups");
  Row header{"scheme", "elements", "step s", "steps", "evaluations", "processor s", "simulated s per s"};
  for (const std::string& g : groups) header.push_back(g + " %");
  header.push_back("ended");
  std::vector<Row> rows;
  for (const json& s : settings) {
    const bool reference = text_in(s, "name") == text_in(answer, "reference");
    const std::string failure = text_in(s, "failure");
    Row row{text_in(s, "scheme"),
            digits_text(number_in(s, "elements"), 6),
            digits_text(number_in(s, "step_s")),
            html_number(number_in(s, "steps")),
            html_number(number_in(s, "evaluations")),
            digits_text(number_in(s, "processor_s")),
            digits_text(number_in(s, "simulated_s_per_s"))};
    for (const std::string& g : groups) row.push_back(reference ? std::string("-") : percent_text(error_of(s, g)));
    row.push_back(failure.empty() ? Cell(reference ? "ok, the reference" : "ok") : Cell(failure, true));
    rows.push_back(std::move(row));
  }
  for (const auto& [name, key] :
       {std::pair{"reference's own band", "reference_band"}, {"noise floor", "noise_floor"}}) {
    if (part_of(answer, key).is_null()) continue;
    Row row{name, "-", "-", "-", "-", "-", "-"};
    for (const std::string& g : groups)
      row.push_back(percent_text(number_in(part_of(part_of(answer, key), g), "error")));
    row.push_back("-");
    rows.push_back(std::move(row));
  }
  return "<section id=\"settings\"><h2>Settings</h2>\n<p>Errors of log10 life are in hundredths of a decade.</p>\n" +
         html_table("study-settings-words", header, rows) + "</section>\n";
}

std::string cheapest_section(const json& answer) {
  const json& cheapest = part_of(answer, "cheapest");
  if (!cheapest.is_object()) return "";
  std::vector<std::string> groups = texts_in(answer, "groups");
  groups.push_back("all");
  std::vector<Row> rows;
  for (const std::string& g : groups) {
    Row row{g == "all" ? "all of them" : g};
    for (const char* bound : bounds) {
      const json& best = part_of(part_of(cheapest, g), bound);
      row.push_back(best.is_null() ? Cell("none of these", true) : Cell(text_in(best, "setting")));
      row.push_back(digits_text(number_in(best, "processor_s")));
    }
    const double band = band_of(answer, g);  // none of all groups together
    row.push_back(Cell(percent_text(band), band > vague_band));
    rows.push_back(std::move(row));
  }
  return "<section id=\"cheapest\"><h2>Cheapest settings</h2>\n" +
         html_table("study-cheapest",
                    {"group", "within 1 %", "processor s", "within 5 %", "processor s", "reference's band %"}, rows) +
         "</section>\n";
}

std::string quantities_section(const StudyRecord& record) {
  const json& quantities = part_of(record.answer, "quantities");
  if (!quantities.is_object()) return "";
  const std::vector<std::string> drowned = texts_in(record.answer, "not_judged");
  const std::set<std::string> not_judged(drowned.begin(), drowned.end());
  std::vector<Row> rows;
  for (const std::string& name : record.head.quantities) {
    const json& q = part_of(quantities, name);
    if (q.is_null()) continue;
    const bool judged = !not_judged.contains(name);
    rows.push_back({name, text_in(q, "group"), digits_text(number_in(q, "reference"), 5),
                    digits_text(number_in(q, "band"), 2), digits_text(number_in(q, "noise"), 2), unit_of_name(name),
                    Cell(judged ? "yes" : "no", !judged)});
  }
  std::string html = "<section id=\"quantities\"><h2>Quantities</h2>\n";
  if (!drowned.empty()) {
    html += "<p>Not judged, because a tenth of their value or more is noise:</p>\n<ul id=\"not-judged\">";
    for (const std::string& name : drowned) html += "<li>" + html_escaped(name) + "</li>\n";
    html += "</ul>\n";
  }
  return html + "<details><summary>" + count_text(rows.size(), "value") + " of the reference</summary>\n" +
         html_table("study-quantities", {"quantity", "group", "reference", "band", "noise", "unit", "judged"}, rows) +
         "</details></section>\n";
}

std::string lead_of(const json& answer) {
  if (const std::string error = text_in(answer, "error"); !error.empty())
    return "<span class=\"alarm\">There is no answer: " + html_escaped(error) + "</span>. ";
  std::string words = fmt::format("Of {}, the cheapest that keeps all groups of quantities ",
                                  count_text(part_of(answer, "settings").size(), "setting"));
  for (const char* bound : bounds) {
    const json& best = part_of(part_of(part_of(answer, "cheapest"), "all"), bound);
    words += fmt::format("{} {} is ", bound == bounds[0] ? "within" : "; within", bound);
    words += best.is_null()
                 ? std::string("<span class=\"alarm\">none of these</span>")
                 : fmt::format("<strong>{}</strong> ({} of processor time)", html_escaped(text_in(best, "setting")),
                               duration_text(number_in(best, "processor_s")));
  }
  const std::vector<std::string> groups = texts_in(answer, "groups");
  const auto vague =
      std::count_if(groups.begin(), groups.end(), [&](const auto& g) { return band_of(answer, g) > vague_band; });
  if (vague > 0)
    words += fmt::format(
        ". <a class=\"alarm\" href=\"#cheapest\">The reference itself is not known to {} % in {} of {} groups</a>: "
        "finer meshes or shorter steps would tell",
        digits_text(100 * vague_band), vague, groups.size());
  return words + ". ";
}

}  // namespace

StudyPart convergence_part(const StudyRecord& record) {
  const json &answer = record.answer, &settings = part_of(answer, "settings");
  StudyPart part;
  part.lead = lead_of(answer);
  const auto failed =
      std::count_if(settings.begin(), settings.end(), [](const json& s) { return s.contains("failure"); });
  part.key_numbers = {{"processor", text_in(answer, "processor") + ", one thread"},
                      {"built by", record.head.compiler + ", revision " + record.head.revision},
                      {"reference", text_in(answer, "reference").empty() ? "-" : text_in(answer, "reference")},
                      {"simulated by each setting", duration_text(number_in(answer, "simulated_s"))},
                      {"settings", std::to_string(settings.size())},
                      {"settings that failed", Cell(std::to_string(failed), failed > 0)},
                      {"quantities not judged", std::to_string(part_of(answer, "not_judged").size())}};
  part.sections = {{"errors", "Errors", charts_section(record, settings)},
                   {"cheapest", "Cheapest", cheapest_section(answer)},
                   {"settings", "Settings", settings_section(answer, settings)},
                   {"quantities", "Quantities", quantities_section(record)}};
  return part;
}

}  // namespace beltlife
