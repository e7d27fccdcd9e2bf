// Steady running without losses: see loop_estimate.h.
#include "sim/modes/loop_estimate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace beltlife {
namespace {

// Bodies joined by torsional springs and gears, one number a train; `without` leaves one gear pair out.
std::vector<int> trains(const Model& m, std::size_t without) {
  std::vector<int> train(m.bodies);
  std::iota(train.begin(), train.end(), 0);
  const auto join = [&](int a, int b) {
    const int from = train[a], to = train[b];
    std::replace(train.begin(), train.end(), from, to);
  };
  for (const TorsionalSpring& s : m.springs) join(s.from, s.to);
  for (std::size_t g = 0; g < m.gears.size(); ++g)
    if (g != without) join(m.gears[g].pinion, m.gears[g].gear);
  return train;
}

// Force at the belt to which the torque on each body amounts, positive onward.
std::vector<double> body_forces(const Model& m, double belt_speed) {
  std::vector<double> force(m.bodies, 0.0);
  for (const TorqueTable& t : m.torques)
    if (m.inverse_inertia[t.body] > 0)
      force[t.body] += t.factor * t.torque(m.speed_ratio[t.body] * belt_speed) * m.speed_ratio[t.body];
  return force;
}

double sum_over(const std::vector<int>& train, int which, const std::vector<double>& force) {
  double sum = 0;
  for (std::size_t b = 0; b < train.size(); ++b)
    if (train[b] == which) sum += force[b];
  return sum;
}

// A side of the cut pair that neither belt nor driver holds leans on the mesh with what its own torques add up to.
bool engaged(const Model& m, std::size_t gear, const std::vector<double>& force) {
  const GearPair& g = m.gears[gear];
  if (g.half_backlash == 0) return true;
  const auto cut = trains(m, gear);
  if (cut[g.pinion] == cut[g.gear]) return true;
  for (const int side : {cut[g.pinion], cut[g.gear]}) {
    const bool held = std::find(cut.begin(), cut.begin() + m.pulleys, side) != cut.begin() + m.pulleys ||
                      (m.driver.body >= 0 && cut[m.driver.body] == side);
    if (!held) return std::abs(sum_over(cut, side, force)) > 1e-9;
  }
  return true;
}

// Several pulleys on one train share its torque in a way that their slip decides; here the first takes all.
std::vector<double> pulley_forces(const Model& m, const std::vector<double>& force) {
  std::vector<double> onward(m.pulleys, 0.0);
  const auto train = trains(m, m.gears.size());
  const int driven = m.driver.body >= 0 ? train[m.driver.body] : -1;
  int closing = -1;
  std::vector<int> done;
  for (int p = 0; p < m.pulleys; ++p) {
    if (std::find(done.begin(), done.end(), train[p]) != done.end()) continue;
    done.push_back(train[p]);
    if (train[p] == driven)
      closing = p;
    else
      onward[p] = sum_over(train, train[p], force);
  }
  if (closing < 0) return std::vector<double>(m.pulleys, 0.0);
  onward[closing] = -std::accumulate(onward.begin(), onward.end(), 0.0);
  return onward;
}

// Tensions above the first span's at which a belt of the given unstretched length fills the route.
void fit_length(const Model& m, const std::vector<double>& above, LoopEstimate& e) {
  const std::size_t n = above.size();
  const double ea = m.belt.axial_stiffness;
  double base = ea * (e.route.length / m.belt.unstretched_length - 1);
  for (int i = 0; i < 20; ++i) {
    double length = 0, slope = 0;
    const auto add = [&](double piece, double tension) {
      const double stretch = 1 + tension / ea;
      length += piece / stretch;
      slope -= piece / (ea * stretch * stretch);
    };
    for (std::size_t k = 0; k < n; ++k) {
      add(e.route.spans[k].length, base + above[k]);
      add(e.route.wrap[k] * e.route.circles[k].radius, base + 0.5 * (above[k] + above[(k + n - 1) % n]));
    }
    base += (m.belt.unstretched_length - length) / slope;
  }
  for (std::size_t k = 0; k < n; ++k) e.tension[k] = base + above[k];
}

// Torque of spring and belt on the arm at this angle; NaN where the belt has no path. Fills the estimate.
double arm_torque(const Model& m, const std::vector<double>& above, double angle, LoopEstimate& e) {
  e.arm_angle = angle;
  if (!make_route(circles_of(m.scene, m.statics.orientation, angle), e.route) || !e.route.simple) return std::nan("");
  fit_length(m, above, e);
  const TensionerModel& t = m.tensioner;
  if (t.pulley < 0) return 0;
  const std::size_t out = t.pulley, in = (out + m.pulleys - 1) % m.pulleys;
  const Vec2 pull{(e.tension[out] - e.centrifugal) * e.route.spans[out].direction.x -
                      (e.tension[in] - e.centrifugal) * e.route.spans[in].direction.x,
                  (e.tension[out] - e.centrifugal) * e.route.spans[out].direction.y -
                      (e.tension[in] - e.centrifugal) * e.route.spans[in].direction.y};
  const double rx = e.route.circles[out].x - t.pivot_x, ry = e.route.circles[out].y - t.pivot_y;
  return t.spring_torque - t.spring_rate * angle + rx * pull.y - ry * pull.x;
}

// The root next to `start`, searched outward in small steps; false if there is none within a quarter turn.
bool root_near(const std::function<double(double)>& f, double start, double& root) {
  constexpr double step = 0.01;
  const double middle = f(start);
  double best = std::numbers::pi / 2;
  bool found = false;
  for (const double side : {1.0, -1.0}) {
    double a = start, fa = middle;
    while (std::abs(a + side * step - start) < best) {
      double b = a + side * step;
      const double fb = f(b);
      if (std::isnan(fa) || std::isnan(fb)) break;
      if ((fa < 0) == (fb < 0)) {
        a = b;
        fa = fb;
        continue;
      }
      for (int i = 0; i < 60; ++i) {
        const double mid = 0.5 * (a + b), fm = f(mid);
        ((fm < 0) == (fa < 0) ? a : b) = mid;
      }
      best = std::abs(a - start);
      root = a;
      found = true;
      break;
    }
  }
  return found;
}

}  // namespace

