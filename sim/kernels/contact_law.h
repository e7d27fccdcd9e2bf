// Owns the law of contact and friction between a belt node and a pulley: forces, tangents and slopes, for all schemes.
//
// With d the penetration of a node below the pulley's surface, d' its rate (positive: approaching), v_t the speed along
// the surface, A the area of an element (thesis 2.24-2.27 and section 2.3.2):
//   F_n = A (k_p d + c_p d')  approaching,  A (k_p d + s_p c_p d')  separating,  0 where d <= 0, never below 0
//   F_t = -(F_s + F_v),  F_s = clip(A k_t delta, +- beta mu F_n),  F_v = (1 - beta) mu F_n sat(v_t / v_s)
// delta' = v_t is the offset from an anchor that moves with the pulley and slides while the clip is active; because the
// clip is 0 without normal force, the anchor is dropped at lift-off.
//
// The explicit kernels (contact.cpp) evaluate the forces, the linearly implicit lanes (../lanes/lane_contact.cpp) also
// the tangents, and the predicted steps (../schemes/stable_step.cpp) the steepest slope. All functions are inline, so
// that the loops over nodes vectorise; of the arguments none is checked.
#pragma once

#include "sim/model.h"

namespace beltlife::contact_law {

/// c_p or s_p c_p (N s/m), by whether the node approaches.
[[gnu::always_inline]] inline double damping(double approaching, double separating, double rate) {
  return rate >= 0 ? approaching : separating;
}

/// F_n (N) with the damping of this rate (m/s).
[[gnu::always_inline]] inline double normal_force(double stiffness, double damping, double d, double rate) {
  const double pressed = stiffness * d + damping * rate;
  return d > 0 ? (pressed > 0 ? pressed : 0.0) : 0.0;
}

/// The same of a drive's constants.
[[gnu::always_inline]] inline double normal_force(const ContactModel& c, double d, double rate) {
  return normal_force(c.stiffness, damping(c.damping, c.separation_damping, rate), d, rate);
}

/// F_s (N) from the force of the anchor spring and the most that it can hold.
[[gnu::always_inline]] inline double anchor_force(double spring, double limit) {
  const double high = spring < limit ? spring : limit;
  return high > -limit ? high : -limit;
}

/// F_v (N) of a saturating element that carries at most `most` (N).
[[gnu::always_inline]] inline double saturating_force(double most, double v, double inverse_speed) {
  const double share = v * inverse_speed, high = share < 1 ? share : 1.0;
  return most * (high > -1 ? high : -1.0);
}

/// Steepest slope of F_v over v_t, which is that at rest, by the node's mass (1/s).
inline double steepest_rate(const ContactModel& c, double friction, double normal, double mass) {
  return friction * normal * (1 - c.anchor_share) / (c.friction_speed * mass);
}

/// Change of F_n with the velocity of approach, averaged over a step h with weights 1/4 for places and 1/2 for
/// velocities (kg/s times h, as the linearly implicit step takes it); of a node in contact.
[[gnu::always_inline]] inline double normal_tangent(double stiffness, double damping, double h) {
  return 0.25 * h * h * stiffness + 0.5 * h * damping;
}

/// Likewise of F_s with v_t, of a node that sticks.
[[gnu::always_inline]] inline double sticking_tangent(double stiffness, double h) { return 0.25 * h * h * stiffness; }

/// The saturating element as a damper with its secant slope at the velocity expected: implicit whether creeping or
/// sliding, so that a light node cannot jump across the slope and back.
struct SecantDamper {
  double slope;   ///< F_v / v, N s/m
  double weight;  ///< share of the step's change of velocity: between 1/2 (slope slow beside the step) and 1
};
/// The weight is 1/2 + 1/2 z/(z + 6), z = h slope/m, as the exact decay has it; by one division for both.
[[gnu::always_inline]] inline SecantDamper secant_damper(double most, double v, double friction_speed, double mass,
                                                         double h) {
  const double size = v > 0 ? v : -v;
  const double pace = size > friction_speed ? size : friction_speed;  // slope = most/pace
  const double still = 6.0 * mass * pace + h * most;
  const double inverse_both = 1.0 / (pace * still);
  return {most * (still * inverse_both), 0.5 + 0.5 * h * most * (pace * inverse_both)};
}

}  // namespace beltlife::contact_law
