// Operating point from the quasi-static solution, or from rest: see operating_point.h.
#include "sim/modes/operating_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/statics/quasi_static.h"

namespace beltlife {
namespace {

// Bodies joined by torsional springs and gears, one number a train; `without` leaves one gear pair out.
std::vector<int> trains_without(const Model& m, std::size_t without) {
  std::vector<int> train(m.bodies);
  std::iota(train.begin(), train.end(), 0);
  const auto join = [&](int a, int b) {
    const int from = train[a], to = train[b];
    std::replace(train.begin(), train.end(), from, to);
  };
  for (const TorsionalSpring& s : m.springs) join(s.from, s.to);
  for (std::size_t g = 0; g < m.gears.size(); ++g)
    if (g != without) join(m.gears[g].pinion, m.gears[g].gear);
  return train;
}

// What the torque tables of a train's bodies amount to, referred to a belt that does not slip, N.
double train_force(const Model& m, const std::vector<int>& train, int which, double belt_speed) {
  double sum = 0;
  for (const TorqueTable& t : m.torques)
    if (train[t.body] == which && m.inverse_inertia[t.body] > 0)
      sum += t.factor * t.torque(m.speed_ratio[t.body] * belt_speed) * m.speed_ratio[t.body];
  return sum;
}

// A side of the cut pair that neither belt nor driver holds leans on the mesh with what its own torques add up to.
bool engaged(const Model& m, std::size_t gear, double belt_speed) {
  const GearPair& g = m.gears[gear];
  if (g.half_backlash == 0) return true;
  const auto cut = trains_without(m, gear);
  if (cut[g.pinion] == cut[g.gear]) return true;
  for (const int side : {cut[g.pinion], cut[g.gear]}) {
    const bool held = std::find(cut.begin(), cut.begin() + m.pulleys, side) != cut.begin() + m.pulleys ||
                      (m.driver.body >= 0 && cut[m.driver.body] == side);
    if (!held) return std::abs(train_force(m, cut, side, belt_speed)) > 1e-9;
  }
  return true;
}

bool arm_turns(const Model& m) { return m.tensioner.pulley >= 0 && !m.tensioner.locked; }

void take_rest(const Model& m, double surface_speed, OperatingPoint& p) {
  const Layout& rest = m.statics.balance;
  p.arm_angle = rest.arm_angle;
  p.on_stop = rest.stop != ArmStop::none;
  p.belt_speed = surface_speed / (1 + rest.tension / m.belt.axial_stiffness);
  p.centrifugal = m.scene.belt.mass_kg_per_m * p.belt_speed * p.belt_speed;
  p.tension.assign(m.pulleys, rest.tension + (arm_turns(m) ? p.centrifugal : 0));
}

// The solution needs the arm without dry friction only: without it, no time goes into the friction's band.
QuasiStaticRange solution_at(const Model& m, double crank_rpm) {
  const RangeSpec range{.name = "", .crank_rpm = crank_rpm, .condition = m.condition};
  if (!arm_turns(m)) return solve_quasi_static(m, range);
  Model frictionless = m;
  frictionless.tensioner.friction_torque = frictionless.tensioner.friction_shortening = 0;
  return solve_quasi_static(frictionless, range);
}

void take_solution(const Model& m, const QuasiStaticRange& solution, OperatingPoint& p) {
  p.belt_speed = solution.belt_speed;
  p.centrifugal = solution.centrifugal;
  p.arm_angle = solution.arm_angle.value_or(p.arm_angle);
  p.on_stop = solution.arm_stop != ArmStop::none;
  for (const QuasiStaticSpan& span : solution.spans) p.tension.push_back(span.tension);
  for (std::size_t s = 0; s < m.springs.size(); ++s)
    p.released[s] = std::find(solution.released.begin(), solution.released.end(), m.scene.torsional_spring[s].name) !=
                    solution.released.end();
}

}  // namespace

OperatingPoint operating_point(const Model& m, double crank_rpm) {
  OperatingPoint p;
  p.crank_rpm = crank_rpm;
  p.arm_angle = m.statics.balance.arm_angle;
  const double surface_speed =
      m.driver.body >= 0 ? crank_rpm * std::numbers::pi / 30 / m.speed_ratio[m.driver.body] : 0;
  p.released.assign(m.springs.size(), false);
  for (std::size_t g = 0; g < m.gears.size(); ++g) p.gear_engaged.push_back(engaged(m, g, surface_speed));

  if (surface_speed == 0) {
    take_rest(m, surface_speed, p);
    p.instead = m.driver.body < 0 ? "no driver turns the drive: the tension at rest is taken"
                                  : "the drive stands still: the tension at rest is taken";
  } else if (const QuasiStaticRange solution = solution_at(m, crank_rpm); solution.error) {
    take_rest(m, surface_speed, p);
    p.balanced = false;
    p.instead = fmt::format(
        "there is no quasi-static solution ({}); instead every span is taken at the tension at rest, {:.0f} N{}",
        *solution.error, m.statics.balance.tension,
        arm_turns(m) ? fmt::format(", and {:.0f} N for the belt's speed", p.centrifugal) : "");
  } else {
    take_solution(m, solution, p);
  }
  const bool closed = make_route(circles_of(m.scene, m.statics.orientation, p.arm_angle), p.route) && p.route.simple;
  if (!closed) {  // the solution went where the layout does not exist
    take_rest(m, surface_speed, p);
    p.balanced = false;
    p.instead = "the quasi-static arm angle has no belt path; instead every span is taken at the tension at rest";
    (void)make_route(circles_of(m.scene, m.statics.orientation, p.arm_angle), p.route);
  }
  p.slack = std::any_of(p.tension.begin(), p.tension.end(), [&](double t) { return t <= p.centrifugal; });
  return p;
}

}  // namespace beltlife
