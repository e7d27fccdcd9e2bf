// Semi-implicit (symplectic) Euler: one force evaluation a step at the old positions and velocities, then
//   v(t+h) = v(t) + h a(x(t), v(t)),   x(t+h) = x(t) + h v(t+h)
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

BELTLIFE_VECTOR void kick_and_drift(int n, double h, double per_mass, double* __restrict x, double* __restrict v,
                                    const double* __restrict f) {
  for (int i = 0; i < n; ++i) {
    v[i] += h * per_mass * f[i];
    x[i] += h * v[i];
  }
}

}  // namespace

void advance_symplectic_euler(Simulator& s) {
  const Model& m = s.model_;
  const double h = s.step_, next = h * static_cast<double>(s.state_.step + 1);
  Coordinates& q = s.state_.q;
  const Work& w = s.work_;
  // The anchors follow with the velocities that moved the nodes, which are the ones this evaluation sees.
  s.evaluate(q, {s.time(), 0, s.state_.step > 0 ? h : 0, true});

  const double per_mass = 1 / m.belt.node_mass;
  kick_and_drift(m.belt.nodes, h, per_mass, q.x.data(), q.vx.data(), w.fx.data());
  kick_and_drift(m.belt.nodes, h, per_mass, q.y.data(), q.vy.data(), w.fy.data());
  const double given = m.driver.body >= 0 ? m.sense[m.driver.body] * s.profile_.speed(next) : 0;
  for (int b = 0; b < m.bodies; ++b) {
    q.speed[b] += h * m.inverse_inertia[b] * w.torque[b];
    if (b == m.driver.body && m.prescribed()) q.speed[b] = given;
    q.angle[b] += h * q.speed[b];
  }
  if (m.tensioner.pulley >= 0 && !m.tensioner.locked) {
    q.arm_rate += h * w.arm_torque / m.tensioner.inertia;
    q.arm_angle += h * q.arm_rate;
  }
  if (m.driver.body >= 0 && !m.prescribed()) q.reference_angle += h * given;
}

}  // namespace beltlife
