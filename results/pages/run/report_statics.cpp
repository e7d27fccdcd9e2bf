// Owns the section of a report page about statics: take-up, steady tensions, hub loads and slip safety by range.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "results/pages/html.h"
#include "results/pages/run/report_sections.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi;

std::string take_up_table(const std::vector<TakeUpRow>& rows) {
  if (rows.empty()) return "";
  std::vector<Row> cells;
  for (const TakeUpRow& r : rows)
    cells.push_back({r.name, html_number(r.arm_angle * degree, 1), html_number(1e3 * r.path_length, 1),
                     html_number(1e3 * r.unstretched_length, 1), html_number(r.tension), r.reason});
  return "<h3>Take-up of the tensioner</h3>\n" +
         html_table("statics-take-up",
                    {"arm", "angle deg", "belt path mm", "unstretched belt mm", "tension N", "ended by"}, cells);
}

using Ranges = std::vector<const QuasiStaticRange*>;

/// A column a range.
Row header_of(const std::string& first, const Ranges& ranges) {
  Row header{first};
  for (const QuasiStaticRange* r : ranges) header.push_back(r->name);
  return header;
}

template <typename Value>
Row row_of(const std::string& name, const Ranges& ranges, Value value) {
  Row row{name};
  for (const QuasiStaticRange* r : ranges) row.push_back(value(*r));
  return row;
}

std::string band(double value, double low, double high) {
  return high - low >= 1 ? fmt::format("{:.0f} ({:.0f}\u00a0to\u00a0{:.0f})", value, low, high)
                         : fmt::format("{:.0f}", value);
}

std::string tension_table(const Ranges& ranges) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < ranges.front()->spans.size(); ++i)
    rows.push_back(row_of(ranges.front()->spans[i].name, ranges, [&](const QuasiStaticRange& r) {
      return band(r.spans[i].tension, r.spans[i].tension_low, r.spans[i].tension_high);
    }));
  rows.push_back(row_of("centrifugal part of each", ranges, [](const auto& r) { return html_number(r.centrifugal); }));
  if (ranges.front()->arm_angle)
    rows.push_back(row_of("arm angle, deg", ranges, [](const auto& r) {
      const double low = r.arm_angle_low.value_or(*r.arm_angle) * degree,
                   high = r.arm_angle_high.value_or(*r.arm_angle) * degree, angle = *r.arm_angle * degree;
      return high - low > 0.05 ? fmt::format("{:.1f} ({:.1f}\u00a0to\u00a0{:.1f})", angle, low, high)
                               : html_number(angle, 1);
    }));
  rows.push_back(row_of("belt speed, m/s", ranges, [](const auto& r) { return html_number(r.belt_speed, 1); }));
  rows.push_back(row_of("put in by the driver, W", ranges, [](const auto& r) { return html_number(r.driver_power); }));
  rows.push_back(
      row_of("put in by torque tables, W", ranges, [](const auto& r) { return html_number(r.table_power); }));
  rows.push_back(row_of("lost, W", ranges, [](const auto& r) { return html_number(r.loss); }));
  return "<h3>Span tensions, N</h3>\n" + html_table("statics-tensions", header_of("span", ranges), rows);
}

std::string hub_load_table(const Ranges& ranges) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < ranges.front()->pulleys.size(); ++i)
    rows.push_back(row_of(ranges.front()->pulleys[i].name, ranges, [&](const QuasiStaticRange& r) {
      const QuasiStaticPulley& p = r.pulleys[i];
      return fmt::format("{:.0f} at {:.0f}\u00b0", p.hub_load,
                         std::round(std::atan2(p.hub_y, p.hub_x) * degree) + 0.0);  // no "-0"
    }));
  return "<h3>Hub loads, N, and their direction counterclockwise from x</h3>\n" +
         html_table("statics-hub-loads", header_of("pulley", ranges), rows);
}

std::string slip_table(const Ranges& ranges) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < ranges.front()->pulleys.size(); ++i) {
    bool any = false;
    Row row{ranges.front()->pulleys[i].name};
    for (const QuasiStaticRange* r : ranges) {
      const auto& safety = r->pulleys[i].slip_safety;
      any = any || safety;
      row.push_back(safety ? Cell(html_number(*safety, *safety < 10 ? 2 : 1) + (slips(r->pulleys[i]) ? " slips" : ""),
                                  slips(r->pulleys[i]))
                           : Cell("-"));
    }
    if (any) rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return "<h3>Slip safety: how many times the wrap that the torque needs</h3>\n" +
         html_table("statics-slip-safety", header_of("pulley", ranges), rows);
}

std::string estimate_words(const DriveStatics& statics) {
  if (statics.ranges.empty()) return "";
  if (statics.estimate.error) return "<p>No life is estimated: " + html_escaped(*statics.estimate.error) + ".</p>\n";
  return fmt::format(
      "<p id=\"statics-life\">From these steady tensions alone the life over the duty cycle is estimated at {} h: "
      "without vibration, good to rank drives before any is simulated.</p>\n",
      html_rounded(statics.estimate.life_h, 2));
}

}  // namespace

std::string statics_section(const Subject& s) {
  if (!s.file.statics) return "";
  const DriveStatics& statics = *s.file.statics;
  std::string html =
      "<section id=\"statics\"><h2>Statics</h2>\n<p>The drive before any time step: steady running at the mean speed, "
      "without ripple and vibration.";
  html += s.model.tensioner.pulley >= 0 ? " In brackets, between the friction limits of the tensioner's arm.</p>\n"
                                        : "</p>\n";
  Ranges solved;
  for (const QuasiStaticRange& r : statics.ranges)
    if (!r.error) solved.push_back(&r);
  if (!solved.empty()) html += tension_table(solved) + hub_load_table(solved) + slip_table(solved);
  for (const QuasiStaticRange& r : statics.ranges)
    if (r.error) html += "<p>" + html_escaped(r.name + ": no quasi-static solution: " + *r.error) + ".</p>\n";
  for (const QuasiStaticRange& r : statics.ranges)
    for (const std::string& words : r.remarks) html += "<p>" + html_escaped(r.name + ": " + words) + ".</p>\n";
  html += estimate_words(statics);
  html += take_up_table(statics.take_up);
  return html + "</section>\n";
}

}  // namespace beltlife
