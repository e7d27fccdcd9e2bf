// Owns what every kernel is handed, the list of kernels that a drive needs, and how loops are compiled.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/model.h"
#include "sim/speed_profile.h"
#include "sim/state.h"

// Loops over nodes are compiled for several instruction sets and chosen at run time. Contraction to fused
// multiply-adds is off and no sum changes its order, so the bits are the same on all of them. Sanitizers intercept
// start-up before the choice is made, so they get the plain version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BELTLIFE_VECTOR __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BELTLIFE_VECTOR
#endif

namespace beltlife {

/// How far history (friction anchors) moves in one pass: by old_weight x rate of the previous pass + new_weight x
/// rate of this pass; it is kept only if `commit`.
struct Pass {
  double time = 0;                        ///< s
  double old_weight = 0, new_weight = 0;  ///< s
  bool commit = false;
};

/// One force evaluation at coordinates q. Anchors in `state` change only in a committing pass.
struct Evaluation {
  const Model& model;
  const SpeedProfile& profile;
  Coordinates& q;  ///< not changed but for ghosts
  State& state;
  Work& work;
  Pass pass;
};

struct Kernel {
  const char* name;
  void (*apply)(Evaluation&);
};

/// The kernels that this drive needs, in order. A feature that the drive does not have is not in the list.
std::vector<Kernel> force_program(const Model& model);

Work make_work(const Model& model);

// Belt: truss elements (thesis 2.28) and three-node bending elements (thesis 2.29).
void belt_ghosts(Evaluation& e);
void belt_axial(Evaluation& e);
void belt_axial_turning(Evaluation& e);  ///< belt_axial and the elements' turn rates
void belt_bending_damping(Evaluation& e);
void belt_bending(Evaluation& e);  ///< stiffness and damping
void belt_forces(Evaluation& e);

// Contact and friction on the pulleys (thesis 2.24-2.27).
void contact(Evaluation& e);

// Bodies.
void clear_torques(Evaluation& e);
void torsional_springs(Evaluation& e);
void torsional_springs_one_way(Evaluation& e);  ///< all springs, where some are one-way
void gear_mesh(Evaluation& e);
void torque_tables(Evaluation& e);
void tensioner_arm(Evaluation& e);
void tensioner_arm_directional(Evaluation& e);  ///< damping and friction by the sense in which the arm turns
void arm_stops(Evaluation& e);                  ///< after either
void pid_driver(Evaluation& e);

/// Torque (N m, running sense) of a one-way spring twisted by `twist` beyond where its clutch engages: the spring and
/// damper's, never below 0 and 0 without twist.
inline double one_way_torque(const TorsionalSpring& s, double twist, double rate) {
  return twist > 0 ? std::max(s.stiffness * twist + s.damping * rate, 0.0) : 0.0;
}
/// Twist of a one-way spring (rad, running sense) from `from` ahead of `to`, clutch included, and its rate.
inline double one_way_twist(const TorsionalSpring& s, const Coordinates& q) {
  return s.sense * (q.angle[s.from] - q.angle[s.to]);
}
inline double one_way_rate(const TorsionalSpring& s, const Coordinates& q) {
  return s.sense * (q.speed[s.from] - q.speed[s.to]);
}

/// Elastic part of the tooth force (N) at the offset delta (m) along the line of action.
double gear_spring_force(const GearPair& g, double delta);
/// Tooth force: the elastic part and damping, never adhesive.
double gear_force(const GearPair& g, double delta, double rate);

/// Angle (rad, -pi to pi) from one unit vector to the next, of cross product `cross` and inner product `dot`. Halving
/// the angle three times leaves an arc tangent of at most 0.2, where the series to the 15th power is exact to 4e-13;
/// straight code, so that the loop vectorises, which std::atan2 does not.
[[gnu::always_inline]] inline double turn_angle(double cross, double dot) {
  const double half = cross / std::max(1 + dot, 1e-12);
  const double quarter = half / (1 + std::sqrt(1 + half * half));
  const double eighth = quarter / (1 + std::sqrt(1 + quarter * quarter));
  const double t = eighth / (1 + std::sqrt(1 + eighth * eighth)), z = t * t;
  const double series =
      1 - z * (1.0 / 3 - z * (1.0 / 5 - z * (1.0 / 7 - z * (1.0 / 9 - z * (1.0 / 11 - z * (1.0 / 13 - z / 15))))));
  return 16 * t * series;
}

/// Centre of a pulley and its velocity; the tensioner pulley's moves with the arm.
struct Centre {
  double x, y, vx, vy;
};
Centre pulley_centre(const Model& model, const Coordinates& q, int pulley);

/// Sum of p[0 .. n) in eight interleaved partial sums: a fixed order that vectorises.
double sum(const double* p, int n);

}  // namespace beltlife
