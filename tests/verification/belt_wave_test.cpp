// Owns the verification of the belt's dynamics: axial and transverse waves, spinning ring.
#include "drives.h"

namespace beltlife {
namespace {

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

// Frequency of a signal from its rising zero crossings, each interpolated between two samples.
struct Crossings {
  double last_time = 0, last_value = 0, first = -1, latest = 0;
  int count = 0;
  void add(double time, double value) {
    if (time > 0 && last_value < 0 && value >= 0) {
      latest = last_time - last_value * (time - last_time) / (value - last_value);
      if (first < 0)
        first = latest;
      else
        ++count;
    }
    last_time = time;
    last_value = value;
  }
  double frequency() const { return count / (latest - first); }
};

TEST(BeltWave, AnAxialPulseTravelsAtTheRootOfStiffnessOverMass) {
  SceneSpec scene = drives::ring(800, 8000, 0);
  scene.belt.axial_damping_n_s = 0;
  Strips strips(scene, 0);
  Drive& d = strips.drive;
  const double speed = std::sqrt(scene.belt.axial_stiffness_n / scene.belt.mass_kg_per_m);
  // A bell u(x - ct) of small strain, 10 elements wide: displacement u and velocity -c u'.
  const double from = 1.0, width = 0.1, height = 1e-6;
  for (int i = 1; i < strips.half; ++i) {
    const double s = (d.q().x[i] - from) / width, u = height * std::exp(-s * s);
    d.q().x[i] += u;
    d.q().vx[i] = speed * 2 * s / width * u;
  }
  // The bell's centre of gravity, before and after 2 m.
  const double l0 = d.model.belt.element_length;
  const auto centre = [&] {
    double sum = 0, moment = 0;
    for (int i = 1; i < strips.half; ++i) {
      const double u = d.q().x[i] - l0 * i;
      sum += u;
      moment += u * l0 * i;
    }
    return moment / sum;
  };
  const double start = centre(), begin = d.simulator.time();
  while (d.simulator.time() < 2.0 / speed) strips.advance();
  const double measured = (centre() - start) / (d.simulator.time() - begin);
  drives::report("axial wave speed, m/s", measured, speed);
  // Grid dispersion slows a wave of wave number k by (k l0)^2/24; the bell holds k up to some 2/width: 2e-3.
  EXPECT_NEAR(measured / speed, 1, 2e-3);
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

// A string that travels at v between two points a distance L apart swings at (c^2 - v^2)/(2 L c), c^2 = T/m'.
TEST(BeltWave, ATravellingSpanSwingsAtTheFrequencyOfATravellingString) {
  for (const double speed : {0.0, 8.0, 20.0}) {
    const double radius = 0.1, distance = 1.5;
    SceneSpec scene = drives::two_pulleys(360, 1e3 * distance, 2e3 * radius, 2e3 * radius, 700);
    scene.belt.axial_damping_n_s = 10;
    const double start = 0.4;
    Drive d(scene, drives::ramp(speed / radius, 0.2));
    d.run_to(start);
    // Mid-span of the lower span, which runs to the right; kicked in its first half wave.
    Coordinates& q = d.q();
    const int n = d.model.belt.nodes;
    for (int i = 0; i < n; ++i)
      if (q.y[i] < 0 && q.x[i] > 0 && q.x[i] < distance) q.vy[i] -= 0.15 * std::sin(pi * q.x[i] / distance);
    Crossings crossings;
    drives::Mean tension, pace;
    d.run_to(start + 0.45, 8, [&] {
      int a = -1;  // the last node before mid-span
      for (int i = 0; i < n; ++i)
        if (q.y[i] < 0 && q.x[i] <= 0.5 * distance && (a < 0 || q.x[i] > q.x[a])) a = i;
      const int b = (a + 1) % n;
      const double w = (0.5 * distance - q.x[a]) / (q.x[b] - q.x[a]);
      crossings.add(d.simulator.time(), q.y[a] + w * (q.y[b] - q.y[a]) + radius);
      tension.add(d.work().tension[a]);
      pace.add(q.vx[a]);
    });
    const double mass = scene.belt.mass_kg_per_m / (1 + tension.value() / scene.belt.axial_stiffness_n);
    const double c = std::sqrt(tension.value() / mass), v = pace.value();
    const double expected = (c * c - v * v) / (2 * distance * c);
    drives::report("transverse frequency at " + std::to_string(v) + " m/s, Hz", crossings.frequency(), expected);
    // The ends are where the belt meets the pulleys, which moves by w'R = 2 mm of 1.5 m; the swing stretches the belt.
    EXPECT_NEAR(crossings.frequency() / expected, 1, 0.02);
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
