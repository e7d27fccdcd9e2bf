// The drawing of layouts before and after, to scale: see optimize_charts.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "optimize/pages/optimize_charts.h"
#include "results/pages/html.h"
#include "results/pages/study/study_parts.h"

namespace beltlife {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Place {
  double x = none, y = none;
  bool known() const { return std::abs(x) < 1e7 && std::abs(y) < 1e7; }  // false for NaN
};

Place place_of(const std::array<double, 2>& pair) { return {pair[0], pair[1]}; }

/// A layout as the answer has it, mm.
struct Loop {
  struct Pulley {
    std::string name;
    Place centre;
    double radius = none;
    bool front = true;
    bool known() const { return centre.known() && radius > 0 && radius < 1e7; }
  };
  struct Span {
    Place from, to;
    bool known() const { return from.known() && to.known(); }
  };
  struct KeepOut {
    std::string name;
    double margin = 0, radius = none;  ///< a radius: of a circle
    std::vector<Place> corners;        ///< of a circle its centre
  };
  std::vector<Pulley> pulleys;
  std::vector<Span> spans;
  std::string arm_pulley;
  Place pivot;
  Place box_low, box_high;
  std::vector<KeepOut> keep_outs;

  bool boxed() const { return box_low.known() && box_high.known(); }
};

Loop::KeepOut keep_out_of(const DrawnKeepOut& drawn) {
  Loop::KeepOut k;
  k.name = drawn.name;
  if (drawn.margin_mm > 0 && drawn.margin_mm < 1e7) k.margin = drawn.margin_mm;
  if (drawn.circle && drawn.circle->radius_mm >= 0 && drawn.circle->radius_mm < 1e7) {
    k.radius = drawn.circle->radius_mm;
    k.corners = {{drawn.circle->x_mm, drawn.circle->y_mm}};
  } else if (drawn.polygon) {
    const auto &x = drawn.polygon->x_mm, &y = drawn.polygon->y_mm;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) k.corners.push_back({x[i], y[i]});
  }
  if (!std::all_of(k.corners.begin(), k.corners.end(), [](const Place& p) { return p.known(); })) k.corners.clear();
  return k;
}

Loop loop_of(const DrawnLayout* layout) {
  Loop loop;
  if (!layout) return loop;
  for (const DrawnPulley& p : layout->pulleys)
    loop.pulleys.push_back({p.name, {p.x_mm, p.y_mm}, 0.5 * p.diameter_mm, p.side != "back"});
  for (const DrawnSpan& span : layout->spans) loop.spans.push_back({place_of(span.from_mm), place_of(span.to_mm)});
  if (layout->keep_outs)
    for (const DrawnKeepOut& k : *layout->keep_outs) loop.keep_outs.push_back(keep_out_of(k));
  if (const auto& arm = layout->tensioner) {
    loop.arm_pulley = arm->pulley;
    loop.pivot = {arm->pivot_x_mm, arm->pivot_y_mm};
  }
  if (const auto& box = layout->box) {
    loop.box_low = {box->x_min_mm, box->y_min_mm};
    loop.box_high = {box->x_max_mm, box->y_max_mm};
  }
  return loop;
}

/// The stretch of the plane that is drawn, and how, px.
struct Frame {
  double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
  double scale = 1;

  void hold(const Place& p, double around = 0) {
    if (!p.known()) return;
    left = std::min(left, p.x - around);
    right = std::max(right, p.x + around);
    bottom = std::min(bottom, p.y - around);
    top = std::max(top, p.y + around);
  }
  void hold(const Loop& loop) {
    for (const auto& p : loop.pulleys)
      if (p.known()) hold(p.centre, p.radius);
    hold(loop.pivot);
    if (loop.boxed()) hold(loop.box_low), hold(loop.box_high);
    for (const auto& k : loop.keep_outs)
      for (const Place& p : k.corners) hold(p, k.margin + (k.radius > 0 ? k.radius : 0));
  }
  void fit() {
    const double margin = 0.06 * std::max({right - left, top - bottom, 1e-3});
    left -= margin, right += margin, bottom -= margin, top += margin;
    scale = std::min(480 / (right - left), 640 / (top - bottom));
  }
  double x(const Place& p) const { return (p.x - left) * scale; }
  double y(const Place& p) const { return (top - p.y) * scale; }
  double width() const { return (right - left) * scale; }
  double height() const { return (top - bottom) * scale; }
};

