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
      Mean before, behind, predicted, pace, normal, tangential;
      int beyond = 0;
      d.run_to(0.5);
      d.run_to(0.8, 16, [&] {
        const Coordinates& q = d.q();
        for (int i = 0; i < q.x.size(); ++i)
          if (q.x[i] > 0.2 && q.x[i] < 0.4)
            (q.vx[i] > 0 ? before : behind).add(d.work().tension[i]);  // the lower span runs to the pulley
        const std::vector<int> nodes = contact_nodes(d, 1);
        for (int i : nodes) {
          pace.add(d.work().slip[i]);
          normal.add(d.work().normal[i]);
          tangential.add(-d.work().tangential[i]);
          beyond += std::abs(d.work().tangential[i]) > mu * d.work().normal[i] * (1 + 1e-12);  // rounding
        }
        const int n = q.x.size();
        const double in = d.work().tension[(nodes.front() + n - 1) % n];
        predicted.add(recursion(d, 1, mu, in) / d.work().tension[nodes.back()]);
      });
      EXPECT_EQ(beyond, 0);
      EXPECT_GT(pace.value(), 2 * d.model.contact.friction_speed);
      const std::string what = ", mu " + std::to_string(mu).substr(0, 3) + ", v " + std::to_string(pace.value());
      // Sliding throughout, all friction is used but where a node that has just landed still winds up its anchor.
      drives::report("friction over normal forces" + what, tangential.value() / normal.value(), mu);
      EXPECT_NEAR(tangential.value() / normal.value() / mu, 1, 0.02);
      // The balances are steady ones: they leave out the jolt with which a node lands, which grows with speed.
      drives::report("tension behind by node balances over measured" + what, predicted.value(), 1);
      EXPECT_NEAR(predicted.value(), 1, speed < 2 ? 0.005 : 0.02);
      // The arc that is touched is uncertain by an element at either end and fluctuates by less: 1 % of the exponent.
      const double lift = d.model.scene.belt.mass_kg_per_m * pace.value() * pace.value();
      const double ratio = (behind.value() - lift) / (before.value() - lift);
      drives::report("(T2 - m'v^2)/(T1 - m'v^2)" + what, ratio, std::exp(mu * pi));
      EXPECT_NEAR(ratio / std::exp(mu * pi), 1, 0.02);
    }
}

// Mean tension over a pulley's arc, by the angle before the point where the belt leaves.
struct Profile {
  static constexpr int bins = 90;  // of 2 degrees
  std::vector<Mean> tension = std::vector<Mean>(bins);
  void add(double angle, double t) {
    if (const int bin = static_cast<int>(angle / pi * bins); angle >= 0 && bin < bins) tension[bin].add(t);
  }
  // Least-squares slope of the logarithm of tension above `lift`, where it is between the fractions 0.1 and 0.9 of the
  // way from `low` to `high`; and the angle from which on the logarithm would be that of the belt entering.
  struct Arc {
    double slope, length;
  };
  Arc fit(double low, double high, double lift, double entering) const {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int i = 0; i < bins; ++i) {
      if (tension[i].count == 0) continue;
      const double share = (tension[i].value() - low) / (high - low);
      if (share < 0.1 || share > 0.9) continue;
      const double x = (i + 0.5) * pi / bins, y = std::log(tension[i].value() - lift);
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), at_zero = (sy - slope * sx) / n;
    return {std::abs(slope), (std::log(entering - lift) - at_zero) / slope};
  }
};

struct Creep {
  double loss_error = 0;
  double driver_arc_error = 0, driven_arc_error = 0;
};

