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
#include "sim/lanes/lane_rows.h"

namespace beltlife {
namespace {

// The coupling of the next rows to the left interface, column by column, and sums for the interface.
struct Fill {
  LaneNumber left[8], after[4];  // of the next row; after: times -q that of the row behind it
  LaneNumber interface[10], rhs[4];
};

struct Factors {
  double *rhs_x, *rhs_y;
  double* next[4];
  double* after[4];  // D^-1 q, and q of the next row
  double* left[8];
};

[[gnu::always_inline]] inline void add_product(LaneNumber& to, const LaneNumber& a, const LaneNumber& b,
                                               const double* p, const double* q) {
  BELTLIFE_EACH_LANE(k) to[k] += a[k] * p[k] + b[k] * q[k];
}

template <bool Bending, bool Filled>
[[gnu::always_inline]] inline void eliminate(int j, const MatrixRow& row, RowCarry& c, Fill& fill, const Factors& f) {
  const int o = j * lanes;
  LaneNumber i00, i01, i11;
  BELTLIFE_EACH_LANE(k) {
    const double d00 = row.d[0][k], d01 = row.d[1][k], d11 = row.d[2][k], r0 = row.r[0][k], r1 = row.r[1][k];
    const double u00 = row.u[0][k], u01 = row.u[1][k], u10 = row.u[2][k], u11 = row.u[3][k];
    const double det = 1.0 / (d00 * d11 - d01 * d01);
    // Products with the adjugate, divided last: the next row waits for this one's division and hardly more.
    const double y0 = d11 * r0 - d01 * r1, y1 = d00 * r1 - d01 * r0;
    const double w0 = d11 * u00 - d01 * u10, w1 = d11 * u01 - d01 * u11;
    const double w2 = d00 * u10 - d01 * u00, w3 = d00 * u11 - d01 * u01;
    c.diagonal[0][k] -= (u00 * w0 + u10 * w2) * det;
    c.diagonal[1][k] -= (u00 * w1 + u10 * w3) * det;
    c.diagonal[2][k] -= (u01 * w1 + u11 * w3) * det;
    c.rhs[0][k] -= (u00 * y0 + u10 * y1) * det;
    c.rhs[1][k] -= (u01 * y0 + u11 * y1) * det;
    f.rhs_x[o + k] = y0 * det;
    f.rhs_y[o + k] = y1 * det;
    f.next[0][o + k] = w0 * det;
    f.next[1][o + k] = w1 * det;
    f.next[2][o + k] = w2 * det;
    f.next[3][o + k] = w3 * det;
    i00[k] = d11 * det;
    i01[k] = -d01 * det;
    i11[k] = d00 * det;
    if (Bending) {
      const double qx = row.qx[k], qy = row.qy[k];
      const double g0 = d11 * qx - d01 * qy, g1 = d00 * qy - d01 * qx;
      f.after[0][o + k] = g0 * det;
      f.after[1][o + k] = g1 * det;
      f.after[2][o + k] = row.ax[k];
      f.after[3][o + k] = row.ay[k];
      c.turned[0][k] = (w0 * qx + w2 * qy) * det;
      c.turned[1][k] = (w1 * qx + w3 * qy) * det;
      c.bent[k] = (g0 * qx + g1 * qy) * det;
      c.bent_rhs[k] = (y0 * qx + y1 * qy) * det;
    }
  }
  if (!Filled) return;
  // The 2 x 4 coupling to the left interface; without bending its first node is not felt. The interface's own block is
  // kept as its upper half.
  constexpr int from = Bending ? 0 : 2;
  LaneNumber a[4], b[4];
#pragma GCC unroll 4
  for (int s = from; s < 4; ++s) {
    BELTLIFE_EACH_LANE(k) {
      const double a0 = fill.left[s][k], b0 = fill.left[4 + s][k];
      const double p = i00[k] * a0 + i01[k] * b0, q = i01[k] * a0 + i11[k] * b0;
      a[s][k] = a0;
      b[s][k] = b0;
      f.left[s][o + k] = p;
      f.left[4 + s][o + k] = q;
      fill.rhs[s][k] += a0 * f.rhs_x[o + k] + b0 * f.rhs_y[o + k];
      double next0 = -(row.u[0][k] * p + row.u[2][k] * q), next1 = -(row.u[1][k] * p + row.u[3][k] * q);
      if (Bending) {
        next0 -= row.qx[k] * fill.after[s][k];
        next1 -= row.qy[k] * fill.after[s][k];
        fill.after[s][k] = row.qx[k] * p + row.qy[k] * q;
      }
      fill.left[s][k] = next0;
      fill.left[4 + s][k] = next1;
    }
  }
  constexpr int first[10] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3}, second[10] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
#pragma GCC unroll 10
  for (int s = Bending ? 0 : 7; s < 10; ++s)
    add_product(fill.interface[s], a[first[s]], b[first[s]], f.left[second[s]] + o, f.left[4 + second[s]] + o);
}

// Couplings of rows 0 and 1 to the two rows of the left interface, rows -2 and -1, and what these hand on.
template <bool Bending>
[[gnu::always_inline]] inline void first_fill(const RowElements& e, RowCarry& c, Fill& fill) {
  BELTLIFE_EACH_LANE(k) {
    const int i = k - lanes;  // the element of row -1
    const double ux = e.ux[i], uy = e.uy[i], kg = e.geometric[i], along = e.axial[k] - kg;
    const double k00 = kg + along * ux * ux, k01 = along * ux * uy, k11 = kg + along * uy * uy;
    double d00 = k00, d01 = k01, d11 = k11;
    double l0 = 0, l1 = 0, l2 = -k00, l3 = -k01, l4 = 0, l5 = 0, l6 = -k01, l7 = -k11;
    if (Bending) {
      const int b = i - lanes, a = i + lanes;
      const double root = e.bend_root[k];
      const double bx = -e.uy[b] * (root * e.inverse_length[b]), by = e.ux[b] * (root * e.inverse_length[b]);
      const double qx = -uy * (root * e.inverse_length[i]), qy = ux * (root * e.inverse_length[i]);
      const double ax = -e.uy[a] * (root * e.inverse_length[a]), ay = e.ux[a] * (root * e.inverse_length[a]);
      const double gx = qx + bx + qx, gy = qy + by + qy;
      // MatrixRow 0 to row -2: (q(-2) q(-1)')'; to row -1: -(s q' + q q' + q a')' of that row; row 1 to row -1.
      l0 = qx * bx;
      l1 = qx * by;
      l4 = qy * bx;
      l5 = qy * by;
      l2 -= qx * gx + ax * qx;
      l3 -= qx * gy + ax * qy;
      l6 -= qy * gx + ay * qx;
      l7 -= qy * gy + ay * qy;
      fill.after[0][k] = fill.after[1][k] = 0;
      fill.after[2][k] = -qx;
      fill.after[3][k] = -qy;
      d00 += qx * qx;
      d01 += qx * qy;
      d11 += qy * qy;
      c.behind[0][k] = qx;
      c.behind[1][k] = qy;
      c.here[0][k] = ax;
      c.here[1][k] = ay;
    }
    c.diagonal[0][k] = d00;
    c.diagonal[1][k] = d01;
    c.diagonal[2][k] = d11;
    fill.left[0][k] = l0;
    fill.left[1][k] = l1;
    fill.left[2][k] = l2;
    fill.left[3][k] = l3;
    fill.left[4][k] = l4;
    fill.left[5][k] = l5;
    fill.left[6][k] = l6;
    fill.left[7][k] = l7;
  }
}

// Ends the left interface's part in the lanes where it is no longer felt from row j on, so that no lane depends on how
// far another one's reaches.
inline void end_fill(int j, const int (&fill_of)[lanes], Fill& fill) {
  for (int k = 0; k < lanes; ++k) {
    if (fill_of[k] != j) continue;
    for (LaneNumber& l : fill.left) l[k] = 0;
    for (LaneNumber& l : fill.after) l[k] = 0;
  }
}

// Forward over all rows; what remains are the interface's rows: d, u of row rows-2 and d of row rows-1.
template <bool Bending>
[[gnu::always_inline]] inline void forward(int rows, const int (&fill_of)[lanes], int filled, double h,
                                           const RowElements& e, const Factors& f, Fill& fill,
                                           LaneNumber (&interface)[10], LaneNumber (&rhs)[4]) {
  RowCarry c{};
  MatrixRow row;
  first_fill<Bending>(e, c, fill);
  for (int j = 0; j < filled; ++j) {
    end_fill(j, fill_of, fill);
    row_blocks<Bending>(j, h, e, c, row);
    eliminate<Bending, true>(j, row, c, fill, f);
  }
  for (int j = filled; j < rows - 2; ++j) {
    row_blocks<Bending>(j, h, e, c, row);
    eliminate<Bending, false>(j, row, c, fill, f);
  }
  row_blocks<Bending>(rows - 2, h, e, c, row);
  BELTLIFE_EACH_LANE(k) {
    interface[0][k] = row.d[0][k];
    interface[1][k] = row.d[1][k];
    interface[2][k] = row.u[0][k];
    interface[3][k] = row.u[1][k];
    interface[4][k] = row.d[2][k];
    interface[5][k] = row.u[2][k];
    interface[6][k] = row.u[3][k];
    rhs[0][k] = row.r[0][k];
    rhs[1][k] = row.r[1][k];
  }
  row_blocks<Bending>(rows - 1, h, e, c, row);
  BELTLIFE_EACH_LANE(k) {
    interface[7][k] = row.d[0][k];
    interface[8][k] = row.d[1][k];
    interface[9][k] = row.d[2][k];
    rhs[2][k] = row.r[0][k];
    rhs[3][k] = row.r[1][k];
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

// Velocities of the two rows behind the one that back substitution is at.
struct Solved {
  LaneNumber x1, y1, x2, y2;
};

template <bool Bending, bool Filled>
[[gnu::always_inline]] inline void back(int j, const LaneNumber (&l)[4], const Factors& f, Solved& v, double* dvx,
                                        double* dvy) {
  const int o = j * lanes;
  BELTLIFE_EACH_LANE(k) {
    const int i = o + k;
    const double x1 = v.x1[k], y1 = v.y1[k];
    double x = f.rhs_x[i], y = f.rhs_y[i];
    if (Bending) {
      const double turn = f.after[2][i] * v.x2[k] + f.after[3][i] * v.y2[k];
      x -= f.after[0][i] * turn;
      y -= f.after[1][i] * turn;
      v.x2[k] = x1;
      v.y2[k] = y1;
    }
    if (Filled) {
      x -= f.left[2][i] * l[2][k] + f.left[3][i] * l[3][k];
      y -= f.left[6][i] * l[2][k] + f.left[7][i] * l[3][k];
      if (Bending) {
        x -= f.left[0][i] * l[0][k] + f.left[1][i] * l[1][k];
        y -= f.left[4][i] * l[0][k] + f.left[5][i] * l[1][k];
      }
    }
    x -= f.next[0][i] * x1 + f.next[1][i] * y1;
    y -= f.next[2][i] * x1 + f.next[3][i] * y1;
    v.x1[k] = x;
    v.y1[k] = y;
    dvx[i] = x;
    dvy[i] = y;
  }
}

// Interfaces of all lanes that still feel each other; the others keep their x.
inline void couple(LaneUse use, int rows, const int (&fill_of)[lanes], const RowElements& e, const Fill& fill,
                   const LaneNumber (&interface)[10], const LaneNumber (&rhs)[4], LaneNumber (&x)[4]) {
  LaneNumber first[8], second[8], coupled[4];
  for (int k = 0; k < lanes; ++k) {
    const int i = (rows - 2) * lanes + k;
    const double root = e.bend_root[k] * e.inverse_length[i], qx = -e.uy[i] * root, qy = e.ux[i] * root;
    for (int s = 0; s < 8; ++s) first[s][k] = fill.left[s][k];
    for (int s = 0; s < 4; ++s) {
      second[s][k] = -qx * fill.after[s][k];
      second[4 + s][k] = -qy * fill.after[s][k];
      coupled[s][k] = rhs[s][k];
    }
  }
  LaneNumber own[10];
  std::copy(interface, interface + 10, own);
  solve_coupled_interfaces(use, own, first, second, coupled);
  for (int k = 0; k < lanes; ++k)
    if (fill_of[k] == rows - 2)
      for (int s = 0; s < 4; ++s) x[s][k] = coupled[s][k];
}

template <bool Bending>
[[gnu::always_inline]] inline void solve(LaneUse use, int rows, const int (&fill_of)[lanes], double h,
                                         const RowElements& e, const Factors& f, double* dvx, double* dvy) {
  const int filled = *std::max_element(fill_of, fill_of + lanes);
  Fill fill{};
  LaneNumber interface[10], rhs[4], x[4], left[4];
  forward<Bending>(rows, fill_of, filled, h, e, f, fill, interface, rhs);
  for (int k = 0; k < lanes; ++k) {
    const int right = use == LaneUse::arcs ? (k + 1) % lanes : k;
    for (int s = 0; s < 10; ++s) interface[s][k] -= fill.interface[s][right];
    for (int s = 0; s < 4; ++s) x[s][k] = rhs[s][k] -= fill.rhs[s][right];
  }
  solve4(interface, x);
  if (filled == rows - 2) couple(use, rows, fill_of, e, fill, interface, rhs, x);
  Solved v;
  for (int k = 0; k < lanes; ++k) {
    const int from = use == LaneUse::arcs ? (k + lanes - 1) % lanes : k;
    for (int s = 0; s < 4; ++s) left[s][k] = x[s][from];
    dvx[(rows - 2) * lanes + k] = v.x1[k] = x[0][k];
    dvy[(rows - 2) * lanes + k] = v.y1[k] = x[1][k];
    dvx[(rows - 1) * lanes + k] = v.x2[k] = x[2][k];
    dvy[(rows - 1) * lanes + k] = v.y2[k] = x[3][k];
  }
  for (int j = rows - 3; j >= filled; --j) back<Bending, false>(j, left, f, v, dvx, dvy);
  for (int j = filled - 1; j >= 0; --j) back<Bending, true>(j, left, f, v, dvx, dvy);
}

BELTLIFE_VECTOR void solve_axial(LaneUse use, int rows, const int (&fill)[lanes], double h, const RowElements& e,
                                 const Factors& f, double* dvx, double* dvy) {
  solve<false>(use, rows, fill, h, e, f, dvx, dvy);
}

BELTLIFE_VECTOR void solve_bending(LaneUse use, int rows, const int (&fill)[lanes], double h, const RowElements& e,
                                   const Factors& f, double* dvx, double* dvy) {
  solve<true>(use, rows, fill, h, e, f, dvx, dvy);
}

}  // namespace

void lane_solve(LaneBelt& b) {
  LaneNumber root;
  for (int k = 0; k < lanes; ++k) root[k] = std::sqrt(b.bend_tangent[k]);
  const RowElements e{b.axial_tangent,
                      b.mass,
                      root,
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
