// Torques on the rotating bodies: torsional springs, gear mesh, torque tables, tensioner arm, PID driver.
#include <algorithm>
#include <cmath>

#include "sim/kernels/kernel.h"

namespace beltlife {

void clear_torques(Evaluation& e) { std::fill(e.work.torque.begin(), e.work.torque.end(), 0.0); }

// T = k (angle difference) + c (speed difference), thesis section 3.1 (shafts).
void torsional_springs(Evaluation& e) {
  const auto& springs = e.model.springs;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const TorsionalSpring& s = springs[i];
    const double t =
        s.stiffness * (e.q.angle[s.from] - e.q.angle[s.to]) + s.damping * (e.q.speed[s.from] - e.q.speed[s.to]);
    e.work.spring_torque[i] = t;
    e.work.torque[s.from] -= t;
    e.work.torque[s.to] += t;
  }
}

// An overrunning clutch in series: it engages at the least twist so far, so that `to` may run ahead of `from` freely
// and is driven again as soon as `from` gains on it. That least twist is history, kept in a committing pass only.
void torsional_springs_one_way(Evaluation& e) {
  const auto& springs = e.model.springs;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const TorsionalSpring& s = springs[i];
    double t = 0;
    if (s.one_way) {
      const double twist = one_way_twist(s, e.q), engaged = std::min(e.state.free_wheel[i], twist);
      if (e.pass.commit) e.state.free_wheel[i] = engaged;
      t = s.sense * one_way_torque(s, twist - engaged, one_way_rate(s, e.q));
    } else {
      t = s.stiffness * (e.q.angle[s.from] - e.q.angle[s.to]) + s.damping * (e.q.speed[s.from] - e.q.speed[s.to]);
    }
    e.work.spring_torque[i] = t;
    e.work.torque[s.from] -= t;
    e.work.torque[s.to] += t;
  }
}

double gear_spring_force(const GearPair& g, double delta) {
  if (delta > g.half_backlash) return g.stiffness * (delta - g.half_backlash);
  if (delta < -g.half_backlash) return g.stiffness * (delta + g.half_backlash);
  return 0;
}

double gear_force(const GearPair& g, double delta, double rate) {
  const double elastic = gear_spring_force(g, delta);
  if (elastic > 0) return std::max(elastic + g.damping * rate, 0.0);
  if (elastic < 0) return std::min(elastic + g.damping * rate, 0.0);
  return 0;
}

// Teeth touch on one flank past half the backlash, on the other past minus half; between they are free. The force
// k (delta -+ b/2) + c delta' never pulls.
void gear_mesh(Evaluation& e) {
  const auto& gears = e.model.gears;
  for (std::size_t i = 0; i < gears.size(); ++i) {
    const GearPair& g = gears[i];
    const double delta = g.pinion_radius * e.q.angle[g.pinion] - g.gear_radius * e.q.angle[g.gear];
    const double rate = g.pinion_radius * e.q.speed[g.pinion] - g.gear_radius * e.q.speed[g.gear];
    const double f = gear_force(g, delta, rate);
    e.work.gear_force[i] = f;
    e.work.torque[g.pinion] -= g.pinion_radius * f;
    e.work.torque[g.gear] += g.gear_radius * f;
  }
}

// Thesis Table 3.4: a torque that depends on the body's own speed and acts in its running sense.
void torque_tables(Evaluation& e) {
  for (const TorqueTable& t : e.model.torques) {
    const double sense = e.model.sense[t.body];
    e.work.torque[t.body] += sense * t.factor * t.torque(sense * e.q.speed[t.body]);
  }
}

namespace {

// Belt on the arm's pulley, spring, viscous damping, and dry friction through an anchor spring that yields at the
// friction torque, `low` < 0 < `high` for the two senses: below it the arm truly sticks.
void turn_arm(Evaluation& e, double damping, double low, double high) {
  const TensionerModel& t = e.model.tensioner;
  const double cos = std::cos(e.q.arm_angle), sin = std::sin(e.q.arm_angle);
  const double rx = cos * t.arm_x - sin * t.arm_y, ry = sin * t.arm_x + cos * t.arm_y;
  double torque = rx * e.work.hub_y[t.pulley] - ry * e.work.hub_x[t.pulley];
  torque += t.spring_torque - t.spring_rate * e.q.arm_angle - damping * e.q.arm_rate;
  const double twist = e.state.arm_anchor + e.pass.old_weight * e.work.arm_slip + e.pass.new_weight * e.q.arm_rate;
  const double friction = std::clamp(t.friction_stiffness * twist, low, high);
  if (e.pass.commit) e.state.arm_anchor = friction / t.friction_stiffness;
  e.work.arm_slip = e.q.arm_rate;
  e.work.arm_friction = -friction;
  e.work.arm_torque = torque - friction;
}

}  // namespace

