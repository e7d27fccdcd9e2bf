// Charts by gnuplot: see gnuplot.h.
#include "results/pages/gnuplot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

/// A folder for script and output that goes away with the object.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "beltlife-chart-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw BadInput(
          {Problem{name, 0, "", "no temporary folder can be made", "TMPDIR set to a folder with free space"}});
    path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

/// Size and colours of all charts.
std::string preamble(int width, int height) {
  std::string s = fmt::format(
      "set terminal svg size {},{} dynamic noenhanced font 'Helvetica,11' linewidth 1.2\nset grid lc rgb '#dddddd'\n",
      width, height);
  int type = 0;
  for (const char* colour : {"#0b61a4", "#d1495b", "#2e933c", "#8f5db7", "#c98a00", "#3aa6a6", "#777777", "#7a4b2a",
                             "#e58bb0", "#9db92c", "#2b2b6b", "#f2b35e"})
    s += fmt::format("set linetype {} lc rgb '{}'\n", ++type, colour);
  return s + fmt::format("set linetype cycle {}\n", type);
}

std::string script_of(const Chart& chart) {
  // A key takes its lines from the curves' height, so the chart grows with them; columns are as wide as the longest
  // label. A single curve is named by its axis.
  std::size_t longest = 0;
  for (const Curve& curve : chart.curves) longest = std::max(longest, curve.label.size());
  const int columns = std::max(1, static_cast<int>(400 / (60 + 6.5 * static_cast<double>(longest))));
  const bool keyed = chart.curves.size() > 1;
  const int lines = keyed ? (static_cast<int>(chart.curves.size()) + columns - 1) / columns : 0;
  std::string s = preamble(480, 237 + 17 * lines);
  s += fmt::format("set xlabel {}\nset ylabel {}\nset key {}\n", gnuplot_quoted(chart.x_label),
                   gnuplot_quoted(chart.y_label), keyed ? "outside top center horizontal" : "off");
  if (chart.x_max > 0) s += fmt::format("set xrange [0:{:g}]\n", chart.x_max);
  int object = 0;
  for (const Chart::Stretch& at : chart.stretches) {
    s += fmt::format("set object {} rect from {:g},graph 0 to {:g},graph 1 fc rgb '#edf1f5' fs solid noborder behind\n",
                     ++object, at.from, at.to);
    const double middle = 0.5 * (at.from + at.to);
    if (middle < 0.02 * chart.x_max || middle > 0.98 * chart.x_max) continue;  // would run into the axis
    s += fmt::format("set label {} at {:g},graph 0.98 right rotate by 90 font ',9' tc rgb '#777777' back\n",
                     gnuplot_quoted(at.label), middle);
  }
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    s += fmt::format("$d{} << EOD\n", i);
    const Curve& c = chart.curves[i];
    for (std::size_t k = 0; k < c.x.size(); ++k) s += fmt::format("{:.6g} {:.6g}\n", c.x[k], c.y[k]);
    s += "EOD\n";
  }
  s += "plot ";
  for (std::size_t i = 0; i < chart.curves.size(); ++i)
    s += fmt::format("{}$d{} using 1:2 with {} title {}", i ? ", " : "", i,
                     chart.curves[i].impulses ? "impulses lw 2" : "lines", gnuplot_quoted(chart.curves[i].label));
  return s + "\n";
}

std::string script_of(const StackedBars& chart) {
  std::string s = preamble(480, 300);
  s += fmt::format("set ylabel {}\nset yrange [0:{}]\nset style data histogram\nset style histogram rowstacked\n",
                   gnuplot_quoted(chart.y_label), chart.y_max > 0 ? fmt::format("{:g}", chart.y_max) : "*");
  s += "set style fill solid 0.9 border rgb '#ffffff'\nset boxwidth 0.7\nset xtics nomirror scale 0\nset border 3\nset "
       "ytics nomirror\n"
       "set key outside right top vertical invert\nunset grid\nset grid ytics lc rgb '#dddddd'\n";
  std::size_t letters = 0, longest = 0;
  for (const std::string& bar : chart.bars) letters += bar.size() + 2;
  for (const StackedBars::Layer& layer : chart.layers) longest = std::max(longest, layer.label.size());
  const double beside_key = 340 - 6.5 * static_cast<double>(longest);  // px, of the axis below the bars
  if (6.2 * static_cast<double>(letters) > beside_key)
    s += "set xtics rotate by -35\n";  // names side by side would run into each other
  s += "$d << EOD\n";
  for (std::size_t b = 0; b < chart.bars.size(); ++b) {
    for (const StackedBars::Layer& layer : chart.layers) s += fmt::format("{:.6g} ", layer.heights[b]);
    s += "\n";
  }
  s += "EOD\nset xtics (";
  for (std::size_t b = 0; b < chart.bars.size(); ++b) {
    std::string name = chart.bars[b];  // a tic's text is a format
    for (std::size_t at = 0; (at = name.find('%', at)) != name.npos; at += 2) name.insert(at, 1, '%');
    s += fmt::format("{}{} {}", b ? ", " : "", gnuplot_quoted(name), b);
  }
  s += ")\nplot ";
  for (std::size_t l = 0; l < chart.layers.size(); ++l)
    s += fmt::format("{}$d using {} title {}", l ? ", " : "", l + 1, gnuplot_quoted(chart.layers[l].label));
  return s + "\n";
}

/// gnuplot gives every plot the same ids: ours are made unique by a prefix, in definitions and in references.
std::string with_unique_ids(std::string svg, const std::string& id) {
  svg = std::regex_replace(svg, std::regex(R"((\bid=['"])([^'"]+))"), "$1" + id + "_$2");
  svg = std::regex_replace(svg, std::regex(R"((href=['"]#)([^'"]+))"), "$1" + id + "_$2");
  svg = std::regex_replace(svg, std::regex(R"((url\(#)([^)]+))"), "$1" + id + "_$2");
  return svg;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "'";
}

std::string svg_of(const Chart& chart) { return svg_of_script(chart.id, script_of(chart)); }

std::string svg_of(const StackedBars& chart) { return svg_of_script(chart.id, script_of(chart)); }

std::string svg_of_script(const std::string& id, const std::string& script) {
  const Scratch scratch;
  std::ofstream(scratch.path / "chart.gp") << "set output 'chart.svg'\n" << script;
  const std::string command = fmt::format("cd '{}' && gnuplot chart.gp >log.txt 2>&1", scratch.path.string());
  const int status = std::system(command.c_str());
  std::ifstream in(scratch.path / "chart.svg");
  std::string svg{std::istreambuf_iterator<char>(in), {}};
  const auto begin = svg.find("<svg");
  if (status != 0 || begin == std::string::npos) {
    std::ifstream log(scratch.path / "log.txt");
    std::string words;
    std::getline(log, words);
    throw BadInput(
        {Problem{"gnuplot", 0, id, "drew no chart: " + (words.empty() ? std::string("no reason given") : words),
                 "a working gnuplot: apt-get install gnuplot-nox"}});
  }
  return fmt::format("<figure id=\"{}\">\n{}\n</figure>\n", id, with_unique_ids(svg.substr(begin), id));
}

}  // namespace beltlife
