// Owns the section of a report page about each evaluated range: traces, spectra, loop, element, tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "results/gnuplot.h"
#include "results/html.h"
#include "results/report_sections.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

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
                       ? r.window->crank_rpm * std::numbers::pi / 30 / s.model.speed_ratio[s.model.driver.body]
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
    spans.push_back({span.name, html_number(span.tension_n_mean), html_number(span.tension_n_min),
                     html_number(span.tension_n_max), html_number(span.deflection_mm_min, 1),
                     html_number(span.deflection_mm_max, 1)});
  for (const PulleySummary& p : r.summary.pulleys)
    pulleys.push_back({p.name, html_number(p.speed_rpm_mean, 1), p.slip_percent ? html_number(*p.slip_percent, 2) : "-",
                       html_number(p.hub_load_n), html_number(p.hub_load_n_max), html_number(p.hub_direction_deg),
                       html_number(p.torque_n_m_mean, 2)});
  std::string html;
  if (!spans.empty())
    html += html_table(r.id + "-spans", {"span", "tension N mean", "min", "max", "deflection mm min", "max"}, spans) +
            html_table(r.id + "-pulleys",
                       {"pulley", "speed r/min", "slip %", "hub load N", "max", "direction deg", "belt torque N m"},
                       pulleys);
  if (r.summary.output && !r.summary.output->orders.empty()) {
    for (const OrderLine& line : r.summary.output->orders)
      orders.push_back({fmt::format("{:g}", line.order), html_number(line.hz, 1), html_number(line.speed_rpm, 3),
                        html_number(line.torque_n_m, 3)});
    html +=
        html_table(r.id + "-orders", {r.summary.output->body + ": order", "Hz", "speed r/min", "torque N m"}, orders);
  }
  return html;
}

}  // namespace

std::string ranges_section(const Subject& s) {
  std::string html = "<section id=\"ranges\"><h2>Ranges</h2>\n";
  for (const auto& r : s.ranges)
    html += fmt::format("<details id=\"{}\"{}><summary>{}{}{}</summary>\n<div class=\"charts\">", html_escaped(r.id),
                        &r == &s.ranges.front() ? " open" : "", html_escaped(r.window->range),
                        r.window->crank_rpm > 0 ? fmt::format(", {:g} r/min", r.window->crank_rpm) : "",
                        r.window->complete ? "" : " (incomplete)") +
            output_charts(s, r) + belt_charts(s, r) + "</div>\n" + range_tables(r) + "</details>\n";
  return html + "</section>\n";
}

}  // namespace beltlife
