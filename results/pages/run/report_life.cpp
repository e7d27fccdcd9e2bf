// Owns the section of a report page about life: ranges, damage shares as a chart, stresses by pulley.
#include <fmt/format.h>

#include <cmath>

#include "results/pages/gnuplot.h"
#include "results/pages/html.h"
#include "results/pages/run/report_sections.h"

namespace beltlife {
namespace {

/// Share of each pulley in the damage of each range (thesis Figure 6.5), and what that is of the duty cycle's damage.
std::string damage_charts(const Life& life) {
  StackedBars within{"life-damage-ranges", "share of the range's damage, %", {}, {}, 100};
  StackedBars cycle{"life-damage-cycle", "share of the duty cycle's damage, %", {}, {}, 0};
  for (const RangeLife& range : life.ranges) {
    for (const PulleyLife& p : range.pulleys)
      if (!std::isfinite(p.damage_share) || !std::isfinite(range.damage_share)) return "";
    within.bars.push_back(range.name);
    cycle.bars.push_back(fmt::format("{} {:.0f} %", range.name, 100 * range.damage_share));
    for (std::size_t i = 0; i < range.pulleys.size(); ++i) {
      const PulleyLife& p = range.pulleys[i];
      if (within.layers.size() <= i) {
        within.layers.push_back({p.name, {}});
        cycle.layers.push_back({p.name, {}});
      }
      within.layers[i].heights.push_back(100 * p.damage_share);
      cycle.layers[i].heights.push_back(100 * p.damage_share * range.damage_share);
    }
  }
  if (within.layers.empty()) return "";
  return "<h3>Damage by pulley (thesis Figure 6.5)</h3>\n<div class=\"charts\">" + svg_of(within) +
         (life.ranges.size() > 1 ? svg_of(cycle) : "") + "</div>\n";
}

}  // namespace

std::string life_section(const Subject& s) {
  if (!s.life) return "";
  std::vector<Row> ranges, pulleys;
  for (const RangeLife& range : s.life->ranges) {
    ranges.push_back({range.name, html_number(100 * range.duty_share), fmt::format("{:.3g}", range.cycles),
                      html_number(range.life_h), html_number(std::log10(range.life_h), 2),
                      html_number(100 * range.damage_share, 1)});
    for (const PulleyLife& p : range.pulleys)
      pulleys.push_back({range.name, p.name, html_number(p.axial_mean / 1e6, 3),
                         html_number(p.axial_alternating / 1e6, 3), html_number(p.bending / 1e6, 3),
                         html_number(p.transverse / 1e6, 3), html_number(p.shear / 1e6, 3),
                         html_number(p.sigma_m / 1e6, 3), html_number(p.sigma_a / 1e6, 3),
                         fmt::format("{:.3g}", p.cycles), html_number(100 * p.damage_share, 1)});
  }
  return "<section id=\"life\"><h2>Life</h2>\n" +
         html_table("life-ranges", {"range", "time %", "rounds to failure", "life h", "log10", "damage %"}, ranges) +
         damage_charts(*s.life) +
         fmt::format("<details id=\"life-stresses\"{}><summary>Stresses, MPa, by pulley</summary>\n",
                     pulleys.size() <= 20 ? " open" : "") +
         html_table("life-pulleys",
                    {"range", "pulley", "axial mean", "altern.", "bending", "transv.", "shear", "sigma_m", "sigma_a",
                     "rounds", "damage %"},
                    pulleys) +
         "</details></section>\n";
}

}  // namespace beltlife
