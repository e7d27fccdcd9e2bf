// Owns what every kernel is handed, the list of kernels that a drive needs, and how loops are compiled.
#pragma once

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
void gear_mesh(Evaluation& e);
void torque_tables(Evaluation& e);
void tensioner_arm(Evaluation& e);
void pid_driver(Evaluation& e);

/// Centre of a pulley and its velocity; the tensioner pulley's moves with the arm.
struct Centre {
  double x, y, vx, vy;
};
Centre pulley_centre(const Model& model, const Coordinates& q, int pulley);

/// Sum of p[0 .. n) in eight interleaved partial sums: a fixed order that vectorises.
double sum(const double* p, int n);

}  // namespace beltlife
