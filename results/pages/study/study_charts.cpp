// Charts of study pages: see study_charts.h.
#include "results/pages/study/study_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "results/pages/gnuplot.h"

namespace beltlife {
namespace {

std::string terminal(int width, int height) {
  return fmt::format(
      "set encoding utf8\nset terminal svg size {},{} dynamic noenhanced font 'Helvetica,11' linewidth 1.2\n"
      "set grid lc rgb '#dddddd'\n",
      width, height);
}

/// So much of a name as fits beside a chart; never half of a character.
std::string shortened(const std::string& name, std::size_t most) {
  if (name.size() <= most) return name;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;
  return name.substr(0, end) + "...";
}

struct Axis {
  char name;
  bool log;
  double low = std::numeric_limits<double>::infinity(), high = -low;

  bool has_place(double v) const { return std::isfinite(v) && (!log || v > 0); }
  void hold(double v) {
    if (!has_place(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  /// Where a value stands between the ends, from 0 to 1.
  double share(double v) const {
    if (!(high > low)) return 0.5;
    return log ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  }
  /// Range and tics, also where all values are the same: gnuplot would take a range of its own, perhaps without tics.
  std::string script() {
    if (!log) {
      const double span = high - low, most = std::max(std::abs(low), std::abs(high));
      const double margin = span > 0 ? 0.06 * span : most > 0 ? 0.05 * most : 1;
      const int digits = span > 0 ? std::clamp(static_cast<int>(std::ceil(std::log10(most / span))) + 2, 4, 15) : 4;
      return fmt::format("set {0}range [{1}:{2}]\nset format {0} '%.{3}g'\n{4}", name, low - margin, high + margin,
                         digits, digits > 6 ? fmt::format("set {}tics {}\n", name, span / 2) : "");
    }
    constexpr double least = 5;  // a factor that holds two tics wherever it lies
    low /= 1.3, high *= 1.3;
    if (const double lacking = least / (high / low); lacking > 1) low /= std::sqrt(lacking), high *= std::sqrt(lacking);
    const double decades = std::log10(high / low);
    const std::vector<double> steps = decades < 0.9   ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
                                      : decades < 1.7 ? std::vector<double>{1, 2, 5}
                                      : decades < 2.5 ? std::vector<double>{1, 3}
                                                      : std::vector<double>{1};
    const int every = std::max(1, static_cast<int>(std::ceil(decades / 7)));
    std::string tics;
    for (int e = static_cast<int>(std::floor(std::log10(low))); e <= std::log10(high); ++e)
      for (const double step : steps)
        if (const double at = step * std::pow(10.0, e); at >= low && at <= high && e % every == 0)
          tics += fmt::format("{}'{:g}' {}", tics.empty() ? "" : ", ", at, at);
    return fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics ({3})\n", name, low, high, tics);
  }
};

/// Lines of a key above the chart, by the room that gnuplot gives its columns.
int key_lines(const std::vector<std::string>& labels, int width) {
  std::size_t longest = 0, count = 0;
  for (const std::string& label : labels)
    if (!label.empty()) longest = std::max(longest, label.size()), ++count;
  const int columns = std::max(1, static_cast<int>((width - 70) / (75 + 6.5 * static_cast<double>(longest))));
  return (static_cast<int>(count) + columns - 1) / columns;
}

}  // namespace

std::string safe_colour(std::size_t index) {
  constexpr std::array colours{"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#000000"};
  return colours[index % colours.size()];
}

std::string id_of(const std::string& name) {
  std::string id;
  for (const char c : name)
    id += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ? c : '-';
  return id;
}

std::string svg_of(const MarkedChart& chart) {
  Axis x{'x', chart.log_x}, y{'y', chart.log_y};
  struct Label {
    double x, y;
    std::string name;
  };
  std::vector<Label> named;
  std::string data, labels, plots;
  std::vector<std::string> key;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const MarkedChart::Series& s = chart.series[i];
    std::string rows;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      if (!x.has_place(s.x[k]) || !y.has_place(s.y[k])) continue;
      x.hold(s.x[k]);
      y.hold(s.y[k]);
      rows += fmt::format("{} {}\n", s.x[k], s.y[k]);
      if (k < s.names.size() && !s.names[k].empty()) named.push_back({s.x[k], s.y[k], s.names[k]});
    }
    if (rows.empty()) continue;  // gnuplot stops at an empty data block
    data += fmt::format("$d{} << EOD\n{}EOD\n", i, rows);
    const std::string line = s.dash > 0 ? fmt::format("lw 1.5 dt {}", s.dash) : std::string();
    const std::string mark = s.mark > 0 ? fmt::format("pt {} ps {}", s.mark, 0.6 * s.size) : std::string();
    if (s.filled)
      plots += fmt::format("{}$d{} using 1:2 with filledcurves y=0 fc rgb '{}' fs solid 0.3 noborder notitle",
                           plots.empty() ? "" : ", ", i, s.colour);
    plots += fmt::format("{}$d{} using 1:2 with {} lc rgb '{}' {} {} {}", plots.empty() ? "" : ", ", i,
                         s.dash == 0   ? "points"
                         : s.mark == 0 ? "lines"
                                       : "linespoints",
                         s.colour, line, mark, s.label.empty() ? "notitle" : "title " + gnuplot_quoted(s.label));
    key.push_back(s.label);
  }
  if (plots.empty()) return "";
  for (const MarkedChart::Level& level : chart.levels) {
    if (!y.has_place(level.y)) continue;
    y.hold(level.y);
    plots += fmt::format(", {} with lines lw 1.2 lc rgb '#666666' dt {} title {}", level.y, level.dash,
                         gnuplot_quoted(level.label));
    key.push_back(level.label);
  }
  for (const Label& l : named) {
    // To the left of its point if it would run out of the chart.
    const double room = (1 - x.share(l.x)) * (chart.width - 90);
    labels += fmt::format("set label {} at {},{} {},0.5 font ',8' tc rgb '#555555'\n", gnuplot_quoted(l.name), l.x, l.y,
                          5.0 * static_cast<double>(l.name.size()) > room ? "right offset -0.6" : "left offset 0.6");
  }
  const int lines = key_lines(key, chart.width);
  const std::string title =
      chart.title.empty() ? "" : "set title " + gnuplot_quoted(chart.title) + " font ',11' offset 0,-0.4\n";
  const std::string texts =
      fmt::format("set xlabel {} offset 0,0.4\nset ylabel {}\nset key {}\n", gnuplot_quoted(chart.x_label),
                  gnuplot_quoted(chart.y_label), lines > 0 ? "outside top center horizontal" : "off");
  return svg_of_script(chart.id, terminal(chart.width, chart.height + 17 * lines) + x.script() + y.script() + title +
                                     texts + labels + data + "plot " + plots + "\n");
}

std::string svg_of(const Bars& chart) {
  Axis x{'x', chart.log};
  const auto at = [](const std::vector<double>& v, std::size_t r) {
    return r < v.size() ? v[r] : std::numeric_limits<double>::quiet_NaN();
  };
  for (const Bars::Layer& layer : chart.layers)
    for (const double v : layer.values) x.hold(v);
  if (x.low > x.high) return "";
  if (chart.base)
    x.hold(*chart.base);
  else if (chart.log)
    x.low /= 2;  // the least bar is a bar
  for (const Bars::Layer& layer : chart.layers)
    for (const auto* ends : {&layer.low, &layer.high})
      for (const double v : *ends) x.hold(v);
  const std::string axis = x.script();
  const double base = chart.base.value_or(x.low);
  // A row is its name, as high as a bar and a half, and its bars below it: beside them it would take half of a phone.
  const double layers = static_cast<double>(chart.layers.size()), row_height = layers + 2;
  std::string data, plots, names;
  std::vector<std::string> key;
  const auto plot = [&](const std::string& block, const std::string& rows, const std::string& how) {
    if (rows.empty()) return;  // gnuplot stops at an empty data block
    data += fmt::format("${} << EOD\n{}EOD\n", block, rows);
    plots += fmt::format("{}${} {}", plots.empty() ? "" : ", ", block, how);
  };
  for (std::size_t l = 0; l < chart.layers.size(); ++l) {
    const Bars::Layer& layer = chart.layers[l];
    std::string bars, pale, ends;
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
      const double v = at(layer.values, r), low = at(layer.low, r), high = at(layer.high, r);
      if (!x.has_place(v)) continue;
      const double top = row_height * static_cast<double>(r) + 1.5 + static_cast<double>(l);
      (r < layer.pale.size() && layer.pale[r] ? pale : bars) +=
          fmt::format("{0} {1} {2} {3} {4} {5}\n", v, top + 0.5, std::min(v, base), std::max(v, base), top, top + 1);
      if (x.has_place(low) && x.has_place(high)) ends += fmt::format("{} {} {} {}\n", v, top + 0.5, low, high);
    }
    const std::string title = layer.label.empty() ? "notitle" : "title " + gnuplot_quoted(layer.label);
    constexpr const char* boxes = "using 1:2:3:4:5:6 with boxxyerror lc rgb";
    plot(fmt::format("d{}", l), bars, fmt::format("{} '{}' {}", boxes, safe_colour(l), title));
    plot(fmt::format("p{}", l), pale, fmt::format("{} '#bbbbbb' notitle", boxes));
    plot(fmt::format("w{}", l), ends, "using 1:2:3:4 with xerrorbars lc rgb '#222222' pt 0 ps 0 notitle");
    if (!bars.empty()) key.push_back(layer.label);
  }
  for (std::size_t r = 0; r < chart.rows.size(); ++r)
    names += fmt::format("set label {} at graph 0.01, first {} left front\n",
                         gnuplot_quoted(shortened(chart.rows[r], 60)), row_height * static_cast<double>(r) + 0.85);
  if (chart.base)
    names += fmt::format("set arrow from first {0}, graph 0 to first {0}, graph 1 nohead lc rgb '#666666'\n", base);
  constexpr int width = 480;
  const double rows = row_height * static_cast<double>(chart.rows.size());
  const int lines = key_lines(key, width);
  return svg_of_script(chart.id, terminal(width, 70 + 17 * lines + static_cast<int>(12 * rows)) + axis + names +
                                     fmt::format("set yrange [{}:0]\nunset ytics\nset xlabel {} offset 0,0.4\n"
                                                 "unset grid\nset xtics nomirror\nset grid xtics lc rgb '#dddddd'\n"
                                                 "set key {}\nset style fill solid 0.9 noborder\n",
                                                 rows, gnuplot_quoted(chart.x_label),
                                                 lines > 0 ? "outside top center horizontal" : "off") +
                                     data + "plot " + plots + "\n");
}

}  // namespace beltlife