void tensioner_arm(Evaluation& e) {
  const TensionerModel& t = e.model.tensioner;
  turn_arm(e, t.damping, -t.friction_torque, t.friction_torque);
}

// A tensioner damped by the sense of its motion: the viscous damping is that of the sense in which the arm turns, the
// dry friction that of the sense in which its anchor spring is twisted.
void tensioner_arm_directional(Evaluation& e) {
  const TensionerModel& t = e.model.tensioner;
  turn_arm(e, t.damping_at(e.q.arm_rate), -t.friction_against(-1), t.friction_against(1));
}

// Beyond a stop's angle k (angle - stop) + c rate holds the arm back, and never pulls it.
void arm_stops(Evaluation& e) {
  e.work.arm_stop_torque = e.model.tensioner.stops.torque(e.q.arm_angle, e.q.arm_rate);
  e.work.arm_torque += e.work.arm_stop_torque;
}

// Thesis 3.3.1: a controller drives the crank along its profile.
void pid_driver(Evaluation& e) {
  const DriverModel& d = e.model.driver;
  const double sense = e.model.sense[d.body];
  e.work.driver_torque = d.speed_gain * (sense * e.profile.speed(e.pass.time) - e.q.speed[d.body]) +
                         d.angle_gain * (e.q.reference_angle - e.q.angle[d.body]);
  e.work.torque[d.body] += e.work.driver_torque;
}

std::vector<Kernel> force_program(const Model& m) {
  std::vector<Kernel> list;
  const bool stiff = m.belt.bending_stiffness > 0, bending = stiff || m.belt.bending_damping > 0;
  list.push_back({"belt ghosts", belt_ghosts});
  list.push_back(bending ? Kernel{"belt axial and turning", belt_axial_turning} : Kernel{"belt axial", belt_axial});
  if (bending)
    list.push_back(stiff ? Kernel{"belt bending", belt_bending} : Kernel{"belt bending damping", belt_bending_damping});
  list.push_back({"belt forces", belt_forces});
  if (m.bodies > 0) list.push_back({"clear torques", clear_torques});
  if (m.pulleys > 0) list.push_back({"contact", contact});
  if (!m.springs.empty())
    list.push_back(m.has_one_way() ? Kernel{"torsional springs, one-way", torsional_springs_one_way}
                                   : Kernel{"torsional springs", torsional_springs});
  if (!m.gears.empty()) list.push_back({"gear mesh", gear_mesh});
  if (!m.torques.empty()) list.push_back({"torque tables", torque_tables});
  if (m.tensioner.pulley >= 0 && !m.tensioner.locked) {
    list.push_back(m.tensioner.directional ? Kernel{"tensioner arm, directional", tensioner_arm_directional}
                                           : Kernel{"tensioner arm", tensioner_arm});
    if (m.tensioner.stops.any()) list.push_back({"arm stops", arm_stops});
  }
  if (m.driver.body >= 0 && m.driver.control == Control::pid) list.push_back({"pid driver", pid_driver});
  return list;
}

Work make_work(const Model& m) {
  const int n = m.belt.nodes;
  Work w;
  for (NodeArray* a : {&w.gx, &w.gy, &w.ux, &w.uy, &w.inverse_length, &w.tension, &w.stretch_rate, &w.fx, &w.fy})
    *a = NodeArray(n);
  if (m.belt.bending_stiffness > 0 || m.belt.bending_damping > 0)
    for (NodeArray* a : {&w.turn_rate, &w.moment}) *a = NodeArray(n);
  if (m.pulleys > 0)
    for (NodeArray* a : {&w.normal, &w.tangential, &w.slip, &w.contact_x, &w.contact_y, &w.contact_moment})
      *a = NodeArray(n);
  w.torque.assign(m.bodies, 0.0);
  for (auto* v : {&w.belt_torque, &w.hub_x, &w.hub_y}) v->assign(m.pulleys, 0.0);
  w.spring_torque.assign(m.springs.size(), 0.0);
  w.gear_force.assign(m.gears.size(), 0.0);
  return w;
}

}  // namespace beltlife
