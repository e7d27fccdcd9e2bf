// Energy account: see energy.h. Runs at the observation rate, not in every step.
#include "sim/energy.h"

#include <algorithm>
#include <cmath>

#include "sim/kernels/contact_law.h"

namespace beltlife {
namespace {

double driver_power(const DriveView& s) {
  const Model& m = s.model();
  const int d = m.driver.body;
  if (d < 0) return 0;
  const double speed = s.state().q.speed[d];
  if (!m.prescribed()) return s.work().driver_torque * speed;
  const double needed = m.inertia[d] * m.sense[d] * s.profile().at(s.state_time()).acceleration - s.work().torque[d];
  return needed * speed;
}

void belt_powers(const DriveView& s, EnergyAccount& p) {
  const BeltModel& b = s.model().belt;
  const Work& w = s.work();
  double axial = 0;
  for (int i = 0; i < b.nodes; ++i) axial += w.stretch_rate[i] * w.stretch_rate[i];
  p[Energy::lost_belt_axial] = axial * b.axial_damping / b.element_length;
  if (b.bending_damping == 0) return;
  double bending = 0;
  for (int i = 0; i < b.nodes; ++i) {
    const double turn = w.turn_rate[i] - w.turn_rate[i - 1];
    bending += turn * turn;
  }
  p[Energy::lost_belt_bending] = bending * b.bending_damping / b.element_length;
}

void contact_powers(const DriveView& s, EnergyAccount& p) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  const Work& w = s.work();
  double normal = 0, friction = 0;
  for (const ContactSegment& segment : s.state().segments) {
    const Centre c = pulley_centre(m, q, segment.pulley);
    for (int i = segment.begin; i < segment.end; ++i) {
      const double dx = q.x[i] - c.x, dy = q.y[i] - c.y, r = std::sqrt(dx * dx + dy * dy);
      const double d = m.pulley_radius[segment.pulley] - r;
      if (d <= 0) continue;
      const double approach = -((q.vx[i] - c.vx) * dx + (q.vy[i] - c.vy) * dy) / r;
      // The law at this state, not the force of the last evaluation: the two lie up to a step apart.
      normal += (contact_law::normal_force(m.contact, d, approach) - m.contact.stiffness * d) * approach;
      friction -= w.tangential[i] * w.slip[i];
    }
  }
  p[Energy::lost_contact_normal] = normal;
  p[Energy::lost_friction] = friction;
}

void train_powers(const DriveView& s, EnergyAccount& p) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  for (const TorqueTable& t : m.torques) {
    const double speed = m.sense[t.body] * q.speed[t.body];
    p[Energy::work_torque_tables] += t.factor * t.torque(speed) * speed;
  }
  for (std::size_t i = 0; i < m.springs.size(); ++i) {
    const TorsionalSpring& k = m.springs[i];
    if (k.one_way) {
      const double twist = std::max(one_way_twist(k, q) - s.state().free_wheel[i], 0.0), rate = one_way_rate(k, q);
      p[Energy::lost_shafts] += (one_way_torque(k, twist, rate) - k.stiffness * twist) * rate;
      continue;
    }
    const double twist_rate = q.speed[k.from] - q.speed[k.to];
    p[Energy::lost_shafts] += k.damping * twist_rate * twist_rate;
  }
  for (const GearPair& g : m.gears) {
    const double delta = g.pinion_radius * q.angle[g.pinion] - g.gear_radius * q.angle[g.gear];
    const double rate = g.pinion_radius * q.speed[g.pinion] - g.gear_radius * q.speed[g.gear];
    p[Energy::lost_gears] += (gear_force(g, delta, rate) - gear_spring_force(g, delta)) * rate;
  }
  if (m.tensioner.pulley >= 0) {
    p[Energy::lost_tensioner_damping] = m.tensioner.damping_at(q.arm_rate) * q.arm_rate * q.arm_rate;
    if (m.tensioner.stops.any()) {
      const ArmStops& stops = m.tensioner.stops;
      p[Energy::lost_tensioner_damping] -=
          (stops.torque(q.arm_angle, q.arm_rate) - stops.elastic_torque(q.arm_angle)) * q.arm_rate;
    }
    p[Energy::lost_tensioner_friction] = -s.work().arm_friction * q.arm_rate;
  }
}

