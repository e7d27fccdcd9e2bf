// The report page: see report.h.
#include "results/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "results/gnuplot.h"
#include "results/layout_svg.h"
#include "sim/eval/summary.h"
#include "sim/life/loads.h"
#include "sim/scene/scene_io.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

using Row = std::vector<std::string>;

std::string table(const std::string& id, const Row& header, const std::vector<Row>& rows) {
  std::string s = fmt::format("<div class=\"scroll\"><table id=\"{}\"><thead><tr>", id);
  for (const auto& cell : header) s += "<th>" + escaped(cell) + "</th>";
  s += "</tr></thead><tbody>\n";
  for (const Row& row : rows) {
    s += "<tr>";
    for (const auto& cell : row) s += "<td>" + escaped(cell) + "</td>";
    s += "</tr>\n";
  }
  return s + "</tbody></table></div>\n";
}

std::string number(double value, int digits = 0) {
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "no end" : fmt::format("{:.{}f}", value, digits);
}

/// Everything that the page is about, worked out again from the records.
struct Subject {
  ResultFile file;
  Model model;
  struct Range {
    const RunRecord* run;
    const WindowRecord* window;
    RangeSummary summary;
    std::string id;  ///< of its section
  };
  std::vector<Range> ranges;
  std::optional<Life> life;
};

Subject subject_of(const ResultFile& file, const std::string& name) {
  Subject s{file, compile(parse_scene(file.provenance.scene_text, name), name), {}, {}};
  std::vector<RangeLoad> loads;
  for (const RunRecord& run : s.file.runs)
    for (const WindowRecord& window : run.windows) {
      if (window.last_sample <= window.first_sample) continue;
      s.ranges.push_back({&run, &window, summarise(s.model, run, window), "range-" + window.range});
      if (window.complete && !s.model.scene.range.empty())
        loads.push_back(range_load(s.model.scene, s.model.statics.unstretched_length, run, window));
    }
  if (!loads.empty()) s.life = duty_cycle_life(loads, s.model.scene.fatigue);
  return s;
}

/// The range and pulley that do most of the damage.
struct Governing {
  const RangeLife* range = nullptr;
  const PulleyLife* pulley = nullptr;
};

Governing governing(const Life& life) {
  Governing g;
  for (const RangeLife& range : life.ranges)
    if (!g.range || range.damage_share > g.range->damage_share) g.range = &range;
  if (g.range)
    for (const PulleyLife& pulley : g.range->pulleys)
      if (!g.pulley || pulley.damage_share > g.pulley->damage_share) g.pulley = &pulley;
  return g;
}

std::vector<std::string> warnings(const Subject& s) {
  std::vector<std::string> out;
  for (const RunRecord& run : s.file.runs) {
    if (!run.status.ok())
      out.push_back(fmt::format("A run ended early: {} at {:.4f} s, {}; likely cause: {}; try: {}.",
                                to_string(run.status.state), run.status.time_s, run.status.where, run.status.cause,
                                run.status.advice));
    if (run.friction_overdamped_s > 0)
      out.push_back(
          fmt::format("During {:.3g} s the step was too long for the friction slope, which then dissipates too much.",
                      run.friction_overdamped_s));
  }
  for (const auto& range : s.ranges) {
    if (range.summary.drift > 0.03)
      out.push_back(fmt::format("{} has not settled: a span's mean tension changes by {:.0f} % within the window.",
                                range.window->range, 100 * range.summary.drift));
    if (std::abs(range.summary.energy_residual) > 0.005)
      out.push_back(fmt::format("{}: {:.2f} % of the energy that went through is not accounted for.",
                                range.window->range, 100 * range.summary.energy_residual));
    for (const PulleySummary& p : range.summary.pulleys)
      if (p.slip_percent && std::abs(*p.slip_percent) > 3)
        out.push_back(fmt::format("{}: {} slips by {:.1f} % against the driven pulley.", range.window->range, p.name,
                                  *p.slip_percent));
  }
  if (s.life && s.life->error) out.push_back("No life: " + *s.life->error + ".");
  return out;
}

/// Of what the life is: of the duty cycle only if the file holds all its ranges.
std::string life_over(const Subject& s) {
  if (s.life->ranges.size() >= s.model.scene.range.size()) return "its duty cycle";
  std::string names;
  for (const RangeLife& range : s.life->ranges) names += (names.empty() ? "" : ", ") + range.name;
  return "range" + std::string(s.life->ranges.size() > 1 ? "s " : " ") + names + " alone";
}

