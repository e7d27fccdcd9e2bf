// Owns what changes in time: State, restartable bit for bit, and Work, scratch that a restart need not keep.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/node_array.h"

namespace beltlife {

/// Positions and velocities of everything that moves, SI units, counterclockwise positive.
struct Coordinates {
  NodeArray x, y;                      ///< belt nodes, m
  NodeArray vx, vy;                    ///< m/s
  std::vector<double> angle, speed;    ///< bodies, rad, rad/s
  double arm_angle = 0, arm_rate = 0;  ///< tensioner arm from where the scene places it, rad, rad/s
  double reference_angle = 0;          ///< what a PID driver follows, rad

  bool operator==(const Coordinates&) const = default;
};

/// A run of neighbouring nodes that are near one pulley and may touch it.
struct ContactSegment {
  int pulley = 0;
  int begin = 0, end = 0;  ///< nodes [begin, end), never across the end of the arrays
  bool operator==(const ContactSegment&) const = default;
};

struct State {
  std::int64_t step = 0;
  Coordinates q;
  NodeArray anchor;                      ///< friction anchors: tangential offset delta of each node, m
  std::vector<double> free_wheel;        ///< by spring, if some are one-way: twist at which the clutch engages, rad
  double arm_anchor = 0;                 ///< twist of the tensioner's dry-friction anchor spring, rad
  std::vector<int> near;                 ///< pulley that a node may touch, -1 on a span
  std::vector<ContactSegment> segments;  ///< the same, as runs of nodes
  std::int64_t refresh_step = 0;         ///< step at which `near` is next determined

  bool operator==(const State&) const = default;
};

/// What one force evaluation computes. Forces of the bodies are reset, belt forces overwritten, each time.
struct Work {
  NodeArray gx, gy;          ///< force transmitted by element i (node i to i + 1), N
  NodeArray ux, uy;          ///< unit vector of element i
  NodeArray inverse_length;  ///< of element i, 1/m
  NodeArray tension;         ///< of element i, N
  NodeArray stretch_rate;    ///< dl/dt of element i, m/s
  NodeArray turn_rate;       ///< angular velocity of element i, rad/s (drives with bending only)
  NodeArray moment;          ///< bending moment at node i, N m (drives with bending only)
  NodeArray fx, fy;          ///< total force on node i, N

  NodeArray normal, tangential;            ///< contact forces on node i, N; tangential counterclockwise positive
  NodeArray slip;                          ///< tangential velocity relative to the pulley surface, m/s
  NodeArray normal_peak, tangential_peak;  ///< largest since last observed (linearly implicit scheme only)
  NodeArray contact_x, contact_y, contact_moment;  ///< contact force and its moment about the pulley centre

  std::vector<double> torque;         ///< on bodies, N m
  std::vector<double> belt_torque;    ///< of it, from the belt (pulleys), N m
  std::vector<double> hub_x, hub_y;   ///< belt force on each pulley, N
  std::vector<double> spring_torque;  ///< transmitted from `from` to `to`, counterclockwise, N m
  std::vector<double> gear_force;     ///< along the line of action, N
  double arm_torque = 0;              ///< on the tensioner arm, N m
  double arm_friction = 0;            ///< of it, from dry friction, N m
  double arm_stop_torque = 0;         ///< of it, from the arm's stops, N m
  double arm_slip = 0;                ///< arm rate of the previous pass, rad/s
  double driver_torque = 0;           ///< of a PID driver, N m
};

}  // namespace beltlife
