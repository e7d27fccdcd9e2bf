// Owns what a layout is held to: the table [layout] of an optimisation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/field.h"

namespace beltlife {

struct WrapLimitSpec {
  std::string pulley;
  double min_deg = 0;

  template <class V>
  void visit(V& v) {
    v("pulley", pulley, required_text, "name of a pulley");
    v("min_deg", min_deg, required(within(0, 360)), "its smallest wrap, in place of min_wrap_deg");
  }
};

struct KeepOutCircleSpec {
  double x_mm = 0;
  double y_mm = 0;
  double radius_mm = 0;

  template <class V>
  void visit(V& v) {
    v("x_mm", x_mm, required(within(-1e5, 1e5)), "centre");
    v("y_mm", y_mm, required(within(-1e5, 1e5)), "centre");
    v("radius_mm", radius_mm, required(within(0, 1e5)), "radius");
  }
};

struct KeepOutPolygonSpec {
  std::vector<double> x_mm;
  std::vector<double> y_mm;

  template <class V>
  void visit(V& v) {
    v("x_mm", x_mm, required(within(-1e5, 1e5)), "corners in order, either way round; the last joins the first");
    v("y_mm", y_mm, required(within(-1e5, 1e5)), "corners, as many as x_mm");
  }
};

struct KeepOutSpec {
  std::string name;
  double margin_mm = 0;
  std::optional<KeepOutCircleSpec> circle;
  std::optional<KeepOutPolygonSpec> polygon;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among keep-outs");
    v("margin_mm", margin_mm, within(0, 1e4), "distance that pulleys and belt keep from it");
    v("circle", circle, any_text, "round; give exactly one of this, polygon");
    v("polygon", polygon, any_text, "with straight sides that do not cross");
  }
};

struct LayoutBoxSpec {
  double x_min_mm = 0;
  double x_max_mm = 0;
  double y_min_mm = 0;
  double y_max_mm = 0;

  template <class V>
  void visit(V& v) {
    v("x_min_mm", x_min_mm, required(within(-1e5, 1e5)), "left side");
    v("x_max_mm", x_max_mm, required(within(-1e5, 1e5)), "right side");
    v("y_min_mm", y_min_mm, required(within(-1e5, 1e5)), "lower side");
    v("y_max_mm", y_max_mm, required(within(-1e5, 1e5)), "upper side");
  }
};

struct TakeUpLimitSpec {
  double longer_mm = 0;
  double shorter_mm = 0;

  template <class V>
  void visit(V& v) {
    v("longer_mm", longer_mm, within(0, 1e4),
      "unstretched length by which a longer belt (worn, or at its upper tolerance) is still held tight");
    v("shorter_mm", shorter_mm, within(0, 1e4),
      "unstretched length by which a shorter belt is still held; how far the arm yields for mounting");
  }
};

struct ModesLimitSpec {
  std::vector<double> orders;
  double min_distance_percent = 10;

  template <class V>
  void visit(V& v) {
    v("orders", orders, required(above(0, 100)),
      "orders of crank rotation that excite the drive, such as 3 and 6 of six cylinders");
    v("min_distance_percent", min_distance_percent, above(0, 100),
      "of every rotational natural frequency, the arm free or stuck, from every order's frequency, as a share of the "
      "latter");
  }
};

struct LayoutLimitsSpec {
  double min_pulley_clearance_mm = 10;
  double min_belt_clearance_mm = 5;
  double min_wrap_deg = 10;
  double min_span_mm = 20;
  double min_arm_leverage_mm = 10;
  std::optional<double> min_unstretched_length_mm;
  std::optional<double> max_unstretched_length_mm;
  std::optional<double> travel_deg;
  std::optional<double> min_slip_safety;
  std::optional<double> max_hub_load_n;
  std::optional<LayoutBoxSpec> box;
  std::optional<TakeUpLimitSpec> take_up;
  std::optional<ModesLimitSpec> modes;
  std::vector<WrapLimitSpec> wrap;
  std::vector<KeepOutSpec> keep_out;

  /// Whether some limit wants the quasi-static solution of every range.
  bool wants_quasi_static() const { return travel_deg || min_slip_safety || max_hub_load_n; }
  /// Whether some limit hangs on how the drive runs, which takes longer to know than its geometry.
  bool of_running() const { return wants_quasi_static() || modes; }

  template <class V>
  void visit(V& v) {
    v("min_pulley_clearance_mm", min_pulley_clearance_mm, within(0, 1e4), "between the circles of any two pulleys");
    v("min_belt_clearance_mm", min_belt_clearance_mm, within(0, 1e4),
      "between a free span and a pulley that it does not touch, and between spans that share no pulley");
    v("min_wrap_deg", min_wrap_deg, within(0, 360), "smallest wrap of every pulley without a limit of its own");
    v("min_span_mm", min_span_mm, within(0, 1e4), "shortest free span");
    v("min_arm_leverage_mm", min_arm_leverage_mm, within(0, 1e4),
      "smallest change of the belt path per radian of the arm, where it rests");
    v("min_unstretched_length_mm", min_unstretched_length_mm, above(0, 1e5), "shortest belt; absent: no limit");
    v("max_unstretched_length_mm", max_unstretched_length_mm, above(0, 1e5), "longest belt; absent: no limit");
    v("travel_deg", travel_deg, within(0, 180),
      "travel left to the arm on either side in all ranges (quasi-static, friction either way) before a stop, a "
      "toggle, "
      "the spring's end or a collision; absent: no limit");
    v("min_slip_safety", min_slip_safety, within(0, 100),
      "friction x wrap over what the torque takes, of every turning pulley in all ranges (quasi-static); absent: no "
      "limit");
    v("max_hub_load_n", max_hub_load_n, above(0, 1e6),
      "largest force of the belt on a pulley in all ranges (quasi-static, friction either way); absent: no limit");
    v("box", box, any_text, "pulleys stay inside");
    v("take_up", take_up, any_text, "other belt lengths that the tensioner must hold");
    v("modes", modes, any_text, "natural frequencies of all ranges that stay away from orders of the crank");
    v("wrap", wrap, any_text, "smallest wraps of single pulleys");
    v("keep_out", keep_out, any_text, "where neither pulleys nor belt may be");
  }
};

}  // namespace beltlife
