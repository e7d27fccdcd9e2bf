// Owns the claims about the law of contact: its tangents are the slopes of its forces.
#include "sim/kernels/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace beltlife {
namespace {

constexpr ContactModel law{.stiffness = 4e5,
                           .damping = 30,
                           .separation_damping = 3,
                           .friction_stiffness = 2e5,
                           .friction_speed = 0.02,
                           .anchor_share = 0.6};

double slope(double (*f)(double), double at, double step) { return (f(at + step) - f(at - step)) / (2 * step); }

TEST(ContactLaw, PressesByPenetrationAndByTheDampingOfItsSense) {
  EXPECT_DOUBLE_EQ(contact_law::normal_force(law, 1e-4, 0.1), 4e5 * 1e-4 + 30 * 0.1);
  EXPECT_DOUBLE_EQ(contact_law::normal_force(law, 1e-4, -0.1), 4e5 * 1e-4 - 3 * 0.1);
  EXPECT_EQ(contact_law::normal_force(law, -1e-6, 10), 0) << "no penetration";
  EXPECT_EQ(contact_law::normal_force(law, 1e-6, -100), 0) << "never adhesive";
}

// The force is linear on either side of rest, so that differences are exact but for rounding.
TEST(ContactLaw, HasTheNormalTangentThatItsForceHas) {
  const double h = 2e-5;
  const double by_place = slope([](double d) { return contact_law::normal_force(law, d, 0.1); }, 1e-4, 1e-6),
               by_rate = slope([](double r) { return contact_law::normal_force(law, 1e-4, r); }, 0.1, 1e-3);
  EXPECT_NEAR(contact_law::normal_tangent(law.stiffness, law.damping, h), 0.25 * h * h * by_place + 0.5 * h * by_rate,
              1e-9 * h * by_rate);
}

TEST(ContactLaw, HasTheStickingTangentOfItsAnchor) {
  const double h = 2e-5;
  const double by_offset =
      slope([](double o) { return contact_law::anchor_force(law.friction_stiffness * o, 100); }, 1e-5, 1e-6);
  EXPECT_NEAR(contact_law::sticking_tangent(law.friction_stiffness, h), 0.25 * h * h * by_offset,
              1e-9 * h * h * by_offset);
  EXPECT_EQ(contact_law::anchor_force(law.friction_stiffness * 1e-3, 100), 100) << "slides at its limit";
  EXPECT_EQ(contact_law::anchor_force(-law.friction_stiffness * 1e-3, 100), -100);
}

TEST(ContactLaw, IsSteepestAtRestByTheRateThatStepsCountOn) {
  constexpr double friction = 0.5, normal = 40, mass = 1e-3;
  const auto force = [](double v) {
    return contact_law::saturating_force((1 - law.anchor_share) * friction * normal, v, 1 / law.friction_speed);
  };
  EXPECT_NEAR(contact_law::steepest_rate(law, friction, normal, mass), slope(force, 0, 1e-4) / mass, 1e-6);
}

TEST(ContactLaw, ItsSecantDamperGivesTheSaturatingForce) {
  for (const double v : {-0.3, -0.01, 0.0, 0.004, 0.02, 1.5}) {
    const auto damper = contact_law::secant_damper(12, v, law.friction_speed, 1e-3, 2e-5);
    EXPECT_NEAR(damper.slope * v, contact_law::saturating_force(12, v, 1 / law.friction_speed), 1e-12) << v;
    EXPECT_GE(damper.weight, 0.5);
    EXPECT_LE(damper.weight, 1);
  }
  // z = h slope/m: far below 6 the trapezoidal rule, far above it the implicit one.
  EXPECT_NEAR(contact_law::secant_damper(12, 0, law.friction_speed, 1e3, 2e-5).weight, 0.5, 1e-6);
  EXPECT_NEAR(contact_law::secant_damper(12, 0, law.friction_speed, 1e-9, 2e-5).weight, 1, 1e-5);
}

}  // namespace
}  // namespace beltlife
