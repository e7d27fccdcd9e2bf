// Quasi-static solution: see quasi_static.h, and README.md for the equations.
#include "sim/statics/quasi_static.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/statics/layer.h"
#include "sim/statics/trains.h"

namespace beltlife {
namespace {

// Pulleys and spans in the order in which the belt runs: pulley k is pulley[k] of the scene, the span behind it, to
// pulley k + 1, is span[k].
struct Loop {
  std::vector<int> pulley, span;
  double direction = 1;  // of the running order against the scene's
};

Loop running_order(const Model& m) {
  Loop loop;
  const double rotation = m.scene.rotation == Rotation::counterclockwise ? 1 : -1;
  loop.direction = rotation * m.statics.orientation;
  const int n = m.pulleys;
  for (int k = 0; k < n; ++k) {
    loop.pulley.push_back(loop.direction > 0 ? k : n - 1 - k);
    loop.span.push_back(loop.direction > 0 ? k : (2 * n - 2 - k) % n);
  }
  return loop;
}

// Everything at one guess of tensions (running order) and arm angle.
struct Point {
  double rate = 0;                                // m/s of unstretched belt
  std::vector<Circle> circles;                    // running order
  std::vector<Vec2> direction;                    // of span k
  std::vector<double> span_length, wrap, radius;  // radius of the nodes' circle
  std::vector<double> arm_in, arm_out;            // of the spans' lines about the pulley, m
  std::vector<double> taut_in, taut_out;          // T - m'v^2 before and behind the pulley, N
  std::vector<double> speed, torque;              // rad/s; N m of the belt on the pulley
  std::vector<double> layer_in, layer_out;        // (CI v/T')^(1/3), m
  bool closed = true;
};

class Balance {
 public:
  Balance(const Model& m, double driver_speed, const Trains& trains)
      : m_(m), loop_(running_order(m)), trains_(trains), driver_speed_(driver_speed), layers_(m.pulleys) {
    for (int k = 0; k < m.pulleys; ++k)
      if (loop_.pulley[k] == trains.driver_pulley) driver_ = k;
    width_ = m.scene.belt.ribs * m.scene.belt.rib_pitch_mm * 1e-3;
    free_arm_ = m.tensioner.pulley >= 0 && !m.tensioner.locked;
    for (auto& layer : layers_) {
      if (m.belt.bending_damping > 0) continue;
      layer.offset_in = layer.offset_out = layer.excess = 0;
    }
  }

  int unknowns() const { return m_.pulleys + (free_arm_ ? 1 : 0); }
  bool free_arm() const { return free_arm_; }
  const Loop& loop() const { return loop_; }
  int driver() const { return driver_; }
  const std::vector<PassLayer>& layers() const { return layers_; }
  double friction = 0;         // N m on the arm, counterclockwise
  std::optional<double> stop;  // rad, angle of the stop on which the arm rests; without, both are as if absent
  double load = 1;             // share of the torques and of the bending damping, for continuation

  double arm_angle(const Eigen::VectorXd& x) const { return free_arm_ ? x[m_.pulleys] : m_.statics.balance.arm_angle; }

