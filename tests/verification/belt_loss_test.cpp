// Owns the verification of the loss in bending: a belt that enters and leaves curvature at speed.
#include "drives.h"
#include "sim/energy.h"

namespace beltlife {
namespace {

using drives::Drive;
using drives::Mean;

struct Loss {
  double power = 0, closed_form = 0;
  double ratio() const { return power / closed_form; }
};

// Two equal pulleys, no load. A free belt of bending damping CI that moves at v under the tension T is in transverse
// equilibrium, T_e = T - m'v^2 left to straighten it, where
//   T_e k = CI v k'',' = d/ds:  k ~ exp(s x), x^3 = T_e/(CI v) = 1/d^3, d the boundary layer
// for the curvature k. On a pulley that holds it rigidly k = 1/R. Before it, k = exp(s/d)/R is all that dies out
// upstream; behind it, with no moment at the end of contact (k' = 0 there),
//   k = exp(-s/2d) (cos(y) + sin(y)/sqrt(3))/R, y = sqrt(3) s/2d
// Both have the integral of k'^2 ds equal to 1/(2 d R^2), so that with the power density CI (v k')^2 a pulley takes
//   P = CI v^2/(d R^2)
Loss bending_loss(int elements, double contact_stiffness) {
  const double radius = 0.2, speed = 20, damping = 1.7e-5;
  SceneSpec scene = drives::two_pulleys(elements, 670, 2e3 * radius, 2e3 * radius, 270);
  scene.belt.bending_damping_n_m2_s = damping;
  scene.belt.axial_damping_n_s = 0.3;
  scene.contact.stiffness_n_per_m3 = contact_stiffness;
  scene.contact.damping_n_s_per_m3 = 4e5 * std::sqrt(contact_stiffness / 1e10);  // the same damping ratio
  Drive d(scene, drives::ramp(speed / radius, 0.08));
  d.run_to(0.18);
  Mean power, tension, pace;
  d.run_to(0.25, 16, [&] {
    power.add(powers(d.simulator.view())[Energy::lost_belt_bending]);
    tension.add(d.work().tension[0]);
    pace.add(std::hypot(d.q().vx[0], d.q().vy[0]));
  });
  const double v = pace.value(), te = tension.value() - scene.belt.mass_kg_per_m * v * v;
  const double layer = std::cbrt(damping * v / te);
  const Loss loss{power.value(), 2 * damping * v * v / (layer * radius * radius)};
  std::printf("    %d elements, k_p %.0e N/m^3, T_e %.1f N, layer %.2f mm\n", elements, contact_stiffness, te,
              1e3 * layer);
  drives::report("bending loss of two pulleys, W", loss.power, loss.closed_form);
  return loss;
}

TEST(BeltLoss, BendingLossDoesNotDependOnTheMesh) {
  // 10, 5 and 2.5 mm in a layer of 15 mm. The pretension is lost in part to chords, so losses are compared by what the
  // tension of each run makes of them.
  const double coarse = bending_loss(256, 1e10).ratio(), middle = bending_loss(512, 1e10).ratio(),
               fine = bending_loss(1024, 1e10).ratio();
  EXPECT_NEAR(middle / fine, 1, 0.01);  // second order: a quarter of what the coarse mesh is off
  EXPECT_NEAR(coarse / fine, 1, 0.04);  // (l0/d)^2/12 = 4 %
  const double order = std::log2(std::abs((coarse - middle) / (middle - fine)));
  std::printf("    observed order %.2f\n", order);
  // Differences of differences: noise of 0.1 % in a loss is 0.3 of the order.
  EXPECT_GT(order, 1.5);
  EXPECT_LT(order, 2.5);
  // The contact gives over (CI v/(k_p width))^(1/5) = 4 mm, which rounds off the ends of the arc.
  EXPECT_NEAR(fine, 1, 0.1);
}

TEST(BeltLoss, StifferContactBringsTheBendingLossToThatOfARigidPulley) {
  const double soft = bending_loss(512, 1e9).ratio(), middle = bending_loss(512, 1e10).ratio(),
               stiff = bending_loss(512, 1e11).ratio();
  EXPECT_LT(soft, middle);
  EXPECT_LT(middle, stiff);
  // The arc's ends are rounded off over a length that falls by 10^(1/5) each time: the error should at least do so.
  EXPECT_LT(1 - stiff, (1 - middle) / std::pow(10, 0.2));
  EXPECT_NEAR(stiff, 1, 0.05);
}

}  // namespace
}  // namespace beltlife
