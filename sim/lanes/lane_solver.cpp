// The linear solve of the implicit step in lanes: see lane_belt.h.
//
// Block pentadiagonal (2 x 2 blocks), symmetric, positive definite and cyclic. Each lane eliminates its rows
// 0 .. rows-3 onto its interfaces: the last two rows of its own lane and those of the lane on its left (drives: the
// same two). Elimination runs from the left, so only the left interface fills in, and that dies out after fill_rows.
// The interfaces of a lane are then a 4 x 4 system of their own, unless the belt is so stiff or damped that an arc's
// two interfaces still feel each other; then they are solved together.
#include <algorithm>
#include <cmath>

#include "sim/kernels/kernel.h"
#include "sim/lanes/lane_belt.h"
#include "sim/lanes/lane_interfaces.h"

namespace beltlife {
namespace {

struct Elements {
  LaneNumber axial, bend, mass;  // k_a, c_b, m
  const double *ux, *uy, *inverse_length, *geometric;
  const double *normal_x, *normal_y, *normal_tangent, *tangential_tangent;
  const double *fx, *fy;
};

// What elimination hands on to the rows that follow.
struct Carry {
  LaneNumber pivot[3], pivot_after[3];  // to be taken off the next row's diagonal block, and the one after
  LaneNumber next[4];                   // off the next row's coupling
  LaneNumber rhs[2], rhs_after[2];
  LaneNumber left[8], left_after[8];  // coupling of the next two rows to the left interface
  LaneNumber interface[10], interface_rhs[4];
  // The element behind the row: its block k_a u u' + k_g n n', and q = n/l.
  LaneNumber k00, k01, k11, qx, qy;
};

// Diagonal block, couplings and right-hand side of one row, less what the carry takes off them.
template <bool Bending>
[[gnu::always_inline]] inline void row_blocks(int j, double h, const Elements& e, Carry& c, LaneNumber (&d)[3],
                                              LaneNumber (&u)[4], LaneNumber (&v)[4], LaneNumber (&r)[2]) {
  const int o = j * lanes;
  BELTLIFE_EACH_LANE(k) {
    const int i = o + k;
    const double ux = e.ux[i], uy = e.uy[i], ka = e.axial[k], kg = e.geometric[i];
    const double k00 = ka * ux * ux + kg * uy * uy, k01 = (ka - kg) * ux * uy, k11 = ka * uy * uy + kg * ux * ux;
    const double nx = e.normal_x[i], ny = e.normal_y[i], cn = e.normal_tangent[i], ct = e.tangential_tangent[i];
    double d00 = e.mass[k] + c.k00[k] + k00 + cn * nx * nx + ct * ny * ny - c.pivot[0][k];
    double d01 = c.k01[k] + k01 + (cn - ct) * nx * ny - c.pivot[1][k];
    double d11 = e.mass[k] + c.k11[k] + k11 + cn * ny * ny + ct * nx * nx - c.pivot[2][k];
    double u00 = -k00 - c.next[0][k], u01 = -k01 - c.next[1][k], u10 = -k01 - c.next[2][k], u11 = -k11 - c.next[3][k];
    if (Bending) {
      const double cb = e.bend[k], il = e.inverse_length[i], ila = e.inverse_length[i + lanes];
      const double qx = -uy * il, qy = ux * il, bx = c.qx[k], by = c.qy[k];
      const double ax = -e.uy[i + lanes] * ila, ay = e.ux[i + lanes] * ila;
      const double sx = qx + bx, sy = qy + by, tx = ax + qx, ty = ay + qy;
      d00 += cb * (sx * sx + bx * bx + qx * qx);
      d01 += cb * (sx * sy + bx * by + qx * qy);
      d11 += cb * (sy * sy + by * by + qy * qy);
      u00 -= cb * (sx * qx + qx * tx);
      u01 -= cb * (sx * qy + qx * ty);
      u10 -= cb * (sy * qx + qy * tx);
      u11 -= cb * (sy * qy + qy * ty);
      v[0][k] = cb * qx * ax;
      v[1][k] = cb * qx * ay;
      v[2][k] = cb * qy * ax;
      v[3][k] = cb * qy * ay;
      c.qx[k] = qx;
      c.qy[k] = qy;
    }
    d[0][k] = d00;
    d[1][k] = d01;
    d[2][k] = d11;
    u[0][k] = u00;
    u[1][k] = u01;
    u[2][k] = u10;
    u[3][k] = u11;
    r[0][k] = h * e.fx[i] - c.rhs[0][k];
    r[1][k] = h * e.fy[i] - c.rhs[1][k];
    c.k00[k] = k00;
    c.k01[k] = k01;
    c.k11[k] = k11;
  }
}

struct Factors {
  double *rhs_x, *rhs_y;
  double* next[4];
  double* after[4];
  double* left[8];
};

[[gnu::always_inline]] inline void add_product(LaneNumber& to, const LaneNumber& a, const LaneNumber& b,
                                               const double* p, const double* q) {
  BELTLIFE_EACH_LANE(k) to[k] += a[k] * p[k] + b[k] * q[k];
}

template <bool Bending, bool Fill>
[[gnu::always_inline]] inline void eliminate(int j, const LaneNumber (&d)[3], const LaneNumber (&u)[4],
                                             const LaneNumber (&v)[4], const LaneNumber (&r)[2], Carry& c,
                                             const Factors& f) {
  const int o = j * lanes;
  LaneNumber i00, i01, i11;
  BELTLIFE_EACH_LANE(k) {
    const double det = 1.0 / (d[0][k] * d[2][k] - d[1][k] * d[1][k]);
    const double a = d[2][k] * det, b = -d[1][k] * det, e = d[0][k] * det;
    i00[k] = a;
    i01[k] = b;
    i11[k] = e;
    const double y0 = a * r[0][k] + b * r[1][k], y1 = b * r[0][k] + e * r[1][k];
    const double w0 = a * u[0][k] + b * u[2][k], w1 = a * u[1][k] + b * u[3][k];
    const double w2 = b * u[0][k] + e * u[2][k], w3 = b * u[1][k] + e * u[3][k];
    f.rhs_x[o + k] = y0;
    f.rhs_y[o + k] = y1;
    f.next[0][o + k] = w0;
    f.next[1][o + k] = w1;
    f.next[2][o + k] = w2;
    f.next[3][o + k] = w3;
    double p0 = u[0][k] * w0 + u[2][k] * w2, p1 = u[0][k] * w1 + u[2][k] * w3, p2 = u[1][k] * w1 + u[3][k] * w3;
    double r0 = u[0][k] * y0 + u[2][k] * y1, r1 = u[1][k] * y0 + u[3][k] * y1;
    if (Bending) {
      const double z0 = a * v[0][k] + b * v[2][k], z1 = a * v[1][k] + b * v[3][k];
      const double z2 = b * v[0][k] + e * v[2][k], z3 = b * v[1][k] + e * v[3][k];
      f.after[0][o + k] = z0;
      f.after[1][o + k] = z1;
      f.after[2][o + k] = z2;
      f.after[3][o + k] = z3;
      c.next[0][k] = u[0][k] * z0 + u[2][k] * z2;
      c.next[1][k] = u[0][k] * z1 + u[2][k] * z3;
      c.next[2][k] = u[1][k] * z0 + u[3][k] * z2;
      c.next[3][k] = u[1][k] * z1 + u[3][k] * z3;
      p0 += c.pivot_after[0][k];
      p1 += c.pivot_after[1][k];
      p2 += c.pivot_after[2][k];
      c.pivot_after[0][k] = v[0][k] * z0 + v[2][k] * z2;
      c.pivot_after[1][k] = v[0][k] * z1 + v[2][k] * z3;
      c.pivot_after[2][k] = v[1][k] * z1 + v[3][k] * z3;
      r0 += c.rhs_after[0][k];
      r1 += c.rhs_after[1][k];
      c.rhs_after[0][k] = v[0][k] * y0 + v[2][k] * y1;
      c.rhs_after[1][k] = v[1][k] * y0 + v[3][k] * y1;
    }
    c.pivot[0][k] = p0;
    c.pivot[1][k] = p1;
    c.pivot[2][k] = p2;
    c.rhs[0][k] = r0;
    c.rhs[1][k] = r1;
  }
  if (!Fill) return;
  // The 2 x 4 coupling to the left interface, column by column; the interface's own block is kept as its upper half.
  LaneNumber a[4], b[4];
#pragma GCC unroll 4
  for (int s = 0; s < 4; ++s) {
    BELTLIFE_EACH_LANE(k) {
      const double a0 = c.left[s][k], b0 = c.left[4 + s][k];
      const double p = i00[k] * a0 + i01[k] * b0, q = i01[k] * a0 + i11[k] * b0;
      a[s][k] = a0;
      b[s][k] = b0;
      f.left[s][o + k] = p;
      f.left[4 + s][o + k] = q;
      c.interface_rhs[s][k] += a0 * f.rhs_x[o + k] + b0 * f.rhs_y[o + k];
      double next0 = -(u[0][k] * p + u[2][k] * q), next1 = -(u[1][k] * p + u[3][k] * q);
      if (Bending) {
        next0 += c.left_after[s][k];
        next1 += c.left_after[4 + s][k];
        c.left_after[s][k] = -(v[0][k] * p + v[2][k] * q);
        c.left_after[4 + s][k] = -(v[1][k] * p + v[3][k] * q);
      }
      c.left[s][k] = next0;
      c.left[4 + s][k] = next1;
    }
  }
  constexpr int first[10] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3}, second[10] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
#pragma GCC unroll 10
  for (int s = 0; s < 10; ++s)
    add_product(c.interface[s], a[first[s]], b[first[s]], f.left[second[s]] + o, f.left[4 + second[s]] + o);
}

// Couplings of rows 0 and 1 to the two rows of the left interface, rows -2 and -1.
template <bool Bending>
[[gnu::always_inline]] inline void first_fill(const Elements& e, Carry& c) {
  BELTLIFE_EACH_LANE(k) {
    const int i = k - lanes;  // the element of row -1
    const double ux = e.ux[i], uy = e.uy[i], ka = e.axial[k], kg = e.geometric[i];
    const double k00 = ka * ux * ux + kg * uy * uy, k01 = (ka - kg) * ux * uy, k11 = ka * uy * uy + kg * ux * ux;
    c.k00[k] = k00;
    c.k01[k] = k01;
    c.k11[k] = k11;
    double l[8] = {0, 0, -k00, -k01, 0, 0, -k01, -k11};
    if (Bending) {
      const int b = i - lanes, a = i + lanes;
      const double cb = e.bend[k];
      const double bx = -e.uy[b] * e.inverse_length[b], by = e.ux[b] * e.inverse_length[b];
      const double qx = -uy * e.inverse_length[i], qy = ux * e.inverse_length[i];
      const double ax = -e.uy[a] * e.inverse_length[a], ay = e.ux[a] * e.inverse_length[a];
      const double sx = qx + bx, sy = qy + by, tx = ax + qx, ty = ay + qy;
      // Row 0 to row -2: (c q(-2) q(-1)')'; to row -1: -c (s(-1) q(-1)' + q(-1) s(0)')'; row 1 to row -1.
      l[0] = cb * qx * bx;
      l[1] = cb * qx * by;
      l[4] = cb * qy * bx;
      l[5] = cb * qy * by;
      l[2] -= cb * (qx * sx + tx * qx);
      l[3] -= cb * (qx * sy + tx * qy);
      l[6] -= cb * (qy * sx + ty * qx);
      l[7] -= cb * (qy * sy + ty * qy);
      c.left_after[0][k] = c.left_after[1][k] = c.left_after[4][k] = c.left_after[5][k] = 0;
      c.left_after[2][k] = cb * ax * qx;
      c.left_after[3][k] = cb * ax * qy;
      c.left_after[6][k] = cb * ay * qx;
      c.left_after[7][k] = cb * ay * qy;
      c.qx[k] = qx;
      c.qy[k] = qy;
    }
    c.left[0][k] = l[0];
    c.left[1][k] = l[1];
    c.left[2][k] = l[2];
    c.left[3][k] = l[3];
    c.left[4][k] = l[4];
    c.left[5][k] = l[5];
    c.left[6][k] = l[6];
    c.left[7][k] = l[7];
  }
}

// Ends the left interface's part in the lanes where it is no longer felt from row j on, so that no lane depends on how
// far another one's reaches.
inline void end_fill(int j, const int (&fill)[lanes], Carry& c) {
  for (int k = 0; k < lanes; ++k) {
    if (fill[k] != j) continue;
    for (int s = 0; s < 8; ++s) c.left[s][k] = c.left_after[s][k] = 0;
  }
}

// Forward over all rows; what remains are the interface's rows: d, u of row rows-2 and d of row rows-1.
template <bool Bending>
[[gnu::always_inline]] inline void forward(int rows, const int (&fill_of)[lanes], int fill, double h, const Elements& e,
                                           const Factors& f, Carry& c, LaneNumber (&interface)[10],
                                           LaneNumber (&rhs)[4]) {
  LaneNumber d[3], u[4], v[4], r[2];
  first_fill<Bending>(e, c);
  for (int j = 0; j < fill; ++j) {
    end_fill(j, fill_of, c);
    row_blocks<Bending>(j, h, e, c, d, u, v, r);
    eliminate<Bending, true>(j, d, u, v, r, c, f);
  }
  for (int j = fill; j < rows - 2; ++j) {
    row_blocks<Bending>(j, h, e, c, d, u, v, r);
    eliminate<Bending, false>(j, d, u, v, r, c, f);
  }
  row_blocks<Bending>(rows - 2, h, e, c, d, u, v, r);
  BELTLIFE_EACH_LANE(k) {
    interface[0][k] = d[0][k];
    interface[1][k] = d[1][k];
    interface[2][k] = u[0][k];
    interface[3][k] = u[1][k];
    interface[4][k] = d[2][k];
    interface[5][k] = u[2][k];
    interface[6][k] = u[3][k];
    rhs[0][k] = r[0][k];
    rhs[1][k] = r[1][k];
    for (int s = 0; s < 3; ++s) c.pivot[s][k] = Bending ? c.pivot_after[s][k] : 0.0;
    for (int s = 0; s < 4; ++s) c.next[s][k] = 0;
    for (int s = 0; s < 2; ++s) c.rhs[s][k] = Bending ? c.rhs_after[s][k] : 0.0;
  }
  row_blocks<Bending>(rows - 1, h, e, c, d, u, v, r);
  BELTLIFE_EACH_LANE(k) {
    interface[7][k] = d[0][k];
    interface[8][k] = d[1][k];
    interface[9][k] = d[2][k];
    rhs[2][k] = r[0][k];
    rhs[3][k] = r[1][k];
  }
}

// Cholesky by hand of a symmetric 4 x 4 system a x = b in every lane; a as upper half by rows.
[[gnu::always_inline]] inline void solve4(const LaneNumber (&a)[10], LaneNumber (&b)[4]) {
  BELTLIFE_EACH_LANE(k) {
    const double i0 = 1.0 / a[0][k];
    const double l1 = a[1][k] * i0, l2 = a[2][k] * i0, l3 = a[3][k] * i0;
    const double a11 = a[4][k] - l1 * a[1][k], a12 = a[5][k] - l1 * a[2][k], a13 = a[6][k] - l1 * a[3][k];
    const double i1 = 1.0 / a11, m2 = a12 * i1, m3 = a13 * i1;
    const double a22 = a[7][k] - l2 * a[2][k] - m2 * a12, a23 = a[8][k] - l2 * a[3][k] - m2 * a13;
    const double i2 = 1.0 / a22, n3 = a23 * i2;
    const double a33 = a[9][k] - l3 * a[3][k] - m3 * a13 - n3 * a23;
    const double b0 = b[0][k], b1 = b[1][k] - l1 * b0, b2 = b[2][k] - l2 * b0 - m2 * b1;
    const double b3 = b[3][k] - l3 * b0 - m3 * b1 - n3 * b2;
    const double x3 = b3 / a33, x2 = b2 * i2 - n3 * x3, x1 = b1 * i1 - m2 * x2 - m3 * x3;
    b[0][k] = b0 * i0 - l1 * x1 - l2 * x2 - l3 * x3;
    b[1][k] = x1;
    b[2][k] = x2;
    b[3][k] = x3;
  }
}

template <bool Bending, bool Fill>
[[gnu::always_inline]] inline void back(int j, const LaneNumber (&l)[4], const Factors& f, double* dvx, double* dvy) {
  const int o = j * lanes;
  BELTLIFE_EACH_LANE(k) {
    const int i = o + k;
    const double x1 = dvx[i + lanes], y1 = dvy[i + lanes];
    double x = f.rhs_x[i] - f.next[0][i] * x1 - f.next[1][i] * y1;
    double y = f.rhs_y[i] - f.next[2][i] * x1 - f.next[3][i] * y1;
    if (Bending) {
      const double x2 = dvx[i + 2 * lanes], y2 = dvy[i + 2 * lanes];
      x -= f.after[0][i] * x2 + f.after[1][i] * y2;
      y -= f.after[2][i] * x2 + f.after[3][i] * y2;
    }
    if (Fill) {
      x -= f.left[0][i] * l[0][k] + f.left[1][i] * l[1][k] + f.left[2][i] * l[2][k] + f.left[3][i] * l[3][k];
      y -= f.left[4][i] * l[0][k] + f.left[5][i] * l[1][k] + f.left[6][i] * l[2][k] + f.left[7][i] * l[3][k];
    }
    dvx[i] = x;
    dvy[i] = y;
  }
}

template <bool Bending>
[[gnu::always_inline]] inline void solve(LaneUse use, int rows, const int (&fill_of)[lanes], double h,
                                         const Elements& e, const Factors& f, double* dvx, double* dvy) {
  const int fill = *std::max_element(fill_of, fill_of + lanes);
  Carry c{};
  LaneNumber interface[10], x[4], left[4];
  forward<Bending>(rows, fill_of, fill, h, e, f, c, interface, x);
  for (int k = 0; k < lanes; ++k) {
    const int right = use == LaneUse::arcs ? (k + 1) % lanes : k;
    for (int s = 0; s < 10; ++s) interface[s][k] -= c.interface[s][right];
    for (int s = 0; s < 4; ++s) x[s][k] -= c.interface_rhs[s][right];
  }
  LaneNumber coupled[4] = {x[0], x[1], x[2], x[3]};
  solve4(interface, x);
  if (fill == rows - 2) {
    solve_coupled_interfaces(use, interface, c.left, c.left_after, coupled);
    for (int k = 0; k < lanes; ++k)
      if (fill_of[k] == rows - 2)
        for (int s = 0; s < 4; ++s) x[s][k] = coupled[s][k];
  }
  for (int k = 0; k < lanes; ++k) {
    const int from = use == LaneUse::arcs ? (k + lanes - 1) % lanes : k;
    for (int s = 0; s < 4; ++s) left[s][k] = x[s][from];
    dvx[(rows - 2) * lanes + k] = x[0][k];
    dvy[(rows - 2) * lanes + k] = x[1][k];
    dvx[(rows - 1) * lanes + k] = x[2][k];
    dvy[(rows - 1) * lanes + k] = x[3][k];
  }
  for (int j = rows - 3; j >= fill; --j) back<Bending, false>(j, left, f, dvx, dvy);
  for (int j = fill - 1; j >= 0; --j) back<Bending, true>(j, left, f, dvx, dvy);
}

BELTLIFE_VECTOR void solve_axial(LaneUse use, int rows, const int (&fill)[lanes], double h, const Elements& e,
                                 const Factors& f, double* dvx, double* dvy) {
  solve<false>(use, rows, fill, h, e, f, dvx, dvy);
}

BELTLIFE_VECTOR void solve_bending(LaneUse use, int rows, const int (&fill)[lanes], double h, const Elements& e,
                                   const Factors& f, double* dvx, double* dvy) {
  solve<true>(use, rows, fill, h, e, f, dvx, dvy);
}

}  // namespace

void lane_solve(LaneBelt& b) {
  const Elements e{b.axial_tangent,
                   b.bend_tangent,
                   b.mass,
                   b.ux.data(),
                   b.uy.data(),
                   b.inverse_length.data(),
                   b.geometric.data(),
                   b.normal_x.data(),
                   b.normal_y.data(),
                   b.normal_tangent.data(),
                   b.tangential_tangent.data(),
                   b.fx.data(),
                   b.fy.data()};
  Factors f{b.rhs_x.data(), b.rhs_y.data(), {}, {}, {}};
  for (int s = 0; s < 4; ++s) f.next[s] = b.next[s].data();
  for (int s = 0; s < 4; ++s) f.after[s] = b.after[s].data();
  for (int s = 0; s < 8; ++s) f.left[s] = b.left[s].data();
  const bool bending = b.bending_damping || b.bending_stiffness;
  (bending ? solve_bending : solve_axial)(b.use, b.rows, b.fill_rows, b.step, e, f, b.dvx.data(), b.dvy.data());
}

}  // namespace beltlife