  Point at(const Eigen::VectorXd& x) const {
    const int n = m_.pulleys;
    const BeltModel& b = m_.belt;
    Point p;
    const auto scene_circles = circles_of(m_.scene, m_.statics.orientation, arm_angle(x));
    for (int k = 0; k < n; ++k) {
      p.circles.push_back(scene_circles[loop_.pulley[k]]);
      p.circles.back().turn *= loop_.direction > 0 ? 1 : -1;
    }
    const auto strain = [&](int k) { return x[k] / b.axial_stiffness; };
    const auto before = [&](int k) { return (k + n - 1) % n; };
    // The driver's surface carries the belt that enters it: nodes on a circle of its own radius, a chord apart.
    const auto turn_of_node = [&](int k, double radius) {
      return 2 * std::asin(0.5 * b.element_length * (1 + strain(before(k))) / radius);
    };
    p.rate = driver_speed_ * p.circles[driver_].radius / (1 + strain(before(driver_)));
    for (int pass = 0; pass < 3; ++pass) {
      const double taut = x[before(driver_)] - momentum(p.rate, strain(before(driver_)));
      const double radius = p.circles[driver_].radius - sink(taut, p.circles[driver_].radius);
      p.rate = driver_speed_ / turn_of_node(driver_, radius) * b.element_length;
    }
    for (int k = 0; k < n; ++k) {
      const double big = p.circles[k].radius;
      p.taut_in.push_back(x[before(k)] - momentum(p.rate, strain(before(k))));
      p.taut_out.push_back(x[k] - momentum(p.rate, strain(k)));
      p.radius.push_back(big - sink(0.5 * (p.taut_in[k] + p.taut_out[k]), big));
      const double entry = big - sink(p.taut_in[k], big);
      p.speed.push_back(m_.inverse_inertia[loop_.pulley[k]] == 0 && k != driver_
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

  Eigen::VectorXd residual(const Eigen::VectorXd& x) const {
    const int n = m_.pulleys;
    const Point p = at(x);
    Eigen::VectorXd r(unknowns());
    if (!p.closed) return Eigen::VectorXd::Constant(unknowns(), std::nan(""));
    int row = 0;
    double needed = 0;
    for (int k = 0; k < n; ++k) {
      const int before = (k + n - 1) % n, pulley = loop_.pulley[k];
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
        r[row++] = (p.torque[k] - load * trains_.load_on(m_, pulley, p.speed[k])) / (100 * big);
    }
    r[row++] = (needed - m_.belt.unstretched_length) * m_.belt.axial_stiffness / m_.belt.unstretched_length / 100;
    if (free_arm_) r[row] = arm_torque(x, p) / 10;
    return r;
  }

  Vec2 hub(const Point& p, int k) const {
    const Vec2 in = p.direction[(k + m_.pulleys - 1) % m_.pulleys], out = p.direction[k];
    return {p.taut_out[k] * out.x - p.taut_in[k] * in.x, p.taut_out[k] * out.y - p.taut_in[k] * in.y};
  }

  double arm_torque(const Eigen::VectorXd& x, const Point& p) const {
    const TensionerModel& t = m_.tensioner;
    for (int k = 0; k < m_.pulleys; ++k)
      if (loop_.pulley[k] == t.pulley) {
        const Vec2 h = hub(p, k);
        return (p.circles[k].x - t.pivot_x) * h.y - (p.circles[k].y - t.pivot_y) * h.x + t.spring_torque -
               t.spring_rate * arm_angle(x) + friction - (stop ? t.stops.stiffness * (arm_angle(x) - *stop) : 0);
      }
    return 0;
  }

  // The layers of this guess; they change slowly and are held while the tensions are solved for.
  void update_layers(const Point& p) {
    if (m_.belt.bending_damping == 0) return;
    for (int k = 0; k < m_.pulleys; ++k) {
      const double taut = 0.5 * (p.taut_in[k] + p.taut_out[k]), d = layer_of(taut, p.rate);
      const double soft = taut / (m_.scene.contact.stiffness_n_per_m3 * width_ * d * d);
      layers_[k] = pass_layer(soft, p.circles[k].radius * p.wrap[k] / d);
    }
  }

 private:
  double momentum(double rate, double strain) const { return m_.scene.belt.mass_kg_per_m * rate * rate * (1 + strain); }
  double sink(double taut, double radius) const {
    return std::max(taut, 0.0) * m_.belt.element_length / (radius * m_.contact.stiffness);
  }
  double layer_of(double taut, double rate) const {
    return std::cbrt(m_.belt.bending_damping * load * rate / std::max(taut, 1.0));
  }

  const Model& m_;
  Loop loop_;
  const Trains& trains_;
  double driver_speed_;
  std::vector<PassLayer> layers_;
  int driver_ = 0;
  double width_ = 0;
  bool free_arm_ = false;
};

bool newton(const Balance& balance, Eigen::VectorXd& x) {
  const int n = balance.unknowns();
  Eigen::VectorXd r = balance.residual(x);
  for (int iteration = 0; iteration < 40; ++iteration) {
    if (!r.allFinite()) return false;
    if (r.cwiseAbs().maxCoeff() < 1e-10) return true;
    Eigen::MatrixXd jacobian(n, n);
    for (int j = 0; j < n; ++j) {
      Eigen::VectorXd y = x;
      const double h = j < n - (balance.free_arm() ? 1 : 0) ? 1e-3 : 1e-7;
      y[j] += h;
      jacobian.col(j) = (balance.residual(y) - r) / h;
    }
    const Eigen::VectorXd change = jacobian.fullPivLu().solve(r);
    if (!change.allFinite()) return false;
    double share = 1;
    if (balance.free_arm()) share = std::min(1.0, 0.1 / std::max(std::abs(change[n - 1]), 1e-30));
    Eigen::VectorXd trial, next;
    for (int half = 0; half < 12; ++half, share *= 0.5) {
      trial = x - share * change;
      next = balance.residual(trial);
      if (next.allFinite() && next.norm() < r.norm()) break;
    }
    if (!next.allFinite() || next.norm() >= r.norm()) return r.cwiseAbs().maxCoeff() < 1e-7;
    x = trial;
    r = next;
  }
  return r.cwiseAbs().maxCoeff() < 1e-7;
}

// Tensions and layers in turn, until the tensions stay.
bool solve(Balance& balance, Eigen::VectorXd& x) {
  for (int pass = 0; pass < 20; ++pass) {
    if (!newton(balance, x)) return false;
    const Eigen::VectorXd before = x;
    balance.update_layers(balance.at(x));
    if (!newton(balance, x)) return false;
    if ((x - before).cwiseAbs().maxCoeff() < 0.05) return true;  // newtons
  }
  return false;
}

// From the static balance, in one step or, where that fails, by raising the load.
bool solve_from_rest(Balance& balance, Eigen::VectorXd& x, const Eigen::VectorXd& rest) {
  for (int steps : {1, 10}) {
    x = rest;
    bool good = true;
    for (int i = 1; i <= steps && good; ++i) {
      balance.load = double(i) / steps;
      good = solve(balance, x);
    }
    if (good) return true;
  }
  return false;
}

// With the arm free, or held by one of its stops: `attempt` solves for x with that, and the first answer stands in
// which a stop pushes and no other is passed. The one on which the arm was last is tried first.
template <class Attempt>
bool solve_between_stops(Balance& balance, const ArmStops& stops, Eigen::VectorXd& x, Attempt attempt) {
  std::vector<std::optional<double>> cases{balance.stop};
  if (balance.stop) cases.push_back({});
  for (double angle : {stops.low, stops.high})
    if (std::isfinite(angle) && angle != balance.stop) cases.push_back(angle);
  for (const auto& stop : cases) {
    balance.stop = stop;
    if (!attempt(x)) continue;
    const double depth = balance.free_arm() ? stops.depth(balance.arm_angle(x)) : 0;
    if (stop ? (*stop == stops.high ? depth > 0 : depth < 0) : depth == 0) return true;
  }
  return false;
}

}  // namespace

QuasiStaticRange solve_quasi_static(const Model& m, const RangeSpec& range) {
  require_condition(m, range.condition);
  QuasiStaticRange out;
  out.name = range.name;
  out.crank_rpm = range.crank_rpm;
  const Trains trains(m, range.crank_rpm * std::numbers::pi / 30);
  out.error = m.pulleys == 0 ? "a belt without pulleys has no spans" : trains.error;
  if (out.error) return out;

  const int n = m.pulleys;
  Balance balance(m, trains.driver_speed, trains);
  const Loop& loop = balance.loop();
  Eigen::VectorXd rest(balance.unknowns()), x;
  const double speed = trains.driver_speed * m.pulley_radius[trains.driver_pulley];
  for (int k = 0; k < n; ++k)
    rest[k] = std::max(m.statics.balance.tension, 10.0) +
              (balance.free_arm() ? m.scene.belt.mass_kg_per_m * speed * speed : 0);
  if (balance.free_arm()) rest[n] = m.statics.balance.arm_angle;
  const ArmStops& stops = m.tensioner.stops;
  if (balance.free_arm() && m.statics.balance.stop != ArmStop::none)
    balance.stop = stops.depth(m.statics.balance.arm_angle) > 0 ? stops.high : stops.low;
  if (!solve_between_stops(balance, stops, x, [&](auto& y) { return solve_from_rest(balance, y, rest); })) {
    out.error = "no balance of torques, belt length and tensioner was found";
    return out;
  }
  const Point p = balance.at(x);
  for (int k = 0; k < n; ++k)
    if (p.taut_out[k] <= 0) {
      out.error = fmt::format("the span {} would be slack: {:.0f} N, of which the belt's speed takes {:.0f} N",
                              span_name(m.scene, static_cast<std::size_t>(loop.span[k])), x[k], x[k] - p.taut_out[k]);
      return out;
    }
  for (int k = 0; k < n; ++k)
    if (!balance.layers()[k].converged) {
      out.error = "how the belt bends onto pulley " + m.body_name[loop.pulley[k]] + " was not solved";
      return out;
    }
  out.belt_speed = p.rate;
  out.centrifugal = m.scene.belt.mass_kg_per_m * p.rate * p.rate;
  if (m.tensioner.pulley >= 0) out.arm_angle = out.arm_angle_low = out.arm_angle_high = balance.arm_angle(x);
  if (balance.stop) {
    out.arm_stop = stops.at(*out.arm_angle, m.tensioner.lengthening);
    out.remarks.push_back(fmt::format("the arm rests on its {} stop",
                                      out.arm_stop == ArmStop::lengthening ? "lengthening" : "shortening"));
  }
  out.spans.resize(n);
  out.pulleys.resize(n);
  const double ea = m.belt.axial_stiffness, mass = m.scene.belt.mass_kg_per_m;
  // Power that the belt carries past a point: tension, its stretch, its motion.
  const auto carried = [&](double t) {
    return p.rate * (t + 0.5 * t * t / ea - 0.5 * mass * std::pow(p.rate * (1 + t / ea), 2));
  };
  for (int k = 0; k < n; ++k) {
    QuasiStaticSpan& span = out.spans[loop.span[k]];
    span.name = span_name(m.scene, static_cast<std::size_t>(loop.span[k]));
    span.tension = span.tension_low = span.tension_high = x[k];
    const int i = loop.pulley[k];
    QuasiStaticPulley& pulley = out.pulleys[i];
    pulley.name = m.body_name[i];
    pulley.speed = p.speed[k];
    pulley.torque = p.torque[k];
    pulley.wrap = p.wrap[k];
    const Vec2 hub = balance.hub(p, k);
    pulley.hub_x = hub.x;
    pulley.hub_y = hub.y;
    pulley.hub_load = pulley.hub_load_low = pulley.hub_load_high = std::hypot(hub.x, hub.y);
    const double ratio = std::abs(std::log(p.taut_out[k] * p.arm_out[k] / (p.taut_in[k] * p.arm_in[k])));
    if (ratio > 1e-6) pulley.slip_safety = m.pulley_friction[i] * p.wrap[k] / ratio;
    pulley.slips = pulley.slip_safety && *pulley.slip_safety < 1 && p.speed[k] > 0;
    if (pulley.slips)
      out.remarks.push_back(fmt::format(
          "the belt would slip on pulley {}: friction x wrap is {:.0f} % of what the torque takes; the tensions are "
          "those of a belt that holds",
          pulley.name, 100 * *pulley.slip_safety));
    if (m.has_one_way())
      for (int s : trains.released(m, i, p.speed[k])) {
        out.released.push_back(m.scene.torsional_spring[s].name);
        out.remarks.push_back(fmt::format("the one-way spring {} is released: {} runs ahead of {}", out.released.back(),
                                          m.body_name[m.springs[s].to], m.body_name[m.springs[s].from]));
      }
    const double lost = carried(x[k]) - carried(x[(k + n - 1) % n]) - p.torque[k] * p.speed[k];
    const double big = p.circles[k].radius, half = 0.5 * m.belt.bending_damping * p.rate * p.rate / (big * big);
    if (m.belt.bending_damping > 0) {
      pulley.rigid_loss = half * (1 / p.layer_in[k] + 1 / p.layer_out[k]);
      // The lines of the spans beside the radius on which the belt rolls.
      const double rate = p.rate * (1 + x[(k + n - 1) % n] / ea), r = p.speed[k] > 0 ? rate / p.speed[k] : p.radius[k];
      pulley.bending_loss = rate / r * (p.taut_in[k] * (p.arm_in[k] - r) - p.taut_out[k] * (p.arm_out[k] - r));
    }
    pulley.creep_loss = lost - pulley.bending_loss;
    out.loss += pulley.bending_loss + pulley.creep_loss;
  }
  out.driver_power = -p.torque[balance.driver()] * p.speed[balance.driver()];
  for (int k = 0; k < n; ++k) {
    if (k == balance.driver()) continue;
    out.table_power -= p.torque[k] * p.speed[k];
  }
  // What acts on the driver's own train never passes the belt.
  const double own = trains.load_on(m, trains.driver_pulley, p.speed[balance.driver()]) * p.speed[balance.driver()];
  out.table_power -= own;
  out.driver_power += own;

  // Friction turns the arm against the sense in which it would move.
  const std::optional<double> resting_stop = balance.stop;
  if (balance.free_arm() && std::max(m.tensioner.friction_against(-1), m.tensioner.friction_against(1)) > 0)
    for (double sign : {-1.0, 1.0}) {
      balance.friction = sign * m.tensioner.friction_against(-sign);
      balance.stop = resting_stop;
      Eigen::VectorXd y;
      const auto from_middle = [&](auto& z) {
        z = x;
        return solve(balance, z);
      };
      const bool solved = solve_between_stops(balance, stops, y, from_middle);
      const Point q = solved ? balance.at(y) : Point{};
      if (!solved || *std::min_element(q.taut_out.begin(), q.taut_out.end()) <= 0) {
        out.band_incomplete = true;
        out.remarks.push_back(
            fmt::format("at the friction limit where the arm's friction {} the belt path {}: the band leaves it out",
                        sign * m.tensioner.lengthening > 0 ? "lengthens" : "shortens",
                        solved ? "a span would be slack" : "no balance was found"));
        continue;
      }
      out.arm_angle_low = std::min(*out.arm_angle_low, y[n]);
      out.arm_angle_high = std::max(*out.arm_angle_high, y[n]);
      for (int k = 0; k < n; ++k) {
        QuasiStaticSpan& span = out.spans[loop.span[k]];
        span.tension_low = std::min(span.tension_low, y[k]);
        span.tension_high = std::max(span.tension_high, y[k]);
        QuasiStaticPulley& pulley = out.pulleys[loop.pulley[k]];
        const Vec2 hub = balance.hub(q, k);
        pulley.hub_load_low = std::min(pulley.hub_load_low, std::hypot(hub.x, hub.y));
        pulley.hub_load_high = std::max(pulley.hub_load_high, std::hypot(hub.x, hub.y));
      }
    }
  return out;
}

RangeLoad estimated_load(const Model& m, const RangeSpec& range, const QuasiStaticRange& solution) {
  require_condition(m, range.condition);
  RangeLoad load;
  load.name = range.name;
  load.duty_share = range.duty_share;
  load.unstretched_length_m = m.belt.unstretched_length;
  load.element_length_m = m.belt.element_length;
  load.axial_stiffness_n = m.belt.axial_stiffness;
  load.ribs = m.scene.belt.ribs;
  const bool driven = m.driver.body >= 0 && m.driver.body < m.pulleys;
  const int reference = driven ? m.driver.body : 0;
  load.driver_radius_m = m.pulley_radius[reference];
  load.driver_rpm = (driven ? range.crank_rpm : solution.pulleys[reference].speed * 30 / std::numbers::pi);
  load.belt_speed_m_s = load.driver_radius_m * load.driver_rpm * std::numbers::pi / 30;
  const Loop loop = running_order(m);
  for (int i = 0; i < m.pulleys; ++i) {
    const double after = solution.spans[i].tension, before = solution.spans[(i + m.pulleys - 1) % m.pulleys].tension;
    PulleyLoad& p = load.pulleys.emplace_back();
    p.name = m.body_name[i];
    p.side = m.scene.pulley[i].side;
    p.radius_m = m.pulley_radius[i];
    p.tension_high_n = std::max(after, before);
    p.tension_low_n = std::min(after, before);
    p.passes = 1;
    const double per_tension = m.belt.element_length / p.radius_m;
    const double normal = (p.tension_high_n - solution.centrifugal) * per_tension;
    p.normal_n[static_cast<int>(PassForce::sampled)] = sampled_peak_factor * normal;
    p.normal_n[static_cast<int>(PassForce::resolved)] = resolved_peak_factor * normal;
    p.normal_n[static_cast<int>(PassForce::percentile_99)] = resolved_peak_factor * normal;
    // A pulley that takes or gives torque is at its friction limit where the belt leaves it; an idler hardly slides.
    const double leaving = (loop.direction > 0 ? after : before) - solution.centrifugal;
    const bool loaded = std::abs(solution.pulleys[i].torque) > 1e-6 * leaving * p.radius_m;
    for (double& t : p.tangential_n) t = loaded ? m.pulley_friction[i] * leaving * per_tension : 0;
  }
  return load;
}

}  // namespace beltlife