std::string summary_section(const Subject& s) {
  std::string words;
  std::vector<Row> rows;
  if (s.life && !s.life->error) {
    const Governing g = governing(*s.life);
    words = fmt::format(
        "The belt is predicted to live <strong>{} h</strong> over {} (log10 {:.2f}). Most of the damage, {:.0f} %, is "
        "done "
        "in range {}, there by pulley {} ({:.0f} %). ",
        number(s.life->life_h), escaped(life_over(s)), s.life->log10_life_h, 100 * g.range->damage_share,
        escaped(g.range->name), escaped(g.pulley->name), 100 * g.pulley->damage_share);
    words += fmt::format("One per cent more stress is {:.0f} % less life: read it as an order of magnitude.",
                         100 * (1 - std::pow(1.01, 1 / s.model.scene.fatigue.exponent)));
    rows.push_back({"life over " + life_over(s), number(s.life->life_h) + " h"});
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
    rows.push_back({"highest tension", number(tension) + " N (" + tension_at + ")"});
    rows.push_back({"lowest tension", number(low) + " N (" + low_at + ")"});
    rows.push_back({"highest hub load", number(hub) + " N (" + hub_at + ")"});
  }
  rows.push_back({"largest belt bending loss", number(bending) + " W"});
  rows.push_back({"energy not accounted for", number(100 * residual, 3) + " % of the throughput at most"});
  const auto list = warnings(s);
  rows.push_back({"warnings", list.empty() ? "none" : std::to_string(list.size())});
  return "<section id=\"summary\"><p class=\"lead\">" + words + "</p>\n" + table("key-numbers", {"", ""}, rows) +
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
                    number(2e3 * s.model.pulley_radius[p], 1), number(1e3 * rest.route.circles[p].x, 1),
                    number(1e3 * rest.route.circles[p].y, 1), number(rest.route.wrap[p] * 180 / 3.14159265358979, 1),
                    number(1e3 * rest.route.spans[p].length, 1)});
  return fmt::format(
             "<section id=\"layout\"><h2>Layout</h2><p>Mean tensions in range {}, the arm at its mean angle. At rest "
             "the belt path is {:.1f} mm and the "
             "tension {:.0f} N; the belt is {:.1f} mm long unstretched.</p>\n",
             escaped(shown->window->range), 1e3 * rest.route.length, rest.tension,
             1e3 * s.model.statics.unstretched_length) +
         layout_svg(s.model, arm, tension, "layout-drawing") +
         table("layout-table", {"pulley", "side", "pitch diameter mm", "x mm", "y mm", "wrap deg", "span to next mm"},
               rows) +
         "</section>\n";
}

std::string losses_section(const Subject& s) {
  Row header{"mean power, W"}, rest{"not accounted for, % of the throughput"};
  std::vector<Row> rows(energy_names.size());
  for (std::size_t i = 0; i < energy_names.size(); ++i) {
    rows[i].push_back(std::string(energy_names[i]));
    std::ranges::replace(rows[i][0], '_', ' ');
  }
  for (const auto& range : s.ranges) {
    header.push_back(range.window->range);
    for (std::size_t i = 0; i < energy_names.size(); ++i) rows[i].push_back(number(range.summary.power_w[i], 1));
    rest.push_back(number(100 * range.summary.energy_residual, 3));
  }
  rows.push_back(std::move(rest));
  return "<section id=\"losses\"><h2>Power and losses</h2>\n" + table("losses-table", header, rows) + "</section>\n";
}

std::span<const double> in_window(const Subject::Range& r, const std::string& channel) {
  const Channel* c = r.run->trace.find(channel);
  if (!c) return {};
  return std::span(c->values).subspan(r.window->first_sample, r.window->last_sample - r.window->first_sample);
}

/// Time from the start of the window.
std::vector<double> window_time(const Subject::Range& r) {
  std::vector<double> t;
  for (std::size_t i = r.window->first_sample; i < r.window->last_sample; ++i)
    t.push_back(r.run->trace.time_s[i] - r.window->begin_s);
  return t;
}

