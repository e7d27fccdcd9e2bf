// Owns the section of a report page about each evaluated range: traces, spectra, loop, element, tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/pages/gnuplot.h"
#include "results/pages/html.h"
#include "results/pages/run/report_sections.h"
#include "results/text/print.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

std::string output_charts(const Subject& s, const Subject::Range& r) {
  if (!r.summary.output) return "";
  std::string html;
  const auto t = window_time(r);
  const double rate = s.model.scene.solver.sample_rate_hz;
  struct Output {
    const char *what, *words, *unit;
  };
  for (const auto& [what, words, unit] :
       {Output{"speed_rpm", "speed", "r/min"}, Output{"torque_n_m", "torque", "N m"}}) {
    const std::string name = r.summary.output->body + " " + words;
    const auto values = in_window(r, r.summary.output->body + "." + what);
    const std::vector<double> y(values.begin(), values.end());
    html += svg_of({r.id + "-trace-" + what,
                    "time in the window, s",
                    fmt::format("{}, {}", name, unit),
                    {{"simulated", t, y}},
                    std::min(0.4, t.back())});
    const Spectrum spectrum = amplitude_spectrum(values, rate);
    html += svg_of({r.id + "-spectrum-" + what,
                    "frequency, Hz",
                    fmt::format("{} amplitude, {}", words, unit),
                    {{name, spectrum.frequency_hz, spectrum.amplitude, true}},
                    300});
  }
  return html;
}

/// Stretches of samples with the same pulley, over a short lift-off, too; `pulley(i)` is -1 off the pulleys.
template <typename Pulley>
std::vector<Chart::Stretch> stretches(const Subject& s, const std::vector<double>& x, double end, Pulley pulley) {
  std::vector<Chart::Stretch> out;
  int last = -1;
  for (std::size_t i = 0; i < x.size() && x[i] <= end; ++i) {
    const int at = pulley(i);
    if (at < 0) continue;
    if (at != last || x[i] - out.back().to > 0.03 * end)
      out.push_back({s.model.body_name[static_cast<std::size_t>(at)], x[i], x[i]});
    out.back().to = x[i];
    last = at;
  }
  return out;
}

/// Where the belt lies on pulleys at the end of the window: nodes no farther out than a pulley's surface and some of
/// its belt, the arm where it then was.
std::vector<Chart::Stretch> on_pulleys(const Subject& s, const Subject::Range& r, const std::vector<double>& x) {
  if (s.model.pulleys == 0) return {};
  double arm = r.summary.arm_angle_mean.value_or(s.model.statics.balance.arm_angle);
  if (const auto angle = in_window(r, "tensioner.arm_angle_rad"); !angle.empty()) arm = angle.back();
  const auto circles = circles_of(s.model.scene, s.model.statics.orientation, arm);
  constexpr double near = 3e-4;  // m; the chord of an element lies farther in, a span soon farther out
  return stretches(s, x, x.back(), [&](std::size_t i) {
    for (std::size_t p = 0; p < circles.size(); ++p)
      if (std::hypot(r.window->loop.x_m[i] - circles[p].x, r.window->loop.y_m[i] - circles[p].y) <
          circles[p].radius + near)
        return static_cast<int>(p);
    return -1;
  });
}

std::vector<Chart::Stretch> passes(const Subject& s, const ElementHistory& e, const std::vector<double>& x,
                                   double end) {
  return stretches(s, x, end, [&](std::size_t i) { return static_cast<int>(e.pulley[i]); });
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
  if (!around.x.empty())
    html += svg_of({r.id + "-loop",
                    "position along the belt, mm, at the end of the window",
                    "tension, N",
                    {around},
                    around.x.back(),
                    on_pulleys(s, r, around.x)});
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
                        std::min(round, normal.x.back()),
                        passes(s, e, normal.x, std::min(round, normal.x.back()))});
}

std::string range_tables(const Subject& s, const Subject::Range& r) {
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
  if (const std::string words = settling_text(*r.run, s.model.scene.profile); !words.empty())
    html += "<p>This range " + html_escaped(words) + ".</p>\n";
  if (r.summary.arm_angle_mean) {
    constexpr double degree = 180 / std::numbers::pi;
    html += fmt::format(
        "<p>The tensioner's arm stands at {}\u00b0 in the mean, between {}\u00b0 and {}\u00b0 from where "
        "the scene places it.</p>\n",
        html_number(*r.summary.arm_angle_mean * degree, 1), html_number(*r.summary.arm_angle_min * degree, 1),
        html_number(*r.summary.arm_angle_max * degree, 1));
  }
  if (!spans.empty())
    html += html_table(r.id + "-spans",
                       {"span", "tension N mean", "tension min", "tension max", "deflection mm min", "deflection max"},
                       spans) +
            html_table(r.id + "-pulleys",
                       {"pulley", "speed r/min", "slip %", "hub load N mean", "hub load max", "direction deg",
                        "belt torque N m"},
                       pulleys);
  if (r.summary.output && !r.summary.output->orders.empty()) {
    for (const OrderLine& line : r.summary.output->orders)
      orders.push_back({fmt::format("{:g}", line.order), html_number(line.hz, 1), html_number(line.speed_rpm, 3),
                        html_number(line.torque_n_m, 3)});
    html += html_table(
        r.id + "-orders",
        {r.summary.output->body + ": order of the driven body", "Hz", "speed amplitude r/min", "torque amplitude N m"},
        orders);
  }
  return html;
}

}  // namespace

std::string ranges_section(const Subject& s) {
  if (s.ranges.empty()) return "";
  std::string html = "<section id=\"ranges\"><h2>Ranges</h2>\n";
  for (const auto& r : s.ranges)
    html += fmt::format("<details id=\"{}\"{}><summary>{}{}{}</summary>\n<div class=\"charts\">", html_escaped(r.id),
                        &r == shown_range(s) ? " open" : "", html_escaped(r.window->range),
                        r.window->crank_rpm > 0 ? fmt::format(", {:g} r/min", r.window->crank_rpm) : "",
                        r.window->complete ? "" : " (incomplete)") +
            output_charts(s, r) + belt_charts(s, r) + "</div>\n" + range_tables(s, r) + "</details>\n";
  return html + "</section>\n";
}

}  // namespace beltlife
