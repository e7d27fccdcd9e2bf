// The ranges of a comparison, and what its sections share: see report_compare_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/pages/gnuplot.h"
#include "results/pages/run/report_compare_parts.h"
#include "results/pages/run/report_sections.h"
#include "sim/signal/spectrum.h"

namespace beltlife::compare_page {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
using Ranges = std::vector<const Subject::Range*>;  ///< one a side, null where it has none

/// The element of that name, null if there is none.
template <class List>
auto named(const List& list, const std::string& name) -> decltype(&list[0]) {
  for (const auto& element : list)
    if (element.name == name) return &element;
  return nullptr;
}

/// A number of each side's range; `value` is not asked where there is none.
template <class Value>
std::vector<double> of_each(const Ranges& ranges, Value value) {
  std::vector<double> out;
  for (const Subject::Range* range : ranges) out.push_back(range ? value(range->summary) : none);
  return out;
}

bool none_known(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double v) { return std::isnan(v); });
}

template <class NamesIn>
std::vector<std::string> names_in(const Contenders& sides, const Ranges& ranges, NamesIn names) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (ranges[i])
      for (const auto& part : names(ranges[i]->summary))
        if (std::ranges::find(all, part.name) == all.end()) all.push_back(part.name);
  return all;
}

/// A table of mean values with their bounds; none where no side has a row.
std::string table(const std::string& id, const char* title, const std::string& first, const Contenders& sides,
                  const std::vector<Row>& rows) {
  if (rows.empty()) return "";
  return fmt::format("<div><h3>{}</h3>\n", title) + html_table(id, compared_header(first, sides), rows) + "</div>\n";
}

std::string span_tables(const std::string& id, const Contenders& sides, const Ranges& ranges) {
  std::vector<Row> mean, peak;
  for (const std::string& name : names_in(sides, ranges, [](const RangeSummary& s) { return s.spans; })) {
    const auto of_span = [&](double SpanSummary::*member) {
      return of_each(ranges, [&](const RangeSummary& s) {
        const SpanSummary* span = named(s.spans, name);
        return span ? span->*member : none;
      });
    };
    mean.push_back(compared_row(name, of_span(&SpanSummary::tension_n_mean), 0));
    peak.push_back(compared_row(name, of_span(&SpanSummary::tension_n_max), 0));
  }
  return table(id + "-tensions", "Span tension, mean, N", "span", sides, mean) +
         table(id + "-tensions-highest", "Span tension, highest, N", "span", sides, peak);
}

std::string pulley_tables(const std::string& id, const Contenders& sides, const Ranges& ranges) {
  std::vector<Row> slip, hub;
  for (const std::string& name : names_in(sides, ranges, [](const RangeSummary& s) { return s.pulleys; })) {
    const auto of_pulley = [&](auto value) {
      return of_each(ranges, [&](const RangeSummary& s) {
        const PulleySummary* pulley = named(s.pulleys, name);
        return pulley ? value(*pulley) : none;
      });
    };
    hub.push_back(compared_row(name, of_pulley([](const PulleySummary& p) { return p.hub_load_n; }), 0));
    const auto slips = of_pulley([](const PulleySummary& p) { return p.slip_percent.value_or(none); });
    if (none_known(slips)) continue;
    Row row{name};  // slip is near zero, where a change in per cent says nothing
    for (const double value : slips) row.push_back(html_number(value, 2));
    slip.push_back(std::move(row));
  }
  Row header{"pulley"};
  for (const Contender& side : sides) header.push_back(side.label);
  return table(id + "-hub-loads", "Hub load, mean, N", "pulley", sides, hub) +
         (slip.empty() ? ""
                       : "<div><h3>Slip against the driven pulley, %</h3>\n" + html_table(id + "-slip", header, slip) +
                             "</div>\n");
}

std::string order_table(const std::string& id, const Contenders& sides, const Ranges& ranges) {
  std::vector<double> orders;
  for (const Subject::Range* range : ranges)
    if (range && range->summary.output)
      for (const OrderLine& line : range->summary.output->orders) orders.push_back(line.order);
  std::ranges::sort(orders);
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  const auto of_order = [&](double order, double OrderLine::*member) {
    return of_each(ranges, [&](const RangeSummary& s) {
      if (s.output)
        for (const OrderLine& line : s.output->orders)
          if (line.order == order) return line.*member;
      return none;
    });
  };
  constexpr double small = 0.01;  // of the largest order in any file: below lies what nobody compares
  std::vector<Row> rows;
  const auto add = [&](const char* words, double OrderLine::*member) {
    double largest = 0;
    for (const double order : orders)
      for (const double v : of_order(order, member)) largest = std::max(largest, std::isnan(v) ? 0 : v);
    for (const double order : orders)
      if (const auto values = of_order(order, member);
          std::ranges::any_of(values, [&](double v) { return v >= small * largest; }))
        rows.push_back(compared_row(fmt::format("order {:g}, {}", order, words), values, 3));
  };
  add("speed r/min", &OrderLine::speed_rpm);
  add("torque N m", &OrderLine::torque_n_m);
  return table(id + "-orders", "Amplitudes of the output from 1 % of the largest, by order of the driven body",
               "amplitude", sides, rows);
}