double belt_stored(const DriveView& s) {
  const BeltModel& b = s.model().belt;
  const Coordinates& q = s.state().q;
  double kinetic = 0, strain = 0, curvature = 0;
  double ux = 0, uy = 0;
  for (int i = -1; i < b.nodes; ++i) {
    const int a = (i + b.nodes) % b.nodes, c = (i + 1) % b.nodes;
    const double dx = q.x[c] - q.x[a], dy = q.y[c] - q.y[a], l = std::sqrt(dx * dx + dy * dy);
    if (i >= 0) {
      kinetic += q.vx[i] * q.vx[i] + q.vy[i] * q.vy[i];
      strain += (l - b.element_length) * (l - b.element_length);
      const double angle = std::atan2(ux * dy - uy * dx, ux * dx + uy * dy);
      curvature += angle * angle;
    }
    ux = dx;
    uy = dy;
  }
  return 0.5 * b.node_mass * kinetic +
         0.5 / b.element_length * (b.axial_stiffness * strain + b.bending_stiffness * curvature);
}

double contact_stored(const DriveView& s, double& anchors) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  double penetration = 0, offset = 0;
  for (const ContactSegment& segment : s.state().segments) {
    const Centre c = pulley_centre(m, q, segment.pulley);
    for (int i = segment.begin; i < segment.end; ++i) {
      const double d = m.pulley_radius[segment.pulley] - std::hypot(q.x[i] - c.x, q.y[i] - c.y);
      if (d > 0) penetration += d * d;
      offset += s.state().anchor[i] * s.state().anchor[i];
    }
  }
  anchors = 0.5 * m.contact.friction_stiffness * offset;
  return 0.5 * m.contact.stiffness * penetration + anchors;
}

double train_stored(const DriveView& s) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  double e = 0;
  for (int b = 0; b < m.bodies; ++b) e += 0.5 * m.inertia[b] * q.speed[b] * q.speed[b];
  for (std::size_t i = 0; i < m.springs.size(); ++i) {
    const TorsionalSpring& k = m.springs[i];
    const double twist =
        k.one_way ? std::max(one_way_twist(k, q) - s.state().free_wheel[i], 0.0) : q.angle[k.from] - q.angle[k.to];
    e += 0.5 * k.stiffness * twist * twist;
  }
  for (const GearPair& g : m.gears) {
    const double f = gear_spring_force(g, g.pinion_radius * q.angle[g.pinion] - g.gear_radius * q.angle[g.gear]);
    e += 0.5 * f * f / g.stiffness;
  }
  return e;
}

}  // namespace

EnergyAccount powers(const DriveView& s) {
  EnergyAccount p;
  p[Energy::work_driver] = driver_power(s);
  belt_powers(s, p);
  contact_powers(s, p);
  train_powers(s, p);
  return p;
}

StoredEnergy stored_energy(const DriveView& s) {
  const TensionerModel& t = s.model().tensioner;
  const Coordinates& q = s.state().q;
  StoredEnergy e;
  e.total = belt_stored(s) + contact_stored(s, e.anchors) + train_stored(s);
  if (t.pulley >= 0) {
    e.arm_anchor = 0.5 * t.friction_stiffness * s.state().arm_anchor * s.state().arm_anchor;
    e.total += 0.5 * t.inertia * q.arm_rate * q.arm_rate - t.spring_torque * q.arm_angle +
               0.5 * t.spring_rate * q.arm_angle * q.arm_angle + e.arm_anchor;
    if (t.stops.any()) e.total += 0.5 * t.stops.stiffness * std::pow(t.stops.depth(q.arm_angle), 2);
  }
  return e;
}

}  // namespace beltlife
