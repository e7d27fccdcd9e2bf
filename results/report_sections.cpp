// The short sections of a report page: summary, layout, losses, warnings, provenance; see report_sections.h.
#include "results/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/html.h"
#include "results/layout_svg.h"

namespace beltlife {

std::string summary_section(const Subject& s) {
  std::string words;
  std::vector<Row> rows;
  if (s.life && !s.life->error) {
    const Governing g = governing(*s.life);
    words = fmt::format(
        "The belt is predicted to live <strong>{} h</strong> over {} (log10 {:.2f}). Most of the damage, {:.0f} %, is "
        "done "
        "in range {}, there by pulley {} ({:.0f} %). ",
        html_number(s.life->life_h), html_escaped(life_over(s)), s.life->log10_life_h, 100 * g.range->damage_share,
        html_escaped(g.range->name), html_escaped(g.pulley->name), 100 * g.pulley->damage_share);
    words += fmt::format("One per cent more stress is {:.0f} % less life: read it as an order of magnitude.",
                         100 * (1 - std::pow(1.01, 1 / s.model.scene.fatigue.exponent)));
    rows.push_back({"life over " + life_over(s), html_number(s.life->life_h) + " h"});
  }
  double tension = 0, low = 1e300, hub = 0, residual = 0, bending = 0;
  std::string tension_at, low_at, hub_at;
  for (const auto& range : s.ranges) {
    for (const SpanSummary& span : range.summary.spans) {
      if (span.tension_n_max > tension) {
        tension = span.tension_n_max;
        tension_at = span.name + ", " + range.window->range;
      }
      if (span.tension_n_min < low) {
        low = span.tension_n_min;
        low_at = span.name + ", " + range.window->range;
      }
    }
    for (const PulleySummary& p : range.summary.pulleys)
      if (p.hub_load_n_max > hub) {
        hub = p.hub_load_n_max;
        hub_at = p.name + ", " + range.window->range;
      }
    residual = std::max(residual, std::abs(range.summary.energy_residual));
    bending = std::max(bending, range.summary.power_w[static_cast<std::size_t>(Energy::lost_belt_bending)]);
  }
  if (s.model.pulleys > 0) {
    rows.push_back({"highest tension", html_number(tension) + " N (" + tension_at + ")"});
    rows.push_back({"lowest tension", html_number(low) + " N (" + low_at + ")"});
    rows.push_back({"highest hub load", html_number(hub) + " N (" + hub_at + ")"});
  }
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
  rows.push_back({"largest belt bending loss", html_number(bending) + " W"});
  rows.push_back({"energy not accounted for", html_number(100 * residual, 3) + " % of the throughput at most"});
  const auto list = warnings(s);
  rows.push_back({"warnings", list.empty() ? "none" : std::to_string(list.size())});
  return "<section id=\"summary\"><p class=\"lead\">" + words + "</p>\n" + html_table("key-numbers", {"", ""}, rows) +
         "</section>\n";
}

std::string layout_section(const Subject& s) {
  if (s.model.pulleys == 0 || s.ranges.empty()) return "";
  const Subject::Range* shown = &s.ranges.front();
  if (s.life && !s.life->error)
    for (const auto& range : s.ranges)
      if (range.window->range == governing(*s.life).range->name) shown = &range;
  std::vector<double> tension;
  for (const SpanSummary& span : shown->summary.spans) tension.push_back(span.tension_n_mean);
  const double arm = shown->summary.arm_angle_mean.value_or(s.model.statics.balance.arm_angle);
  std::vector<Row> rows;
  const Layout& rest = s.model.statics.balance;
  for (int p = 0; p < s.model.pulleys; ++p)
    rows.push_back({s.model.body_name[p], std::string(enum_name(s.model.scene.pulley[p].side)),
                    html_number(2e3 * s.model.pulley_radius[p], 1), html_number(1e3 * rest.route.circles[p].x, 1),
                    html_number(1e3 * rest.route.circles[p].y, 1),
                    html_number(rest.route.wrap[p] * 180 / std::numbers::pi, 1),
                    html_number(1e3 * rest.route.spans[p].length, 1)});
  return fmt::format(
             "<section id=\"layout\"><h2>Layout</h2><p>Mean tensions in range {}, the arm at its mean angle. At rest "
             "the belt path is {:.1f} mm and the "
             "tension {:.0f} N; the belt is {:.1f} mm long unstretched.</p>\n",
             html_escaped(shown->window->range), 1e3 * rest.route.length, rest.tension,
             1e3 * s.model.statics.unstretched_length) +
         layout_svg(s.model, arm, tension, "layout-drawing") +
         html_table("layout-table",
                    {"pulley", "side", "pitch diameter mm", "x mm", "y mm", "wrap deg", "span to next mm"}, rows) +
         "</section>\n";
}

std::string losses_section(const Subject& s) {
  Row header{"mean power, W"}, rest{"not accounted for, % of the throughput"};
  std::vector<Row> rows(energy_names.size());
  for (std::size_t i = 0; i < energy_names.size(); ++i) {
    rows[i].push_back(std::string(energy_names[i]));
    std::ranges::replace(rows[i][0].text, '_', ' ');
  }
  for (const auto& range : s.ranges) {
    header.push_back(range.window->range);
    for (std::size_t i = 0; i < energy_names.size(); ++i) rows[i].push_back(html_number(range.summary.power_w[i], 1));
    rest.push_back(html_number(100 * range.summary.energy_residual, 3));
  }
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