std::string loss_table(const std::string& id, const Contenders& sides, const Ranges& ranges) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < energy_words.size(); ++i) {
    const auto power = of_each(ranges, [&](const RangeSummary& s) { return s.power_w[i]; });
    if (std::ranges::any_of(power, [](double v) { return v != 0 && !std::isnan(v); }))  // what no drive has
      rows.push_back(compared_row(energy_words[i], power, 1));
  }
  return table(id + "-losses", "Power and losses, mean, W", "power", sides, rows);
}

/// Speed and torque of each side's output over each other, in time and by frequency.
std::string output_charts(const std::string& id, const Contenders& sides, const Ranges& ranges) {
  struct Output {
    const char *what, *words, *unit;
  };
  std::string html;
  for (const auto& [what, words, unit] :
       {Output{"speed_rpm", "speed", "r/min"}, Output{"torque_n_m", "torque", "N m"}}) {
    std::vector<Curve> traces, spectra;
    double end = 0.4;  // s: longer stretches show no single waves
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (!ranges[i] || !ranges[i]->summary.output) continue;
      const auto values = in_window(*ranges[i], ranges[i]->summary.output->body + "." + what);
      if (values.empty()) continue;
      traces.push_back({sides[i].label, window_time(*ranges[i]), {values.begin(), values.end()}});
      end = std::min(end, traces.back().x.back());
      const Spectrum s = amplitude_spectrum(values, sides[i].subject.model.scene.solver.sample_rate_hz);
      spectra.push_back({sides[i].label, s.frequency_hz, s.amplitude});
    }
    if (traces.empty()) continue;
    html += svg_of({id + "-trace-" + what, "time since the start of each window, s",
                    fmt::format("output's {}, {}", words, unit), traces, end}) +
            svg_of({id + "-spectrum-" + what, "frequency, Hz", fmt::format("output's {} amplitude, {}", words, unit),
                    spectra, 300});
  }
  return html.empty() ? "" : "<div class=\"charts\">" + html + "</div>\n";
}

}  // namespace

std::vector<std::string> all_names(const Contenders& sides, const NamesOf& names_of) {
  std::vector<std::string> all;
  for (const Contender& side : sides)
    for (const std::string& name : names_of(side))
      if (std::ranges::find(all, name) == all.end()) all.push_back(name);
  return all;
}

const Subject::Range* range_of(const Contender& side, const std::string& name) {
  for (const auto& range : side.subject.ranges)
    if (range.window->range == name) return &range;
  return nullptr;
}

std::string change_text(double value, double first) {
  const double change = 100 * (value / first - 1);
  if (!std::isfinite(change)) return "-";
  const std::string text = html_number(change, 1);
  return change > 0 && text != "0.0" ? "+" + text : text;
}

Row compared_header(const std::string& first, const Contenders& sides) {
  Row header{first};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    header.push_back(sides[i].label);
    if (i > 0) header.push_back("change %");
  }
  return header;
}

Row compared_row(const std::string& name, const std::vector<double>& values, int digits) {
  Row row{name};
  for (std::size_t i = 0; i < values.size(); ++i) {
    row.push_back(html_number(values[i], digits));
    if (i > 0) row.push_back(change_text(values[i], values.front()));
  }
  return row;
}

std::string ranges_section(const Contenders& sides) {
  const auto names = all_names(sides, [](const Contender& side) {
    std::vector<std::string> of_side;
    for (const auto& range : side.subject.ranges) of_side.push_back(range.window->range);
    return of_side;
  });
  if (names.empty()) return "";
  const Subject::Range* shown = shown_range(sides.front().subject);
  const std::string open = shown ? shown->window->range : names.front();
  std::string html = "<section id=\"ranges\"><h2>Ranges</h2>\n";
  for (const std::string& name : names) {
    Ranges ranges;
    std::string missing, incomplete;
    for (const Contender& side : sides) {
      ranges.push_back(range_of(side, name));
      if (!ranges.back())
        missing += (missing.empty() ? "; not in " : ", ") + side.label;
      else if (!ranges.back()->window->complete)
        incomplete += (incomplete.empty() ? "; incomplete in " : ", ") + side.label;
    }
    const std::string id = "range-" + name;
    html += fmt::format("<details id=\"{}\"{}><summary>{}{}</summary>\n", html_escaped(id), name == open ? " open" : "",
                        html_escaped(name), html_escaped(missing + incomplete)) +
            output_charts(id, sides, ranges) + "<div class=\"charts\">" + order_table(id, sides, ranges) +
            span_tables(id, sides, ranges) + pulley_tables(id, sides, ranges) + loss_table(id, sides, ranges) +
            "</div></details>\n";
  }
  return html + "</section>\n";
}

}  // namespace beltlife::compare_page
