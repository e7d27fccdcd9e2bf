// Belt nodes in lanes: their constants, ghosts and motion. See lane_belt.h.
#include "sim/lanes/lane_belt.h"

#include <algorithm>
#include <cmath>

#include "sim/kernels/kernel.h"

namespace beltlife {
namespace {

// The left interface's part in row j dies out as r^j, r + 1/r = 2 + m/k_a. What is left at the last row kept, 1e-4 of
// a correction that is itself small, changes no quantity above its noise.
int rows_of_fill(const LaneBelt& b, int lane) {
  const double half = 0.5 * b.mass[lane] / b.axial_tangent[lane];
  const double decay = std::acosh(1 + half);
  return std::min(std::max(static_cast<int>(std::ceil(9.2 / decay)), 4), b.rows - 2);
}

}  // namespace

LaneBelt make_lane_belt(const std::vector<const Model*>& drives, LaneUse use, double step) {
  LaneBelt b;
  b.use = use;
  const int nodes = drives.front()->belt.nodes;
  b.rows = use == LaneUse::arcs ? nodes / lanes : nodes;
  b.step = step;
  for (const Model* m : drives) {
    b.bending_stiffness = b.bending_stiffness || m->belt.bending_stiffness > 0;
    b.bending_damping = b.bending_damping || m->belt.bending_damping > 0;
  }
  for (int k = 0; k < lanes; ++k) {
    const Model& m = *drives[static_cast<std::size_t>(k) < drives.size() ? k : 0];
    const double l0 = m.belt.element_length;
    b.mass[k] = m.belt.node_mass;
    b.length[k] = l0;
    b.axial_stiffness[k] = m.belt.axial_stiffness / l0;
    b.axial_damping[k] = m.belt.axial_damping / l0;
    b.bend_stiffness[k] = m.belt.bending_stiffness / l0;
    b.bend_damping[k] = m.belt.bending_damping / l0;
    // The axial damper is faster than the step on short waves and weak on long ones: weighted as in lane_contact.cpp,
    // short waves die out instead of alternating.
    const double z = 4 * step * b.axial_damping[k] / m.belt.node_mass, weight = 0.5 + 0.5 * z / (z + 6.0);
    b.axial_tangent[k] = 0.25 * step * step * b.axial_stiffness[k] + weight * step * b.axial_damping[k];
    b.turning_tension[k] = 0.25 * step * step * b.axial_stiffness[k] + (weight - 0.5) * step * b.axial_damping[k];
    b.bend_tangent[k] = 0.25 * step * step * b.bend_stiffness[k] + 0.5 * step * b.bend_damping[k];
    b.law.mass[k] = m.belt.node_mass;
    b.law.stiffness[k] = m.contact.stiffness;
    b.law.damping[k] = m.contact.damping;
    b.law.separation_damping[k] = m.contact.separation_damping;
    b.law.friction_stiffness[k] = m.contact.friction_stiffness;
    b.law.inverse_friction_stiffness[k] = 1 / m.contact.friction_stiffness;
    b.law.friction_speed[k] = m.contact.friction_speed;
  }
  for (LaneArray* a : {&b.x,
                       &b.y,
                       &b.vx,
                       &b.vy,
                       &b.dvx,
                       &b.dvy,
                       &b.anchor,
                       &b.ux,
                       &b.uy,
                       &b.inverse_length,
                       &b.turn_rate,
                       &b.tension,
                       &b.geometric,
                       &b.fx,
                       &b.fy,
                       &b.normal_x,
                       &b.normal_y,
                       &b.distance,
                       &b.normal,
                       &b.tangential,
                       &b.normal_tangent,
                       &b.tangential_tangent,
                       &b.normal_peak,
                       &b.lag,
                       &b.tangential_now,
                       &b.creep,
                       &b.normal_last,
                       &b.normal_before,
                       &b.tangential_peak,
                       &b.rhs_x,
                       &b.rhs_y})
    *a = LaneArray(b.rows);
  for (auto& a : b.next) a = LaneArray(b.rows);
  for (auto& a : b.after) a = LaneArray(b.rows);
  for (int k = 0; k < lanes; ++k) b.fill_rows[k] = rows_of_fill(b, k);
  for (auto& a : b.left) a = LaneArray(b.rows);
  return b;
}

void fill_lane_ghosts(LaneBelt& b) {
  const int n = b.rows;
  for (LaneArray* a : {&b.x, &b.y, &b.vx, &b.vy}) {
    for (int g = 1; g <= LaneArray::ghosts; ++g) {
      double* before = a->row(-g);
      double* behind = a->row(n - 1 + g);
      const double* last = a->row(n - g);
      const double* first = a->row(g - 1);
      for (int k = 0; k < lanes; ++k) {
        const int left = b.use == LaneUse::arcs ? (k + lanes - 1) % lanes : k;
        const int right = b.use == LaneUse::arcs ? (k + 1) % lanes : k;
        before[k] = last[left];
        behind[k] = first[right];
      }
    }
  }
}

namespace {

BELTLIFE_VECTOR void advance(int count, double h, const double* __restrict dvx, const double* __restrict dvy,
                             double* __restrict x, double* __restrict y, double* __restrict vx, double* __restrict vy) {
  for (int i = 0; i < count; ++i) {
    vx[i] += dvx[i];
    vy[i] += dvy[i];
    x[i] += h * vx[i];
    y[i] += h * vy[i];
  }
}

}  // namespace

void lane_advance(LaneBelt& b) {
  advance(b.rows * lanes, b.step, b.dvx.data(), b.dvy.data(), b.x.data(), b.y.data(), b.vx.data(), b.vy.data());
}

}  // namespace beltlife
