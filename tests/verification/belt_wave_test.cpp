// Owns the verification of the belt's dynamics: axial and transverse waves, spinning ring.
#include "drives.h"

namespace beltlife {
namespace {

using drives::Crossings;
using drives::Drive;
using drives::pi;

// A closed belt laid flat: n elements to the right along y = 0, n back to the left, stretched by `strain`. The test
// holds the two nodes at the folds, which leaves two straight strips with fixed ends.
class Strips {
 public:
  Strips(const SceneSpec& scene, double strain) : drive(scene), half(drive.model.belt.nodes / 2) {
    const double pitch = drive.model.belt.element_length * (1 + strain);
    for (int i = 0; i < 2 * half; ++i) {
      drive.q().x[i] = pitch * (i <= half ? i : 2 * half - i);
      drive.q().y[i] = drive.q().vx[i] = drive.q().vy[i] = 0;
    }
    end_x = pitch * half;
  }
  void advance() {
    drive.simulator.advance();
    for (int i : {0, half}) {
      drive.q().x[i] = i == 0 ? 0 : end_x;
      drive.q().y[i] = drive.q().vx[i] = drive.q().vy[i] = 0;
    }
  }
  double length() const { return end_x; }

  Drive drive;
  int half;
  double end_x;
};

TEST(BeltWave, AnAxialPulseTravelsAtTheRootOfStiffnessOverMass) {
  SceneSpec scene = drives::ring(800, 8000, 0);
  scene.belt.axial_damping_n_s = 0;
  scene.solver.step_s = 4e-6;
  Strips strips(scene, 0);
  Drive& d = strips.drive;
  // A bell of displacement, at rest, 20 elements wide: half of it runs to the right.
  const double l0 = d.model.belt.element_length, width = 0.2;
  const int from = 120, to = 320;
  for (int i = 1; i < strips.half; ++i) {
    const double s = (i - from) * l0 / width;
    d.q().x[i] += 1e-6 * std::exp(-s * s);
  }
  // When its top passes node `to`: the vertex of the parabola through the three highest readings.
  double before = 0, now = 0, after = 0;
  while (!(now > 2e-7 && after < now && before <= now)) {
    strips.advance();
    before = now;
    now = after;
    after = d.q().x[to] - l0 * to;
  }
  const double h = d.simulator.step(), shift = 0.5 * (before - after) / (before - 2 * now + after);
  const double arrival = d.simulator.time() + h * (shift - 1);
  const double speed = std::sqrt(scene.belt.axial_stiffness_n / scene.belt.mass_kg_per_m);
  drives::report("axial wave speed, m/s", (to - from) * l0 / arrival, speed);
  // Grid dispersion slows a wave of wave number k by (k l0)^2/24; the bell holds k up to some 2/width = 0.1/l0: 4e-4.
  // The scheme's velocities stand half a step beside its displacements: 1/1700 of the way.
  EXPECT_NEAR((to - from) * l0 / arrival / speed, 1, 1e-3);
}

TEST(BeltWave, AFixedStripRingsAxiallyAtHalfTheWaveSpeedOverItsLength) {
  SceneSpec scene = drives::ring(100, 1000, 0);
  scene.belt.axial_damping_n_s = 0;
  Strips strips(scene, 0);
  Drive& d = strips.drive;
  const double length = strips.length(), l0 = d.model.belt.element_length;
  for (int i = 1; i < strips.half; ++i) d.q().vx[i] = -1e-3 * std::sin(pi * i * l0 / length);
  Crossings crossings;
  const int mid = strips.half / 2;
  while (crossings.count < 10) {
    strips.advance();
    crossings.add(d.simulator.time(), d.q().x[mid] - l0 * mid);
  }
  const double expected = std::sqrt(scene.belt.axial_stiffness_n / scene.belt.mass_kg_per_m) / (2 * length);
  drives::report("axial frequency of a fixed strip, Hz", crossings.frequency(), expected);
  // Lumped masses lower it by (pi/50)^2/24 = 1.6e-4, the scheme by (w h)^2/24, less than that.
  EXPECT_NEAR(crossings.frequency() / expected, 1, 5e-4);
}

TEST(BeltWave, AFixedStripSwingsLikeAString) {
  SceneSpec scene = drives::ring(100, 1000, 0);
  scene.belt.axial_damping_n_s = 0;
  const double strain = 0.005;
  Strips strips(scene, strain);
  Drive& d = strips.drive;
  for (int i = 1; i < strips.half; ++i) d.q().vy[i] = -1e-3 * std::sin(pi * i / strips.half);
  Crossings crossings;
  while (crossings.count < 3) {
    strips.advance();
    crossings.add(d.simulator.time(), d.q().y[strips.half / 2]);
  }
  // The mass per stretched length is m'/(1 + strain).
  const double tension = strain * scene.belt.axial_stiffness_n, mass = scene.belt.mass_kg_per_m / (1 + strain);
  const double expected = std::sqrt(tension / mass) / (2 * strips.length());
  drives::report("transverse frequency of a fixed strip, Hz", crossings.frequency(), expected);
  EXPECT_NEAR(crossings.frequency() / expected, 1, 5e-4);  // lumped masses: (pi/50)^2/24 = 1.6e-4
}

// Mid-span position of the lower span of a two-pulley drive, which runs to the right.
struct MidSpan {
  double y, tension, vx;
};
MidSpan mid_span(const Drive& d, double x) {
  const Coordinates& q = d.simulator.state().q;
  const int n = q.x.size();
  int a = -1;  // the last node before x
  for (int i = 0; i < n; ++i)
    if (q.y[i] < 0 && q.x[i] <= x && (a < 0 || q.x[i] > q.x[a])) a = i;
  const int b = (a + 1) % n;
  const double w = (x - q.x[a]) / (q.x[b] - q.x[a]);
  return {q.y[a] + w * (q.y[b] - q.y[a]), d.work().tension[a], q.vx[a]};
}

// A string that travels at v between two points a distance L apart swings at (c^2 - v^2)/(2 L c), c^2 = T/m'.
TEST(BeltWave, ATravellingSpanSwingsAtTheFrequencyOfATravellingString) {
  const double radius = 0.1, distance = 1.5, start = 0.4, end = start + 0.5;
  for (const double speed : {0.0, 8.0, 20.0}) {
    SceneSpec scene = drives::two_pulleys(360, 1e3 * distance, 2e3 * radius, 2e3 * radius, 700);
    scene.belt.axial_damping_n_s = 10;
    // The same drive twice, one kicked in the first half wave: their difference is free of what the run itself stirs
    // up.
    Drive plain(scene, drives::ramp(speed / radius, 0.2)), kicked(scene, drives::ramp(speed / radius, 0.2));
    plain.run_to(start);
    kicked.run_to(start);
    Coordinates& q = kicked.q();
    for (int i = 0; i < q.x.size(); ++i)
      if (q.y[i] < 0 && q.x[i] > 0 && q.x[i] < distance) q.vy[i] -= 0.1 * std::sin(pi * q.x[i] / distance);
    Crossings crossings;
    drives::Mean tension, pace;
    kicked.run_to(end, 8, [&] {
      plain.run_to(kicked.simulator.time() - 0.5 * plain.simulator.step(), 8, [] {});
      const MidSpan a = mid_span(plain, 0.5 * distance), b = mid_span(kicked, 0.5 * distance);
      crossings.add(plain.simulator.time(), b.y - a.y);
      tension.add(a.tension);
      pace.add(a.vx);
    });
    const double mass = scene.belt.mass_kg_per_m / (1 + tension.value() / scene.belt.axial_stiffness_n);
    const double c = std::sqrt(tension.value() / mass), v = pace.value();
    const double expected = (c * c - v * v) / (2 * distance * c);
    drives::report("transverse frequency at " + std::to_string(v) + " m/s, Hz", crossings.frequency(), expected);
    // The ends are where the belt meets the pulleys: they shift by the belt's slope times R, 0.2 mm of 1.5 m here, and
    // the 10 mm elements leave them uncertain by some 0.2 %.
    EXPECT_NEAR(crossings.frequency() / expected, 1, 0.005);
    EXPECT_GE(crossings.count, 2);
  }
}

// At w a polygon of N masses m on the radius r is in equilibrium with T = m w^2 r / (2 sin(pi/N)).
TEST(BeltWave, ASpinningRingCarriesItsCentrifugalTension) {
  SceneSpec scene = drives::shipped("spinning_ring");
  scene.solver.scheme = Scheme::thesis;
  Drive d(scene);
  d.run_to(0.05);
  const Coordinates& q = d.q();
  const int n = d.model.belt.nodes;
  drives::Mean radius, spin, tension;
  double low = 1e300, high = 0;
  for (int i = 0; i < n; ++i) {
    const double r2 = q.x[i] * q.x[i] + q.y[i] * q.y[i];
    radius.add(std::sqrt(r2));
    spin.add((q.x[i] * q.vy[i] - q.y[i] * q.vx[i]) / r2);
    tension.add(d.work().tension[i]);
    low = std::min(low, d.work().tension[i]);
    high = std::max(high, d.work().tension[i]);
  }
  const double expected =
      d.model.belt.node_mass * spin.value() * spin.value() * radius.value() / (2 * std::sin(pi / n));
  drives::report("tension of the spinning ring, N", tension.value(), expected);
  // 0.8 turns at a scheme error of h^2 w^2 = 1e-9 a radian; 1e-6 leaves room for rounding, 1e-16 EA / T = 2e-13 a step.
  EXPECT_NEAR(tension.value() / expected, 1, 1e-6);
  EXPECT_NEAR(low / expected, 1, 1e-6);
  EXPECT_NEAR(high / expected, 1, 1e-6);
  EXPECT_NEAR(spin.value() / 100, 1, 1e-6);
}

}  // namespace
}  // namespace beltlife
