// Owns the verification of the bending element: ring stiffness, frequency and damping against Euler-Bernoulli.
#include <Eigen/Dense>
#include <vector>

#include "drives.h"

namespace beltlife {
namespace {

using drives::Drive;
using drives::pi;

constexpr double stiffness = 2, damping = 1e-3, axial = 1e6, length = 1;  // EI, CI, EA, L0

// A ring at rest. The belt is straight when free, but in a closed ring all angles together are one turn whatever the
// shape, so the moment that bent it does no work and the ring vibrates like one that was made round. Its axial
// stiffness is high beside bending, EI/(EA r^2) = 8e-5, which is how far the closed forms of an inextensible ring hold.
SceneSpec bent_ring(int elements) {
  SceneSpec scene = drives::ring(elements, 1e3 * length, 0);
  scene.belt.axial_stiffness_n = axial;
  scene.belt.axial_damping_n_s = 0;
  scene.belt.bending_stiffness_n_m2 = stiffness;
  scene.belt.bending_damping_n_m2_s = damping;
  return scene;
}

// -dF/dx (or -dF/dv) by central differences of the simulator's forces. Displacements of 1e-7 m leave a rounding of
// 1e-10 and a truncation of 1e-10 of the axial stiffness: 1e-3 of the softest bending mode.
Eigen::MatrixXd derivative(Drive& d, bool of_velocity) {
  const int n = d.model.belt.nodes;
  const double step = of_velocity ? 1e-3 : 1e-7;
  Eigen::MatrixXd matrix(2 * n, 2 * n);
  for (int k = 0; k < 2 * n; ++k) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(2 * n);
    for (const double side : {1.0, -1.0}) {
      Coordinates q = d.q();
      NodeArray& array = of_velocity ? (k % 2 == 0 ? q.vx : q.vy) : (k % 2 == 0 ? q.x : q.y);
      array[k / 2] += side * step;
      d.simulator.evaluate(q, {});
      for (int i = 0; i < n; ++i) {
        column[2 * i] -= side * d.work().fx[i] / (2 * step);
        column[2 * i + 1] -= side * d.work().fy[i] / (2 * step);
      }
    }
    matrix.col(k) = column;
  }
  return 0.5 * (matrix + matrix.transpose());
}

struct RingModes {
  Eigen::VectorXd values;  // rising; the first three are those of rigid motion, zero
  Eigen::MatrixXd vectors;
  double node_mass = 0;
};

RingModes modes(Drive& d) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(derivative(d, false));
  return {solved.eigenvalues(), solved.eigenvectors(), d.model.belt.node_mass};
}

double ring_frequency(int waves) {  // Hoppe 1871, rad/s
  const double r = length / (2 * pi), n2 = waves * waves;
  return std::sqrt(n2 * (n2 - 1) * (n2 - 1) / (n2 + 1) * stiffness / 0.4) / (r * r);
}

// Order p of an error c l0^p from three meshes, each twice as fine as the one before.
double observed_order(double coarse, double middle, double fine) {
  return std::log2(std::abs((coarse - middle) / (middle - fine)));
}

constexpr double order_tolerance = 0.2;  // the next term, of order 4, on 16 elements

TEST(BeltBending, ADiametrallyLoadedRingGivesWayLikeAnEulerBernoulliRing) {
  const double r = length / (2 * pi), expected = (pi / 4 - 2 / pi) * r * r * r / stiffness;
  std::vector<double> measured;
  for (int elements : {16, 32, 64}) {
    Drive d(bent_ring(elements));
    const RingModes m = modes(d);
    // One newton outwards at node 0, one at the node opposite; the widening of the diameter between them.
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * elements);
    load[0] = 1;
    load[elements] = -1;
    double widening = 0;
    for (int k = 3; k < 2 * elements; ++k) widening += std::pow(m.vectors.col(k).dot(load), 2) / m.values[k];
    measured.push_back(widening);
    drives::report("widening per newton, m, " + std::to_string(elements) + " elements", widening, expected);
  }
  EXPECT_NEAR(measured[2] / expected, 1, 0.01);  // (2 pi/64)^2 = 0.0096: chords instead of arcs
  const double order = observed_order(measured[0], measured[1], measured[2]);
  std::printf("    observed order %.2f\n", order);
  EXPECT_NEAR(order, 2, order_tolerance);
}

