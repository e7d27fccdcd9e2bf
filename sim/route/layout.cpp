// Layout, static balance and feasibility: see layout.h.
#include "sim/route/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim/scene/pitch_line.h"
#include "sim/scene/pulley_place.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::size_t pulley_index(const SceneSpec& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.pulley.size(); ++i)
    if (scene.pulley[i].name == name) return i;
  return scene.pulley.size();
}

bool crossing(const Span& a, const Span& b) {
  const auto side = [](const Span& s, const Vec2& p) {
    return s.direction.x * (p.y - s.from.y) - s.direction.y * (p.x - s.from.x);
  };
  return side(a, b.from) * side(a, b.to) < 0 && side(b, a.from) * side(b, a.to) < 0;
}

bool crosses_itself(const Route& route) {
  for (std::size_t i = 0; i < route.spans.size(); ++i)
    for (std::size_t j = i + 1; j < route.spans.size(); ++j)
      if (crossing(route.spans[i], route.spans[j])) return true;
  return false;
}

// The loop can be traversed in the listed order with front pulleys on the left (+1) or on the right (-1). Of both, the
// one that closes without crossing itself; two pulleys close both ways alike. If neither does, the sense in which the
// centres go round, so that a refusal can say what is wrong there.
int orientation_of(const SceneSpec& scene) {
  for (int orientation : {1, -1}) {
    Route route;
    if (make_route(circles_of(scene, orientation, 0), route) && route.simple && !crosses_itself(route))
      return orientation;
  }
  double area = 0;
  for (std::size_t i = 0; i < scene.pulley.size(); ++i) {
    const PulleyPlace a = pulley_place(scene, scene.pulley[i]);
    const PulleyPlace b = pulley_place(scene, scene.pulley[(i + 1) % scene.pulley.size()]);
    area += a.x_mm * b.y_mm - b.x_mm * a.y_mm;
  }
  return area < 0 ? -1 : 1;
}

std::string key_of(const SceneSpec& scene, std::size_t pulley) {
  if (scene.tensioner && scene.tensioner->arm_angle_deg && scene.tensioner->pulley == scene.pulley[pulley].name)
    return "tensioner.arm_angle_deg";
  return "pulley." + scene.pulley[pulley].name + ".x_mm";
}

double distance_to_span(const Span& span, double x, double y) {
  const double s = (x - span.from.x) * span.direction.x + (y - span.from.y) * span.direction.y;
  const double c = std::clamp(s, 0.0, span.length);
  return std::hypot(x - span.from.x - c * span.direction.x, y - span.from.y - c * span.direction.y);
}

// Torque with which spring and stops turn the arm counterclockwise. The spring acts in the path-lengthening sense
// `sense`: torque at the placed position plus rate x rotation in the path-shortening sense.
struct Arm {
  const TensionerSpec& spec;
  double sense;
  double placed_torque;
  ArmStops stops = arm_stops_of(spec, sense);
  double torque(double angle) const {
    return sense * placed_torque - spec.spring_rate_n_m_per_rad * angle + stops.elastic_torque(angle);
  }
};

// First root of f next to 0 on either side within +-limit; nothing where f is undefined (NaN).
bool root_near_zero(const std::function<double(double)>& f, double limit, double& root) {
  constexpr int pieces = 400;
  double best = 2 * limit;
  for (double side : {1.0, -1.0}) {
    double a = 0, fa = f(0);
    for (int k = 1; k <= pieces && std::abs(a) < best; ++k) {
      const double b = side * limit * k / pieces, fb = f(b);
      if (std::isnan(fa) || std::isnan(fb)) break;
      if (fa == 0) {
        best = std::abs(a);
        root = a;
        break;
      }
      if ((fa < 0) != (fb < 0)) {
        double lo = a, hi = b, flo = fa;
        for (int i = 0; i < 200 && std::abs(hi - lo) > 0; ++i) {
          const double mid = 0.5 * (lo + hi), fm = f(mid);
          if (mid == lo || mid == hi) break;
          if ((fm < 0) == (flo < 0)) {
            lo = mid;
            flo = fm;
          } else {
            hi = mid;
          }
        }
        const double found = 0.5 * (lo + hi);
        if (std::abs(found) < best) {
          best = std::abs(found);
          root = found;
        }
        break;
      }
      a = b;
      fa = fb;
    }
  }
  return best <= limit;
}

