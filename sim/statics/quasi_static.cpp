// Quasi-static solution: see quasi_static.h, and README.md for the equations.
#include "sim/statics/quasi_static.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/statics/balance.h"

namespace beltlife {
namespace {

// Why numbers that balance are no running drive, in words.
std::optional<std::string> refusal(const Model& m, const Balance& balance, const Eigen::VectorXd& x,
                                   const BalancePoint& p) {
  const RunningOrder& order = balance.order();
  for (int k = 0; k < m.pulleys; ++k)
    if (p.taut_out[k] <= 0)
      return fmt::format("the span {} would be slack: {:.0f} N, of which the belt's speed takes {:.0f} N",
                         span_name(m.scene, static_cast<std::size_t>(order.span[k])), x[k], x[k] - p.taut_out[k]);
  for (int k = 0; k < m.pulleys; ++k)
    if (!balance.layers()[k].converged)
      return "how the belt bends onto pulley " + m.body_name[order.pulley[k]] + " was not solved";
  return {};
}

void take_arm(const Model& m, const Balance& balance, const Eigen::VectorXd& x, QuasiStaticRange& out) {
  if (m.tensioner.pulley >= 0) out.arm_angle = out.arm_angle_low = out.arm_angle_high = balance.arm_angle(x);
  if (!balance.stop) return;
  out.arm_stop = m.tensioner.stops.at(*out.arm_angle, m.tensioner.lengthening);
  out.remarks.push_back(
      fmt::format("the arm rests on its {} stop", out.arm_stop == ArmStop::lengthening ? "lengthening" : "shortening"));
}

// Speed, torque and hub load of pulley k, and whether the belt holds there.
void take_load(const Model& m, const Balance& balance, const BalancePoint& p, int k, QuasiStaticRange& out) {
  const int i = balance.order().pulley[k];
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
}

void take_released(const Model& m, const Trains& trains, int pulley, double speed, QuasiStaticRange& out) {
  if (!m.has_one_way()) return;
  for (int s : trains.released(m, pulley, speed)) {
    out.released.push_back(m.scene.torsional_spring[s].name);
    out.remarks.push_back(fmt::format("the one-way spring {} is released: {} runs ahead of {}", out.released.back(),
                                      m.body_name[m.springs[s].to], m.body_name[m.springs[s].from]));
  }
}

void take_losses(const Model& m, const Balance& balance, const Eigen::VectorXd& x, const BalancePoint& p, int k,
                 QuasiStaticRange& out) {
  const double ea = m.belt.axial_stiffness, mass = m.scene.belt.mass_kg_per_m;
  const int before = (k + m.pulleys - 1) % m.pulleys;
  QuasiStaticPulley& pulley = out.pulleys[balance.order().pulley[k]];
  // Power that the belt carries past a point: tension, its stretch, its motion.
  const auto carried = [&](double t) {
    return p.rate * (t + 0.5 * t * t / ea - 0.5 * mass * std::pow(p.rate * (1 + t / ea), 2));
  };
  const double lost = carried(x[k]) - carried(x[before]) - p.torque[k] * p.speed[k];
  const double big = p.circles[k].radius, half = 0.5 * m.belt.bending_damping * p.rate * p.rate / (big * big);
  if (m.belt.bending_damping > 0) {
    pulley.rigid_loss = half * (1 / p.layer_in[k] + 1 / p.layer_out[k]);
    // The lines of the spans beside the radius on which the belt rolls.
    const double rate = p.rate * (1 + x[before] / ea), r = p.speed[k] > 0 ? rate / p.speed[k] : p.radius[k];
    pulley.bending_loss = rate / r * (p.taut_in[k] * (p.arm_in[k] - r) - p.taut_out[k] * (p.arm_out[k] - r));
  }
  pulley.creep_loss = lost - pulley.bending_loss;
  out.loss += pulley.bending_loss + pulley.creep_loss;
}

void take_powers(const Model& m, const Trains& trains, const Balance& balance, const BalancePoint& p,
                 QuasiStaticRange& out) {
  out.driver_power = -p.torque[balance.driver()] * p.speed[balance.driver()];
  for (int k = 0; k < m.pulleys; ++k) {
    if (k == balance.driver()) continue;
    out.table_power -= p.torque[k] * p.speed[k];
  }
  // What acts on the driver's own train never passes the belt.
  const double own = trains.load_on(m, trains.driver_pulley, p.speed[balance.driver()]) * p.speed[balance.driver()];
  out.table_power -= own;
  out.driver_power += own;
}

void widen_band(const Balance& balance, const Eigen::VectorXd& y, const BalancePoint& q, QuasiStaticRange& out) {
  const RunningOrder& order = balance.order();
  const int n = static_cast<int>(out.spans.size());
  out.arm_angle_low = std::min(*out.arm_angle_low, y[n]);
  out.arm_angle_high = std::max(*out.arm_angle_high, y[n]);
  for (int k = 0; k < n; ++k) {
    QuasiStaticSpan& span = out.spans[order.span[k]];
    span.tension_low = std::min(span.tension_low, y[k]);
    span.tension_high = std::max(span.tension_high, y[k]);
    QuasiStaticPulley& pulley = out.pulleys[order.pulley[k]];
    const Vec2 hub = balance.hub(q, k);
    pulley.hub_load_low = std::min(pulley.hub_load_low, std::hypot(hub.x, hub.y));
    pulley.hub_load_high = std::max(pulley.hub_load_high, std::hypot(hub.x, hub.y));
  }
}

// Friction turns the arm against the sense in which it would move: from the solution without it, to either side.
void take_friction_band(const Model& m, Balance& balance, const Eigen::VectorXd& x, QuasiStaticRange& out) {
  if (!balance.free_arm() || std::max(m.tensioner.friction_against(-1), m.tensioner.friction_against(1)) <= 0) return;
  const std::optional<double> resting_stop = balance.stop;
  for (double sign : {-1.0, 1.0}) {
    balance.friction = sign * m.tensioner.friction_against(-sign);
    balance.stop = resting_stop;
    Eigen::VectorXd y;
    const bool solved = balance.solve_from(x, y);
    const BalancePoint q = solved ? balance.at(y) : BalancePoint{};
    if (solved && *std::min_element(q.taut_out.begin(), q.taut_out.end()) > 0) {
      widen_band(balance, y, q, out);
      continue;
    }
    out.band_incomplete = true;
    out.remarks.push_back(
        fmt::format("at the friction limit where the arm's friction {} the belt path {}: the band leaves it out",
                    sign * m.tensioner.lengthening > 0 ? "lengthens" : "shortens",
                    solved ? "a span would be slack" : "no balance was found"));
  }
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

  Balance balance(m, trains);
  Eigen::VectorXd x;
  if (!balance.solve_from_rest(x)) {
    out.error = "no balance of torques, belt length and tensioner was found";
    return out;
  }
  const BalancePoint p = balance.at(x);
  out.error = refusal(m, balance, x, p);
  if (out.error) return out;
  out.belt_speed = p.rate;
  out.centrifugal = m.scene.belt.mass_kg_per_m * p.rate * p.rate;
  take_arm(m, balance, x, out);
  out.spans.resize(m.pulleys);
  out.pulleys.resize(m.pulleys);
  for (int k = 0; k < m.pulleys; ++k) {
    const int at = balance.order().span[k];
    QuasiStaticSpan& span = out.spans[at];
    span.name = span_name(m.scene, static_cast<std::size_t>(at));
    span.tension = span.tension_low = span.tension_high = x[k];
    take_load(m, balance, p, k, out);
    take_released(m, trains, balance.order().pulley[k], p.speed[k], out);
    take_losses(m, balance, x, p, k, out);
  }
  take_powers(m, trains, balance, p, out);
  take_friction_band(m, balance, x, out);
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
  const RunningOrder order(m);
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
    const double leaving = (order.direction > 0 ? after : before) - solution.centrifugal;
    const bool loaded = std::abs(solution.pulleys[i].torque) > 1e-6 * leaving * p.radius_m;
    for (double& t : p.tangential_n) t = loaded ? m.pulley_friction[i] * leaving * per_tension : 0;
  }
  return load;
}

}  // namespace beltlife
