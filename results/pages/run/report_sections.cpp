// The short sections of a report page: summary, layout, losses, warnings, provenance; see report_sections.h.
#include "results/pages/run/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/pages/html.h"
#include "results/pages/layout_svg.h"
#include "sim/scene/pitch_line.h"

namespace beltlife {

namespace {

std::string where(const std::string& what, const Subject::Range& range) { return what + ", " + range.window->range; }

/// What the page says, in words.
std::string lead(const Subject& s) {
  std::string words;
  if (s.file.sweep || s.file.event) {
    words = fmt::format(
        "This page is about {}, which says nothing of the belt's life. ",
        s.file.sweep ? "<a href=\"#sweep\">a sweep through crank speeds</a>" : "<a href=\"#event\">an event</a>");
  } else if (!s.life) {
    words = s.model.scene.range.empty() ? "The scene has no operating ranges, so nothing is said of the belt's life. "
                                        : "No range ran to its end, so no life can be stated. ";
  } else if (s.life->error) {
    words = "No life can be stated over " + html_escaped(life_over(s)) + "; the warnings say why. ";
  } else if (std::isinf(s.life->life_h)) {
    words = "Nothing wears the belt over " + html_escaped(life_over(s)) + ". ";
  } else {
    const Governing g = governing(*s.life);
    words = fmt::format("The belt is predicted to live about <strong>{} h</strong> over {} (log10 {:.2f}). ",
                        html_rounded(s.life->life_h, 3), html_escaped(life_over(s)), s.life->log10_life_h);
    if (s.life->ranges.size() > 1)
      words +=
          fmt::format("The largest share of the damage, {:.0f} %, is done in range {}; pulley {} does {:.0f} % of it. ",
                      100 * g.range->damage_share, html_escaped(g.range->name), html_escaped(g.pulley->name),
                      100 * g.pulley->damage_share);
    else
      words += fmt::format("Pulley {} does {:.0f} % of the damage. ", html_escaped(g.pulley->name),
                           100 * g.pulley->damage_share);
    words += fmt::format("One per cent more stress is {:.0f}\u00a0% less life: read it as an order of magnitude. ",
                         100 * (1 - std::pow(1.01, 1 / s.model.scene.fatigue.exponent)));
  }
  if (const auto count = warnings(s).size(); count > 0)
    words += fmt::format("<a class=\"alarm\" href=\"#warnings\">{} to be heeded.</a>",
                         count == 1 ? "One warning is" : std::to_string(count) + " warnings are");
  return words;
}

/// Largest and smallest of what was simulated, with their places.
void add_extremes(const Subject& s, std::vector<Row>& rows) {
  if (s.ranges.empty()) return;
  struct Extreme {
    double value = 0;
    std::string at;
  };
  Extreme high, hub, bending, low{1e300, ""};
  double residual = 0;
  for (const auto& range : s.ranges) {
    for (const SpanSummary& span : range.summary.spans) {
      if (span.tension_n_max > high.value) high = {span.tension_n_max, where(span.name, range)};
      if (span.tension_n_min < low.value) low = {span.tension_n_min, where(span.name, range)};
    }
    for (const PulleySummary& p : range.summary.pulleys)
      if (p.hub_load_n_max > hub.value) hub = {p.hub_load_n_max, where(p.name, range)};
    const double loss = range.summary.power_w[static_cast<std::size_t>(Energy::lost_belt_bending)];
    if (loss > bending.value) bending = {loss, range.window->range};
    residual = std::max(residual, std::abs(range.summary.energy_residual));
  }
  const auto add = [&](const char* name, const Extreme& e, const char* unit) {
    if (!e.at.empty()) rows.push_back({name, html_number(e.value) + unit + " (" + e.at + ")"});
  };
  add("highest tension", high, " N");
  add("lowest tension", low, " N");
  add("highest hub load", hub, " N");
  add("largest belt bending loss", bending, " W");
  rows.push_back({"energy not accounted for", html_number(100 * residual, 3) + " % of what went through, at most"});
}

}  // namespace

std::string summary_section(const Subject& s) {
  std::vector<Row> rows;
  if (s.life && !s.life->error) rows.push_back({"life over " + life_over(s), html_rounded(s.life->life_h, 3) + " h"});
  if (s.file.statics) {
    const QuasiStaticPulley* least = nullptr;
    std::string least_at;
    for (const QuasiStaticRange& range : s.file.statics->ranges)
      for (const QuasiStaticPulley& p : range.pulleys)
        if (p.slip_safety && (!least || *p.slip_safety < *least->slip_safety)) {
          least = &p;
          least_at = p.name + ", " + range.name;
        }
    if (least)
      rows.push_back({"lowest slip safety, quasi-static",
                      Cell(html_number(*least->slip_safety, 2) + " (" + least_at + ")", slips(*least))});
  }
  add_extremes(s, rows);
  const auto list = warnings(s);
  rows.push_back({"warnings", Cell(list.empty() ? "none" : std::to_string(list.size()), !list.empty())});
  return "<section id=\"summary\"><p class=\"lead\">" + lead(s) + "</p>\n" + html_table("key-numbers", {"", ""}, rows) +
         "</section>\n";
}

std::string layout_section(const Subject& s) {
  if (s.model.pulleys == 0) return "";
  const SceneSpec& scene = s.model.scene;
  const Layout& rest = s.model.statics.balance;
  const Subject::Range* shown = shown_range(s);
  const DrawnState state = drawn_state(s, shown);
  std::string words = "Drawn at rest. ";
  if (shown) {
    words = "Mean tensions in range " + html_escaped(shown->window->range) +
            (s.model.tensioner.pulley >= 0 ? ", the arm at its mean angle. " : ". ");
  }
  words +=
      fmt::format("At rest the belt path is {:.1f} mm and the tension {:.0f} N; the belt is {:.1f} mm long unstretched",
                  1e3 * rest.route.length, rest.tension, 1e3 * s.model.statics.unstretched_length);
  if (scene.belt.effective_length_mm)
    words += fmt::format(", its effective length is {:g} mm", *scene.belt.effective_length_mm);

  const bool effective = has_effective_diameters(scene);
  Row header{"pulley", "side"};
  if (effective) header.push_back("effective diameter mm");
  for (const char* name : {"pitch diameter mm", "x mm", "y mm", "wrap deg", "span to next mm"}) header.push_back(name);
  std::vector<Row> rows;
  for (std::size_t p = 0; p < scene.pulley.size(); ++p) {
    const PulleySpec& spec = scene.pulley[p];
    Row row{spec.name, std::string(enum_name(spec.side))};
    if (effective) row.push_back(spec.effective_diameter_mm ? html_number(*spec.effective_diameter_mm, 1) : "-");
    row.push_back(html_number(pitch_diameter_mm(scene, spec), 1));
    row.push_back(html_number(1e3 * rest.route.circles[p].x, 1));
    row.push_back(html_number(1e3 * rest.route.circles[p].y, 1));
    row.push_back(html_number(rest.route.wrap[p] * 180 / std::numbers::pi, 1));
    row.push_back(html_number(1e3 * rest.route.spans[p].length, 1));
    rows.push_back(std::move(row));
  }
  return "<section id=\"layout\"><h2>Layout</h2><p>" + words + ".</p>\n" +
         layout_svg(s.model, state.arm, state.tension, "layout-drawing") +
         "<h3>Positions, wraps and spans at rest</h3>\n" + html_table("layout-table", header, rows) + "</section>\n";
}

std::string losses_section(const Subject& s) {
  if (s.ranges.empty()) return "";
  Row header{"mean power, W"}, rest{"not accounted for, % of what went through"};
  std::vector<Row> rows(energy_names.size());
  for (std::size_t i = 0; i < energy_names.size(); ++i) rows[i].push_back(energy_words[i]);
  for (const auto& range : s.ranges) {
    header.push_back(range.window->range);
    for (std::size_t i = 0; i < energy_names.size(); ++i) rows[i].push_back(html_number(range.summary.power_w[i], 1));
    rest.push_back(html_number(100 * range.summary.energy_residual, 3));
  }
  for (std::size_t i = rows.size(); i-- > 0;)  // what the drive does not have
    if (std::ranges::all_of(s.ranges, [&](const auto& range) { return range.summary.power_w[i] == 0; }))
      rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
  rows.push_back(std::move(rest));
  return "<section id=\"losses\"><h2>Power and losses</h2>\n" + html_table("losses-table", header, rows) +
         "</section>\n";
}

std::string warnings_section(const Subject& s) {
  std::string html = "<section id=\"warnings\"><h2>Warnings</h2>\n";
  const auto list = warnings(s);
  if (list.empty()) return html + "<p>None.</p></section>\n";
  html += "<ul>";
  for (const auto& words : list) html += "<li>" + html_escaped(words) + "</li>\n";
  return html + "</ul></section>\n";
}

std::string provenance_section(const Subject& s) {
  const Provenance& p = s.file.provenance;
  double wall = 0, simulated = 0;
  for (const RunRecord& run : s.file.runs) {
    wall += run.wall_s;
    simulated += run.simulated_s;
  }
  return "<section id=\"provenance\"><h2>How these numbers came about</h2>\n" +
         html_table("provenance-table", {"", ""},
                    {{"command", p.command_line},
                     {"scene", p.scene_path},
                     {"beltlife", p.version + " (" + p.revision + "), " + p.compiler},
                     {"scheme", fmt::format("{}, {} elements, step {:.3g} s", p.scheme, p.elements,
                                            s.file.runs.empty() ? 0 : s.file.runs.front().step_s)},
                     {"run time", fmt::format("{:.3g} s simulated in {:.3g} s of processor time", simulated, wall)}}) +
         "<details id=\"scene\"><summary>Scene as it was run</summary><pre>" + html_escaped(p.scene_text) +
         "</pre></details></section>\n";
}

}  // namespace beltlife
