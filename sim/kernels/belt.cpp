// Belt elements: truss (thesis 2.28), three-node bending (thesis 2.29), and their assembly onto the nodes.
//
// Element i leads from node i to node i + 1. Arrays run over the ghosts where a difference needs it, so no index wraps:
// node forces need elements -1 .. n-1, those need moments at nodes -1 .. n, those need turn rates of elements -2 .. n.
#include <cmath>

#include "sim/kernels/kernel.h"

namespace beltlife {
namespace {

// F = EA (l - l0)/l0 + CA (dl/dt)/l0 along the unit vector u; w = n.dv/l, the element's angular velocity, if Turning.
template <bool Turning>
[[gnu::always_inline]] inline void axial_loop(int n, const double* __restrict x, const double* __restrict y,
                                              const double* __restrict vx, const double* __restrict vy,
                                              double* __restrict gx, double* __restrict gy, double* __restrict ux,
                                              double* __restrict uy, double* __restrict inverse_length,
                                              double* __restrict tension, double* __restrict stretch_rate,
                                              double* __restrict turn_rate, double l0, double ea, double ca) {
  const double stiffness = ea / l0, damping = ca / l0;
  for (int i = -2; i <= n; ++i) {
    const double dx = x[i + 1] - x[i], dy = y[i + 1] - y[i];
    const double dvx = vx[i + 1] - vx[i], dvy = vy[i + 1] - vy[i];
    const double l = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / l;
    const double cx = dx * inverse, cy = dy * inverse;
    const double rate = cx * dvx + cy * dvy;
    const double f = stiffness * (l - l0) + damping * rate;
    ux[i] = cx;
    uy[i] = cy;
    inverse_length[i] = inverse;
    stretch_rate[i] = rate;
    tension[i] = f;
    gx[i] = f * cx;
    gy[i] = f * cy;
    if (Turning) turn_rate[i] = (cx * dvy - cy * dvx) * inverse;
  }
}

BELTLIFE_VECTOR void axial(int n, const double* x, const double* y, const double* vx, const double* vy, double* gx,
                           double* gy, double* ux, double* uy, double* inverse_length, double* tension,
                           double* stretch_rate, double l0, double ea, double ca) {
  axial_loop<false>(n, x, y, vx, vy, gx, gy, ux, uy, inverse_length, tension, stretch_rate, nullptr, l0, ea, ca);
}

BELTLIFE_VECTOR void axial_turning(int n, const double* x, const double* y, const double* vx, const double* vy,
                                   double* gx, double* gy, double* ux, double* uy, double* inverse_length,
                                   double* tension, double* stretch_rate, double* turn_rate, double l0, double ea,
                                   double ca) {
  axial_loop<true>(n, x, y, vx, vy, gx, gy, ux, uy, inverse_length, tension, stretch_rate, turn_rate, l0, ea, ca);
}

// M = CI (da/dt)/l0 at node i between elements i-1 and i.
BELTLIFE_VECTOR void damping_moments(int n, const double* __restrict turn_rate, double* __restrict moment, double c) {
  for (int i = -1; i <= n; ++i) moment[i] = c * (turn_rate[i] - turn_rate[i - 1]);
}

// M = EI a/l0 + CI (da/dt)/l0 with the angle a between elements i-1 and i; at rest the belt is straight.
BELTLIFE_VECTOR void moments(int n, const double* __restrict ux, const double* __restrict uy,
                             const double* __restrict turn_rate, double* __restrict moment, double k, double c) {
  for (int i = -1; i <= n; ++i) {
    const double cross = ux[i - 1] * uy[i] - uy[i - 1] * ux[i], dot = ux[i - 1] * ux[i] + uy[i - 1] * uy[i];
    moment[i] = k * turn_angle(cross, dot) + c * (turn_rate[i] - turn_rate[i - 1]);
  }
}

// Equal and opposite couples M on the elements beside a node: each is a pair of forces M/l across the element, so
// element i carries the shear (M(i+1) - M(i))/l.
BELTLIFE_VECTOR void shear(int n, const double* __restrict moment, const double* __restrict inverse_length,
                           const double* __restrict ux, const double* __restrict uy, double* __restrict gx,
                           double* __restrict gy) {
  for (int i = -1; i < n; ++i) {
    const double q = (moment[i + 1] - moment[i]) * inverse_length[i];
    gx[i] += q * uy[i];
    gy[i] -= q * ux[i];
  }
}

BELTLIFE_VECTOR void differences(int n, const double* __restrict gx, const double* __restrict gy, double* __restrict fx,
                                 double* __restrict fy) {
  for (int i = 0; i < n; ++i) {
    fx[i] = gx[i] - gx[i - 1];
    fy[i] = gy[i] - gy[i - 1];
  }
}

void apply_shear(Evaluation& e) {
  Work& w = e.work;
  shear(e.model.belt.nodes, w.moment.data(), w.inverse_length.data(), w.ux.data(), w.uy.data(), w.gx.data(),
        w.gy.data());
}

}  // namespace

void belt_ghosts(Evaluation& e) {
  e.q.x.fill_ghosts();
  e.q.y.fill_ghosts();
  e.q.vx.fill_ghosts();
  e.q.vy.fill_ghosts();
}

void belt_axial(Evaluation& e) {
  const BeltModel& b = e.model.belt;
  const Coordinates& q = e.q;
  Work& w = e.work;
  axial(b.nodes, q.x.data(), q.y.data(), q.vx.data(), q.vy.data(), w.gx.data(), w.gy.data(), w.ux.data(), w.uy.data(),
        w.inverse_length.data(), w.tension.data(), w.stretch_rate.data(), b.element_length, b.axial_stiffness,
        b.axial_damping);
}

void belt_axial_turning(Evaluation& e) {
  const BeltModel& b = e.model.belt;
  const Coordinates& q = e.q;
  Work& w = e.work;
  axial_turning(b.nodes, q.x.data(), q.y.data(), q.vx.data(), q.vy.data(), w.gx.data(), w.gy.data(), w.ux.data(),
                w.uy.data(), w.inverse_length.data(), w.tension.data(), w.stretch_rate.data(), w.turn_rate.data(),
                b.element_length, b.axial_stiffness, b.axial_damping);
}

void belt_bending_damping(Evaluation& e) {
  const BeltModel& b = e.model.belt;
  damping_moments(b.nodes, e.work.turn_rate.data(), e.work.moment.data(), b.bending_damping / b.element_length);
  apply_shear(e);
}

void belt_bending(Evaluation& e) {
  const BeltModel& b = e.model.belt;
  Work& w = e.work;
  moments(b.nodes, w.ux.data(), w.uy.data(), w.turn_rate.data(), w.moment.data(),
          b.bending_stiffness / b.element_length, b.bending_damping / b.element_length);
  apply_shear(e);
}

void belt_forces(Evaluation& e) {
  Work& w = e.work;
  differences(e.model.belt.nodes, w.gx.data(), w.gy.data(), w.fx.data(), w.fy.data());
}

}  // namespace beltlife
