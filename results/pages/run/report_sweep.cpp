// Owns the sections of a report page about a sweep and about an event; see report_sections.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/pages/gnuplot.h"
#include "results/pages/html.h"
#include "results/pages/run/report_sections.h"
#include "results/pages/sweep_chart.h"
#include "results/store/names.h"
#include "results/text/event_text.h"

namespace beltlife {
namespace {

/// Joules by mechanism; what the drive does not have is left out.
std::string energy_table(const std::string& id, const EnergyAccount& account) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < account.joule.size(); ++i)
    if (account.joule[i] != 0) rows.push_back({std::string(names::energy_about[i]), html_number(account.joule[i], 1)});
  rows.push_back({"not accounted for, % of what went through", html_number(100 * account.relative_residual(), 3)});
  return html_table(id, {"energy", "J"}, rows);
}

/// "drive_shaft.speed_rpm" as an id of HTML.
std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), '.', '-');
  return name;
}

std::string cuts(const Sweep& s, const SweepChannel& c, std::vector<SweepPeak> peaks) {
  constexpr std::size_t most = 6;  // more curves hide each other; the table has all orders
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const SweepPeak& a, const SweepPeak& b) { return a.amplitude > b.amplitude; });
  peaks.resize(std::min(peaks.size(), most));
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const SweepPeak& a, const SweepPeak& b) { return a.order < b.order; });
  Chart chart{"sweep-cuts-" + plain(c.name), "crank speed, r/min", c.name + ", " + c.unit, {}};
  for (const SweepPeak& peak : peaks) {
    const auto at =
        static_cast<std::size_t>(std::find(s.orders.begin(), s.orders.end(), peak.order) - s.orders.begin());
    Curve curve{fmt::format("order {:g}", peak.order), {}, {}};
    for (std::size_t i = 0; i < s.crank_rpm.size(); ++i)
      if (std::isfinite(c.amplitude[at][i])) {
        curve.x.push_back(s.crank_rpm[i]);
        curve.y.push_back(c.amplitude[at][i]);
      }
    chart.curves.push_back(std::move(curve));
  }
  return svg_of(chart);
}

std::string channel_part(const Sweep& s, const SweepChannel& c) {
  const auto peaks = peaks_of(s, c);
  if (peaks.empty()) return "";
  std::vector<Row> rows;
  for (const SweepPeak& peak : peaks)
    rows.push_back({fmt::format("{:g}", peak.order), html_number(peak.amplitude, 3), html_number(peak.crank_rpm),
                    html_number(peak.frequency_hz, 1), peak.near ? peak.near->mode : "none",
                    peak.near ? html_number(peak.near->frequency_hz, 1) : "-",
                    peak.near ? html_number(peak.near->damping_ratio, 3) : "-"});
  const bool any = std::any_of(peaks.begin(), peaks.end(), [](const SweepPeak& p) { return p.amplitude > 0; });
  return "<h3>" + html_escaped(c.name) + "</h3>\n" +
         (any ? svg_of_script("sweep-map-" + plain(c.name), sweep_map_script(s, c)) : "") + "<div class=\"charts\">" +
         cuts(s, c, peaks) + "</div>\n" +
         html_table("sweep-peaks-" + plain(c.name),
                    {"order", "largest, " + c.unit, "at r/min", "Hz", "natural frequency that it meets there", "Hz",
                     "damping ratio"},
                    rows);
}

std::vector<double> thinned(std::span<const double> values, std::size_t stride) {
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += stride) out.push_back(values[i]);
  return out;
}

}  // namespace

std::string sweep_section(const Subject& s) {
  if (!s.file.sweep) return "";
  const Sweep& sweep = *s.file.sweep;
  std::string html = fmt::format(
      "<section id=\"sweep\"><h2>Sweep</h2>\n<p>From {:g} to {:g} r/min in {:g} s{}. Amplitudes are those of {:g} "
      "revolutions of the driven body under a Hann window, tracked over its angle: orders that differ by a half are "
      "told apart, and a resonance that the sweep passes within a window is flattened. White rays are whole orders; "
      "red "
      "lines are natural frequencies of the linearised drive.</p>\n",
      sweep.asked.from_rpm, sweep.asked.to_rpm, sweep.asked.seconds, sweep.complete ? "" : ", broken off",
      sweep.window_revolutions);
  if (sweep.crank_rpm.empty()) html += "<p>The run ended before a window was full.</p>\n";
  for (const SweepChannel& c : sweep.channels)
    if (!sweep.crank_rpm.empty()) html += channel_part(sweep, c);
  return html + energy_table("sweep-energy", sweep.energy) + "</section>\n";
}

std::string event_section(const Subject& s) {
  if (!s.file.event || s.file.event->last_sample <= s.file.event->first_sample) return "";
  const WindowRecord& window = *s.file.event;
  const RunRecord& run = s.file.runs.front();
  const EventSummary summary = summarise_event(s.model, run, window);
  const std::size_t count = window.last_sample - window.first_sample, stride = 1 + count / 3000;
  const auto stretch = [&](const std::vector<double>& values) {
    return thinned(std::span(values).subspan(window.first_sample, count), stride);
  };
  std::vector<double> time = stretch(run.trace.time_s);
  for (double& t : time) t -= window.begin_s;
  const auto chart = [&](const std::string& id, const std::string& label,
                         const std::vector<std::pair<std::string, std::string>>& curves) {
    Chart c{"event-" + id, "time, s", label, {}};
    for (const auto& [words, channel] : curves)
      if (const Channel* found = run.trace.find(channel)) c.curves.push_back({words, time, stretch(found->values)});
    return c.curves.empty() ? "" : svg_of(c);
  };
  const SceneSpec& scene = s.model.scene;
  std::vector<std::pair<std::string, std::string>> speeds{{scene.driver->body, scene.driver->body + ".speed_rpm"}},
      torques{{"driver", "driver.torque_n_m"}}, tensions, slips;
  if (scene.output && scene.output->body != scene.driver->body)
    speeds.emplace_back(scene.output->body, scene.output->body + ".speed_rpm");
  if (scene.output) torques.emplace_back(scene.output->body, scene.output->body + ".torque_n_m");
  for (int p = 0; p < s.model.pulleys; ++p) {
    const std::string span = span_name(scene, static_cast<std::size_t>(p)), &name = s.model.body_name[p];
    tensions.emplace_back(span, "span." + span + ".tension_n");
    slips.emplace_back(name, "pulley." + name + ".slip_speed_m_s");
  }
  std::string html = "<section id=\"event\"><h2>Event</h2>\n<p>" + html_escaped(event_sentence(summary)) +
                     "</p>\n<div class=\"charts\">" + chart("speed", "speed, r/min", speeds) +
                     chart("tension", "span tension, N", tensions) +
                     chart("slip", "belt ahead of the pulley's surface, m/s", slips) +
                     chart("torque", "torque, N m", torques) + "</div>\n";
  for (const EventTable& t : event_tables(summary)) {
    std::vector<Row> rows;
    for (const auto& row : t.rows) rows.emplace_back(row.begin(), row.end());
    html += html_table("event-" + t.id, Row(t.header.begin(), t.header.end()), rows);
  }
  return html + energy_table("event-energy", window.energy) + "</section>\n";
}

}  // namespace beltlife
