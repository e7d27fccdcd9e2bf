// Rotation of pulleys, bodies and arm in the implicit scheme: see implicit_train.h.
#include "sim/lanes/implicit_train.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/kernels/kernel.h"

namespace beltlife {
namespace {

constexpr double longest_substep = 5e-6;  // s: teeth that strike are resolved

}  // namespace

ImplicitTrain::ImplicitTrain(const Model& m, const SpeedProfile& profile, double step)
    : model_(m),
      profile_(profile),
      step_(step),
      substeps_(std::max(1, static_cast<int>(std::ceil(step / longest_substep - 1e-9)))),
      change_(m.bodies, 0.0),
      torque_(m.bodies, 0.0),
      rhs_(m.bodies, 0.0),
      solved_(m.bodies, 0.0) {
  substep_ = step / substeps_;
  std::vector<int> group(m.bodies);
  std::iota(group.begin(), group.end(), 0);
  const auto join = [&](int a, int b) {
    const int from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
    std::replace(group.begin(), group.end(), from, to);
  };
  for (const auto& s : m.springs) join(s.from, s.to);
  for (const auto& g : m.gears) join(g.pinion, g.gear);
  for (int id = 0; id < m.bodies; ++id) {
    BodyGroup g;
    for (int b = 0; b < m.bodies; ++b)
      if (group[b] == id) g.bodies.push_back(b);
    if (g.bodies.empty()) continue;
    for (int i = 0; i < static_cast<int>(m.springs.size()); ++i)
      if (group[m.springs[i].from] == id) g.springs.push_back(i);
    for (int i = 0; i < static_cast<int>(m.gears.size()); ++i)
      if (group[m.gears[i].pinion] == id) g.gears.push_back(i);
    for (int i = 0; i < static_cast<int>(m.torques.size()); ++i)
      if (group[m.torques[i].body] == id) g.tables.push_back(i);
    g.pid = m.driver.body >= 0 && !m.prescribed() && group[m.driver.body] == id;
    groups_.push_back(std::move(g));
  }
  for (const auto& s : m.springs) {
    const double rate = s.damping * (m.inverse_inertia[s.from] + m.inverse_inertia[s.to]);
    damping_share_.push_back(rate * substep_ > 1 ? 1.0 : 0.5);
  }
}

void ImplicitTrain::factor(BodyGroup& g) const {
  const Model& m = model_;
  const int n = static_cast<int>(g.bodies.size());
  const auto at = [&](int body) {
    return static_cast<int>(std::find(g.bodies.begin(), g.bodies.end(), body) - g.bodies.begin());
  };
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) a(i, i) = m.inertia[g.bodies[i]];
  const double quarter = 0.25 * substep_ * substep_, half = 0.5 * substep_;
  const auto couple = [&](int one, double r1, int two, double r2, double tangent) {
    a(one, one) += r1 * r1 * tangent;
    a(two, two) += r2 * r2 * tangent;
    a(one, two) -= r1 * r2 * tangent;
    a(two, one) -= r1 * r2 * tangent;
  };
  std::size_t at_spring = 0;
  for (int i : g.springs) {
    const TorsionalSpring& s = m.springs[i];
    const bool carries = !s.one_way || ((g.status >> (g.gears.size() + at_spring)) & 1);
    ++at_spring;
    if (carries) couple(at(s.from), 1, at(s.to), 1, quarter * s.stiffness + damping_share_[i] * substep_ * s.damping);
  }
  for (std::size_t i = 0; i < g.gears.size(); ++i) {
    const GearPair& p = m.gears[g.gears[i]];
    if ((g.status >> i) & 1)
      couple(at(p.pinion), p.pinion_radius, at(p.gear), p.gear_radius, quarter * p.stiffness + half * p.damping);
  }
  if (g.pid) a(at(m.driver.body), at(m.driver.body)) += quarter * m.driver.angle_gain + half * m.driver.speed_gain;
  // A body of given speed keeps its row of the coupling for the others' right-hand sides; see advance_group.
  for (int i = 0; i < n; ++i)
    if (m.inverse_inertia[g.bodies[i]] == 0) {
      a.row(i).setZero();
      a(i, i) = 1;
    }
  const Eigen::MatrixXd inverse = a.inverse();
  g.inverse.resize(static_cast<std::size_t>(n) * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) g.inverse[static_cast<std::size_t>(i) * n + j] = inverse(i, j);
}