Layout layout_at(const SceneSpec& scene, int orientation, double angle) {
  Layout layout;
  layout.arm_angle = angle;
  const auto circles = circles_of(scene, orientation, angle);
  if (!make_route(circles, layout.route) || !layout.route.simple || crosses_itself(layout.route)) {
    layout.route.length = std::nan("");
    return layout;
  }
  if (scene.tensioner) {
    const std::size_t i = pulley_index(scene, scene.tensioner->pulley);
    const Vec2 g = length_gradient(layout.route, i);
    const double rx = circles[i].x - scene.tensioner->pivot_x_mm * 1e-3;
    const double ry = circles[i].y - scene.tensioner->pivot_y_mm * 1e-3;
    layout.length_per_arm_angle = -ry * g.x + rx * g.y;
  }
  return layout;
}

[[noreturn]] void refuse(std::string_view file, std::string key, std::string what, std::string allowed) {
  throw BadInput({Problem{std::string(file), 0, std::move(key), std::move(what), std::move(allowed)}});
}

void add_crossings(const SceneSpec& scene, const Route& route, std::string_view file, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < route.spans.size(); ++i)
    for (std::size_t j = i + 1; j < route.spans.size(); ++j)
      if (crossing(route.spans[i], route.spans[j]))
        problems.push_back({std::string(file), 0, key_of(scene, j),
                            fmt::format("the belt would cross itself: span {} runs through span {}",
                                        span_name(scene, i), span_name(scene, j)),
                            "pulleys in the order in which the belt passes them, each with the right side"});
}

void refuse_infeasible(const SceneSpec& scene, const Route& route, bool closed, std::string_view file,
                       const char* where) {
  std::vector<Problem> problems;
  for (const auto& c : clearances(scene, route))
    if (c.value < 0)
      problems.push_back({std::string(file), 0, c.key, c.words + where, "pulleys and spans clear of each other"});
  if (problems.empty() && closed) add_crossings(scene, route, file, problems);
  if (problems.empty() && !closed)
    problems.push_back({std::string(file), 0, "pulley", std::string("the belt does not close as a simple loop") + where,
                        "list the pulleys in the order in which the belt passes them, with the right side each"});
  if (!problems.empty()) throw BadInput(std::move(problems));
}

// The field that states the belt's length, and what to add to lengths in refusals.
std::string length_key(const SceneSpec& scene) {
  if (scene.belt.length_catalogue_mm) return "belt.length_catalogue_mm";
  return scene.belt.effective_length_mm ? "belt.effective_length_mm" : "belt.unstretched_length_mm";
}
const char* along_cord(const SceneSpec& scene) {
  return scene.belt.effective_length_mm ? " along the cord without tension" : "";
}

// Whether the spring's torque is to be solved for the pretension.
bool torque_is_open(const SceneSpec& scene) { return scene.tensioner && !scene.tensioner->spring_torque_n_m; }

