// Charts by gnuplot: see gnuplot.h.
#include "results/gnuplot.h"

#include <fmt/format.h>
#include <unistd.h>

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

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '_') out += "\\\\";  // enhanced text would set a subscript
    out += c;
  }
  return out + "\"";
}

std::string script_of(const Chart& chart) {
  std::string s =
      "set terminal svg size 620,300 dynamic font 'Helvetica,11' linewidth 1.2\nset output 'chart.svg'\nset grid lc "
      "rgb '#dddddd'\n";
  s += fmt::format("set xlabel {}\nset ylabel {}\nset key outside top center horizontal\n", quoted(chart.x_label),
                   quoted(chart.y_label));
  s += "set linetype 1 lc rgb '#0b61a4'\nset linetype 2 lc rgb '#d1495b'\nset linetype 3 lc rgb '#2e933c'\nset "
       "linetype 4 lc rgb '#8f5db7'\n"
       "set linetype 5 lc rgb '#c98a00'\nset linetype 6 lc rgb '#3aa6a6'\nset linetype 7 lc rgb '#777777'\nset "
       "linetype cycle 7\n";
  if (chart.x_max > 0) s += fmt::format("set xrange [0:{:g}]\n", chart.x_max);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    s += fmt::format("$d{} << EOD\n", i);
    const Curve& c = chart.curves[i];
    for (std::size_t k = 0; k < c.x.size(); ++k) s += fmt::format("{:.6g} {:.6g}\n", c.x[k], c.y[k]);
    s += "EOD\n";
  }
  s += "plot ";
  for (std::size_t i = 0; i < chart.curves.size(); ++i)
    s += fmt::format("{}$d{} using 1:2 with {} title {}", i ? ", " : "", i,
                     chart.curves[i].impulses ? "impulses lw 2" : "lines", quoted(chart.curves[i].label));
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

std::string svg_of(const Chart& chart) {
  const Scratch scratch;
  std::ofstream(scratch.path / "chart.gp") << script_of(chart);
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
        {Problem{"gnuplot", 0, chart.id, "drew no chart: " + (words.empty() ? std::string("no reason given") : words),
                 "a working gnuplot: apt-get install gnuplot-nox"}});
  }
  return fmt::format("<figure id=\"{}\">\n{}\n</figure>\n", chart.id, with_unique_ids(svg.substr(begin), chart.id));
}

}  // namespace beltlife