/// The belt as a path: spans, and between them arcs the way the spans leave and reach each pulley.
std::string belt_path(const Loop& loop, const Frame& f) {
  const std::size_t n = loop.pulleys.size();
  if (loop.spans.size() != n || !std::all_of(loop.spans.begin(), loop.spans.end(), [](auto& s) { return s.known(); }) ||
      !std::all_of(loop.pulleys.begin(), loop.pulleys.end(), [](auto& p) { return p.known(); }))
    return "";
  std::string path = fmt::format("M {:.1f} {:.1f}", f.x(loop.spans[0].from), f.y(loop.spans[0].from));
  for (std::size_t i = 0; i < n; ++i) {
    const Loop::Span &span = loop.spans[i], &next = loop.spans[(i + 1) % n];
    const Loop::Pulley& p = loop.pulleys[(i + 1) % n];
    const double ax = span.to.x - p.centre.x, ay = span.to.y - p.centre.y;
    const double bx = next.from.x - p.centre.x, by = next.from.y - p.centre.y;
    const bool left = ax * (span.to.y - span.from.y) - ay * (span.to.x - span.from.x) > 0;
    double wrap = std::atan2(ax * by - ay * bx, ax * bx + ay * by) * (left ? 1 : -1);
    if (wrap < -1e-6) wrap += 2 * std::numbers::pi;
    // In the picture y points down, so that a counterclockwise arc is drawn with sweep 0.
    path += fmt::format(" L {:.1f} {:.1f} A {:.1f} {:.1f} 0 {} {} {:.1f} {:.1f}", f.x(span.to), f.y(span.to),
                        p.radius * f.scale, p.radius * f.scale, wrap > std::numbers::pi ? 1 : 0, left ? 0 : 1,
                        f.x(next.from), f.y(next.from));
  }
  return path;
}

/// Pulleys, arm and belt of the other layout, for comparison.
std::string faint_loop(const Loop& loop, const Frame& f) {
  std::string s = "<g fill=\"none\" stroke=\"#999\" stroke-width=\"1.3\" stroke-dasharray=\"5 4\">\n";
  for (const auto& p : loop.pulleys)
    if (p.known())
      s += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", f.x(p.centre), f.y(p.centre),
                       p.radius * f.scale);
  if (const std::string path = belt_path(loop, f); !path.empty()) s += "<path d=\"" + path + "\"/>\n";
  return s + "</g>\n";
}

std::string shape_of(const Loop::KeepOut& k, const Frame& f, const std::string& style) {
  if (k.radius >= 0)
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", f.x(k.corners[0]), f.y(k.corners[0]),
                       k.radius * f.scale, style);
  std::string points;
  for (const Place& p : k.corners) points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", f.x(p), f.y(p));
  return fmt::format("<polygon points=\"{}\" {}/>\n", points, style);
}

std::string surroundings(const Loop& loop, const Frame& f) {
  std::string s;
  if (loop.boxed())
    s += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#d55e00\" "
        "stroke-dasharray=\"8 3\"><title>box</title></rect>\n",
        f.x(loop.box_low), f.y(loop.box_high), std::max(0.0, f.x(loop.box_high) - f.x(loop.box_low)),
        std::max(0.0, f.y(loop.box_low) - f.y(loop.box_high)));
  for (const auto& k : loop.keep_outs) {
    if (k.corners.empty()) continue;
    // The margin is a wide, pale outline.
    s += shape_of(k, f,
                  fmt::format("fill=\"none\" stroke=\"#d55e00\" stroke-opacity=\"0.15\" stroke-linejoin=\"round\" "
                              "stroke-width=\"{:.1f}\"",
                              2 * k.margin * f.scale));
    s += shape_of(k, f, "fill=\"#d55e00\" fill-opacity=\"0.25\" stroke=\"#d55e00\"");
  }
  return s;
}

struct Label {
  double x = 0, y = 0, half_width = 0;
  static constexpr double half_height = 7;
  double distance(double px, double py) const {
    return std::hypot(std::max(std::abs(px - x) - half_width, 0.0), std::max(std::abs(py - y) - half_height, 0.0));
  }
};

