// Owns the verification of one-way springs: impact, overrunning and catching up, energy, restart, quasi-static release.
#include <gtest/gtest.h>

#include "drives.h"
#include "sim/energy.h"
#include "sim/statics/quasi_static.h"

namespace beltlife {
namespace {

using drives::pi;

TorsionalSpringSpec clutch(const char* from, const char* to, double stiffness, double damping) {
  return {.name = "clutch",
          .from = from,
          .to = to,
          .stiffness_n_m_per_rad = stiffness,
          .damping_n_m_s_per_rad = damping,
          .one_way = true};
}

// Two bodies beside a belt that touches nothing; both turn counterclockwise or, mirrored, clockwise.
SceneSpec two_bodies(Scheme scheme, double damping, bool mirrored = false) {
  SceneSpec scene = drives::ring(16, 1000, 0);
  scene.rotation = mirrored ? Rotation::clockwise : Rotation::counterclockwise;
  scene.body = {{.name = "first", .inertia_kg_m2 = 2e-3}, {.name = "second", .inertia_kg_m2 = 5e-4}};
  scene.torsional_spring = {clutch("first", "second", 100, damping)};
  scene.solver.scheme = scheme;
  scene.solver.step_s = 1e-6;
  return scene;
}

class OneWay : public testing::TestWithParam<Scheme> {};

TEST_P(OneWay, PassesOnAnImpactAndLetsGo) {
  const double ja = 2e-3, jb = 5e-4, k = 100, v = 10, reduced = ja * jb / (ja + jb), w = std::sqrt(k / reduced);
  for (const double zeta : {0.0, 0.2})
    for (const bool mirrored : {false, true}) {
      drives::Drive d(two_bodies(GetParam(), 2 * zeta * w * reduced, mirrored));
      const double sense = d.model.sense[0];
      d.q().speed = {sense * v, 0};
      double most = 0, before = 0.5 * ja * v * v, gained = 0;
      d.run_to(0.02, 1, [&] {
        most = std::max(most, sense * d.work().spring_torque[0]);
        EXPECT_GE(sense * d.work().spring_torque[0], 0);
        const double now = stored_energy(d.simulator.view()).total;
        gained = std::max(gained, now - before);
        before = now;
      });
      // Elastic: half a period of the reduced inertia on the spring. Damped, the spring lets go at k d + c d' = 0.
      const double root = std::sqrt(1 - zeta * zeta);
      const double bounce = zeta == 0 ? 1 : std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
      const double mean = ja * v / (ja + jb), first = mean - bounce * v * jb / (ja + jb),
                   second = mean + bounce * v * ja / (ja + jb);
      const double h_w = 1e-6 * w;  // 5e-4: the order of what a step of torque changes
      drives::report("speed of the first body behind the impact, rad/s", sense * d.q().speed[0], first);
      drives::report("speed of the second", sense * d.q().speed[1], second);
      EXPECT_NEAR(sense * d.q().speed[0], first, h_w * v);
      EXPECT_NEAR(sense * d.q().speed[1], second, h_w * v);
      if (zeta == 0) {
        EXPECT_NEAR(most / (v * std::sqrt(k * reduced)), 1, h_w);
      }
      // Symplectic Euler carries its energy with an error that swings by h w/2 of it; a step of that is its square.
      EXPECT_LT(gained, 0.5 * reduced * v * v * h_w * h_w);
      EXPECT_NEAR(ja * sense * d.q().speed[0] + jb * sense * d.q().speed[1], ja * v, 1e-12 * ja * v * 1e3);
    }
}

// The first body's speed is given: up to 100 rad/s, down to 60, and up to 120.
const SpeedProfile up_down_up({0, 0.1, 0.2, 0.25, 0.3, 0.4}, {0, 100, 100, 60, 60, 120});

TEST_P(OneWay, OverrunsADriverThatSlowsDownAndIsDrivenAgainWhenOvertaken) {
  const double k = 100, c = 0.4, j = 5e-4, w = std::sqrt(k / j), zeta = c / (2 * std::sqrt(k * j));
  SceneSpec scene = two_bodies(GetParam(), c);
  scene.driver.emplace();
  scene.driver->body = "first";
  drives::Drive d(scene, up_down_up);
  d.run_to(0.0999, 1, [] {});
  EXPECT_NEAR(d.work().spring_torque[0], j * 1000, 1e-6 * j * 1000);  // accelerated with the ramp
  // Where the ramp ends the twist x0 = J a/k throws the second body ahead; the spring lets go at k d + c d' = 0.
  const double root = std::sqrt(1 - zeta * zeta), phase = std::atan2(root, zeta);
  const double left = std::exp(-zeta / root * phase), x0 = j * 1000 / k, free_speed = 100 + x0 * w * left;
  const double let_go = 0.1 + phase / (w * root), twist = x0 * left * 2 * zeta;
  const auto second_alone = [&] {
    return stored_energy(d.simulator.view()).total - 0.5 * 2e-3 * std::pow(d.q().speed[0], 2);
  };
  double speed = 0, energy = 0, engaged_at = 0;
  while (d.simulator.time() < 0.4) {
    d.simulator.advance();
    const double t = d.simulator.time();
    if (t < 0.12) {
      speed = d.q().speed[1];
      energy = second_alone();
      continue;
    }
    if (d.work().spring_torque[0] > 0 && engaged_at == 0) engaged_at = t;
    if (engaged_at > 0) continue;
    ASSERT_EQ(d.q().speed[1], speed);  // nothing acts on it: not a bit changes
    ASSERT_NEAR(second_alone(), energy, 1e-12);
  }
  drives::report("speed while it overruns, rad/s", speed, free_speed);
  EXPECT_NEAR(speed, free_speed, 1e-4);  // first order: h w = 4e-4 of 0.88
  const double overtaken = 0.3 + (speed - 60) / 600;
  drives::report("driven again at, s", engaged_at, overtaken);
  EXPECT_NEAR(engaged_at, overtaken, 3e-6);  // three steps
  const double ahead =
      free_speed * (overtaken - let_go) - (up_down_up.at(overtaken).angle - up_down_up.at(let_go).angle);
  drives::report("ran ahead by, rad", -d.simulator.state().free_wheel[0], ahead - twist);
  EXPECT_NEAR(-d.simulator.state().free_wheel[0], ahead - twist, 1e-4 * 0.27);  // the error of speed over this time
  EXPECT_NEAR(d.work().spring_torque[0], j * 600, 1e-3 * j * 600);
}

TEST_P(OneWay, GoesOnBitForBitFromAStateSavedWhileItOverruns) {
  SceneSpec scene = two_bodies(GetParam(), 0.4);
  scene.driver.emplace();
  scene.driver->body = "first";
  drives::Drive whole(scene, up_down_up), part(scene, up_down_up);
  whole.run_to(0.28);
  ASSERT_LT(whole.simulator.state().free_wheel[0], -1);
  part.simulator.restore(whole.simulator.state());
  whole.run_to(0.39);
  part.run_to(0.39);
  EXPECT_TRUE(whole.simulator.state() == part.simulator.state());
}

INSTANTIATE_TEST_SUITE_P(EitherScheme, OneWay, testing::Values(Scheme::thesis, Scheme::symplectic_euler),
                         [](const auto& info) { return std::string(enum_name(info.param)); });

// A rotor behind a clutch on the driven pulley.
SceneSpec rotor_drive(bool pulley_drives, double torque) {
  SceneSpec scene = drives::two_pulleys(128, 500, 120, 80, 600);
  scene.body = {{.name = "rotor", .inertia_kg_m2 = 0.002}};
  scene.torsional_spring = {pulley_drives ? clutch("driven", "rotor", 300, 0.3) : clutch("rotor", "driven", 300, 0.3)};
  scene.torque.push_back({"load", "rotor", {100, 10000}, {torque, torque}, {}});
  scene.range = {{"one", 2000, 1}};
  return scene;
}

TEST(OneWayStatics, EngageWhereTheyWouldPushAndReleaseWhereTheyWouldPull) {
  for (const bool pulley_drives : {true, false})
    for (const double torque : {-8.0, 8.0}) {
      const Model m = compile(rotor_drive(pulley_drives, torque));
      const QuasiStaticRange q = solve_quasi_static(m, m.scene.range[0]);
      ASSERT_FALSE(q.error) << *q.error;
      const bool engaged = pulley_drives == (torque < 0);
      EXPECT_NEAR(q.pulleys[1].torque, engaged ? -torque : 0, 1e-6) << pulley_drives << torque;
      EXPECT_EQ(q.released, engaged ? std::vector<std::string>{} : std::vector<std::string>{"clutch"});
      EXPECT_EQ(q.remarks.size(), engaged ? 0u : 1u);
    }
  SceneSpec scene = rotor_drive(true, -8);
  scene.driver->body = "rotor";
  EXPECT_NE(solve_quasi_static(compile(scene), scene.range[0]).error.value_or("").find("one-way spring"),
            std::string::npos);
}

TEST(OneWayStatics, AgreeWithARunWhoseEnergyAccountCloses) {
  SceneSpec scene = rotor_drive(true, -8);
  scene.belt.elements = 256;
  scene.profile = {.settle_s = 0.05, .ramp_s = 0.2, .hold_s = 0.3, .transition_s = 0.2, .evaluate_s = 0.15};
  scene.driver->harmonic = {{"second", 2, 0, {1000}, {60}}};  // its rotor overruns twice a turn
  const Model m = compile(scene);
  const RunRecord record = run(m, plan_range(scene, scene.range[0])).record;
  ASSERT_TRUE(record.status.ok()) << record.status.cause;
  const auto& window = record.windows[0];
  const auto& torque = record.trace.find("spring.clutch.torque_n_m")->values;
  const auto& overrun = record.trace.find("spring.clutch.overrun_rad")->values;
  drives::Mean mean;
  double least = 1e9;
  for (std::size_t i = window.first_sample; i < window.last_sample; ++i) {
    mean.add(torque[i]);
    least = std::min(least, torque[i]);
  }
  drives::report("mean torque through the clutch, N m", mean.value(), 8);
  EXPECT_NEAR(mean.value(), 8, 0.08);  // the samples of 1000 Hz of a torque that swings at 67 Hz
  EXPECT_EQ(least, 0);
  EXPECT_GT(overrun[window.last_sample - 1], overrun[window.first_sample]);
  std::printf("    energy residual %.2g of the throughput\n", window.energy.relative_residual());
  EXPECT_LT(std::abs(window.energy.relative_residual()), 5e-3);
  EXPECT_GT(window.energy[Energy::lost_shafts], 0);
}

}  // namespace
}  // namespace beltlife
