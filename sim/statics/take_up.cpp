// Take-up of a tensioner: see take_up.h.
#include "sim/statics/take_up.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {
namespace {

// The row at an arm angle; `reason` says why the angle cannot be had.
TakeUpRow row_at(const Model& m, double angle) {
  TakeUpRow row;
  row.arm_angle = angle;
  const TensionerModel& t = m.tensioner;
  Route route;
  if (!make_route(circles_of(m.scene, m.statics.orientation, angle), route) || !route.simple) {
    row.reason = "a wrap vanishes or pulleys overlap";
    return row;
  }
  for (const Clearance& c : clearances(m.scene, route))
    if (c.value < 0) {
      row.reason = c.words;
      return row;
    }
  row.path_length = route.length;
  const Vec2 g = length_gradient(route, static_cast<std::size_t>(t.pulley));
  const Circle& c = route.circles[t.pulley];
  const double gradient = (c.x - t.pivot_x) * g.y - (c.y - t.pivot_y) * g.x;
  const double torque = t.spring_torque - t.spring_rate * angle + t.stops.elastic_torque(angle);
  row.tension = torque / gradient;
  row.unstretched_length = row.path_length / (1 + row.tension / m.belt.axial_stiffness);
  if (t.stops.at(angle, t.lengthening) != ArmStop::none)
    row.reason = "the arm meets its stop";
  else if (gradient * m.statics.placed.length_per_arm_angle <= 0)
    row.reason = "turning the arm further no longer changes the path in its sense";
  else if (row.tension < -1e-9)
    row.reason = "the spring has run out";
  else if (row.tension > take_up_strain * m.belt.axial_stiffness)
    row.reason = "the belt would be stretched by more than 1 %";
  return row;
}

// The last angle from the balance in one sense that can be had.
TakeUpRow end_of_reach(const Model& m, double sense) {
  constexpr int pieces = 720;
  // An arm at rest on a stop has turned into it by what the stop gives way.
  const double start = m.statics.balance.arm_angle - m.tensioner.stops.depth(m.statics.balance.arm_angle);
  double good = start;
  for (int i = 1; i <= pieces; ++i) {
    double bad = start + sense * std::numbers::pi * i / pieces;
    TakeUpRow beyond = row_at(m, bad);
    if (beyond.reason.empty()) {
      good = bad;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (good + bad);
      TakeUpRow row = row_at(m, middle);
      if (row.reason.empty()) {
        good = middle;
      } else {
        bad = middle;
        beyond = std::move(row);
      }
    }
    TakeUpRow last = row_at(m, good);
    last.reason = beyond.reason;
    last.tension = std::max(last.tension, 0.0);  // bisected to the spring's end
    return last;
  }
  TakeUpRow last = row_at(m, good);
  last.reason = "half a turn of the arm";
  return last;
}

}  // namespace

std::vector<TakeUpRow> take_up(const Model& m) {
  if (m.tensioner.pulley < 0 || m.tensioner.locked) return {};
  const double lengthening = m.statics.placed.length_per_arm_angle > 0 ? 1 : -1;
  std::vector<TakeUpRow> rows{end_of_reach(m, lengthening), row_at(m, 0), row_at(m, m.statics.balance.arm_angle),
                              end_of_reach(m, -lengthening)};
  rows[0].name = "longest belt";
  rows[1].name = "as placed";
  rows[2].name = "at rest";
  rows[3].name = "shortest belt";
  std::stable_sort(rows.begin(), rows.end(),
                   [](const TakeUpRow& a, const TakeUpRow& b) { return a.path_length > b.path_length; });
  return rows;
}

}  // namespace beltlife
