// Owns the belt in eight lanes: where its nodes lie, its constants, and what one linearly implicit step computes.
//
// The step (positions x at t_n, velocities v half a step earlier) solves once
//   (M + h/2 C + h^2/4 K) dv = h (f(x, v) + curvature terms),   v += dv,   x += h v
// with the tangents C and K of axial, bending and contact forces; see README.md.
#pragma once

#include <vector>

#include "sim/lanes/lane_array.h"
#include "sim/model.h"

namespace beltlife {

/// What the lanes hold: eight arcs of one belt (node j of lane k is belt node k rows + j) or eight drives.
enum class LaneUse { arcs, drives };

/// Pulley of each lane of a block.
struct LanePulleys {
  LaneNumber x, y, vx, vy;                  ///< centre, m, m/s
  LaneNumber radius;                        ///< m; below zero where a lane has no candidate
  LaneNumber anchor_limit, velocity_limit;  ///< friction coefficient's shares: beta mu, (1 - beta) mu
};

/// Rows in which every lane keeps its candidate pulley, numbered; as many as there are pulleys: none.
struct ContactBlock {
  int begin = 0, end = 0;
  int pulley[lanes] = {};
  bool on_arm = false;  ///< whether a lane's pulley is the one that moves
  LanePulleys of;
};

/// Constants of contact and friction in each lane, SI units as in ContactModel.
struct ContactLaw {
  LaneNumber mass, stiffness, damping, separation_damping;
  LaneNumber friction_stiffness, inverse_friction_stiffness, friction_speed;
};

struct LaneBelt {
  LaneUse use = LaneUse::arcs;
  int rows = 0;
  double step = 0;  ///< h, s
  bool bending_damping = false, bending_stiffness = false;
  bool peaks = false;  ///< whether the largest contact forces are kept

  // Constants of each lane, SI units as in BeltModel.
  LaneNumber mass, length, axial_stiffness, axial_damping;  ///< m, l0, EA/l0, CA/l0
  LaneNumber bend_stiffness, bend_damping;                  ///< EI/l0, CI/l0
  ContactLaw law;
  LaneNumber axial_tangent;    ///< h^2/4 EA/l0 + theta h CA/l0, kg
  LaneNumber turning_tension;  ///< h^2/4 EA/l0 + (theta - 1/2) h CA/l0, kg: times l w^2, see lane_elements.cpp
  LaneNumber bend_tangent;     ///< h^2/4 EI/l0 + h/2 CI/l0, kg m^2

  LaneArray x, y, vx, vy;  ///< nodes: m, m/s
  LaneArray dvx, dvy;      ///< change of velocity in the last step, m/s
  LaneArray anchor;        ///< tangential offset from the friction anchor, m

  LaneArray ux, uy, inverse_length, turn_rate, tension;  ///< elements (node j to j + 1)
  LaneArray geometric;                                   ///< h^2/4 max(F, 0)/l of elements, kg
  LaneArray fx, fy;                                      ///< force on nodes, N

  LaneArray normal_x, normal_y, distance;        ///< outward normal of the candidate pulley, distance from its centre
  LaneArray normal, tangential;                  ///< contact forces, N
  LaneArray normal_tangent, tangential_tangent;  ///< their implicit parts, kg
  LaneArray lag;                                 ///< of the averaged normal force behind that at t_n, N
  LaneArray tangential_now, creep;               ///< friction at t_n before the solve, N, and its slope, N s/m
  LaneArray normal_last, normal_before;          ///< normal force one and two steps ago, N
  LaneArray normal_peak, tangential_peak;        ///< largest since they were last cleared, N

  // Factors: of node j its eliminated right-hand side, the products of its inverse pivot with what follows, and with
  // the left interface.
  LaneArray rhs_x, rhs_y;
  LaneArray next[4], after[4], left[8];
  int fill_rows[lanes] = {};  ///< rows beyond which the left interface is not felt, each lane's own

  std::vector<ContactBlock> blocks;
};

/// Belt nodes of up to eight drives, or of one as arcs. Lanes beyond the drives repeat the first.
LaneBelt make_lane_belt(const std::vector<const Model*>& drives, LaneUse use, double step);

/// Copies neighbouring rows into the ghosts of positions and velocities.
void fill_lane_ghosts(LaneBelt& b);

/// Forces of the belt's own elements on the nodes, and their tangents (thesis 2.28, 2.29).
void lane_elements(LaneBelt& b);

/// Contact and friction in all blocks (thesis 2.24-2.27): adds to the nodes' forces. Of every pulley, and behind the
/// last of none: its speed half a step ago and the change expected over this step, rad/s.
void lane_contact(LaneBelt& b, const LaneNumber* speeds, const LaneNumber* changes);

/// Solves for the change of velocity of all nodes.
void lane_solve(LaneBelt& b);

/// v += dv, x += h v.
void lane_advance(LaneBelt& b);

/// Loads that a pulley receives from the nodes it carries in a lane.
struct LaneLoads {
  LaneNumber x, y, moment;  ///< N, N m
};
/// Contact forces as the step really applied them, with their implicit parts; adds what the pulleys receive to `loads`,
/// by pulley and then for none. Sums go on from block to block in each lane by itself, so that they do not depend on
/// where mates end their blocks.
void lane_reactions(LaneBelt& b, LaneLoads* loads);

}  // namespace beltlife
