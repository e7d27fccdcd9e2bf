// Owns the tests of single kernels: belt elements and contact against plain reference code, and the vector sum.
#include "sim/kernels/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

/// A drive whose state a test writes by hand, to evaluate single kernels on.
struct Bench {
  Model model;
  SpeedProfile profile;
  State state;
  Work work;
  Pass pass;

  explicit Bench(const char* scene, const std::vector<std::string>& settings = {})
      : model(compile(read_scene(std::string(BELTLIFE_SCENES "/") + scene, settings).scene)),
        state(model.initial),
        work(make_work(model)) {}

  void apply(void (*kernel)(Evaluation&)) {
    Evaluation e{model, profile, state.q, state, work, pass};
    kernel(e);
  }
};

void shake(Bench& b, double place, double speed) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < b.model.belt.nodes; ++i) {
    b.state.q.x[i] += place * unit(random);
    b.state.q.y[i] += place * unit(random);
    b.state.q.vx[i] = speed * unit(random);
    b.state.q.vy[i] = speed * unit(random);
  }
}

// Largest relative deviation of sums and products in another order.
constexpr double reordered = 1e-12;

TEST(AxialKernel, EqualsPlainCode) {
  Bench b("spinning_ring.toml",
          {"belt.elements=61", "solver.scheme=symplectic_euler", "belt.bending_damping_n_m2_s=0"});
  shake(b, 1e-3, 3.0);
  b.apply(belt_ghosts);
  b.apply(belt_axial);
  b.apply(belt_forces);
  const BeltModel& belt = b.model.belt;
  const Coordinates& q = b.state.q;
  const int n = belt.nodes;
  std::vector<double> gx(n), gy(n);
  double scale = 0;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    const double dx = q.x[j] - q.x[i], dy = q.y[j] - q.y[i], length = std::hypot(dx, dy);
    const double rate = ((q.vx[j] - q.vx[i]) * dx + (q.vy[j] - q.vy[i]) * dy) / length;
    const double strain = length / belt.element_length - 1;
    const double force = belt.axial_stiffness * strain + belt.axial_damping * rate / belt.element_length;
    scale = std::max(scale, std::abs(force));
    gx[i] = force * dx / length;
    gy[i] = force * dy / length;
    // Strain is a difference of lengths near 1 here and of metres there: 1e-16 of EA.
    EXPECT_NEAR(b.work.tension[i], force, reordered * belt.axial_stiffness) << i;
    EXPECT_NEAR(b.work.stretch_rate[i], rate, reordered * 10) << i;
  }
  ASSERT_GT(scale, 100);
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n;
    EXPECT_NEAR(b.work.fx[i], gx[i] - gx[before], reordered * belt.axial_stiffness) << i;
    EXPECT_NEAR(b.work.fy[i], gy[i] - gy[before], reordered * belt.axial_stiffness) << i;
  }
}

TEST(BendingKernel, EqualsPlainCouplesOnNeighbouringSegments) {
  Bench b("spinning_ring.toml",
          {"belt.elements=61", "solver.scheme=symplectic_euler", "belt.bending_stiffness_n_m2=0.3",
           "belt.axial_stiffness_n=1e-9", "belt.axial_damping_n_s=0", "ring.speed_rad_s=0"});
  shake(b, 1e-3, 3.0);
  b.apply(belt_ghosts);
  b.apply(belt_axial_turning);
  b.apply(belt_bending);
  b.apply(belt_forces);
  const BeltModel& belt = b.model.belt;
  const Coordinates& q = b.state.q;
  const int n = belt.nodes;
  std::vector<double> fx(n, 0.0), fy(n, 0.0);
  double scale = 0;
  for (int i = 0; i < n; ++i) {  // node i between node a and node c
    const int a = (i + n - 1) % n, c = (i + 1) % n;
    const double px = q.x[i] - q.x[a], py = q.y[i] - q.y[a], pp = px * px + py * py;
    const double sx = q.x[c] - q.x[i], sy = q.y[c] - q.y[i], ss = sx * sx + sy * sy;
    const double turn_p = (px * (q.vy[i] - q.vy[a]) - py * (q.vx[i] - q.vx[a])) / pp;
    const double turn_s = (sx * (q.vy[c] - q.vy[i]) - sy * (q.vx[c] - q.vx[i])) / ss;
    const double angle = std::remainder(std::atan2(sy, sx) - std::atan2(py, px), 2 * std::numbers::pi);
    const double moment =
        (belt.bending_stiffness * angle + belt.bending_damping * (turn_s - turn_p)) / belt.element_length;
    // A couple M on a segment (dx, dy) is the force M (-dy, dx)/l^2 at its end and the opposite at its beginning; the
    // moment turns the segment before by +M and the one after by -M.
    fx[a] -= moment * -py / pp, fy[a] -= moment * px / pp;
    fx[i] += moment * -py / pp, fy[i] += moment * px / pp;
    fx[i] += moment * -sy / ss, fy[i] += moment * sx / ss;
    fx[c] -= moment * -sy / ss, fy[c] -= moment * sx / ss;
  }
  for (int i = 0; i < n; ++i) scale = std::max({scale, std::abs(fx[i]), std::abs(fy[i])});
  ASSERT_GT(scale, 100);
  for (int i = 0; i < n; ++i) {
    EXPECT_NEAR(b.work.fx[i], fx[i], reordered * scale) << i;
    EXPECT_NEAR(b.work.fy[i], fy[i], reordered * scale) << i;
  }
}

