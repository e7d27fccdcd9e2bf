// Owns the verification of friction: Euler-Eytelwein on a locked pulley, creep of a loaded two-pulley drive.
#include <vector>

#include "drives.h"

namespace beltlife {
namespace {

using drives::Drive;
using drives::Mean;
using drives::pi;

// Contact nodes of a pulley in the order in which the belt passes them (nodes count up along the belt).
std::vector<int> contact_nodes(const Drive& d, int pulley) {
  const int n = d.model.belt.nodes;
  std::vector<bool> touches(n, false);
  for (const ContactSegment& s : d.simulator.state().segments)
    for (int i = s.begin; i < s.end && s.pulley == pulley; ++i) touches[i] = d.work().normal[i] > 0;
  int first = 0;
  while (first < n && !(touches[first] && !touches[(first + n - 1) % n])) ++first;
  std::vector<int> nodes;
  for (int k = 0; k < n; ++k)
    if (const int i = (first + k) % n; touches[i]) nodes.push_back(i);
  return nodes;
}

// The belt is dragged over a pulley that cannot turn; the driver's grooves grip.
SceneSpec dragged(int elements, double mu) {
  SceneSpec scene = drives::two_pulleys(elements, 600, 200, 200, 800);
  scene.pulley[0].friction = 5;
  scene.pulley[1].friction = mu;
  scene.pulley[1].locked = true;
  scene.contact.stiffness_n_per_m3 = 1e11;
  scene.contact.damping_n_s_per_m3 = 1e6;
  return scene;
}

// Tensions on either side of a dragged belt and what friction makes of the first by nodes: node by node the tangential
// and radial balances of a node that slides along the pulley at v,
//   T_out cos(b_out) - T_in cos(b_in) = mu F_n,   T_out sin(b_out) + T_in sin(b_in) = F_n + m v^2 / r,
// with b the angle between element and tangent, give T_out from T_in.
double recursion(const Drive& d, int pulley, double mu, double tension_in) {
  const Coordinates& q = d.simulator.state().q;
  const Work& w = d.work();
  const int n = q.x.size();
  const double cx = d.model.pulley_x[pulley], cy = d.model.pulley_y[pulley];
  double t = tension_in;
  for (int i : contact_nodes(d, pulley)) {
    const double r = std::hypot(q.x[i] - cx, q.y[i] - cy), nx = (q.x[i] - cx) / r, ny = (q.y[i] - cy) / r;
    const int a = (i + n - 1) % n;
    const double sin_in = w.ux[a] * nx + w.uy[a] * ny, sin_out = -(w.ux[i] * nx + w.uy[i] * ny);
    const double cos_in = w.uy[a] * nx - w.ux[a] * ny, cos_out = w.uy[i] * nx - w.ux[i] * ny;
    const double v = q.vy[i] * nx - q.vx[i] * ny;
    t = (t * (cos_in + mu * sin_in) - mu * d.model.belt.node_mass * v * v / r) / (cos_out - mu * sin_out);
  }
  return t;
}

TEST(BeltFriction, ALockedPulleyMultipliesTensionByTheExponentialOfFrictionTimesWrap) {
  for (const double mu : {0.2, 0.4})
    for (const double speed : {1.0, 12.0}) {
      Drive d(dragged(184, mu), drives::ramp(speed / 0.1, 0.1));
      Mean before, behind, predicted, pace;  // the lower span runs towards the pulley
      d.run_to(0.5);
      d.run_to(0.8, 16, [&] {
        const Coordinates& q = d.q();
        for (int i = 0; i < q.x.size(); ++i)
          if (q.x[i] > 0.2 && q.x[i] < 0.4) (q.vx[i] > 0 ? before : behind).add(d.work().tension[i]);
        const std::vector<int> nodes = contact_nodes(d, 1);
        for (int i : nodes) {
          pace.add(d.work().slip[i]);
          // Beyond the slip speed both parts of the law are at their limits: rounding only.
          ASSERT_NEAR(d.work().tangential[i], -mu * d.work().normal[i], 1e-9 * d.work().normal[i] + 1e-9);
        }
        const int n = q.x.size();
        const double in = d.work().tension[(nodes.front() + n - 1) % n];
        predicted.add(recursion(d, 1, mu, in) / d.work().tension[nodes.back()]);
      });
      const std::string what = ", mu " + std::to_string(mu) + ", v " + std::to_string(pace.value());
      drives::report("tension behind by summed node balances" + what, predicted.value(), 1);
      EXPECT_NEAR(predicted.value(), 1, 0.01);
      const double lift = d.model.scene.belt.mass_kg_per_m * pace.value() * pace.value();
      const double ratio = (behind.value() - lift) / (before.value() - lift);
      drives::report("(T2 - m'v^2)/(T1 - m'v^2)" + what, ratio, std::exp(mu * pi));
      EXPECT_NEAR(ratio / std::exp(mu * pi), 1, 0.02);
      EXPECT_GT(pace.value(), 2 * d.model.contact.friction_speed);
    }
}

struct Creep {
  double speed_loss, expected_loss;
  double driver_arc, driven_arc, expected_arc;
};

// Steady creep of a belt with stiff contact. The belt sticks where it enters a pulley and slides, at the friction
// limit, on the arc before it leaves. Each second as many metres of unstretched belt pass everywhere, so that its speed
// goes as its stretch 1 + T/EA; it enters the driver at the driver's surface speed with T1 and the driven pulley at
// that one's with T2:
//   speed loss = 1 - (1 + T2/EA)/(1 + T1/EA) = (T1 - T2)/(EA + T1)
// and on the slip arcs of both pulleys the tension above m'v^2 changes by the exponential of friction times arc:
//   slip arc = ln((T1 - m'v^2)/(T2 - m'v^2))/mu
Creep creep(int elements) {
  const double radius = 0.1, speed = 4, mu = 0.6;
  SceneSpec scene = drives::two_pulleys(elements, 600, 2e3 * radius, 2e3 * radius, 650);
  scene.belt.axial_damping_n_s = 0.3;
  scene.contact.stiffness_n_per_m3 = scene.contact.friction_stiffness_n_per_m3 = 1e12;
  scene.contact.damping_n_s_per_m3 = 4e6;
  scene.contact.anchor_share = 1;
  TorqueSpec load;
  load.name = "load";
  load.body = "driven";
  load.speeds_rpm = {200};
  load.torques_n_m = {-50};
  scene.torque.push_back(load);
  Drive d(scene, drives::ramp(speed / radius, 0.1));
  d.run_to(0.7);
  Mean tight, slack, driver_arc, driven_arc;
  const double driver_start = d.q().angle[0], driven_start = d.q().angle[1];
  d.run_to(1.0, 16, [&] {
    const Coordinates& q = d.q();
    const Work& w = d.work();
    for (int i = 0; i < q.x.size(); ++i)
      if (q.x[i] > 0.2 && q.x[i] < 0.4) (q.vx[i] < 0 ? tight : slack).add(w.tension[i]);
    for (int p : {0, 1}) {  // nodes at the limit, counted back from where the belt leaves
      const std::vector<int> nodes = contact_nodes(d, p);
      int sliding = 0;
      while (sliding < static_cast<int>(nodes.size())) {
        const int i = nodes[nodes.size() - 1 - sliding];
        if (std::abs(w.tangential[i]) < 0.999 * mu * w.normal[i]) break;
        ++sliding;
      }
      (p == 0 ? driver_arc : driven_arc).add(sliding * d.model.belt.element_length / radius);
    }
  });
  const double lift = scene.belt.mass_kg_per_m * speed * speed, t1 = tight.value(), t2 = slack.value();
  Creep c{};
  c.speed_loss = 1 - (d.q().angle[1] - driven_start) / (d.q().angle[0] - driver_start);
  c.expected_loss = (t1 - t2) / (scene.belt.axial_stiffness_n + t1);
  c.driver_arc = driver_arc.value();
  c.driven_arc = driven_arc.value();
  c.expected_arc = std::log((t1 - lift) / (t2 - lift)) / mu;
  std::printf("    %d elements: T1 %.1f N, T2 %.1f N\n", elements, t1, t2);
  drives::report("speed loss", c.speed_loss, c.expected_loss);
  drives::report("slip arc on the driver, rad", c.driver_arc, c.expected_arc);
  drives::report("slip arc on the driven pulley, rad", c.driven_arc, c.expected_arc);
  return c;
}

TEST(BeltFriction, ALoadedDriveCreepsAsTheAdhesionAndSlipArcsSay) {
  const Creep coarse = creep(184), middle = creep(368), fine = creep(736);
  (void)coarse;
  (void)middle;
  EXPECT_NEAR(fine.speed_loss / fine.expected_loss, 1, 0.03);
  EXPECT_NEAR(fine.driver_arc / fine.expected_arc, 1, 0.1);
  EXPECT_NEAR(fine.driven_arc / fine.expected_arc, 1, 0.1);
}

}  // namespace
}  // namespace beltlife
