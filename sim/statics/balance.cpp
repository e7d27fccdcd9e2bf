// From a guess to a balance: see balance.h.
#include "sim/statics/balance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {

RunningOrder::RunningOrder(const Model& m) {
  const double rotation = m.scene.rotation == Rotation::counterclockwise ? 1 : -1;
  direction = rotation * m.statics.orientation;
  const int n = m.pulleys;
  for (int k = 0; k < n; ++k) {
    pulley.push_back(direction > 0 ? k : n - 1 - k);
    span.push_back(direction > 0 ? k : (2 * n - 2 - k) % n);
  }
}

Balance::Balance(const Model& m, const Trains& trains)
    : m_(m), trains_(trains), order_(m), layers_(static_cast<std::size_t>(m.pulleys)) {
  for (int k = 0; k < m.pulleys; ++k)
    if (order_.pulley[k] == trains.driver_pulley) driver_ = k;
  width_ = m.scene.belt.ribs * m.scene.belt.rib_pitch_mm * 1e-3;
  free_arm_ = m.tensioner.pulley >= 0 && !m.tensioner.locked;
  for (auto& layer : layers_) {
    if (m.belt.bending_damping > 0) continue;
    layer.offset_in = layer.offset_out = layer.excess = 0;
  }
}

double Balance::sink(double taut, double radius) const {
  return std::max(taut, 0.0) * m_.belt.element_length / (radius * m_.contact.stiffness);
}

double Balance::layer_of(double taut, double rate) const {
  return std::cbrt(m_.belt.bending_damping * load_ * rate / std::max(taut, 1.0));
}

BalancePoint Balance::at(const Eigen::VectorXd& x) const {
  const int n = m_.pulleys;
  const BeltModel& b = m_.belt;
  BalancePoint p;
  const auto scene_circles = circles_of(m_.scene, m_.statics.orientation, arm_angle(x));
  for (int k = 0; k < n; ++k) {
    p.circles.push_back(scene_circles[order_.pulley[k]]);
    p.circles.back().turn *= order_.direction > 0 ? 1 : -1;
  }
  const auto strain = [&](int k) { return x[k] / b.axial_stiffness; };
  const auto before = [&](int k) { return (k + n - 1) % n; };
  // The driver's surface carries the belt that enters it: nodes on a circle of its own radius, a chord apart.
  const auto turn_of_node = [&](int k, double radius) {
    return 2 * std::asin(0.5 * b.element_length * (1 + strain(before(k))) / radius);
  };
  p.rate = trains_.driver_speed * p.circles[driver_].radius / (1 + strain(before(driver_)));
  for (int pass = 0; pass < 3; ++pass) {
    const double taut = x[before(driver_)] - momentum(p.rate, strain(before(driver_)));
    const double radius = p.circles[driver_].radius - sink(taut, p.circles[driver_].radius);
    p.rate = trains_.driver_speed / turn_of_node(driver_, radius) * b.element_length;
  }
  for (int k = 0; k < n; ++k) {
    const double big = p.circles[k].radius;
    p.taut_in.push_back(x[before(k)] - momentum(p.rate, strain(before(k))));
    p.taut_out.push_back(x[k] - momentum(p.rate, strain(k)));
    p.radius.push_back(big - sink(0.5 * (p.taut_in[k] + p.taut_out[k]), big));
    const double entry = big - sink(p.taut_in[k], big);
    p.speed.push_back(m_.inverse_inertia[order_.pulley[k]] == 0 && k != driver_
                          ? 0
                          : p.rate / b.element_length * turn_of_node(k, entry));
    p.layer_in.push_back(layer_of(p.taut_in[k], p.rate));
    p.layer_out.push_back(layer_of(p.taut_out[k], p.rate));
    const PassLayer& layer = layers_[k];
    // Chords of one element turn about the pulley at a mean distance less than that of their nodes.
    const double chord = 1 - std::pow(b.element_length / p.radius[k], 2) / 24;
    const bool soft = b.bending_damping > 0;
    const double in = soft ? big + layer.offset_in * p.layer_in[k] * p.layer_in[k] / big : p.radius[k];
    const double out = soft ? big + layer.offset_out * p.layer_out[k] * p.layer_out[k] / big : p.radius[k];
    p.arm_in.push_back(in * chord);
    p.arm_out.push_back(out * chord);
  }
  p.direction.resize(n);
  p.span_length.resize(n);
  for (int k = 0; k < n; ++k) {  // span k touches circle k at the leaving line, circle k + 1 at the entering one
    Circle from = p.circles[k], to = p.circles[(k + 1) % n];
    from.radius = p.arm_out[k];
    to.radius = p.arm_in[(k + 1) % n];
    Route pair;
    p.closed = make_route({from, to}, pair) || std::isfinite(pair.spans[0].length) ? p.closed : false;
    if (!p.closed) return p;
    p.direction[k] = pair.spans[0].direction;
    p.span_length[k] = pair.spans[0].length;
  }
  for (int k = 0; k < n; ++k) {
    const Vec2 in = p.direction[before(k)], out = p.direction[k];
    const double angle = p.circles[k].turn * std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
    // A layout has wraps between 0 and 2 pi; near 0 the wrap may vanish, which is no turn and a half.
    p.wrap.push_back(angle < -1 ? angle + 2 * std::numbers::pi : angle);
    p.torque.push_back(p.taut_out[k] * p.arm_out[k] - p.taut_in[k] * p.arm_in[k]);
  }
  return p;
}

