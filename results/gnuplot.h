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
};

/// The chart as an SVG element that can stand in an HTML page beside others. Throws BadInput naming the package to
/// install if there is no gnuplot.
std::string svg_of(const Chart& chart);

}  // namespace beltlife
