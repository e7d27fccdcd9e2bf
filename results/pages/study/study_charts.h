// Owns the charts of study pages: marked curves and horizontal bars, on logarithmic or plain axes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace beltlife {

/// Colours that remain apart for colour-blind eyes (Okabe and Ito), in a fixed order.
std::string safe_colour(std::size_t index);

/// Curves with marks. A point that has no place on a logarithmic axis, or is no number, is left out.
struct MarkedChart {
  std::string id;  ///< unique on its page, of letters, digits, '-', '_' and '.'
  std::string title;
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  struct Series {
    std::string label;  ///< empty: not in the key
    std::vector<double> x, y;
    std::vector<std::string> names = {};  ///< written beside the points; may be empty
    std::string colour = "#000000";
    int mark = 7;         ///< gnuplot's point type; 0: none
    int dash = 1;         ///< gnuplot's dash type of the line; 0: no line
    double size = 1;      ///< of the marks
    bool filled = false;  ///< down to zero, paler than the line
  };
  std::vector<Series> series = {};
  /// A dashed line across the chart.
  struct Level {
    std::string label;
    double y = 0;
    int dash = 2;
  };
  std::vector<Level> levels = {};
  int width = 480, height = 330;  ///< px, without the key
};

/// The chart as SVG; empty if no point of it can be drawn.
std::string svg_of(const MarkedChart& chart);

/// Horizontal bars, for each row one of every layer.
struct Bars {
  std::string id;
  std::string x_label;
  std::vector<std::string> rows;
  struct Layer {
    std::string label;                        ///< empty: not in the key
    std::vector<double> values;               ///< one a row; what has no place on the axis has no bar
    std::vector<double> low = {}, high = {};  ///< ends of whiskers, one a row; may be empty
    std::vector<bool> pale = {};              ///< bars without colour; may be empty
  };
  std::vector<Layer> layers;
  bool log = false;
  std::optional<double> base = {};  ///< where bars begin; none: at the left end of the axis
};

/// The chart as SVG; empty if there is no bar.
std::string svg_of(const Bars& chart);

/// A part of an id: what is neither letter, digit, '-' nor '.' becomes '-'.
std::string id_of(const std::string& name);

}  // namespace beltlife
