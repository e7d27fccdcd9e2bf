// Owns the rotation of pulleys, bodies and tensioner arm in the implicit scheme: small linear solves with substeps.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/model.h"
#include "sim/speed_profile.h"

namespace beltlife {

/// Bodies that shafts and gears join; a pulley on its own is a group of one.
struct BodyGroup {
  std::vector<int> bodies;
  std::vector<int> springs, gears, tables;
  bool pid = false;
  std::uint64_t status = 0;     ///< which teeth touch and which clutches carry, of the factors below
  std::vector<double> inverse;  ///< of the step's matrix, row by row; empty: not yet computed

  /// A body that nothing but the belt acts on.
  bool free() const { return springs.empty() && gears.empty() && tables.empty() && !pid; }
};

/// Advances bodies from t_n - h/2 to t_n + h/2 under the belt's torques at t_n, by substeps short enough for teeth that
/// strike: (J + s/2 C + s^2/4 K) dw = s T(angle + s/2 w, w). The arm goes with the belt: angle at t_n, rate half a
/// step earlier.
class ImplicitTrain {
 public:
  ImplicitTrain(const Model& model, const SpeedProfile& profile, double step);

  /// `belt_torque`, `hub_x`, `hub_y`: by pulley, at t_n; `time` is t_n.
  void advance(State& state, double time, const double* belt_torque, const double* hub_x, const double* hub_y);

  /// Expected change of each pulley's speed over the coming step from t_n, rad/s: known for a given speed, else that of
  /// the step before.
  void expect(const State& state, double time);
  const std::vector<double>& speed_change() const { return change_; }

 private:
  void advance_group(BodyGroup& g, State& state, double time, const double* belt_torque);
  void advance_free(int body, Coordinates& q, const double* belt_torque);
  void advance_arm(State& state, const double* hub_x, const double* hub_y);
  void factor(BodyGroup& g) const;

  const Model& model_;
  const SpeedProfile& profile_;
  double step_, substep_;
  int substeps_;
  double given_ = 0;  ///< speed of the driven body at t_n + h/2, rad/s
  std::vector<BodyGroup> groups_;
  std::vector<double> change_, torque_;
  std::vector<double> rhs_, solved_;   ///< of a group, while it is solved
  std::vector<double> damping_share_;  ///< of each spring: 1/2, or 1 where its damper is faster than a substep
};

}  // namespace beltlife