LoopEstimate estimate_loop(const Model& m, double crank_rpm) {
  LoopEstimate e;
  e.crank_rpm = crank_rpm;
  if (m.driver.body >= 0) e.belt_speed = crank_rpm * std::numbers::pi / 30 / m.speed_ratio[m.driver.body];
  e.centrifugal = m.scene.belt.mass_kg_per_m * e.belt_speed * e.belt_speed;
  e.tension.assign(m.pulleys, 0.0);
  const auto force = body_forces(m, e.belt_speed);
  for (std::size_t g = 0; g < m.gears.size(); ++g) e.gear_engaged.push_back(engaged(m, g, force));
  e.train_force = pulley_forces(m, force);

  // A pulley that drives the belt onward slackens the span it drives it into.
  const double along = m.pulleys ? m.sense[0] * m.statics.balance.route.circles[0].turn : 1;
  std::vector<double> above(m.pulleys, 0.0);
  for (int p = 1; p < m.pulleys; ++p) above[p] = above[p - 1] - along * e.train_force[p];

  const double rest = m.statics.balance.arm_angle;
  if (m.tensioner.pulley >= 0 && !m.tensioner.locked) {
    double angle = rest;
    e.balanced = root_near([&](double a) { return arm_torque(m, above, a, e); }, rest, angle);
    (void)arm_torque(m, above, angle, e);
  } else {
    (void)arm_torque(m, above, rest, e);
  }
  e.slack = std::any_of(e.tension.begin(), e.tension.end(), [&](double t) { return t <= e.centrifugal; });
  return e;
}

}  // namespace beltlife
