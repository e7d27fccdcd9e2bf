// Owns the balance of a belt in steady running: torques, length and arm, from a guess of tensions to their solution.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/model.h"
#include "sim/statics/layer.h"
#include "sim/statics/trains.h"

namespace beltlife {

/// Pulleys and spans in the order in which the belt runs: pulley k is pulley[k] of the scene, the span behind it, to
/// pulley k + 1, is span[k].
struct RunningOrder {
  explicit RunningOrder(const Model& model);
  std::vector<int> pulley, span;
  double direction = 1;  ///< of the running order against the scene's
};

/// Everything at one guess of tensions and arm angle, in running order.
struct BalancePoint {
  double rate = 0;  ///< m/s of unstretched belt
  std::vector<Circle> circles;
  std::vector<Vec2> direction;                    ///< of span k
  std::vector<double> span_length, wrap, radius;  ///< radius of the nodes' circle
  std::vector<double> arm_in, arm_out;            ///< of the spans' lines about the pulley, m
  std::vector<double> taut_in, taut_out;          ///< T - m'v^2 before and behind the pulley, N
  std::vector<double> speed, torque;              ///< rad/s; N m of the belt on the pulley
  std::vector<double> layer_in, layer_out;        ///< (CI v/T')^(1/3), m
  bool closed = true;
};

/// README.md has the equations. Guesses and solutions are the tensions of the spans in running order, N, and behind
/// them the angle of an arm that turns, rad.
class Balance {
 public:
  /// Model and trains are kept by reference; `trains` has no error.
  Balance(const Model& model, const Trains& trains);

  bool free_arm() const { return free_arm_; }
  const RunningOrder& order() const { return order_; }
  int driver() const { return driver_; }  ///< in running order
  const std::vector<PassLayer>& layers() const { return layers_; }

  double friction = 0;         ///< N m on the arm, counterclockwise
  std::optional<double> stop;  ///< rad, angle of the stop on which the arm rests; without, both are as if absent

  /// From the balance at rest, in one step or, where that fails, by raising the load. False: no solution was found.
  bool solve_from_rest(Eigen::VectorXd& x);
  /// From a solution nearby.
  bool solve_from(const Eigen::VectorXd& start, Eigen::VectorXd& x);

  double arm_angle(const Eigen::VectorXd& x) const { return free_arm_ ? x[m_.pulleys] : m_.statics.balance.arm_angle; }
  BalancePoint at(const Eigen::VectorXd& x) const;
  Vec2 hub(const BalancePoint& p, int k) const;  ///< N, force of the belt on pulley k

 private:
  int unknowns() const { return m_.pulleys + (free_arm_ ? 1 : 0); }
  Eigen::VectorXd residual(const Eigen::VectorXd& x) const;
  double arm_torque(const Eigen::VectorXd& x, const BalancePoint& p) const;
  void update_layers(const BalancePoint& p);
  bool newton(Eigen::VectorXd& x) const;
  bool solve(Eigen::VectorXd& x);
  template <class Attempt>
  bool solve_between_stops(Eigen::VectorXd& x, Attempt attempt);

  double momentum(double rate, double strain) const { return m_.scene.belt.mass_kg_per_m * rate * rate * (1 + strain); }
  double sink(double taut, double radius) const;
  double layer_of(double taut, double rate) const;

  const Model& m_;
  const Trains& trains_;
  RunningOrder order_;
  std::vector<PassLayer> layers_;
  double load_ = 1;  // share of the torques and of the bending damping, for continuation
  int driver_ = 0;
  double width_ = 0;
  bool free_arm_ = false;
};

}  // namespace beltlife