TEST(BeltKernels, LeaveMomentumAndAngularMomentumAlone) {
  Bench b("spinning_ring.toml", {"belt.bending_stiffness_n_m2=0.3"});
  shake(b, 1e-4, 3.0);
  for (const auto kernel : {belt_ghosts, belt_axial_turning, belt_bending, belt_forces}) b.apply(kernel);
  double x = 0, y = 0, moment = 0, scale = 0;
  for (int i = 0; i < b.model.belt.nodes; ++i) {
    x += b.work.fx[i];
    y += b.work.fy[i];
    moment += b.state.q.x[i] * b.work.fy[i] - b.state.q.y[i] * b.work.fx[i];
    scale += std::abs(b.work.fx[i]) + std::abs(b.work.fy[i]);
  }
  const double rounding = 1e-14 * scale;  // 200 terms of random sign
  EXPECT_NEAR(x, 0, rounding);
  EXPECT_NEAR(y, 0, rounding);
  EXPECT_NEAR(moment, 0, rounding);
}

/// One belt node at a pulley, for the contact law.
struct Touch : Bench {
  double mu, radius;

  explicit Touch(const std::vector<std::string>& settings = {}) : Bench("two_pulley.toml", settings) {
    state.segments = {{0, 0, 1}};
    state.near[0] = 0;
    mu = model.pulley_friction[0];
    radius = model.pulley_radius[0];
  }

  /// Places node 0 at `depth` below the surface at polar angle a, approaching the centre at `approach` and slipping.
  void place(double depth, double approach, double slip, double a = 0.7) {
    const double r = radius - depth, nx = std::cos(a), ny = std::sin(a);
    state.q.x[0] = model.pulley_x[0] + r * nx;
    state.q.y[0] = model.pulley_y[0] + r * ny;
    const double along = slip + state.q.speed[0] * r;
    state.q.vx[0] = -approach * nx - along * ny;
    state.q.vy[0] = -approach * ny + along * nx;
  }

  void press(double depth, double approach, double slip, double a = 0.7) {
    place(depth, approach, slip, a);
    work.fx[0] = work.fy[0] = 0;
    std::fill(work.torque.begin(), work.torque.end(), 0.0);
    apply(contact);
  }
};

TEST(ContactLaw, HasNoForceWithoutPenetration) {
  Touch t;
  t.pass.commit = true;
  for (const double approach : {-2.0, 0.0, 2.0}) {
    t.press(-1e-9, approach, 1.0);
    EXPECT_EQ(t.work.normal[0], 0);
    EXPECT_EQ(t.work.tangential[0], 0);
    EXPECT_EQ(t.work.fx[0], 0);
    EXPECT_EQ(t.work.torque[0], 0);
  }
}

TEST(ContactLaw, IsPiecewiseLinearAndNeverAdhesive) {
  Touch t({"contact.separation_factor=0.25"});
  const ContactModel& c = t.model.contact;
  for (const double depth : {1e-6, 2e-5, 1e-4})
    for (const double approach : {-3.0, -0.5, -1e-3, 0.0, 1e-3, 0.5, 3.0}) {
      t.press(depth, approach, 0);
      const double share = approach < 0 ? 0.25 : 1.0;
      const double expected = std::max(c.stiffness * depth + share * c.damping * approach, 0.0);
      // Depth is a difference of metres: 1e-17 m on 1e-6 m and more.
      EXPECT_NEAR(t.work.normal[0], expected, 1e-10 * (c.stiffness * depth + c.damping * std::abs(approach)));
      EXPECT_GE(t.work.normal[0], 0);
    }
}

TEST(ContactLaw, FrictionNeverExceedsTheCoulombLimitAndOpposesSlip) {
  Touch t;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  t.pass = {0, 0, 1e-5, true};
  for (int k = 0; k < 20000; ++k) {
    t.state.q.speed[0] = 100 * unit(random);
    t.state.anchor[0] = 1e-4 * unit(random);
    const double slip = std::pow(10.0, 3 * unit(random) - 2) * (unit(random) < 0 ? -1 : 1);
    t.press(1e-4 * unit(random), unit(random), slip, 3 * unit(random));
    EXPECT_LE(std::abs(t.work.tangential[0]), t.mu * t.work.normal[0] * (1 + 1e-14));  // two roundings
  }
  t.state.q.speed[0] = 50;
  for (const double slip : {-1.0, 1.0}) {
    t.state.anchor[0] = 0;
    t.pass.new_weight = 1.0;  // slid far
    t.press(1e-4, 0, slip);
    EXPECT_NEAR(t.work.tangential[0], -slip * t.mu * t.work.normal[0], 1e-12 * t.work.normal[0]);
  }
}

