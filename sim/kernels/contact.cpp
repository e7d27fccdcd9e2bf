// Belt-pulley contact: penalty normal force (thesis 2.24-2.26) and asperity friction (thesis 2.27, section 2.3.2).
//
// The law stands in contact_law.h. Only nodes of the contact segments are looked at. v_t and the moment on the pulley
// use the node's own radius R - d, so that angular momentum is exact.
#include <algorithm>
#include <cmath>

#include "sim/kernels/contact_law.h"
#include "sim/kernels/kernel.h"

namespace beltlife {
namespace {

struct SegmentConstants {
  Centre centre;
  double radius, speed;
  ContactModel law;
  double anchor_limit;    // beta mu
  double velocity_limit;  // (1 - beta) mu
  double friction_stiffness, inverse_friction_stiffness, inverse_friction_speed;
  double old_weight, new_weight;
};

/// Arrays over the nodes, ghosts before and behind; SI units as in Coordinates, State and Work.
struct ContactNodes {
  const double *x, *y, *vx, *vy;
  double *anchor, *slip, *normal, *tangential, *contact_x, *contact_y, *contact_moment, *fx, *fy;
};

template <bool Commit>
[[gnu::always_inline]] inline void segment_loop(int begin, int end, const SegmentConstants& c, const ContactNodes& n) {
  // Without a copy the compiler has to read every pointer again after each store.
  const ContactNodes a = n;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const double dx = a.x[i] - c.centre.x, dy = a.y[i] - c.centre.y;
    const double rvx = a.vx[i] - c.centre.vx, rvy = a.vy[i] - c.centre.vy;
    const double r = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / r;
    const double nx = dx * inverse, ny = dy * inverse;
    const double d = c.radius - r;
    const double approach = -(rvx * nx + rvy * ny);
    const double vt = rvy * nx - rvx * ny - c.speed * r;
    const double fn = contact_law::normal_force(c.law, d, approach);
    const double spring = c.friction_stiffness * (a.anchor[i] + c.old_weight * a.slip[i] + c.new_weight * vt);
    const double fs = contact_law::anchor_force(spring, c.anchor_limit * fn);
    const double fv = contact_law::saturating_force(c.velocity_limit * fn, vt, c.inverse_friction_speed);
    const double ft = -(fs + fv);
    if (Commit) a.anchor[i] = fs * c.inverse_friction_stiffness;
    a.slip[i] = vt;
    a.normal[i] = fn;
    a.tangential[i] = ft;
    const double px = fn * nx - ft * ny, py = fn * ny + ft * nx;
    a.contact_x[i] = px;
    a.contact_y[i] = py;
    a.contact_moment[i] = ft * r;
    a.fx[i] += px;
    a.fy[i] += py;
  }
}

BELTLIFE_VECTOR void segment_trial(int begin, int end, const SegmentConstants& c, const ContactNodes& n) {
  segment_loop<false>(begin, end, c, n);
}

BELTLIFE_VECTOR void segment_commit(int begin, int end, const SegmentConstants& c, const ContactNodes& n) {
  segment_loop<true>(begin, end, c, n);
}

}  // namespace

Centre pulley_centre(const Model& model, const Coordinates& q, int pulley) {
  const TensionerModel& t = model.tensioner;
  if (pulley != t.pulley) return {model.pulley_x[pulley], model.pulley_y[pulley], 0, 0};
  const double cos = std::cos(q.arm_angle), sin = std::sin(q.arm_angle);
  const double rx = cos * t.arm_x - sin * t.arm_y, ry = sin * t.arm_x + cos * t.arm_y;
  return {t.pivot_x + rx, t.pivot_y + ry, -q.arm_rate * ry, q.arm_rate * rx};
}

BELTLIFE_VECTOR double sum(const double* p, int n) {
  double lane[8] = {};
  int i = 0;
  for (; i + 8 <= n; i += 8)
    for (int k = 0; k < 8; ++k) lane[k] += p[i + k];
  for (int k = 0; i + k < n; ++k) lane[k] += p[i + k];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

void contact(Evaluation& e) {
  const ContactModel& contact = e.model.contact;
  Coordinates& q = e.q;
  Work& w = e.work;
  std::fill(w.hub_x.begin(), w.hub_x.end(), 0.0);
  std::fill(w.hub_y.begin(), w.hub_y.end(), 0.0);
  std::fill(w.belt_torque.begin(), w.belt_torque.end(), 0.0);
  const auto loop = e.pass.commit ? segment_commit : segment_trial;
  const ContactNodes nodes{q.x.data(),
                           q.y.data(),
                           q.vx.data(),
                           q.vy.data(),
                           e.state.anchor.data(),
                           w.slip.data(),
                           w.normal.data(),
                           w.tangential.data(),
                           w.contact_x.data(),
                           w.contact_y.data(),
                           w.contact_moment.data(),
                           w.fx.data(),
                           w.fy.data()};
  for (const ContactSegment& s : e.state.segments) {
    const double mu = e.model.pulley_friction[s.pulley];
    const SegmentConstants c{pulley_centre(e.model, q, s.pulley),
                             e.model.pulley_radius[s.pulley],
                             q.speed[s.pulley],
                             contact,
                             contact.anchor_share * mu,
                             (1 - contact.anchor_share) * mu,
                             contact.friction_stiffness,
                             1 / contact.friction_stiffness,
                             1 / contact.friction_speed,
                             e.pass.old_weight,
                             e.pass.new_weight};
    loop(s.begin, s.end, c, nodes);
    const int n = s.end - s.begin;
    w.hub_x[s.pulley] -= sum(w.contact_x.data() + s.begin, n);
    w.hub_y[s.pulley] -= sum(w.contact_y.data() + s.begin, n);
    w.belt_torque[s.pulley] -= sum(w.contact_moment.data() + s.begin, n);
  }
  for (int p = 0; p < e.model.pulleys; ++p) w.torque[p] += w.belt_torque[p];
}

}  // namespace beltlife