TEST(BeltBending, ARingOvalisesAtTheFrequencyOfAnEulerBernoulliRing) {
  std::vector<double> two, three;
  for (int elements : {16, 32, 64}) {
    Drive d(bent_ring(elements));
    const RingModes m = modes(d);
    // Modes come in pairs, turned against each other; three rigid motions come first.
    two.push_back(std::sqrt(0.5 * (m.values[3] + m.values[4]) / m.node_mass));
    three.push_back(std::sqrt(0.5 * (m.values[5] + m.values[6]) / m.node_mass));
    drives::report("two waves, rad/s, " + std::to_string(elements) + " elements", two.back(), ring_frequency(2));
    drives::report("three waves, rad/s, " + std::to_string(elements) + " elements", three.back(), ring_frequency(3));
  }
  EXPECT_NEAR(two[2] / ring_frequency(2), 1, 0.01);    // (2 wave numbers l0)^2/12 = (4 pi/64)^2/12 = 3e-3
  EXPECT_NEAR(three[2] / ring_frequency(3), 1, 0.02);  // likewise 7e-3
  std::printf("    observed orders %.2f, %.2f\n", observed_order(two[0], two[1], two[2]),
              observed_order(three[0], three[1], three[2]));
  EXPECT_NEAR(observed_order(two[0], two[1], two[2]), 2, order_tolerance);
  EXPECT_NEAR(observed_order(three[0], three[1], three[2]), 2, order_tolerance);
}

TEST(BeltBending, AnOvalRingSwingsInTimeWithThatFrequencyAndDampingRatio) {
  Drive d(bent_ring(64));
  const RingModes m = modes(d);
  const Eigen::VectorXd mode = m.vectors.col(3);
  const Coordinates rest = d.q();
  for (int i = 0; i < 64; ++i) {
    d.q().vx[i] += 1e-3 * mode[2 * i];
    d.q().vy[i] += 1e-3 * mode[2 * i + 1];
  }
  drives::Crossings crossings;
  double top = 0;
  std::vector<double> tops;
  d.run_to(0.4, 1, [&] {
    double along = 0;
    for (int i = 0; i < 64; ++i)
      along += mode[2 * i] * (d.q().x[i] - rest.x[i]) + mode[2 * i + 1] * (d.q().y[i] - rest.y[i]);
    const int before = crossings.count;
    crossings.add(d.simulator.time(), along);
    top = std::max(top, along);
    if (crossings.count > before) {
      tops.push_back(top);
      top = 0;
    }
  });
  // A Kelvin-Voigt bar: damping ratio CI w/(2 EI), amplitude falls by exp(-2 pi ratio) a period.
  const double w = ring_frequency(2), ratio = damping * w / (2 * stiffness);
  const double decay = std::log(tops[1] / tops[4]) / 3;
  drives::report("frequency of oval swinging, Hz", crossings.frequency(), w / (2 * pi));
  drives::report("logarithmic decrement", decay, 2 * pi * ratio);
  EXPECT_NEAR(2 * pi * crossings.frequency() / w, 1, 0.01);  // as above, and ratio^2/2 = 2e-3
  EXPECT_NEAR(decay / (2 * pi * ratio), 1, 0.03);            // the rigid and higher modes excited by rounding: less
}

TEST(BeltBending, DampingActsOnTurnRatesAsStiffnessDoesOnAngles) {
  Drive d(bent_ring(32));
  const Eigen::MatrixXd viscous = derivative(d, true);
  const RingModes m = modes(d);
  for (int k = 3; k < 9; ++k) {  // two, three and four waves
    const Eigen::VectorXd v = m.vectors.col(k);
    // What these modes stretch axially, where there is no damping: some EI/(EA r^2) of their stiffness.
    EXPECT_NEAR(v.dot(viscous * v) / (m.values[k] * damping / stiffness), 1, 5e-3);
  }
  for (int k = 0; k < 3; ++k)  // rigid motion is free: rounding of CI/l0^3
    EXPECT_LT(std::abs(m.vectors.col(k).dot(viscous * m.vectors.col(k))), 1e-6 * viscous.norm());
}

}  // namespace
}  // namespace beltlife