TEST(ContactLaw, SticksOnItsAnchorSpringBelowTheLimit) {
  Touch t;
  const double offset = 3e-6;
  t.state.anchor[0] = offset;
  t.pass.commit = true;
  t.press(1e-4, 0, 0);
  const ContactModel& c = t.model.contact;
  ASSERT_LT(c.friction_stiffness * offset, c.anchor_share * t.mu * t.work.normal[0]);
  EXPECT_NEAR(t.work.tangential[0], -c.friction_stiffness * offset, 1e-9);  // rounding of the node's velocity, 1e-16
  EXPECT_NEAR(t.state.anchor[0], offset, 1e-18);
}

TEST(ContactLaw, DropsItsAnchorAtLiftOffAndKeepsItInATrial) {
  Touch t;
  t.state.anchor[0] = 3e-6;
  t.pass.commit = false;
  t.press(-1e-6, 0, 0);
  EXPECT_EQ(t.state.anchor[0], 3e-6);
  t.pass.commit = true;
  t.press(-1e-6, 0, 0);
  EXPECT_EQ(t.state.anchor[0], 0);
}

TEST(ContactLaw, GivesThePulleyTheOppositeOfTheBeltsForceAndMoment) {
  Touch t;
  t.state.anchor[0] = 3e-6;
  t.press(1e-4, 0.3, 0.4, 2.0);
  const double moment =
      (t.state.q.x[0] - t.model.pulley_x[0]) * t.work.fy[0] - (t.state.q.y[0] - t.model.pulley_y[0]) * t.work.fx[0];
  EXPECT_EQ(t.work.hub_x[0], -t.work.fx[0]);
  EXPECT_EQ(t.work.hub_y[0], -t.work.fy[0]);
  EXPECT_NEAR(t.work.torque[0], -moment, 1e-14 * t.work.normal[0]);  // products in another order
}

TEST(ArmStopsKernel, PushesBeyondItsAngleAndNeverPulls) {
  Bench b("accessory_drive.toml", {"tensioner.stop_lengthening_deg=4", "tensioner.stop_stiffness_n_m_per_rad=1000",
                                   "tensioner.stop_damping_n_m_s_per_rad=2"});
  const double sense = b.model.tensioner.lengthening, stop = 4 * std::numbers::pi / 180;
  const auto torque = [&](double beyond, double rate) {  // in the sense that lengthens the path
    b.state.q.arm_angle = sense * (stop + beyond);
    b.state.q.arm_rate = sense * rate;
    b.work.arm_torque = 7;
    b.apply(arm_stops);
    EXPECT_EQ(b.work.arm_torque, 7 + b.work.arm_stop_torque);
    return sense * b.work.arm_stop_torque;
  };
  EXPECT_EQ(torque(-1e-3, 5), 0);
  EXPECT_NEAR(torque(0.01, 0), -10, 1e-12);  // rounding of the angle times the stiffness
  EXPECT_NEAR(torque(0.01, 3), -16, 1e-12);
  EXPECT_EQ(torque(0.01, -6), 0);  // spring and damper together would pull
  EXPECT_EQ(torque(-1, 0), 0);     // no stop on the other side
}

TEST(OneWayKernel, RemembersWhereItEngagesOnlyInACommittingPass) {
  Bench b("overrunning_alternator.toml");
  const TorsionalSpring& s = b.model.springs[0];
  const auto torque = [&](double twist, bool commit) {
    b.state.q.angle[s.from] = s.sense * twist;
    b.pass.commit = commit;
    b.apply(torsional_springs_one_way);
    return s.sense * b.work.spring_torque[0];
  };
  EXPECT_NEAR(torque(0.01, true), 15, 1e-12);
  EXPECT_EQ(torque(-0.02, false), 0);
  EXPECT_EQ(b.state.free_wheel[0], 0);
  EXPECT_EQ(torque(-0.02, true), 0);
  EXPECT_EQ(b.state.free_wheel[0], -0.02);
  EXPECT_NEAR(torque(-0.01, true), 15, 1e-12);  // engaged again without going back
  EXPECT_EQ(b.work.torque[s.from] + b.work.torque[s.to], 0);
}

TEST(VectorSum, EqualsALongDoubleSum) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int n : {0, 1, 7, 8, 9, 63, 512, 4099}) {
    std::vector<double> values(n);
    long double exact = 0;
    for (double& v : values) exact += v = unit(random);
    // Positive terms in eight lanes: at most n/8 roundings of 1.1e-16 each, of random sign.
    EXPECT_NEAR(sum(values.data(), n), static_cast<double>(exact), 1e-14 * static_cast<double>(exact)) << n;
  }
}

}  // namespace
TEST(TurnAngle, EqualsTheArcTangentOverTheWholeCircle) {
  // The series is cut where its next term is 4e-13 of the angle; rounding adds some 1e-15.
  for (double a = -3.1; a <= 3.1; a += 0.01)
    EXPECT_NEAR(turn_angle(std::sin(a), std::cos(a)), a, 1e-12 * std::abs(a) + 1e-15);
}

}  // namespace beltlife
