// Drawing of a drive to scale: see layout_svg.h.
#include "results/pages/layout_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

/// From slack (blue) to tight (red).
std::string colour(double value, double low, double high) {
  const double s = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
  const auto mix = [s](double slack, double tight) { return static_cast<int>(slack + (tight - slack) * s); };
  return fmt::format("rgb({},{},{})", mix(20, 220), mix(90, 30), mix(210, 40));
}

/// A text's place in the drawing, px: its middle and half its size.
struct Label {
  double x = 0, y = 0, half_width = 0, half_height = 7;
};

double distance(const Label& label, double x, double y) {
  return std::hypot(std::max(std::abs(x - label.x) - label.half_width, 0.0),
                    std::max(std::abs(y - label.y) - label.half_height, 0.0));
}

double distance(const Label& a, const Label& b) {
  return std::hypot(std::max(std::abs(a.x - b.x) - a.half_width - b.half_width, 0.0),
                    std::max(std::abs(a.y - b.y) - a.half_height - b.half_height, 0.0));
}

/// What stands in the way of labels, px.
struct Obstacles {
  std::vector<std::array<double, 3>> circles;  ///< x, y, radius
  std::vector<std::array<double, 4>> lines;    ///< from x, y to x, y
  std::vector<Label> labels;

  double clearance(const Label& label) const {
    double clear = 1e9;
    for (const auto& [x, y, r] : circles) clear = std::min(clear, distance(label, x, y) - r);
    for (const auto& [x0, y0, x1, y1] : lines)
      for (int k = 0; k <= 40; ++k)
        clear = std::min(clear, distance(label, x0 + (x1 - x0) * k / 40, y0 + (y1 - y0) * k / 40));
    for (const Label& other : labels) clear = std::min(clear, distance(label, other));
    return clear;
  }
};

/// Beside a line, on the side and at the height where a label of this half width is clearest; the middle if that will
/// do.
Label beside(const std::array<double, 4>& line, double half_width, const Obstacles& obstacles) {
  const auto [x0, y0, x1, y1] = line;
  const double length = std::hypot(x1 - x0, y1 - y0), nx = -(y1 - y0) / length, ny = (x1 - x0) / length;
  constexpr double gap = 7, enough = 5;  // px; an arrow head reaches 6 px off its line
  Label best;
  double widest = -1e9;
  for (const double t : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8})
    for (const double side : {1.0, -1.0})
      for (const double farther : {0.0, 12.0}) {
        Label at{.half_width = half_width};
        const double away = gap + farther + half_width * std::abs(nx) + at.half_height * std::abs(ny);
        at.x = x0 + t * (x1 - x0) + side * away * nx;
        at.y = y0 + t * (y1 - y0) + side * away * ny;
        const double clear = std::min(obstacles.clearance(at), enough);
        if (clear > widest + 1e-9) {
          widest = clear;
          best = at;
        }
      }
  return best;
}

/// Pulleys and belt of another drive; `x` and `y` take m to px.
template <class X, class Y>
std::string dashed(const Model& m, double arm_angle, double scale, X x, Y y) {
  const auto circles = circles_of(m.scene, m.statics.orientation, arm_angle);
  std::string s = "<g fill=\"none\" stroke=\"#777\" stroke-width=\"1.3\" stroke-dasharray=\"5 4\">\n";
  for (const Circle& c : circles)
    s += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", x(c.x), y(c.y), c.radius * scale);
  Route route;
  if (make_route(circles, route))
    for (const Span& span : route.spans)
      s += fmt::format("<path d=\"M {:.1f} {:.1f} L {:.1f} {:.1f}\"/>\n", x(span.from.x), y(span.from.y), x(span.to.x),
                       y(span.to.y));
  return s + "</g>\n";
}

/// Pulleys by the side of the belt that runs on them, and the tensioner's arm.
template <class X, class Y>
std::string pulleys_and_arm(const Model& m, const std::vector<Circle>& circles, double scale, X x, Y y) {
  std::string s;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const Circle& c = circles[i];
    const bool front = m.scene.pulley[i].side == Side::front;
    s += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"#999\"/>\n", x(c.x), y(c.y),
                     c.radius * scale, front ? "#e9eef3" : "#f4efe6");
  }
  if (m.tensioner.pulley >= 0) {
    const Circle& c = circles[static_cast<std::size_t>(m.tensioner.pulley)];
    s += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#555\" stroke-width=\"6\" "
        "stroke-linecap=\"round\" "
        "opacity=\"0.6\"/><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"#333\"/>\n",
        x(m.tensioner.pivot_x), y(m.tensioner.pivot_y), x(c.x), y(c.y), x(m.tensioner.pivot_x), y(m.tensioner.pivot_y));
  }
  return s;
}

}  // namespace

void make_room(SharedDrawing& box, const Model& m, double arm_angle, const std::vector<double>& tension) {
  for (const Circle& c : circles_of(m.scene, m.statics.orientation, arm_angle)) {
    box.left = std::min(box.left, c.x - c.radius);
    box.right = std::max(box.right, c.x + c.radius);
    box.bottom = std::min(box.bottom, c.y - c.radius);
    box.top = std::max(box.top, c.y + c.radius);
  }
  for (const double value : tension) {
    box.slack_n = std::min(box.slack_n, value);
    box.tight_n = std::max(box.tight_n, value);
  }
}