Eigen::VectorXd Balance::residual(const Eigen::VectorXd& x) const {
  const int n = m_.pulleys;
  const BalancePoint p = at(x);
  Eigen::VectorXd r(unknowns());
  if (!p.closed) return Eigen::VectorXd::Constant(unknowns(), std::nan(""));
  int row = 0;
  double needed = 0;
  for (int k = 0; k < n; ++k) {
    const int before = (k + n - 1) % n, pulley = order_.pulley[k];
    const double ea = m_.belt.axial_stiffness, big = p.circles[k].radius;
    // Unstretched belt on the span behind the pulley and on its arc, chords of one element.
    const double chord = 1 - std::pow(m_.belt.element_length / p.radius[k], 2) / 24;
    const double layer = std::pow(0.5 * (p.layer_in[k] + p.layer_out[k]), 3) / (big * big) * layers_[k].excess;
    needed += p.span_length[k] / (1 + x[k] / ea) +
              (p.radius[k] * p.wrap[k] * chord + layer) / (1 + 0.5 * (x[k] + x[before]) / ea);
    if (k == driver_) continue;
    if (p.speed[k] == 0 && m_.inverse_inertia[pulley] == 0)  // a locked pulley: the belt slides over it
      r[row++] = (p.taut_out[k] - p.taut_in[k] * std::exp(m_.pulley_friction[pulley] * p.wrap[k])) / 100;
    else
      r[row++] = (p.torque[k] - load_ * trains_.load_on(m_, pulley, p.speed[k])) / (100 * big);
  }
  r[row++] = (needed - m_.belt.unstretched_length) * m_.belt.axial_stiffness / m_.belt.unstretched_length / 100;
  if (free_arm_) r[row] = arm_torque(x, p) / 10;
  return r;
}

Vec2 Balance::hub(const BalancePoint& p, int k) const {
  const Vec2 in = p.direction[(k + m_.pulleys - 1) % m_.pulleys], out = p.direction[k];
  return {p.taut_out[k] * out.x - p.taut_in[k] * in.x, p.taut_out[k] * out.y - p.taut_in[k] * in.y};
}

double Balance::arm_torque(const Eigen::VectorXd& x, const BalancePoint& p) const {
  const TensionerModel& t = m_.tensioner;
  for (int k = 0; k < m_.pulleys; ++k)
    if (order_.pulley[k] == t.pulley) {
      const Vec2 h = hub(p, k);
      return (p.circles[k].x - t.pivot_x) * h.y - (p.circles[k].y - t.pivot_y) * h.x + t.spring_torque -
             t.spring_rate * arm_angle(x) + friction - (stop ? t.stops.stiffness * (arm_angle(x) - *stop) : 0);
    }
  return 0;
}

// The layers of this guess; they change slowly and are held while the tensions are solved for.
void Balance::update_layers(const BalancePoint& p) {
  if (m_.belt.bending_damping == 0) return;
  for (int k = 0; k < m_.pulleys; ++k) {
    const double taut = 0.5 * (p.taut_in[k] + p.taut_out[k]), d = layer_of(taut, p.rate);
    const double soft = taut / (m_.scene.contact.stiffness_n_per_m3 * width_ * d * d);
    layers_[k] = pass_layer(soft, p.circles[k].radius * p.wrap[k] / d);
  }
}

