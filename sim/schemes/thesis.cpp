// The thesis' explicit trapezoidal predictor-corrector (thesis 2.3-2.6), the reference scheme.
//
//   v(t) = v(t-h) + h/2 (a(t-h) + a(t)),   x(t) = x(t-h) + h/2 (v(t-h) + v(t))
//
// Pass 1 evaluates a(t-h) at the old state and predicts with a(t) = a(t-h); pass 2 evaluates at the prediction and
// corrects. Friction anchors move by the trapezoidal rule too and are kept in pass 2 only.
#include <utility>

#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

// Prediction: v1 = v + h a, x1 = x + h/2 (v + v1).
BELTLIFE_VECTOR void predict(int n, double h, double per_mass, const double* __restrict x, const double* __restrict v,
                             const double* __restrict f, double* __restrict x1, double* __restrict v1) {
  for (int i = 0; i < n; ++i) {
    v1[i] = v[i] + h * per_mass * f[i];
    x1[i] = x[i] + 0.5 * h * (v[i] + v1[i]);
  }
}

BELTLIFE_VECTOR void correct(int n, double h, double per_mass, double* __restrict x, double* __restrict v,
                             const double* __restrict f0, const double* __restrict f1) {
  for (int i = 0; i < n; ++i) {
    const double next = v[i] + 0.5 * h * per_mass * (f0[i] + f1[i]);
    x[i] += 0.5 * h * (v[i] + next);
    v[i] = next;
  }
}

}  // namespace

void advance_thesis(Simulator& s) {
  const Model& m = s.model_;
  const double h = s.step_, t = s.time(), next = h * static_cast<double>(s.state_.step + 1);
  const int n = m.belt.nodes;
  const double per_mass = 1 / m.belt.node_mass;
  Coordinates& q = s.state_.q;
  Coordinates& p = s.predicted_;
  Work& w = s.work_;
  const bool arm = m.tensioner.pulley >= 0 && !m.tensioner.locked, prescribed = m.prescribed();

  s.evaluate(q, {t, 0, 0, false});
  std::swap(w.fx, s.first_fx_);
  std::swap(w.fy, s.first_fy_);
  std::swap(w.torque, s.first_torque_);
  s.first_arm_torque_ = w.arm_torque;

  predict(n, h, per_mass, q.x.data(), q.vx.data(), s.first_fx_.data(), p.x.data(), p.vx.data());
  predict(n, h, per_mass, q.y.data(), q.vy.data(), s.first_fy_.data(), p.y.data(), p.vy.data());
  for (int b = 0; b < m.bodies; ++b) p.speed[b] = q.speed[b] + h * m.inverse_inertia[b] * s.first_torque_[b];
  const SpeedProfile::Value given = prescribed || m.driver.body >= 0 ? s.profile_.at(next) : SpeedProfile::Value{};
  if (prescribed) p.speed[m.driver.body] = m.sense[m.driver.body] * given.speed;
  for (int b = 0; b < m.bodies; ++b) p.angle[b] = q.angle[b] + 0.5 * h * (q.speed[b] + p.speed[b]);
  if (arm) {
    p.arm_rate = q.arm_rate + h * s.first_arm_torque_ / m.tensioner.inertia;
    p.arm_angle = q.arm_angle + 0.5 * h * (q.arm_rate + p.arm_rate);
  } else {
    p.arm_angle = q.arm_angle;
  }
  p.reference_angle = q.reference_angle;
  if (m.driver.body >= 0 && !prescribed)
    p.reference_angle += 0.5 * h * m.sense[m.driver.body] * (s.profile_.speed(t) + given.speed);

  s.evaluate(p, {next, 0.5 * h, 0.5 * h, true});

  correct(n, h, per_mass, q.x.data(), q.vx.data(), s.first_fx_.data(), w.fx.data());
  correct(n, h, per_mass, q.y.data(), q.vy.data(), s.first_fy_.data(), w.fy.data());
  for (int b = 0; b < m.bodies; ++b) {
    double speed = q.speed[b] + 0.5 * h * m.inverse_inertia[b] * (s.first_torque_[b] + w.torque[b]);
    if (prescribed && b == m.driver.body) speed = m.sense[b] * given.speed;
    q.angle[b] += 0.5 * h * (q.speed[b] + speed);
    q.speed[b] = speed;
  }
  if (arm) {
    const double rate = q.arm_rate + 0.5 * h * (s.first_arm_torque_ + w.arm_torque) / m.tensioner.inertia;
    q.arm_angle += 0.5 * h * (q.arm_rate + rate);
    q.arm_rate = rate;
  }
  q.reference_angle = p.reference_angle;
}

}  // namespace beltlife
