// Owns charts: curves to SVG text by the gnuplot program.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

struct Curve {
  std::string label;
  std::vector<double> x, y;
  bool impulses = false;  ///< vertical lines instead of a line through the points
};

struct Chart {
  std::string id;  ///< unique on its page; every id inside the SVG begins with it
  std::string x_label, y_label;
  std::vector<Curve> curves;
  double x_max = 0;  ///< 0: by the data
  /// Stretches of the x axis that are shaded and named, such as the belt on a pulley; they need x_max.
  struct Stretch {
    std::string label;
    double from = 0, to = 0;
  };
  std::vector<Stretch> stretches = {};
};

/// Bars of layers on top of each other, in percent or what else adds up.
struct StackedBars {
  std::string id;
  std::string y_label;
  std::vector<std::string> bars;  ///< name of each bar
  struct Layer {
    std::string label;
    std::vector<double> heights;  ///< one a bar
  };
  std::vector<Layer> layers;
  double y_max = 0;  ///< 0: by the data
};

/// The chart as an SVG element that can stand in an HTML page beside others. Throws BadInput naming the package to
/// install if there is no gnuplot.
std::string svg_of(const Chart& chart);
std::string svg_of(const StackedBars& chart);
/// A string of gnuplot's, where the terminal is `noenhanced`: in single quotes, where only they are special; no line
/// break may end the command.
std::string gnuplot_quoted(const std::string& text);
/// The same of a script that sets terminal and axes and plots, but names no output.
std::string svg_of_script(const std::string& id, const std::string& script);

}  // namespace beltlife