void ImplicitTrain::advance_group(BodyGroup& g, State& state, double time, const double* belt_torque) {
  const Model& m = model_;
  Coordinates& q = state.q;
  const int n = static_cast<int>(g.bodies.size());
  const double s = substep_;
  double *change = solved_.data(), *rhs = rhs_.data();
  for (int sub = 0; sub < substeps_; ++sub) {
    for (int b : g.bodies) torque_[b] = b < m.pulleys ? belt_torque[b] : 0.0;
    std::uint64_t status = 0;
    for (std::size_t at = 0; at < g.springs.size(); ++at) {
      const TorsionalSpring& k = m.springs[g.springs[at]];
      double t = 0;
      if (k.one_way) {
        const double rate = one_way_rate(k, q), twist = one_way_twist(k, q) + 0.5 * s * rate;
        t = k.sense * one_way_torque(k, twist - std::min(state.free_wheel[g.springs[at]], twist), rate);
        if (t != 0) status |= std::uint64_t{1} << (g.gears.size() + at);
      } else {
        const double rate = q.speed[k.from] - q.speed[k.to];
        t = k.stiffness * (q.angle[k.from] - q.angle[k.to] + 0.5 * s * rate) + k.damping * rate;
      }
      torque_[k.from] -= t;
      torque_[k.to] += t;
    }
    for (std::size_t i = 0; i < g.gears.size(); ++i) {
      const GearPair& p = m.gears[g.gears[i]];
      const double rate = p.pinion_radius * q.speed[p.pinion] - p.gear_radius * q.speed[p.gear];
      const double delta = p.pinion_radius * q.angle[p.pinion] - p.gear_radius * q.angle[p.gear] + 0.5 * s * rate;
      const double f = gear_force(p, delta, rate);
      if (f != 0) status |= std::uint64_t{1} << i;
      torque_[p.pinion] -= p.pinion_radius * f;
      torque_[p.gear] += p.gear_radius * f;
    }
    for (int i : g.tables) {
      const TorqueTable& t = m.torques[i];
      const double sense = m.sense[t.body];
      torque_[t.body] += sense * t.factor * t.torque(sense * q.speed[t.body]);
    }
    const double at = time + (sub - 0.5 * substeps_ + 0.5) * s;
    if (g.pid) {
      const DriverModel& d = m.driver;
      const double wanted = m.sense[d.body] * profile_.speed(at);
      torque_[d.body] += d.speed_gain * (wanted - q.speed[d.body]) +
                         d.angle_gain * (q.reference_angle - q.angle[d.body] + 0.5 * s * (wanted - q.speed[d.body]));
      q.reference_angle += s * wanted;
    }
    if (g.inverse.empty() || status != g.status) {
      g.status = status;
      factor(g);
    }
    for (int i = 0; i < n; ++i) {
      const int b = g.bodies[i];
      if (m.inverse_inertia[b] != 0)
        rhs[i] = s * torque_[b];
      else
        rhs[i] = b == m.driver.body && m.prescribed() ? (given_ - q.speed[b]) / (substeps_ - sub) : 0.0;
    }
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += g.inverse[static_cast<std::size_t>(i) * n + j] * rhs[j];
      change[i] = sum;
    }
    for (int i = 0; i < n; ++i) {
      const int b = g.bodies[i];
      q.angle[b] += s * (q.speed[b] + 0.5 * change[i]);
      q.speed[b] += change[i];
    }
    for (int i : g.springs)
      if (m.springs[i].one_way) state.free_wheel[i] = std::min(state.free_wheel[i], one_way_twist(m.springs[i], q));
  }
}

// A pulley on its own has the belt's torque alone, which holds over the step: substeps would change nothing.
void ImplicitTrain::advance_free(int b, Coordinates& q, const double* belt_torque) {
  double change = 0;
  if (model_.inverse_inertia[b] != 0)
    change = step_ * (b < model_.pulleys ? belt_torque[b] : 0.0) * model_.inverse_inertia[b];
  else if (b == model_.driver.body && model_.prescribed())
    change = given_ - q.speed[b];
  q.angle[b] += step_ * (q.speed[b] + 0.5 * change);
  q.speed[b] += change;
}

void ImplicitTrain::advance_arm(State& state, const double* hub_x, const double* hub_y) {
  const TensionerModel& t = model_.tensioner;
  Coordinates& q = state.q;
  const double h = step_;
  const double cos = std::cos(q.arm_angle), sin = std::sin(q.arm_angle);
  const double rx = cos * t.arm_x - sin * t.arm_y, ry = sin * t.arm_x + cos * t.arm_y;
  double torque = rx * hub_y[t.pulley] - ry * hub_x[t.pulley];
  const double damping = t.directional ? t.damping_at(q.arm_rate) : t.damping;
  const double low = t.directional ? -t.friction_against(-1) : -t.friction_torque;
  const double high = t.directional ? t.friction_against(1) : t.friction_torque;
  torque += t.spring_torque - t.spring_rate * q.arm_angle - damping * q.arm_rate;
  const double trial = t.friction_stiffness * (state.arm_anchor + h * q.arm_rate);
  const double friction = std::clamp(trial, low, high), stop = t.stops.torque(q.arm_angle, q.arm_rate);
  state.arm_anchor = friction / t.friction_stiffness;
  const double stiffness =
      t.spring_rate + (friction == trial ? t.friction_stiffness : 0.0) + (stop != 0 ? t.stops.stiffness : 0.0);
  const double damped = damping + (stop != 0 ? t.stops.damping : 0.0);
  q.arm_rate += h * (torque - friction + stop) / (t.inertia + 0.5 * h * damped + 0.25 * h * h * stiffness);
  q.arm_angle += h * q.arm_rate;
}

void ImplicitTrain::expect(const State& state, double time) {
  if (!model_.prescribed()) return;
  const int b = model_.driver.body;
  given_ = model_.sense[b] * profile_.speed(time + 0.5 * step_);
  change_[b] = given_ - state.q.speed[b];
}

void ImplicitTrain::advance(State& state, double time, const double* belt_torque, const double* hub_x,
                            const double* hub_y) {
  Coordinates& q = state.q;
  for (int b = 0; b < model_.bodies; ++b) change_[b] = -q.speed[b];
  for (BodyGroup& g : groups_) {
    if (g.free())
      advance_free(g.bodies.front(), q, belt_torque);
    else
      advance_group(g, state, time, belt_torque);
  }
  for (int b = 0; b < model_.bodies; ++b) change_[b] += q.speed[b];
  if (model_.tensioner.pulley >= 0 && !model_.tensioner.locked) advance_arm(state, hub_x, hub_y);
}

}  // namespace beltlife