// Steady creep of a belt with stiff contact. The belt sticks where it enters a pulley and slides, at the friction
// limit, on the arc before it leaves. Each second as many metres of unstretched belt pass everywhere, so that its speed
// goes as its stretch 1 + T/EA; it enters the driver at the driver's surface speed with T1 and the driven pulley at
// that one's with T2:
//   speed loss = 1 - (1 + T2/EA)/(1 + T1/EA) = (T1 - T2)/(EA + T1)
// and on the slip arcs of both pulleys the tension above m'v^2 changes by the exponential of friction times arc:
//   slip arc = ln((T1 - m'v^2)/(T2 - m'v^2))/mu
// The arc is read from the mean tension over the pulley's angle: from where the belt leaves to where the exponential
// fitted to the changing tension meets the tension with which the belt enters.
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
  Mean tight, slack;
  Profile driver, driven;
  const double driver_start = d.q().angle[0], driven_start = d.q().angle[1];
  d.run_to(1.0, 16, [&] {
    const Coordinates& q = d.q();
    const int n = q.x.size();
    for (int i = 0; i < n; ++i) {
      const double x = 0.5 * (q.x[i] + q.x[(i + 1) % n]), y = 0.5 * (q.y[i] + q.y[(i + 1) % n]),
                   t = d.work().tension[i];
      if (x > 0.2 && x < 0.4) (y > 0 ? tight : slack).add(t);
      if (x < 0) driver.add(pi / 2 + std::atan2(y, -x), t);  // the belt leaves it downwards
      if (x > 0.6) driven.add(pi / 2 - std::atan2(y, x - 0.6), t);
    }
  });
  const double lift = scene.belt.mass_kg_per_m * speed * speed, t1 = tight.value(), t2 = slack.value();
  const double loss = 1 - (d.q().angle[1] - driven_start) / (d.q().angle[0] - driver_start);
  const double expected_loss = (t1 - t2) / (scene.belt.axial_stiffness_n + t1);
  const double expected_arc = std::log((t1 - lift) / (t2 - lift)) / mu;
  const Profile::Arc a = driver.fit(t2, t1, lift, t1), b = driven.fit(t2, t1, lift, t2);
  std::printf("    %d elements: T1 %.1f N, T2 %.1f N\n", elements, t1, t2);
  drives::report("speed loss", loss, expected_loss);
  drives::report("slip arc on the driver, rad", a.length, expected_arc);
  drives::report("slip arc on the driven pulley, rad", b.length, expected_arc);
  drives::report("logarithmic slope on the driver, 1/rad", a.slope, mu);
  drives::report("logarithmic slope on the driven pulley, 1/rad", b.slope, mu);
  // Where the belt sticks its tension keeps the value with which it came: 5 % of the change.
  for (int i = 0; i < Profile::bins; ++i) {
    const double angle = (i + 0.5) * pi / Profile::bins;
    if (angle < 1.2 * expected_arc || angle > 0.9 * pi) continue;  // the last 18 degrees: the belt lands
    EXPECT_NEAR(driver.tension[i].value(), t1, 0.05 * (t1 - t2)) << angle;
    EXPECT_NEAR(driven.tension[i].value(), t2, 0.05 * (t1 - t2)) << angle;
  }
  return {loss / expected_loss - 1, a.length / expected_arc - 1, b.length / expected_arc - 1};
}

TEST(BeltFriction, ALoadedDriveCreepsAsTheAdhesionAndSlipArcsSay) {
  const Creep coarse = creep(184), middle = creep(368), fine = creep(736);
  // Chords shorten the sliding belt by (l0/R)^2/24, 4e-4 of itself on the coarse mesh and a sixteenth of it here; 3 %
  // of the loss is left for what the stiff contact still gives. Arcs are read from bins of 2 degrees, 2.5 % of them.
  EXPECT_NEAR(fine.loss_error, 0, 0.03);
  EXPECT_NEAR(fine.driver_arc_error, 0, 0.05);
  EXPECT_NEAR(fine.driven_arc_error, 0, 0.05);
  // Finer elements come closer, until what is left is noise of some 0.1 %.
  for (const Creep* c : {&middle, &fine}) {
    EXPECT_LT(std::abs(c->loss_error), std::max(0.5 * std::abs(coarse.loss_error), 1e-3));
    EXPECT_LT(std::abs(c->driver_arc_error), std::max(0.5 * std::abs(coarse.driver_arc_error), 3e-3));
    EXPECT_LT(std::abs(c->driven_arc_error), std::max(0.5 * std::abs(coarse.driven_arc_error), 3e-3));
  }
}

}  // namespace
}  // namespace beltlife
