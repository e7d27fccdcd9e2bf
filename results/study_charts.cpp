// Charts of study pages: see study_charts.h.
#include "results/study_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "results/gnuplot.h"

namespace beltlife {
namespace {

std::string terminal(int width, int height) {
  return fmt::format(
      "set encoding utf8\nset terminal svg size {},{} dynamic noenhanced font 'Helvetica,11' linewidth 1.2\n"
      "set grid lc rgb '#dddddd'\n",
      width, height);
}

/// The text of a tic is a format.
std::string tic_text(std::string name) {
  for (std::size_t at = 0; (at = name.find('%', at)) != name.npos; at += 2) name.insert(at, 1, '%');
  return gnuplot_quoted(name);
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
    const std::vector<double> steps = decades < 1.7   ? std::vector<double>{1, 2, 5}
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

/// Lines of a key below the chart, and the script that puts it there.
int key_lines(const std::vector<std::string>& labels, int width) {
  std::size_t longest = 0, count = 0;
  for (const std::string& label : labels)
    if (!label.empty()) longest = std::max(longest, label.size()), ++count;
  const int columns = std::max(1, static_cast<int>((width - 70) / (60 + 6.0 * static_cast<double>(longest))));
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
      if (k < s.names.size() && !s.names[k].empty())
        labels += fmt::format("set label {} at {},{} left offset 0.6,0.5 font ',8' tc rgb '#555555'\n",
                              gnuplot_quoted(s.names[k]), s.x[k], s.y[k]);
    }
    if (rows.empty()) continue;  // gnuplot stops at an empty data block
    data += fmt::format("$d{} << EOD\n{}EOD\n", i, rows);
    const std::string line = s.dash > 0 ? fmt::format("lw 1.5 dt {}", s.dash) : std::string();
    const std::string mark = s.mark > 0 ? fmt::format("pt {} ps {}", s.mark, 0.6 * s.size) : std::string();
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
  const int lines = key_lines(key, chart.width);
  return svg_of_script(chart.id, terminal(chart.width, chart.height + 17 * lines) + x.script() + y.script() +
                                     fmt::format("set xlabel {}\nset ylabel {}\nset key {}\n",
                                                 gnuplot_quoted(chart.x_label), gnuplot_quoted(chart.y_label),
                                                 lines > 0 ? "below center horizontal" : "off") +
                                     labels + data + "plot " + plots + "\n");
}

std::string svg_of(const LogBars& chart) {
  Axis x{'x', true};
  for (const LogBars::Layer& layer : chart.layers)
    for (const double v : layer.values) x.hold(v);
  if (x.low > x.high) return "";
  x.low /= 2;  // the least bar is a bar
  const std::string axis = x.script();
  const double layers = static_cast<double>(chart.layers.size()), height = 0.84 / layers;
  std::string data, plots, names;
  std::vector<std::string> key;
  for (std::size_t l = 0; l < chart.layers.size(); ++l) {
    std::string rows;
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
      const double v = chart.layers[l].values[r];
      if (!x.has_place(v)) continue;
      const double middle = static_cast<double>(r) + (static_cast<double>(l) - 0.5 * (layers - 1)) * height;
      rows += fmt::format("{0} {1} {2} {0} {3} {4}\n", v, middle, x.low, middle - 0.5 * height, middle + 0.5 * height);
    }
    if (rows.empty()) continue;
    data += fmt::format("$d{} << EOD\n{}EOD\n", l, rows);
    plots += fmt::format("{}$d{} using 1:2:3:4:5:6 with boxxyerror lc rgb '{}' title {}", plots.empty() ? "" : ", ", l,
                         safe_colour(l), gnuplot_quoted(chart.layers[l].label));
    key.push_back(chart.layers[l].label);
  }
  for (std::size_t r = 0; r < chart.rows.size(); ++r)
    names += fmt::format("{}{} {}", r > 0 ? ", " : "", tic_text(shortened(chart.rows[r], 48)), r);
  constexpr int width = 720;
  const int bars = static_cast<int>(chart.rows.size() * chart.layers.size());
  return svg_of_script(
      chart.id, terminal(width, 80 + 17 * key_lines(key, width) + 11 * bars + 6 * static_cast<int>(chart.rows.size())) +
                    axis +
                    fmt::format("set yrange [{}:-0.5]\nset ytics ({}) scale 0\nset xlabel {}\n"
                                "unset grid\nset grid xtics lc rgb '#dddddd'\n"
                                "set key below center horizontal\nset style fill solid 0.9 noborder\n",
                                static_cast<double>(chart.rows.size()) - 0.5, names, gnuplot_quoted(chart.x_label)) +
                    data + "plot " + plots + "\n");
}

}  // namespace beltlife
