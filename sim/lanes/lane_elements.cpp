// Forces of the belt's elements in lanes, second order in the step: see lane_belt.h.
//
// The step averages a force as (f(n-1) + 2 f(n) + f(n+1))/4 = f(n) + h^2/4 f''. The solve supplies the part of f'' that
// is linear in the acceleration; what is left is that an element turning at w lengthens by l w^2: without that term
// the implicit stiffness acts as centrifugal mass (4 % of a slack span's tension at 2e-5 s).
#include <cmath>

#include "sim/kernels/kernel.h"
#include "sim/lanes/lane_belt.h"

namespace beltlife {
namespace {

// Elements -2 .. rows: direction, angular velocity and tension.
template <bool Turning>
[[gnu::always_inline]] inline void directions(int rows, double h, const LaneNumber& length, const LaneNumber& stiffness,
                                              const LaneNumber& damping, const LaneNumber& turning, const double* x,
                                              const double* y, const double* vx, const double* vy, double* ux,
                                              double* uy, double* inverse_length, double* turn_rate, double* tension,
                                              double* geometric) {
  const double quarter = 0.25 * h * h;
  for (int e = -2; e <= rows; ++e) {
    const double *x0 = x + e * lanes, *y0 = y + e * lanes, *vx0 = vx + e * lanes, *vy0 = vy + e * lanes;
    double *oux = ux + e * lanes, *ouy = uy + e * lanes, *oil = inverse_length + e * lanes, *ot = turn_rate + e * lanes,
           *of = tension + e * lanes, *og = geometric + e * lanes;
    BELTLIFE_EACH_LANE(k) {
      const double dx = x0[k + lanes] - x0[k], dy = y0[k + lanes] - y0[k];
      const double dvx = vx0[k + lanes] - vx0[k], dvy = vy0[k + lanes] - vy0[k];
      const double l = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / l;
      const double cx = dx * inverse, cy = dy * inverse;
      const double rate = cx * dvx + cy * dvy;
      const double w = (cx * dvy - cy * dvx) * inverse;
      const double f = stiffness[k] * (l - length[k]) + damping[k] * rate;
      oux[k] = cx;
      ouy[k] = cy;
      oil[k] = inverse;
      if (Turning) ot[k] = w;
      of[k] = f + turning[k] * l * w * w;
      og[k] = quarter * (f > 0 ? f : 0.0) * inverse;
    }
  }
}

BELTLIFE_VECTOR void directions_plain(int rows, double h, const LaneNumber& length, const LaneNumber& stiffness,
                                      const LaneNumber& damping, const LaneNumber& turning, const double* x,
                                      const double* y, const double* vx, const double* vy, double* ux, double* uy,
                                      double* inverse_length, double* turn_rate, double* tension, double* geometric) {
  directions<false>(rows, h, length, stiffness, damping, turning, x, y, vx, vy, ux, uy, inverse_length, turn_rate,
                    tension, geometric);
}

BELTLIFE_VECTOR void directions_turning(int rows, double h, const LaneNumber& length, const LaneNumber& stiffness,
                                        const LaneNumber& damping, const LaneNumber& turning, const double* x,
                                        const double* y, const double* vx, const double* vy, double* ux, double* uy,
                                        double* inverse_length, double* turn_rate, double* tension, double* geometric) {
  directions<true>(rows, h, length, stiffness, damping, turning, x, y, vx, vy, ux, uy, inverse_length, turn_rate,
                   tension, geometric);
}

BELTLIFE_VECTOR void node_forces_plain(int rows, const double* ux, const double* uy, const double* tension, double* fx,
                                       double* fy) {
  for (int j = 0; j < rows; ++j) {
    const double *ux1 = ux + j * lanes, *uy1 = uy + j * lanes, *f1 = tension + j * lanes;
    double *ox = fx + j * lanes, *oy = fy + j * lanes;
    BELTLIFE_EACH_LANE(k) {
      ox[k] = f1[k] * ux1[k] - f1[k - lanes] * ux1[k - lanes];
      oy[k] = f1[k] * uy1[k] - f1[k - lanes] * uy1[k - lanes];
    }
  }
}

// Moments M at the nodes and the shear (M(j+1) - M(j))/l of the element between them, as in sim/kernels/belt.cpp.
template <bool Stiff>
[[gnu::always_inline]] inline void node_forces(int rows, const LaneNumber& stiffness, const LaneNumber& damping,
                                               const double* ux, const double* uy, const double* inverse_length,
                                               const double* turn_rate, const double* tension, double* fx, double* fy) {
  LaneNumber moment, gx, gy;  // at the node behind the element, and force of the element behind
  for (int e = -2; e < rows; ++e) {
    const double *ux0 = ux + e * lanes, *uy0 = uy + e * lanes, *il = inverse_length + e * lanes,
                 *w = turn_rate + e * lanes, *f = tension + e * lanes;
    double *ox = fx + e * lanes, *oy = fy + e * lanes;
    BELTLIFE_EACH_LANE(k) {
      double m = damping[k] * (w[k + lanes] - w[k]);
      if (Stiff) {
        const double cross = ux0[k] * uy0[k + lanes] - uy0[k] * ux0[k + lanes];
        const double dot = ux0[k] * ux0[k + lanes] + uy0[k] * uy0[k + lanes];
        m += stiffness[k] * turn_angle(cross, dot);
      }
      const double q = (m - moment[k]) * il[k];
      const double hx = f[k] * ux0[k] + q * uy0[k], hy = f[k] * uy0[k] - q * ux0[k];
      ox[k] = hx - gx[k];
      oy[k] = hy - gy[k];
      moment[k] = m;
      gx[k] = hx;
      gy[k] = hy;
    }
  }
}

BELTLIFE_VECTOR void node_forces_damped(int rows, const LaneNumber& stiffness, const LaneNumber& damping,
                                        const double* ux, const double* uy, const double* inverse_length,
                                        const double* turn_rate, const double* tension, double* fx, double* fy) {
  node_forces<false>(rows, stiffness, damping, ux, uy, inverse_length, turn_rate, tension, fx, fy);
}

BELTLIFE_VECTOR void node_forces_stiff(int rows, const LaneNumber& stiffness, const LaneNumber& damping,
                                       const double* ux, const double* uy, const double* inverse_length,
                                       const double* turn_rate, const double* tension, double* fx, double* fy) {
  node_forces<true>(rows, stiffness, damping, ux, uy, inverse_length, turn_rate, tension, fx, fy);
}

}  // namespace

void lane_elements(LaneBelt& b) {
  const bool bending = b.bending_damping || b.bending_stiffness;
  (bending ? directions_turning : directions_plain)(b.rows, b.step, b.length, b.axial_stiffness, b.axial_damping,
                                                    b.turning_tension, b.x.data(), b.y.data(), b.vx.data(), b.vy.data(),
                                                    b.ux.data(), b.uy.data(), b.inverse_length.data(),
                                                    b.turn_rate.data(), b.tension.data(), b.geometric.data());
  if (!bending)
    node_forces_plain(b.rows, b.ux.data(), b.uy.data(), b.tension.data(), b.fx.data(), b.fy.data());
  else
    (b.bending_stiffness ? node_forces_stiff : node_forces_damped)(
        b.rows, b.bend_stiffness, b.bend_damping, b.ux.data(), b.uy.data(), b.inverse_length.data(), b.turn_rate.data(),
        b.tension.data(), b.fx.data(), b.fy.data());
}

}  // namespace beltlife
