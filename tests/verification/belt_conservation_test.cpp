// Owns the verification of exact balances and symmetries: internal forces, contact forces, mirror image, rotation.
#include <random>

#include "drives.h"

namespace beltlife {
namespace {

using drives::Drive;
using drives::pi;

struct Total {
  double force_x = 0, force_y = 0, moment = 0;
  double force_scale = 0, moment_scale = 0;  // sums of absolute values, what rounding is relative to
  void add(double x, double y, double fx, double fy) {
    force_x += fx;
    force_y += fy;
    moment += x * fy - y * fx;
    force_scale += std::abs(fx) + std::abs(fy);
    moment_scale += std::abs(x * fy) + std::abs(y * fx);
  }
};

void shake(Coordinates& q, double metres, double metres_per_second, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < q.x.size(); ++i) {
    q.x[i] += metres * unit(random);
    q.y[i] += metres * unit(random);
    q.vx[i] += metres_per_second * unit(random);
    q.vy[i] += metres_per_second * unit(random);
  }
}

TEST(BeltConservation, InternalForcesAndMomentsSumToZero) {
  SceneSpec scene = drives::ring(100, 1000, 100);
  scene.belt.axial_damping_n_s = 10;
  scene.belt.bending_stiffness_n_m2 = 2;
  scene.belt.bending_damping_n_m2_s = 1e-3;
  for (unsigned seed : {1u, 2u, 3u}) {
    Drive d(scene);
    shake(d.q(), 4e-3, 10, seed);  // elements of 10 mm turn by up to a radian
    d.simulator.evaluate(d.q(), {});
    Total total;
    for (int i = 0; i < d.model.belt.nodes; ++i) total.add(d.q().x[i], d.q().y[i], d.work().fx[i], d.work().fy[i]);
    // Rounding of a hundred terms.
    EXPECT_LT(std::hypot(total.force_x, total.force_y), 1e-12 * total.force_scale);
    EXPECT_LT(std::abs(total.moment), 1e-12 * total.moment_scale);
    std::printf("    force %.1e, moment %.1e of the sums of absolute values\n",
                std::hypot(total.force_x, total.force_y) / total.force_scale,
                std::abs(total.moment) / total.moment_scale);
  }
}

TEST(BeltConservation, PulleysTakeExactlyWhatTheyGiveToTheBelt) {
  SceneSpec scene = drives::shipped("accessory_drive");
  Drive d(scene, drives::ramp(200, 0.01));
  d.run_to(0.01);
  shake(d.q(), 1e-4, 5, 7);
  d.simulator.evaluate(d.q(), {d.simulator.time(), 0, 1e-6, false});
  const Work& w = d.work();
  for (int p = 0; p < d.model.pulleys; ++p) {
    const Centre c = pulley_centre(d.model, d.q(), p);
    Total on_belt;
    for (const ContactSegment& s : d.simulator.state().segments)
      for (int i = s.begin; i < s.end && s.pulley == p; ++i)
        on_belt.add(d.q().x[i] - c.x, d.q().y[i] - c.y, w.contact_x[i], w.contact_y[i]);
    ASSERT_GT(on_belt.force_scale, 1) << d.model.body_name[p] << " touches nothing";
    // Rounding only. Moments are taken about the pulley's centre from forces and positions, not from F_t r.
    EXPECT_NEAR(w.hub_x[p], -on_belt.force_x, 1e-12 * on_belt.force_scale);
    EXPECT_NEAR(w.hub_y[p], -on_belt.force_y, 1e-12 * on_belt.force_scale);
    EXPECT_NEAR(w.belt_torque[p], -on_belt.moment, 1e-12 * on_belt.moment_scale);
  }
}

TEST(BeltConservation, NodeForcesAreBeltAndContactForcesAndNothingElse) {
  Drive d(drives::shipped("two_pulley"), drives::ramp(200, 0.01));
  d.run_to(0.01);
  d.simulator.evaluate(d.q(), {d.simulator.time(), 0, 0, false});
  Total total;
  for (int i = 0; i < d.model.belt.nodes; ++i) total.add(d.q().x[i], d.q().y[i], d.work().fx[i], d.work().fy[i]);
  for (int p = 0; p < d.model.pulleys; ++p) {
    total.add(d.model.pulley_x[p], d.model.pulley_y[p], d.work().hub_x[p], d.work().hub_y[p]);
    total.moment += d.work().belt_torque[p];
  }
  EXPECT_LT(std::hypot(total.force_x, total.force_y), 1e-12 * total.force_scale);
  EXPECT_LT(std::abs(total.moment), 1e-12 * total.moment_scale);
}

SceneSpec quick_baseline() {
  SceneSpec scene = drives::shipped("baseline");
  scene.belt.elements = 128;
  return scene;
}

template <class Map>
void move(SceneSpec& scene, Map map) {
  for (PulleySpec& p : scene.pulley) map(p.x_mm, p.y_mm);
  if (scene.tensioner) map(scene.tensioner->pivot_x_mm, scene.tensioner->pivot_y_mm);
}

// Largest distance between the nodes of one drive and those of another, its points mapped.
template <class Map>
double apart(const Drive& a, const Drive& b, Map map) {
  double most = 0;
  for (int i = 0; i < a.model.belt.nodes; ++i) {
    double x = b.simulator.state().q.x[i], y = b.simulator.state().q.y[i];
    map(x, y);
    most = std::max(most, std::hypot(x - a.simulator.state().q.x[i], y - a.simulator.state().q.y[i]));
  }
  return most;
}

// Rounding differs between the two runs and grows with every contact that opens or closes: some 1e-13 after 0.05 s in
// which the crank reaches 60 rad/s.
constexpr double motion_tolerance = 1e-9;
constexpr double motion_s = 0.05;

TEST(BeltConservation, AMirroredDriveMovesInMirrorImage) {
  SceneSpec scene = quick_baseline(), mirrored = scene;
  const auto mirror = [](double& x, double&) { x = -x; };
  move(mirrored, mirror);
  mirrored.rotation = Rotation::counterclockwise;
  Drive a(scene, drives::ramp(60, 0.04)), b(mirrored, drives::ramp(60, 0.04));
  a.run_to(motion_s);
  b.run_to(motion_s);
  const double off = apart(a, b, mirror);
  std::printf("    after %g s nodes are %.1e m apart\n", motion_s, off);
  EXPECT_LT(off, motion_tolerance);
  for (int body = 0; body < a.model.bodies; ++body)
    EXPECT_NEAR(a.q().angle[body], -b.q().angle[body], motion_tolerance / 0.01) << a.model.body_name[body];
  EXPECT_NEAR(a.q().arm_angle, -b.q().arm_angle, motion_tolerance / 0.09);
  EXPECT_GT(std::abs(a.q().angle[0]), 0.5) << "the drive pulley has hardly turned";
}

TEST(BeltConservation, ARotatedDriveMovesAlike) {
  SceneSpec scene = quick_baseline(), rotated = scene;
  const double angle = 0.7, cos = std::cos(angle), sin = std::sin(angle);
  const auto turn = [&](double sine) {
    return [=](double& x, double& y) {
      const double old = x;
      x = cos * old - sine * y;
      y = sine * old + cos * y;
    };
  };
  move(rotated, turn(sin));
  Drive a(scene, drives::ramp(60, 0.04)), b(rotated, drives::ramp(60, 0.04));
  a.run_to(motion_s);
  b.run_to(motion_s);
  const double off = apart(a, b, turn(-sin));
  std::printf("    after %g s nodes are %.1e m apart\n", motion_s, off);
  EXPECT_LT(off, motion_tolerance);
  for (int body = 0; body < a.model.bodies; ++body)
    EXPECT_NEAR(a.q().angle[body], b.q().angle[body], motion_tolerance / 0.01) << a.model.body_name[body];
  EXPECT_NEAR(a.q().arm_angle, b.q().arm_angle, motion_tolerance / 0.09);
}

}  // namespace
}  // namespace beltlife