/// Names in their pulleys where they fit, else beside them, where circles, belt and other names leave most room.
std::string names_of(const Loop& loop, const Frame& f) {
  std::vector<Label> placed;
  std::string s;
  const auto write = [&](const Label& l, const std::string& name, const char* style) {
    placed.push_back(l);
    s += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" {} stroke=\"#fff\" stroke-width=\"3\" "
        "paint-order=\"stroke\">{}</text>\n",
        l.x, l.y + 4, style, html_escaped(name));
  };
  const auto half = [](const std::string& name) { return 3.5 * static_cast<double>(name.size()); };
  const auto fits = [&](const Loop::Pulley& p) { return half(p.name) < 0.92 * p.radius * f.scale; };
  const auto clearance = [&](const Label& l) {
    double clear = std::min({l.x - l.half_width, f.width() - l.x - l.half_width, l.y - 7, f.height() - l.y - 7});
    for (const auto& p : loop.pulleys)
      if (p.known()) clear = std::min(clear, l.distance(f.x(p.centre), f.y(p.centre)) - p.radius * f.scale);
    if (loop.pivot.known()) clear = std::min(clear, l.distance(f.x(loop.pivot), f.y(loop.pivot)) - 5);
    for (const auto& span : loop.spans)
      for (int k = 0; span.known() && k <= 40; ++k) {
        const double t = k / 40.0, x0 = f.x(span.from), y0 = f.y(span.from);
        clear = std::min(clear, l.distance(x0 + t * (f.x(span.to) - x0), y0 + t * (f.y(span.to) - y0)) - 2);
      }
    for (const Label& other : placed)
      clear = std::min(clear, std::max(std::abs(l.x - other.x) - l.half_width - other.half_width,
                                       std::abs(l.y - other.y) - 2 * Label::half_height));
    return clear;
  };
  for (const auto& k : loop.keep_outs)
    if (!k.corners.empty()) {
      Place middle{0, 0};
      for (const Place& p : k.corners)
        middle.x += p.x / static_cast<double>(k.corners.size()),
            middle.y += p.y / static_cast<double>(k.corners.size());
      write({f.x(middle), f.y(middle), half(k.name)}, k.name, "fill=\"#a04000\" font-style=\"italic\"");
    }
  for (const auto& p : loop.pulleys)
    if (p.known() && fits(p)) write({f.x(p.centre), f.y(p.centre), half(p.name)}, p.name, "font-weight=\"bold\"");
  for (const auto& p : loop.pulleys) {
    if (!p.known() || fits(p)) continue;
    Label best;
    double widest = -INFINITY;
    for (const double gap : {6.0, 16.0, 28.0})
      for (int k = 0; k < 16; ++k) {
        const double a = k * std::numbers::pi / 8, r = p.radius * f.scale + gap;
        const Label at{f.x(p.centre) + std::cos(a) * (r + half(p.name)), f.y(p.centre) + std::sin(a) * (r + 7),
                       half(p.name)};
        if (const double clear = std::min(clearance(at), 3.0); clear > widest + 1e-9) widest = clear, best = at;
      }
    write(best, p.name, "font-weight=\"bold\"");
  }
  return s;
}

}  // namespace

std::string layout_drawing(const std::string& id, const std::string& caption, const DrawnLayout* layout,
                           const DrawnLayout* other, bool faint) {
  const Loop loop = loop_of(layout), beneath = loop_of(other);
  if (std::none_of(loop.pulleys.begin(), loop.pulleys.end(), [](const auto& p) { return p.known(); })) return "";
  Frame f;
  f.hold(loop);
  f.hold(beneath);
  f.fit();
  std::string s = fmt::format(
      "<figure id=\"{0}\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {1:.0f} {2:.0f}\" "
      "width=\"{1:.0f}\" "
      "role=\"img\" aria-label=\"layout to scale: {3}\" font-family=\"Helvetica, sans-serif\" font-size=\"12\">\n",
      id, f.width(), f.height() + 30, html_escaped(caption));
  s += surroundings(loop, f);
  for (const auto& p : loop.pulleys)
    if (p.known())
      s += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"#999\"><title>{}: centre {:.1f}, "
          "{:.1f} mm, diameter {:.1f} mm</title></circle>\n",
          f.x(p.centre), f.y(p.centre), p.radius * f.scale, p.front ? "#e9eef3" : "#f4efe6", html_escaped(p.name),
          p.centre.x, p.centre.y, 2 * p.radius);
  if (faint) s += faint_loop(beneath, f);
  const auto arm = std::find_if(loop.pulleys.begin(), loop.pulleys.end(),
                                [&](const auto& p) { return p.known() && p.name == loop.arm_pulley; });
  if (loop.pivot.known() && arm != loop.pulleys.end())
    s += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{3:.1f}\" stroke=\"#555\" stroke-width=\"6\" "
        "stroke-linecap=\"round\" opacity=\"0.6\"/><circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"5\" "
        "fill=\"#333\"><title>pivot: {4:.1f}, {5:.1f} mm</title></circle>\n",
        f.x(loop.pivot), f.y(loop.pivot), f.x(arm->centre), f.y(arm->centre), loop.pivot.x, loop.pivot.y);
  if (const std::string path = belt_path(loop, f); !path.empty())
    s += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"3\" stroke-linejoin=\"round\"/>\n";
  s += names_of(loop, f);
  const double bar = std::pow(10, std::floor(std::log10(0.5 * (f.right - f.left))));
  s += fmt::format(
      "<line x1=\"10\" y1=\"{0:.0f}\" x2=\"{1:.1f}\" y2=\"{0:.0f}\" stroke=\"#333\" stroke-width=\"2\"/>"
      "<text x=\"10\" y=\"{2:.0f}\">{3:g} mm</text>\n</svg>\n<figcaption>{4}</figcaption>\n</figure>\n",
      f.height() + 8, 10 + bar * f.scale, f.height() + 24, bar, html_escaped(caption));
  return s;
}

}  // namespace beltlife
