// Owns a layout as an answer holds it for drawings: circles, spans, arm, and what stands around them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

struct DrawnPulley {
  std::string name;
  double x_mm = not_known, y_mm = not_known, diameter_mm = not_known;
  std::string side;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "of the pulley");
    v("x_mm", x_mm, "mm", "centre, the arm at rest");
    v("y_mm", y_mm, "mm", "centre");
    v("diameter_mm", diameter_mm, "mm", "pitch diameter");
    v("side", side, "", "side of the belt that runs on it: front or back");
  }
};

struct DrawnSpan {
  std::string name;
  std::array<double, 2> from_mm{not_known, not_known}, to_mm{not_known, not_known};

  template <class V>
  void visit(V& v) {
    v("name", name, "", "of the span");
    v("from_mm", from_mm, "mm", "where it leaves a pulley, x and y");
    v("to_mm", to_mm, "mm", "where it reaches the next");
  }
};

struct DrawnArm {
  std::string pulley;
  double pivot_x_mm = not_known, pivot_y_mm = not_known;

  template <class V>
  void visit(V& v) {
    v("pulley", pulley, "", "pulley on the arm");
    v("pivot_x_mm", pivot_x_mm, "mm", "pivot");
    v("pivot_y_mm", pivot_y_mm, "mm", "pivot");
  }
};

struct DrawnBox {
  double x_min_mm = not_known, x_max_mm = not_known, y_min_mm = not_known, y_max_mm = not_known;

  template <class V>
  void visit(V& v) {
    v("x_min_mm", x_min_mm, "mm", "left");
    v("x_max_mm", x_max_mm, "mm", "right");
    v("y_min_mm", y_min_mm, "mm", "bottom");
    v("y_max_mm", y_max_mm, "mm", "top");
  }
};

struct DrawnCircle {
  double x_mm = not_known, y_mm = not_known, radius_mm = not_known;

  template <class V>
  void visit(V& v) {
    v("x_mm", x_mm, "mm", "centre");
    v("y_mm", y_mm, "mm", "centre");
    v("radius_mm", radius_mm, "mm", "radius");
  }
};

struct DrawnPolygon {
  std::vector<double> x_mm, y_mm;

  template <class V>
  void visit(V& v) {
    v("x_mm", x_mm, "mm", "corners");
    v("y_mm", y_mm, "mm", "corners");
  }
};

struct DrawnKeepOut {
  std::string name;
  double margin_mm = 0;
  std::optional<DrawnCircle> circle;
  std::optional<DrawnPolygon> polygon;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "of what is kept clear of");
    v("margin_mm", margin_mm, "mm", "distance to be kept from it");
    v("circle", circle, "", "its shape, if it is a circle");
    v("polygon", polygon, "", "its shape, if it is a polygon");
  }
};

struct DrawnLayout {
  std::vector<DrawnPulley> pulleys;
  std::vector<DrawnSpan> spans;
  std::optional<DrawnArm> tensioner;
  std::optional<DrawnBox> box;
  std::optional<std::vector<DrawnKeepOut>> keep_outs;
  double path_length_mm = not_known, tension_n = not_known, unstretched_length_mm = not_known;

  template <class V>
  void visit(V& v) {
    v("pulleys", pulleys, "", "in belt order");
    v("spans", spans, "", "in belt order");
    v("tensioner", tensioner, "", "the arm; absent without one");
    v("box", box, "", "box in which all pulleys have to be");
    v("keep_outs", keep_outs, "", "what belt and pulleys keep clear of");
    v("path_length_mm", path_length_mm, "mm", "length of the belt path");
    v("tension_n", tension_n, "N", "tension at rest");
    v("unstretched_length_mm", unstretched_length_mm, "mm", "length of the belt without tension");
  }
};

}  // namespace beltlife