std::string output_charts(const Subject& s, const Subject::Range& r) {
  if (!r.summary.output) return "";
  std::string html;
  const auto t = window_time(r);
  const double rate = s.model.scene.solver.sample_rate_hz;
  for (const auto& [what, unit] : {std::pair{"speed_rpm", "r/min"}, std::pair{"torque_n_m", "N m"}}) {
    const auto values = in_window(r, r.summary.output->body + "." + what);
    const std::vector<double> y(values.begin(), values.end());
    html += svg_of({r.id + "-trace-" + what,
                    "time in the window, s",
                    fmt::format("{} {}, {}", r.summary.output->body, what, unit),
                    {{"simulated", t, y}},
                    std::min(0.4, t.back())});
    const Spectrum spectrum = amplitude_spectrum(values, rate);
    html += svg_of({r.id + "-spectrum-" + what,
                    "frequency, Hz",
                    fmt::format("amplitude, {}", unit),
                    {{r.summary.output->body + " " + what, spectrum.frequency_hz, spectrum.amplitude, true}},
                    300});
  }
  return html;
}

std::string belt_charts(const Subject& s, const Subject::Range& r) {
  std::string html;
  const auto t = window_time(r);
  std::vector<Curve> spans;
  for (const SpanSummary& span : r.summary.spans) {
    const auto values = in_window(r, "span." + span.name + ".tension_n");
    spans.push_back({span.name, t, {values.begin(), values.end()}});
  }
  if (!spans.empty())
    html += svg_of({r.id + "-tensions", "time in the window, s", "span tension, N", spans, std::min(0.2, t.back())});
  const LoopSnapshot& loop = r.window->loop;
  Curve around{"at the end of the window", {}, loop.tension_n};
  double length = 0;
  for (std::size_t i = 0; i < loop.x_m.size(); ++i) {
    around.x.push_back(1e3 * length);
    const std::size_t j = (i + 1) % loop.x_m.size();
    length += std::hypot(loop.x_m[j] - loop.x_m[i], loop.y_m[j] - loop.y_m[i]);
  }
  if (!around.x.empty()) html += svg_of({r.id + "-loop", "position along the belt, mm", "tension, N", {around}});
  const ElementHistory& e = r.window->element;
  if (e.time_s.empty() || s.model.pulleys == 0) return html;
  Curve normal{"normal", {}, e.normal_n}, tangential{"tangential", {}, e.tangential_n};
  for (double time : e.time_s) normal.x.push_back(time - r.window->begin_s);
  tangential.x = normal.x;
  const double v = r.window->crank_rpm > 0 && s.model.driver.body >= 0
                       ? r.window->crank_rpm * 3.14159265358979 / 30 / s.model.speed_ratio[s.model.driver.body]
                       : 0;
  const double round = v > 0 ? s.model.statics.unstretched_length / v : 0;
  return html + svg_of({r.id + "-element",
                        "time in the window, s (one round of the belt)",
                        "contact force on one element, N",
                        {normal, tangential},
                        std::min(round, normal.x.back())});
}

std::string range_tables(const Subject::Range& r) {
  std::vector<Row> spans, pulleys, orders;
  for (const SpanSummary& span : r.summary.spans)
    spans.push_back({span.name, number(span.tension_n_mean), number(span.tension_n_min), number(span.tension_n_max),
                     number(span.deflection_mm_min, 1), number(span.deflection_mm_max, 1)});
  for (const PulleySummary& p : r.summary.pulleys)
    pulleys.push_back({p.name, number(p.speed_rpm_mean, 1), p.slip_percent ? number(*p.slip_percent, 2) : "-",
                       number(p.hub_load_n), number(p.hub_load_n_max), number(p.hub_direction_deg),
                       number(p.torque_n_m_mean, 2)});
  std::string html;
  if (!spans.empty())
    html +=
        table(r.id + "-spans", {"span", "tension N mean", "min", "max", "deflection mm min", "max"}, spans) +
        table(r.id + "-pulleys",
              {"pulley", "speed r/min", "slip %", "hub load N", "max", "direction deg", "belt torque N m"}, pulleys);
  if (r.summary.output && !r.summary.output->orders.empty()) {
    for (const OrderLine& line : r.summary.output->orders)
      orders.push_back(
          {fmt::format("{:g}", line.order), number(line.hz, 1), number(line.speed_rpm, 3), number(line.torque_n_m, 3)});
    html += table(r.id + "-orders", {r.summary.output->body + ": order", "Hz", "speed r/min", "torque N m"}, orders);
  }
  return html;
}

