// Owns the rows of the implicit step's matrix as elimination comes to them: see lane_solver.cpp.
#pragma once

#include "sim/lanes/lane_array.h"

namespace beltlife {

struct RowElements {
  LaneNumber axial, mass;  // k_a, m
  LaneNumber bend_root;    // root of c_b: q = root n/l carries it
  const double *ux, *uy, *inverse_length, *geometric;
  const double *normal_x, *normal_y, *normal_tangent, *tangential_tangent;
  const double *fx, *fy;
};

// What elimination hands on to the rows that follow. The bending blocks are of rank one, v_j = q_j q_(j+1)', so that
// what a row takes off the one after next is q of the row between, times a number.
struct RowCarry {
  LaneNumber diagonal[3];         // of the next row: block of the element behind it, less what elimination takes off
  LaneNumber rhs[2];              // the same for the right-hand side
  LaneNumber behind[2], here[2];  // q of the elements behind and ahead of the next row
  LaneNumber turned[2];           // t = u' D^-1 q: t q' comes off the next row's coupling
  LaneNumber bent, bent_rhs;      // q' D^-1 q and q' D^-1 r of the last row
};

// Diagonal block, coupling to the next row and right-hand side of a row, less what was taken off them; q of the row and
// of the next.
struct MatrixRow {
  LaneNumber d[3], u[4], r[2], qx, qy, ax, ay;
};

template <bool Bending>
[[gnu::always_inline]] inline void row_blocks(int j, double h, const RowElements& e, RowCarry& c, MatrixRow& row) {
  const int o = j * lanes;
  BELTLIFE_EACH_LANE(k) {
    const int i = o + k;
    // Block of the element k_a u u' + k_g n n' = k_g + (k_a - k_g) u u', and of contact likewise.
    const double ux = e.ux[i], uy = e.uy[i], kg = e.geometric[i], along = e.axial[k] - kg;
    const double k00 = kg + along * ux * ux, k01 = along * ux * uy, k11 = kg + along * uy * uy;
    const double nx = e.normal_x[i], ny = e.normal_y[i], ct = e.tangential_tangent[i], cn = e.normal_tangent[i] - ct;
    const double own = e.mass[k] + ct;
    double d00 = own + cn * nx * nx + k00, d01 = cn * nx * ny + k01, d11 = own + cn * ny * ny + k11;
    double next00 = k00, next01 = k01, next11 = k11, next_x = 0, next_y = 0;
    double u00 = -k00, u01 = -k01, u10 = -k01, u11 = -k11;
    if (Bending) {
      const double root = e.bend_root[k] * e.inverse_length[i + lanes];
      const double ax = -e.uy[i + lanes] * root, ay = e.ux[i + lanes] * root;
      const double qx = c.here[0][k], qy = c.here[1][k], sx = qx + c.behind[0][k], sy = qy + c.behind[1][k];
      const double q00 = qx * qx, q01 = qx * qy, q11 = qy * qy;
      d00 += sx * sx + q00;
      d01 += sx * sy + q01;
      d11 += sy * sy + q11;
      // u = -k - (s + q + t) q' - q a'
      const double gx = sx + qx + c.turned[0][k], gy = sy + qy + c.turned[1][k];
      u00 -= gx * qx + qx * ax;
      u01 -= gx * qy + qx * ay;
      u10 -= gy * qx + qy * ax;
      u11 -= gy * qy + qy * ay;
      const double rest = 1.0 - c.bent[k];
      next00 += rest * q00;
      next01 += rest * q01;
      next11 += rest * q11;
      next_x = -c.bent_rhs[k] * qx;
      next_y = -c.bent_rhs[k] * qy;
      row.qx[k] = qx;
      row.qy[k] = qy;
      row.ax[k] = ax;
      row.ay[k] = ay;
      c.behind[0][k] = qx;
      c.behind[1][k] = qy;
      c.here[0][k] = ax;
      c.here[1][k] = ay;
    }
    row.d[0][k] = d00 + c.diagonal[0][k];
    row.d[1][k] = d01 + c.diagonal[1][k];
    row.d[2][k] = d11 + c.diagonal[2][k];
    row.u[0][k] = u00;
    row.u[1][k] = u01;
    row.u[2][k] = u10;
    row.u[3][k] = u11;
    row.r[0][k] = h * e.fx[i] + c.rhs[0][k];
    row.r[1][k] = h * e.fy[i] + c.rhs[1][k];
    c.diagonal[0][k] = next00;
    c.diagonal[1][k] = next01;
    c.diagonal[2][k] = next11;
    c.rhs[0][k] = next_x;
    c.rhs[1][k] = next_y;
  }
}

}  // namespace beltlife
