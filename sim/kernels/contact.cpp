// Belt-pulley contact: penalty normal force (thesis 2.24-2.26) and asperity friction (thesis 2.27, section 2.3.2).
//
// Only nodes of the contact segments are looked at. With d the penetration of a node below the pulley's surface:
//   F_n = A (k_p d + c_p d')  approaching,  A (k_p d + s_p c_p d')  separating,  0 where d <= 0, never below 0
//   F_t = -(F_v + F_s),  F_v = (1 - beta) mu F_n sat(v_t / v_s),  F_s = clip(A k_t delta, +- beta mu F_n)
// delta' = v_t is the offset from an anchor that moves with the pulley and slides while the clip is active; because
// the clip is 0 without normal force, the anchor is dropped at lift-off. v_t and the moment on the pulley use the
// node's own radius R - d, so that angular momentum is exact.
#include <algorithm>
#include <cmath>

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

template <bool Commit>
[[gnu::always_inline]] inline void segment_loop(
    int begin, int end, const SegmentConstants& c, const double* __restrict x, const double* __restrict y,
    const double* __restrict vx, const double* __restrict vy, double* __restrict anchor, double* __restrict slip,
    double* __restrict normal, double* __restrict tangential, double* __restrict contact_x,
    double* __restrict contact_y, double* __restrict contact_moment, double* __restrict fx, double* __restrict fy) {
  for (int i = begin; i < end; ++i) {
    const double dx = x[i] - c.centre.x, dy = y[i] - c.centre.y;
    const double rvx = vx[i] - c.centre.vx, rvy = vy[i] - c.centre.vy;
    const double r = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / r;
    const double nx = dx * inverse, ny = dy * inverse;
    const double d = c.radius - r;
    const double approach = -(rvx * nx + rvy * ny);
    const double vt = rvy * nx - rvx * ny - c.speed * r;
    const double fn = normal_force(c.law, d, approach);
    const double limit = c.anchor_limit * fn;
    const double spring = c.friction_stiffness * (anchor[i] + c.old_weight * slip[i] + c.new_weight * vt);
    const double fs = std::max(std::min(spring, limit), -limit);
    const double fv = c.velocity_limit * fn * std::max(std::min(vt * c.inverse_friction_speed, 1.0), -1.0);
    const double ft = -(fs + fv);
    if (Commit) anchor[i] = fs * c.inverse_friction_stiffness;
    slip[i] = vt;
    normal[i] = fn;
    tangential[i] = ft;
    const double px = fn * nx - ft * ny, py = fn * ny + ft * nx;
    contact_x[i] = px;
    contact_y[i] = py;
    contact_moment[i] = ft * r;
    fx[i] += px;
    fy[i] += py;
  }
}

BELTLIFE_VECTOR void segment_trial(int begin, int end, const SegmentConstants& c, const double* x, const double* y,
                                   const double* vx, const double* vy, double* anchor, double* slip, double* normal,
                                   double* tangential, double* contact_x, double* contact_y, double* contact_moment,
                                   double* fx, double* fy) {
  segment_loop<false>(begin, end, c, x, y, vx, vy, anchor, slip, normal, tangential, contact_x, contact_y,
                      contact_moment, fx, fy);
}

BELTLIFE_VECTOR void segment_commit(int begin, int end, const SegmentConstants& c, const double* x, const double* y,
                                    const double* vx, const double* vy, double* anchor, double* slip, double* normal,
                                    double* tangential, double* contact_x, double* contact_y, double* contact_moment,
                                    double* fx, double* fy) {
  segment_loop<true>(begin, end, c, x, y, vx, vy, anchor, slip, normal, tangential, contact_x, contact_y,
                     contact_moment, fx, fy);
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
    loop(s.begin, s.end, c, q.x.data(), q.y.data(), q.vx.data(), q.vy.data(), e.state.anchor.data(), w.slip.data(),
         w.normal.data(), w.tangential.data(), w.contact_x.data(), w.contact_y.data(), w.contact_moment.data(),
         w.fx.data(), w.fy.data());
    const int n = s.end - s.begin;
    w.hub_x[s.pulley] -= sum(w.contact_x.data() + s.begin, n);
    w.hub_y[s.pulley] -= sum(w.contact_y.data() + s.begin, n);
    w.belt_torque[s.pulley] -= sum(w.contact_moment.data() + s.begin, n);
  }
  for (int p = 0; p < e.model.pulleys; ++p) w.torque[p] += w.belt_torque[p];
}

}  // namespace beltlife