std::string layout_svg(const Model& m, double arm_angle, const std::vector<double>& tension, const std::string& id) {
  SharedDrawing own;
  make_room(own, m, arm_angle, tension);
  return layout_svg(m, arm_angle, tension, id, own);
}

std::string layout_svg(const Model& m, double arm_angle, const std::vector<double>& tension, const std::string& id,
                       const SharedDrawing& box) {
  const auto circles = circles_of(m.scene, m.statics.orientation, arm_angle);
  Route route;
  if (!make_route(circles, route)) return "";
  const double margin = 0.09 * std::max(box.right - box.left, box.top - box.bottom);
  const double scale =
      620 / std::max(box.right - box.left + 2 * margin, box.top - box.bottom + 2 * margin);  // px per m
  const auto x = [&](double v) { return (v - box.left + margin) * scale; };
  const auto y = [&](double v) { return (box.top + margin - v) * scale; };
  const double width = x(box.right + margin), height = y(box.bottom - margin) + 40;

  std::string s = fmt::format(
      "<figure id=\"{0}\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{0}_svg\" viewBox=\"0 0 {1:.0f} {2:.0f}\" "
      "width=\"{1:.0f}\" role=\"img\" "
      "aria-label=\"layout to "
      "scale, spans coloured by tension\" font-family=\"Helvetica, sans-serif\" font-size=\"12\">\n",
      id, width, height);
  s += pulleys_and_arm(m, circles, scale, x, y);
  if (box.beneath) s += dashed(*box.beneath, box.beneath_arm, scale, x, y);
  const double low = box.slack_n, high = box.tight_n;
  const std::size_t n = circles.size();
  const bool in_order = (m.scene.rotation == Rotation::counterclockwise) == (m.statics.orientation > 0);
  const double ahead = in_order ? 1 : -1;  // the scene may list its pulleys against the running sense
  Obstacles obstacles;
  for (std::size_t i = 0; i < n; ++i) {
    const Span& span = route.spans[i];
    obstacles.circles.push_back({x(circles[i].x), y(circles[i].y), circles[i].radius * scale});
    obstacles.lines.push_back({x(span.from.x), y(span.from.y), x(span.to.x), y(span.to.y)});
    obstacles.labels.push_back(
        {x(circles[i].x), y(circles[i].y), 3.6 * static_cast<double>(m.scene.pulley[i].name.size())});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Span &span = route.spans[i], &next = route.spans[(i + 1) % n];
    s += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"4\"><title>{}: "
        "{:.0f} N</title></line>\n",
        x(span.from.x), y(span.from.y), x(span.to.x), y(span.to.y), colour(tension[i], low, high),
        span_name(m.scene, i), tension[i]);
    const std::size_t j = (i + 1) % n;
    const Circle& c = circles[j];
    // In the picture y points down, so a counterclockwise arc is drawn with sweep 0.
    s += fmt::format(
        "<path d=\"M {:.1f} {:.1f} A {:.1f} {:.1f} 0 {} {} {:.1f} {:.1f}\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"4\"/>\n",
        x(span.to.x), y(span.to.y), c.radius * scale, c.radius * scale, route.wrap[j] > std::numbers::pi ? 1 : 0,
        c.turn > 0 ? 0 : 1, x(next.from.x), y(next.from.y), colour(0.5 * (tension[i] + tension[j]), low, high));
    // An arrow head in the middle of the span, the way the belt runs.
    const double mx = x(0.5 * (span.from.x + span.to.x)), my = y(0.5 * (span.from.y + span.to.y));
    const double ux = ahead * span.direction.x, uy = -ahead * span.direction.y;
    s += fmt::format("<path d=\"M {:.1f} {:.1f} L {:.1f} {:.1f} L {:.1f} {:.1f} Z\" fill=\"{}\"/>\n", mx + 8 * ux,
                     my + 8 * uy, mx - 6 * ux - 6 * uy, my - 6 * uy + 6 * ux, mx - 6 * ux + 6 * uy,
                     my - 6 * uy - 6 * ux, colour(tension[i], low, high));
    const Label label = beside(obstacles.lines[i], 20, obstacles);
    obstacles.labels.push_back(label);
    s += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#333\" stroke=\"#fff\" stroke-width=\"3\" "
        "paint-order=\"stroke\">{:.0f} N</text>\n",
        label.x, label.y + 4, tension[i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    s += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-weight=\"bold\" stroke=\"#fff\" "
        "stroke-width=\"3\" "
        "paint-order=\"stroke\">{}</text>\n",
        x(circles[i].x), y(circles[i].y) + 4, m.scene.pulley[i].name);
  s += fmt::format(
      "<line x1=\"20\" y1=\"{0:.0f}\" x2=\"{1:.0f}\" y2=\"{0:.0f}\" stroke=\"#333\" stroke-width=\"2\"/><text x=\"20\" "
      "y=\"{2:.0f}\">100 mm</text>\n</svg>\n<figcaption>{5}. Arrows show the way the belt runs. "
      "Ribs run on the grey pulleys, the back on the beige ones.</figcaption>\n</figure>\n",
      height - 22, 20 + 0.1 * scale, height - 6, low, high,
      high - low < 0.5 ? fmt::format("Belt at {:.0f} N", low)
                       : fmt::format("Belt from blue, {:.0f} N, to red, {:.0f} N", low, high));
  return s;
}

}  // namespace beltlife