bool Balance::newton(Eigen::VectorXd& x) const {
  const int n = unknowns();
  Eigen::VectorXd r = residual(x);
  for (int iteration = 0; iteration < 40; ++iteration) {
    if (!r.allFinite()) return false;
    if (r.cwiseAbs().maxCoeff() < 1e-10) return true;
    Eigen::MatrixXd jacobian(n, n);
    for (int j = 0; j < n; ++j) {
      Eigen::VectorXd y = x;
      const double h = j < n - (free_arm_ ? 1 : 0) ? 1e-3 : 1e-7;
      y[j] += h;
      jacobian.col(j) = (residual(y) - r) / h;
    }
    const Eigen::VectorXd change = jacobian.fullPivLu().solve(r);
    if (!change.allFinite()) return false;
    double share = 1;
    if (free_arm_) share = std::min(1.0, 0.1 / std::max(std::abs(change[n - 1]), 1e-30));
    Eigen::VectorXd trial, next;
    for (int half = 0; half < 12; ++half, share *= 0.5) {
      trial = x - share * change;
      next = residual(trial);
      if (next.allFinite() && next.norm() < r.norm()) break;
    }
    if (!next.allFinite() || next.norm() >= r.norm()) return r.cwiseAbs().maxCoeff() < 1e-7;
    x = trial;
    r = next;
  }
  return r.cwiseAbs().maxCoeff() < 1e-7;
}

// Tensions and layers in turn, until the tensions stay.
bool Balance::solve(Eigen::VectorXd& x) {
  for (int pass = 0; pass < 20; ++pass) {
    if (!newton(x)) return false;
    const Eigen::VectorXd before = x;
    update_layers(at(x));
    if (!newton(x)) return false;
    if ((x - before).cwiseAbs().maxCoeff() < 0.05) return true;  // newtons
  }
  return false;
}

// With the arm free, or held by one of its stops: `attempt` solves for x with that, and the first answer stands in
// which a stop pushes and no other is passed. The one on which the arm was last is tried first.
template <class Attempt>
bool Balance::solve_between_stops(Eigen::VectorXd& x, Attempt attempt) {
  const ArmStops& stops = m_.tensioner.stops;
  std::vector<std::optional<double>> cases{stop};
  if (stop) cases.push_back({});
  for (double angle : {stops.low, stops.high})
    if (std::isfinite(angle) && angle != stop) cases.push_back(angle);
  for (const auto& tried : cases) {
    stop = tried;
    if (!attempt()) continue;
    const double depth = free_arm_ ? stops.depth(arm_angle(x)) : 0;
    if (stop ? (*stop == stops.high ? depth > 0 : depth < 0) : depth == 0) return true;
  }
  return false;
}

bool Balance::solve_from_rest(Eigen::VectorXd& x) {
  const int n = m_.pulleys;
  // An arm that gives way leaves the belt the tension that its speed takes on top.
  Eigen::VectorXd rest(unknowns());
  const double speed = trains_.driver_speed * m_.pulley_radius[trains_.driver_pulley];
  for (int k = 0; k < n; ++k)
    rest[k] =
        std::max(m_.statics.balance.tension, 10.0) + (free_arm_ ? m_.scene.belt.mass_kg_per_m * speed * speed : 0);
  if (free_arm_) rest[n] = m_.statics.balance.arm_angle;
  const ArmStops& stops = m_.tensioner.stops;
  if (free_arm_ && m_.statics.balance.stop != ArmStop::none)
    stop = stops.depth(m_.statics.balance.arm_angle) > 0 ? stops.high : stops.low;
  return solve_between_stops(x, [&] {
    for (int steps : {1, 10}) {
      x = rest;
      bool good = true;
      for (int i = 1; i <= steps && good; ++i) {
        load_ = double(i) / steps;
        good = solve(x);
      }
      if (good) return true;
    }
    return false;
  });
}

bool Balance::solve_from(const Eigen::VectorXd& start, Eigen::VectorXd& x) {
  return solve_between_stops(x, [&] {
    x = start;
    return solve(x);
  });
}

}  // namespace beltlife
