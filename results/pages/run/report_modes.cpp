// Owns the section of a report page about natural frequencies: map with orders, modes by range, crossings.
#include <fmt/format.h>

#include <algorithm>

#include "results/pages/campbell_chart.h"
#include "results/pages/gnuplot.h"
#include "results/pages/html.h"
#include "results/pages/run/report_sections.h"

namespace beltlife {
namespace {

Row header_of(const std::string& first, const std::vector<Modes>& points) {
  Row header{first};
  for (const Modes& p : points) header.push_back(p.range.name);
  return header;
}

std::string in_words(ArmState arm) {
  switch (arm) {
    case ArmState::free:
      return "Rotational modes, Hz, the arm free: a vibration that overcomes its dry friction";
    case ArmState::stuck:
      return "Rotational modes, Hz, the arm stuck: a vibration too small for its dry friction";
    case ArmState::locked:
      return "Rotational modes, Hz, the arm locked";
    case ArmState::none:
      break;
  }
  return "Rotational modes, Hz";
}

/// Modes by rows, ranges by columns; who moves and how damped, in the last range that has the mode.
std::string rotational_table(const Subject& s, std::size_t arm) {
  const auto& points = s.file.modes->points;
  const ArmState state = points.front().arms[arm].arm;
  std::size_t count = 0;
  for (const Modes& p : points) count = std::max(count, arm < p.arms.size() ? p.arms[arm].damped.size() : 0);
  if (count == 0) return "";
  Row header = header_of("mode", points);
  const std::string last = points.size() > 1 ? " in " + points.back().range.name : "";
  header.push_back("damping ratio" + last);
  header.push_back("who moves" + last);
  std::vector<Row> rows;
  for (std::size_t k = 0; k < count; ++k) {
    Row row{std::to_string(k + 1)};
    std::string ratio = "-", who = "-";
    for (const Modes& p : points) {
      const bool has = arm < p.arms.size() && k < p.arms[arm].damped.size();
      row.push_back(has ? html_number(p.arms[arm].damped[k].frequency_hz, 1) : "-");
      if (!has) continue;
      ratio = html_number(p.arms[arm].damped[k].damping_ratio, 3);
      who = describe(s.model, p.arms[arm].damped[k].energy);
    }
    row.push_back(ratio);
    row.push_back(who);
    rows.push_back(std::move(row));
  }
  return "<h3>" + in_words(state) + "</h3>\n" +
         html_table("modes-rotational-" + std::string(name_of(state)), header, rows);
}

std::string transverse_table(const std::vector<Modes>& points) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < points.front().spans.size(); ++k) {
    Row row{points.front().spans[k].name};
    for (const Modes& p : points)
      row.push_back(fmt::format("{:.1f}, {:.1f}", p.spans[k].frequency_hz[0], p.spans[k].frequency_hz[1]));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return "<h3>Transverse vibration of the free spans, first and second, Hz</h3>\n" +
         html_table("modes-transverse", header_of("span", points), rows);
}

std::string crossing_table(const Subject& s) {
  const DriveModes& modes = *s.file.modes;
  if (modes.map.crank_rpm.empty()) return "";
  std::vector<Row> rows;
  for (const Crossing& c : modes.crossings)
    if (can_resonate(c, s.model.scene))
      rows.push_back({*c.near, fmt::format("{:g}", c.order), html_number(c.crank_rpm), html_number(c.frequency_hz, 1),
                      c.mode, html_number(c.damping_ratio, 3)});
  const auto place = [&](const Row& row) {
    const auto& ranges = s.model.scene.range;
    return std::find_if(ranges.begin(), ranges.end(), [&](const auto& r) { return r.name == row[0].text; });
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return place(a) < place(b); });
  return fmt::format(
             "<details id=\"modes-near\"><summary>{} crossings within 5 % of a range&apos;s speed</summary>\n"
             "<p>Of {} crossings in all; listed are those of orders that the driven body&apos;s speed has, with modes "
             "that are not damped away.</p>\n",
             rows.size(), modes.crossings.size()) +
         html_table("modes-crossings", {"range", "order", "r/min", "Hz", "mode", "damping ratio"}, rows) +
         "</details>\n";
}

}  // namespace

std::string modes_section(const Subject& s) {
  if (!s.file.modes) return "";
  const DriveModes& modes = *s.file.modes;
  std::string html =
      "<section id=\"modes\"><h2>Modes</h2>\n<p>Natural frequencies about steady running, and where orders of the "
      "driven body&apos;s rotation meet them.</p>\n";
  if (!modes.map.curves.empty()) html += svg_of_script("modes-map", small_map_script(s.model.scene, modes));
  html += crossing_table(s);
  for (std::size_t arm = 0; arm < modes.points.front().arms.size(); ++arm) html += rotational_table(s, arm);
  html += transverse_table(modes.points);
  for (const Modes& p : modes.points) {
    if (p.loop.slack) html += "<p>" + html_escaped(p.range.name) + ": a span is slack; its numbers mean little.</p>\n";
    if (!p.loop.instead.empty()) html += "<p>" + html_escaped(p.range.name + ": " + p.loop.instead) + ".</p>\n";
  }
  return html + "</section>\n";
}

}  // namespace beltlife