// Of the lengths that can be had, the one nearest to what an arm at rest as placed would want; mm.
double from_catalogue(const std::vector<double>& lengths, double wanted) {
  return *std::min_element(lengths.begin(), lengths.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

// The arm's angle next to the placed one at which a belt of the given length has the pretension. The search ends where
// turning the arm changes the path the other way: there no spring of this sense holds it.
double angle_of_pretension(const SceneSpec& scene, const StaticState& s, std::string_view file) {
  const double taut = s.unstretched_length * (1 + *scene.belt.pretension_n / scene.belt.axial_stiffness_n);
  const auto longer = [&](double a) {
    const Layout l = layout_at(scene, s.orientation, a);
    return l.length_per_arm_angle * s.placed.length_per_arm_angle > 0 ? l.route.length - taut : std::nan("");
  };
  double angle = 0;
  if (!root_near_zero(longer, std::numbers::pi, angle))
    refuse(file, length_key(scene),
           fmt::format("no arm angle gives a belt of {:g} mm{} the tension of {:g} N: its path would be {:.1f} mm",
                       1e3 * s.unstretched_length, along_cord(scene), *scene.belt.pretension_n, 1e3 * taut),
           fmt::format("about {:.1f} mm{}, with which the arm rests where it is placed",
                       1e3 * s.placed.route.length / (taut / s.unstretched_length), along_cord(scene)));
  return angle;
}

// The torque at the placed position with which the spring holds the pretension at `angle`.
double torque_of_pretension(const SceneSpec& scene, const StaticState& s, double angle, std::string_view file) {
  constexpr double degree = std::numbers::pi / 180, most = 1e5;  // N m, the field's own limit
  const TensionerSpec& t = *scene.tensioner;
  const double sense = s.placed.length_per_arm_angle > 0 ? 1 : -1;
  const ArmStops stops = arm_stops_of(t, sense);
  if (const ArmStop stop = stops.at(angle, sense); stop != ArmStop::none)
    refuse(file, std::string("tensioner.stop_") + (stop == ArmStop::lengthening ? "lengthening_deg" : "shortening_deg"),
           fmt::format("the arm would rest {:.1f} degrees beyond this stop", std::abs(stops.depth(angle)) / degree),
           fmt::format("more than {:.1f} degrees, or a belt of another length", std::abs(angle) / degree));
  const double at_rest = *scene.belt.pretension_n * layout_at(scene, s.orientation, angle).length_per_arm_angle;
  const double torque = sense * (at_rest + t.spring_rate_n_m_per_rad * angle);
  if (!(torque >= 0 && torque <= most))
    refuse(file, "tensioner.spring_torque_n_m",
           fmt::format("to hold {:g} N at rest the spring would need {:g} N m where the arm is placed",
                       *scene.belt.pretension_n, torque),
           fmt::format("from 0 to {:g}: place the pulley nearer to where the arm rests, {:.1f} degrees away", most,
                       std::abs(angle) / degree));
  return torque;
}

// A polyester or aramid cord breaks at a few per cent.
void refuse_overstretched(const SceneSpec& scene, const StaticState& s, std::string_view file) {
  const double strain = s.balance.route.length / s.unstretched_length - 1;
  if (strain > 0.1 && torque_is_open(scene))
    refuse(file, "belt.pretension_n", fmt::format("the belt would be stretched by {:.0f} % at rest", 100 * strain),
           fmt::format("at most {:.0f} N for this belt", 0.1 * scene.belt.axial_stiffness_n));
  if (strain > 0.1)
    refuse(file, length_key(scene),
           fmt::format("the belt would be stretched by {:.0f} % at rest and carry {:.0f} N", 100 * strain,
                       s.balance.tension),
           fmt::format("at least {:.0f} mm{} for this layout", 1e3 * s.balance.route.length / 1.1, along_cord(scene)));
}

}  // namespace

std::string span_name(const SceneSpec& scene, std::size_t i) {
  return scene.pulley[i].name + "-" + scene.pulley[(i + 1) % scene.pulley.size()].name;
}

std::vector<Circle> circles_of(const SceneSpec& scene, int orientation, double arm_angle) {
  std::vector<Circle> circles;
  for (const auto& p : scene.pulley) {
    const PulleyPlace place = pulley_place(scene, p);
    circles.push_back({place.x_mm * 1e-3, place.y_mm * 1e-3, pitch_diameter_mm(scene, p) * 5e-4,
                       p.side == Side::front ? orientation : -orientation});
  }
  if (scene.tensioner) {
    Circle& c = circles[pulley_index(scene, scene.tensioner->pulley)];
    const double px = scene.tensioner->pivot_x_mm * 1e-3, py = scene.tensioner->pivot_y_mm * 1e-3;
    const double rx = c.x - px, ry = c.y - py, cos = std::cos(arm_angle), sin = std::sin(arm_angle);
    c.x = px + cos * rx - sin * ry;
    c.y = py + sin * rx + cos * ry;
  }
  return circles;
}

std::vector<Clearance> clearances(const SceneSpec& scene, const Route& route) {
  std::vector<Clearance> out;
  const auto& c = route.circles;
  const std::size_t count = c.size();
  bool overlap = false;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const double gap = 1e3 * (std::hypot(c[i].x - c[j].x, c[i].y - c[j].y) - c[i].radius - c[j].radius);
      out.push_back(
          {fmt::format("pulleys {} and {}", scene.pulley[i].name, scene.pulley[j].name), gap, "mm",
           fmt::format("pulleys {} and {} overlap by {:.1f} mm", scene.pulley[i].name, scene.pulley[j].name, -gap),
           key_of(scene, j)});
      overlap = overlap || gap < 0;
    }
  if (overlap || !route.simple) {
    // Without a loop there are no wraps to name; a wrap that vanished shows as one close to a full turn.
    if (!overlap && route.wrap.size() == count)
      for (std::size_t i = 0; i < count; ++i) {
        const double missing = route.wrap[i] / degree - 360;
        if (missing > -120)
          out.push_back(
              {"wrap on " + scene.pulley[i].name, missing, "deg",
               fmt::format("the wrap on {} vanishes: the belt would pass it on its {} side by {:.1f} degrees",
                           scene.pulley[i].name, scene.pulley[i].side == Side::front ? "back" : "front", -missing),
               key_of(scene, i)});
      }
    return out;
  }
  for (std::size_t i = 0; i < count; ++i)
    out.push_back({"wrap on " + scene.pulley[i].name, route.wrap[i] / degree, "deg", "", key_of(scene, i)});
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i || j == (i + 1) % count) continue;
      const double gap = 1e3 * (distance_to_span(route.spans[i], c[j].x, c[j].y) - c[j].radius);
      out.push_back({fmt::format("belt {} and pulley {}", span_name(scene, i), scene.pulley[j].name), gap, "mm",
                     fmt::format("the belt between {} and {} runs through pulley {} by {:.1f} mm", scene.pulley[i].name,
                                 scene.pulley[(i + 1) % count].name, scene.pulley[j].name, -gap),
                     key_of(scene, j)});
    }
  return out;
}