std::string ranges_section(const Subject& s) {
  std::string html = "<section id=\"ranges\"><h2>Ranges</h2>\n";
  for (const auto& r : s.ranges)
    html += fmt::format("<details id=\"{}\"{}><summary>{}{}{}</summary>\n<div class=\"charts\">", escaped(r.id),
                        &r == &s.ranges.front() ? " open" : "", escaped(r.window->range),
                        r.window->crank_rpm > 0 ? fmt::format(", {:g} r/min", r.window->crank_rpm) : "",
                        r.window->complete ? "" : " (incomplete)") +
            output_charts(s, r) + belt_charts(s, r) + "</div>\n" + range_tables(r) + "</details>\n";
  return html + "</section>\n";
}

std::string life_section(const Subject& s) {
  if (!s.life) return "";
  std::vector<Row> ranges, pulleys;
  for (const RangeLife& range : s.life->ranges) {
    ranges.push_back({range.name, number(100 * range.duty_share), fmt::format("{:.3g}", range.cycles),
                      number(range.life_h), number(std::log10(range.life_h), 2), number(100 * range.damage_share, 1)});
    for (const PulleyLife& p : range.pulleys)
      pulleys.push_back({range.name, p.name, number(p.axial_mean / 1e6, 3), number(p.axial_alternating / 1e6, 3),
                         number(p.bending / 1e6, 3), number(p.transverse / 1e6, 3), number(p.shear / 1e6, 3),
                         number(p.sigma_m / 1e6, 3), number(p.sigma_a / 1e6, 3), fmt::format("{:.3g}", p.cycles),
                         number(100 * p.damage_share, 1)});
  }
  return "<section id=\"life\"><h2>Life</h2>\n" +
         table("life-ranges", {"range", "time %", "rounds to failure", "life h", "log10", "damage %"}, ranges) +
         "<h3>Stresses, MPa, and damage by pulley (thesis Figure 6.5)</h3>\n" +
         table("life-pulleys",
               {"range", "pulley", "axial mean", "alternating", "bending", "transverse", "shear", "sigma_m", "sigma_a",
                "rounds", "damage %"},
               pulleys) +
         "</section>\n";
}

std::string warnings_section(const Subject& s) {
  std::string html = "<section id=\"warnings\"><h2>Warnings</h2>\n";
  const auto list = warnings(s);
  if (list.empty()) return html + "<p>None.</p></section>\n";
  html += "<ul>";
  for (const auto& words : list) html += "<li>" + escaped(words) + "</li>\n";
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
         table("provenance-table", {"", ""},
               {{"command", p.command_line},
                {"scene", p.scene_path},
                {"beltlife", p.version + " (" + p.revision + "), " + p.compiler},
                {"scheme", fmt::format("{}, {} elements, step {:.3g} s", p.scheme, p.elements,
                                       s.file.runs.empty() ? 0 : s.file.runs.front().step_s)},
                {"run time", fmt::format("{:.3g} s simulated in {:.3g} s of processor time", simulated, wall)}}) +
         "<details id=\"scene\"><summary>Scene as it was run</summary><pre>" + escaped(p.scene_text) +
         "</pre></details></section>\n";
}

constexpr const char* style = R"(
:root{color-scheme:light}body{font:16px/1.5 system-ui,Helvetica,sans-serif;color:#222;max-width:1000px;margin:0 auto;padding:1rem}
h1{font-size:1.6rem;margin:.2rem 0}h2{margin-top:2rem;border-bottom:2px solid #0b61a4}.lead{font-size:1.15rem}
table{border-collapse:collapse;margin:.8rem 0;font-size:.88rem}th,td{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:right}
th:first-child,td:first-child{text-align:left}#life-pulleys td:nth-child(2){text-align:left}.scroll{overflow-x:auto}
#key-numbers td,#provenance-table td{text-align:left}figure{margin:.5rem 0}figure svg{max-width:100%;height:auto}
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:.5rem}
details>summary{cursor:pointer;font-weight:bold;padding:.4rem 0}pre{overflow-x:auto;font-size:.8rem;background:#f6f6f6;padding:.5rem}
@media print{details{display:block}details>*{display:block}})";

}  // namespace

std::string report_html(const ResultFile& file, const std::string& name) {
  const Subject s = subject_of(file, name);
  const std::string title = s.model.scene.title.empty() ? name : s.model.scene.title;
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + style + "</style></head><body>\n<h1>" + escaped(title) + "</h1>\n" +
         summary_section(s) + layout_section(s) + life_section(s) + losses_section(s) + ranges_section(s) +
         warnings_section(s) + provenance_section(s) + "</body></html>\n";
}

}  // namespace beltlife