StaticState solve_statics(const SceneSpec& scene, std::string_view file) {
  StaticState s;
  s.orientation = orientation_of(scene);
  const double ea = scene.belt.axial_stiffness_n;
  {
    Route route;
    const bool closed = make_route(circles_of(scene, s.orientation, 0), route) && route.simple;
    refuse_infeasible(scene, route, closed, file, "");
  }
  s.placed = layout_at(scene, s.orientation, 0);
  const auto tension_of = [&](double length) { return ea * (length / s.unstretched_length - 1); };
  if (const auto length = unstretched_length_mm(scene.belt)) s.unstretched_length = *length * 1e-3;

  if (!scene.tensioner) {
    if (scene.belt.pretension_n) s.unstretched_length = s.placed.route.length / (1 + *scene.belt.pretension_n / ea);
    s.placed.tension = s.placed_strain_tension = tension_of(s.placed.route.length);
    s.placed_unstretched_length = s.unstretched_length;
    s.balance = s.placed;
    refuse_overstretched(scene, s, file);
    return s;
  }

  const double gradient = s.placed.length_per_arm_angle;
  if (std::abs(gradient) < 1e-6)
    refuse(file, "tensioner.pivot_x_mm", "turning the arm does not change the length of the belt path",
           "a pivot off the line of the tensioner pulley's hub load");
  double angle = 0;
  const bool open = torque_is_open(scene);
  if (open) {
    if (!scene.belt.pretension_n)
      refuse(file, "tensioner.spring_torque_n_m", "missing key",
             "a torque, or belt.pretension_n for which to solve it");
    if (scene.belt.length_catalogue_mm)
      s.unstretched_length = 1e-3 * from_catalogue(*scene.belt.length_catalogue_mm,
                                                   1e3 * s.placed.route.length / (1 + *scene.belt.pretension_n / ea));
    if (!scene.belt.balanced_as_placed.value_or(false)) angle = angle_of_pretension(scene, s, file);
  }
  s.spring_torque = open ? torque_of_pretension(scene, s, angle, file) : *scene.tensioner->spring_torque_n_m;
  const Arm arm{*scene.tensioner, gradient > 0 ? 1.0 : -1.0, s.spring_torque};

  s.placed.tension = arm.torque(0) / gradient;
  s.placed_unstretched_length = s.placed.route.length / (1 + s.placed.tension / ea);

  if (scene.belt.balanced_as_placed.value_or(false)) {
    s.unstretched_length = s.placed_unstretched_length;
  } else if (!open) {
    const auto imbalance = [&](double a) {
      const Layout l = layout_at(scene, s.orientation, a);
      if (std::isnan(l.route.length)) return std::nan("");
      const double tension =
          scene.belt.pretension_n ? *scene.belt.pretension_n : std::max(tension_of(l.route.length), 0.0);
      return arm.torque(a) - tension * l.length_per_arm_angle;
    };
    if (!root_near_zero(imbalance, std::numbers::pi, angle))
      refuse(
          file, scene.belt.pretension_n ? "belt.pretension_n" : length_key(scene),
          scene.belt.pretension_n
              ? fmt::format("no arm angle gives a tension of {:g} N at rest", *scene.belt.pretension_n)
              : fmt::format("no arm angle balances a belt of {:g} mm{}", 1e3 * s.unstretched_length, along_cord(scene)),
          fmt::format("as placed, the belt path is {:.1f} mm and the spring holds {:.0f} N",
                      1e3 * s.placed.route.length, s.placed.tension));
    if (scene.belt.pretension_n)
      s.unstretched_length = layout_at(scene, s.orientation, angle).route.length / (1 + *scene.belt.pretension_n / ea);
  }
  s.placed_strain_tension = tension_of(s.placed.route.length);
  s.balance = layout_at(scene, s.orientation, angle);
  s.balance.tension = tension_of(s.balance.route.length);
  s.balance.stop = arm.stops.at(angle, arm.sense);
  if (s.balance.tension < -1e-6 * ea)
    refuse(file, length_key(scene),
           fmt::format("the belt is slack: even where the arm{} it is {:.1f} mm longer than its path",
                       s.balance.stop == ArmStop::none ? "'s spring runs out" : " meets its stop",
                       1e3 * (s.unstretched_length - s.balance.route.length)),
           fmt::format("less than {:.1f} mm{} for this tensioner", 1e3 * s.balance.route.length, along_cord(scene)));
  refuse_infeasible(scene, s.balance.route, true, file, " where the tensioner comes to rest");
  refuse_overstretched(scene, s, file);
  return s;
}

}  // namespace beltlife
