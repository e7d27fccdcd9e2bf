// Owns the verification of the quasi-static solution: against the running simulator, by hand, and by its own balances.
#include "drives.h"
#include "sim/eval/summary.h"
#include "sim/statics/layer.h"
#include "sim/statics/quasi_static.h"
#include "sim/statics/take_up.h"

namespace beltlife {
namespace {

using drives::pi;

RangeSpec range_of(const SceneSpec& scene, const std::string& name) {
  for (const RangeSpec& r : scene.range)
    if (r.name == name) return r;
  throw std::logic_error("no range " + name);
}

// The simulator at constant crank speed, its tensioner free of friction, for a moment of steady running.
void compare(const std::string& name, const std::string& range, int elements, double ramp_s = 0.2) {
  SceneSpec scene = drives::shipped(name);
  scene.belt.elements = elements;
  scene.driver->ripple_scale = 0;
  if (scene.tensioner) scene.tensioner->friction_torque_n_m = 0;
  scene.profile.settle_s = 0.1;
  scene.profile.ramp_s = ramp_s;
  scene.profile.hold_s = 1.5 * ramp_s;
  scene.profile.evaluate_s = 0.75 * ramp_s;
  const RangeSpec spec = range_of(scene, range);
  const Model model = compile(scene);
  const QuasiStaticRange q = solve_quasi_static(model, spec);
  ASSERT_FALSE(q.error) << *q.error;
  const RunRecord record = run(model, plan_range(scene, spec)).record;
  ASSERT_TRUE(record.status.ok()) << record.status.cause;
  const RangeSummary s = summarise(model, record, record.windows[0]);
  for (int p = 0; p < model.pulleys; ++p) {
    drives::report("tension of " + s.spans[p].name + ", N", s.spans[p].tension_n_mean, q.spans[p].tension);
    EXPECT_NEAR(s.spans[p].tension_n_mean / q.spans[p].tension, 1, 0.02) << s.spans[p].name;
    drives::report("hub load of " + s.pulleys[p].name + ", N", s.pulleys[p].hub_load_n, q.pulleys[p].hub_load);
    // On a wrap of some degrees the load is T times the wrap, and an error of T x 0.01 in direction counts.
    const double allowed = 0.02 * q.pulleys[p].hub_load + (q.pulleys[p].wrap < 0.35 ? 0.01 * q.spans[p].tension : 0);
    EXPECT_NEAR(s.pulleys[p].hub_load_n, q.pulleys[p].hub_load, allowed) << s.pulleys[p].name;
    const double direction = std::atan2(q.pulleys[p].hub_y, q.pulleys[p].hub_x) * 180 / pi;
    EXPECT_NEAR(std::remainder(s.pulleys[p].hub_direction_deg - direction, 360), 0, 3) << s.pulleys[p].name;
    // Where in the entry peak, which sinks deeper than T' l0/R, the belt begins to stick is not modelled.
    EXPECT_NEAR(s.pulleys[p].speed_rpm_mean / (q.pulleys[p].speed * 30 / pi), 1, 0.004) << s.pulleys[p].name;
  }
  const auto lost = [&](Energy e) { return s.power_w[static_cast<std::size_t>(e)]; };
  drives::report("losses, W",
                 lost(Energy::lost_belt_bending) + lost(Energy::lost_contact_normal) + lost(Energy::lost_friction),
                 q.loss);
}

// A longer ramp: the turbine's inertia, a hundred times as large behind its gears, must not make the belt slip.
TEST(Statics, QuasiStaticMeansAreThoseOfTheRunningBaseline) { compare("baseline", "B100", 384, 0.4); }
TEST(Statics, QuasiStaticMeansAreThoseOfTheRunningBaselineOnACoarseMesh) { compare("baseline", "B100", 256, 0.4); }
TEST(Statics, QuasiStaticMeansAreThoseOfTheRunningAccessoryDrive) { compare("accessory_drive", "town", 256); }
TEST(Statics, QuasiStaticMeansAreThoseOfTwoRunningPulleys) { compare("two_pulley", "fast", 256); }

TEST(Statics, PowerBalanceClosesAndNothingGainsPower) {
  for (const char* name : {"baseline", "baseline_322n", "alternative_1", "alternative_2", "alternative_3",
                           "accessory_drive", "two_pulley"}) {
    const Model model = compile(drives::shipped(name));
    for (const RangeSpec& range : model.scene.range) {
      const QuasiStaticRange q = solve_quasi_static(model, range);
      ASSERT_FALSE(q.error) << name << " " << range.name << ": " << *q.error;
      const double through = std::max({std::abs(q.driver_power), std::abs(q.table_power), q.loss});
      EXPECT_NEAR(q.driver_power + q.table_power, q.loss, 1e-9 * through) << name << " " << range.name;
      for (const QuasiStaticPulley& p : q.pulleys) {
        EXPECT_GT(p.bending_loss, 0) << name << " " << range.name << " " << p.name;
        EXPECT_GT(p.creep_loss, -1e-6 * through) << name << " " << range.name << " " << p.name;
      }
    }
  }
}

// Two equal pulleys on rigid contact, no bending: T1 + T2 from the length, T1 - T2 from the torque M/R, by hand. The
// strain of either half is its span's, and on the arcs the mean: the sum of both tensions stays 2 T0 but for the part
// of m'v^2 that a belt of fixed length holds itself.
TEST(Statics, SlipSafetyOfTwoPulleysIsTheOneWorkedByHand) {
  const double radius = 0.06, torque = 12, pretension = 600, rpm = 2000;
  SceneSpec scene = drives::two_pulleys(512, 500, 2e3 * radius, 2e3 * radius, pretension);
  scene.contact.stiffness_n_per_m3 = 1e14;
  scene.torque.push_back({"load", "driven", {100, 10000}, {-torque, -torque}, {}});
  const Model model = compile(scene);
  const QuasiStaticRange q = solve_quasi_static(model, {"one", rpm, 1});
  ASSERT_FALSE(q.error) << *q.error;
  const double v = rpm * pi / 30 * radius, centrifugal = 0.4 * v * v;
  const double tight = pretension + torque / radius / 2, slack = pretension - torque / radius / 2;
  const double safety = 0.6 * pi / std::log((tight - centrifugal) / (slack - centrifugal));
  drives::report("slip safety", *q.pulleys[1].slip_safety, safety);
  // Chords of 3 mm on a radius of 60 mm leave the belt 1e-4 of its arcs longer: some newtons less tension.
  EXPECT_NEAR(*q.pulleys[1].slip_safety / safety, 1, 0.02);
  // Creep dissipates T1 - T2 over half the difference of strains, on either pulley.
  const double creep = v * std::pow(torque / radius, 2) / (2 * scene.belt.axial_stiffness_n);
  drives::report("creep loss of one pulley, W", q.pulleys[1].creep_loss, creep);
  EXPECT_NEAR(q.pulleys[1].creep_loss / creep, 1, 0.02);
  EXPECT_NEAR(1 - q.pulleys[1].speed / q.pulleys[0].speed, torque / radius / (scene.belt.axial_stiffness_n + tight),
              2e-5);
}

// The losses that belt_loss_test.cpp measured on the simulator, of the rigid pulley's: 0.87, 0.944, 0.973.
TEST(Statics, LossOnSoftContactRisesToThatOfARigidPulley) {
  const double layer = std::cbrt(1.7e-5 * 20 / 104.0), width = 8 * 3.56e-3;
  double last = 0;
  for (double stiffness : {1e9, 1e10, 1e11, 1e12}) {
    const PassLayer pass = pass_layer(104 / (stiffness * width * layer * layer), 0.2 * pi / layer);
    ASSERT_TRUE(pass.converged);
    std::printf("    k_p %.0e N/m^3: loss %.3f of the rigid pulley's, peak pressure %.2f T'/R\n", stiffness,
                pass.loss(), pass.peak);
    EXPECT_GT(pass.loss(), last);
    last = pass.loss();
  }
  EXPECT_NEAR(last, 1, 0.05);
}

TEST(Statics, LossOnAVanishingArcIsThatOfAPointLoad) {
  // A kink by the angle b: CI v^2 times the integral of k'^2 is b^2/6 of the rigid pulley's loss.
  for (double arc : {0.2, 0.3, 0.5}) EXPECT_NEAR(pass_layer(0.003, arc).loss() / (arc * arc / 6), 1, 0.05);
}

TEST(Statics, TakeUpIsThatOfTheRoute) {
  for (const char* name : {"baseline", "alternative_3", "accessory_drive"}) {
    const Model model = compile(drives::shipped(name));
    const auto rows = take_up(model);
    ASSERT_EQ(rows.size(), 4u);
    const TensionerSpec& t = *model.scene.tensioner;
    const double sense = model.statics.placed.length_per_arm_angle > 0 ? 1 : -1;
    for (const TakeUpRow& row : rows) {
      const auto length = [&](double angle) {
        Route route;
        EXPECT_TRUE(make_route(circles_of(model.scene, model.statics.orientation, angle), route));
        return route.length;
      };
      EXPECT_NEAR(row.path_length, length(row.arm_angle), 1e-12) << name << " " << row.name;
      // One-sided, towards the rest position: beyond the ends of the reach there may be no route.
      const double h = row.arm_angle > model.statics.balance.arm_angle ? -1e-6 : 1e-6;
      const double gradient = (length(row.arm_angle + h) - length(row.arm_angle)) / h;
      const double tension = (sense * *t.spring_torque_n_m - t.spring_rate_n_m_per_rad * row.arm_angle) / gradient;
      EXPECT_NEAR(row.tension, tension, 1e-3 * std::abs(tension) + 1e-3) << name << " " << row.name;
      EXPECT_EQ(row.reason.empty(), row.name == "as placed" || row.name == "at rest") << row.reason;
      if (row.name == "at rest") {
        EXPECT_NEAR(row.unstretched_length, model.statics.unstretched_length, 1e-9) << name;
      }
      std::printf("    %s, %s: arm %.4f rad, path %.1f mm, unstretched %.1f mm, %.0f N %s\n", name, row.name.c_str(),
                  row.arm_angle, 1e3 * row.path_length, 1e3 * row.unstretched_length, row.tension, row.reason.c_str());
    }
    EXPECT_GE(rows.front().path_length, rows.back().path_length);
  }
  EXPECT_TRUE(take_up(compile(drives::shipped("two_pulley"))).empty());
}

// The belt slides over a pulley that cannot turn: T' ratio e^(mu wrap), and the driver's power goes into that.
TEST(Statics, LockedPulleyHoldsTheBeltByItsFrictionAlone) {
  SceneSpec scene = drives::two_pulleys(256, 500, 120, 120, 600);
  scene.contact.stiffness_n_per_m3 = 1e14;
  scene.pulley[1].locked = true;
  const Model model = compile(scene);
  const QuasiStaticRange q = solve_quasi_static(model, {"one", 2000, 1});
  ASSERT_FALSE(q.error) << *q.error;
  const QuasiStaticPulley& locked = q.pulleys[1];
  const double tight = std::max(q.spans[0].tension, q.spans[1].tension) - q.centrifugal;
  const double slack = std::min(q.spans[0].tension, q.spans[1].tension) - q.centrifugal;
  drives::report("T' ratio on the locked pulley", tight / slack, std::exp(0.6 * locked.wrap));
  // T' takes off m'v^2 (1 + T/EA): some thousandths of 63 N on a slack span of 140 N.
  EXPECT_NEAR(tight / slack / std::exp(0.6 * locked.wrap), 1, 5e-3);
  EXPECT_EQ(locked.speed, 0);
  EXPECT_FALSE(locked.slips);  // it slides, as it must: not a belt that could not hold
  EXPECT_NEAR(*locked.slip_safety, 1, 1e-6);
  EXPECT_NEAR(locked.creep_loss / ((tight - slack) * q.belt_speed), 1, 0.01);  // the belt stretches on the way: T/EA
  EXPECT_NEAR(q.driver_power, q.loss, 1e-9 * q.loss);
}

TEST(Statics, LockedArmMakesTheDriveOfAFixedPulley) {
  SceneSpec locked = drives::shipped("accessory_drive");
  locked.tensioner->locked = true;
  locked.belt.balanced_as_placed.reset();
  locked.belt.unstretched_length_mm = 1630;
  const Model model = compile(locked);
  SceneSpec fixed = locked;
  const Circle at = circles_of(locked, model.statics.orientation, model.statics.balance.arm_angle)[1];
  fixed.tensioner.reset();
  fixed.pulley[1].x_mm = 1e3 * at.x;
  fixed.pulley[1].y_mm = 1e3 * at.y;
  const QuasiStaticRange q = solve_quasi_static(model, locked.range[1]);
  const QuasiStaticRange reference = solve_quasi_static(compile(fixed), fixed.range[1]);
  ASSERT_FALSE(q.error || reference.error);
  EXPECT_EQ(*q.arm_angle, model.statics.balance.arm_angle);
  EXPECT_EQ(*q.arm_angle_low, *q.arm_angle_high);  // friction does not move it
  for (int i = 0; i < model.pulleys;
       ++i)  // the centre's millimetres are rounded: 1e-13 m of a path of 64 N a millimetre
    EXPECT_NEAR(q.spans[i].tension, reference.spans[i].tension, 1e-6) << q.spans[i].name;
}

TEST(Statics, PulleyThatWouldSlipIsFlaggedAndNamed) {
  SceneSpec scene = drives::two_pulleys(256, 500, 120, 120, 600);
  scene.torque.push_back({"load", "driven", {100, 10000}, {-60, -60}, {}});
  const QuasiStaticRange q = solve_quasi_static(compile(scene), {"one", 500, 1});
  ASSERT_FALSE(q.error) << *q.error;
  EXPECT_LT(*q.pulleys[1].slip_safety, 1);
  EXPECT_TRUE(q.pulleys[0].slips && q.pulleys[1].slips);
  ASSERT_EQ(q.remarks.size(), 2u);
  EXPECT_NE(q.remarks[1].find("slip on pulley driven"), std::string::npos) << q.remarks[1];
  scene.torque[0].torques_n_m = {-20, -20};
  const QuasiStaticRange held = solve_quasi_static(compile(scene), {"one", 500, 1});
  EXPECT_TRUE(held.remarks.empty());
  EXPECT_FALSE(held.pulleys[0].slips || held.pulleys[1].slips);
}

TEST(Statics, FrictionBandThatCannotBeSolvedSaysSo) {
  SceneSpec scene = drives::shipped("accessory_drive");
  EXPECT_FALSE(solve_quasi_static(compile(scene), scene.range[1]).band_incomplete);
  scene.tensioner->friction_torque_n_m = 40;  // more than the spring's 24: it can hold the arm off the belt
  const QuasiStaticRange q = solve_quasi_static(compile(scene), scene.range[1]);
  ASSERT_FALSE(q.error) << *q.error;
  EXPECT_TRUE(q.band_incomplete);
  ASSERT_EQ(q.remarks.size(), 1u);
  EXPECT_NE(q.remarks[0].find("shortens the belt path"), std::string::npos) << q.remarks[0];
  for (const QuasiStaticSpan& s : q.spans) EXPECT_GT(s.tension_low, 0) << s.name;
}

TEST(Statics, FrictionBandOfALopsidedTensionerIsThatOfEachOfItsTorques) {
  SceneSpec scene = drives::shipped("accessory_drive");
  scene.tensioner->friction_torque_shortening_n_m = 5;
  const QuasiStaticRange q = solve_quasi_static(compile(scene), scene.range[1]);
  const auto with = [&](double torque, bool high) {
    SceneSpec other = drives::shipped("accessory_drive");
    other.tensioner->friction_torque_n_m = torque;
    const auto& span = solve_quasi_static(compile(other), other.range[1]).spans[0];
    return high ? span.tension_high : span.tension_low;
  };
  EXPECT_NEAR(q.spans[0].tension_low, with(3, false), 1e-3);  // what holds back a path that lengthens slackens the belt
  EXPECT_NEAR(q.spans[0].tension_high, with(5, true), 1e-3);
}

TEST(Statics, WhatHasNoSolutionSaysSoInWords) {
  SceneSpec scene = drives::two_pulleys(256, 500, 120, 80, 300);
  const RangeSpec range{"one", 2000, 1};
  scene.torque.push_back({"load", "driven", {100, 10000}, {-60, -60}, {}});
  EXPECT_TRUE(solve_quasi_static(compile(scene), range).error);  // 1500 N of effective tension from 300 N of pretension
  scene.torque.clear();
  scene.driver.reset();
  EXPECT_NE(solve_quasi_static(compile(scene), range).error.value_or("").find("no driver"), std::string::npos);
  EXPECT_TRUE(solve_quasi_static(compile(drives::shipped("spinning_ring")), range).error);
  scene = drives::two_pulleys(256, 500, 120, 120, 300);
  scene.torsional_spring.push_back({"shaft", "driver", "driven", 100, 0});
  EXPECT_NE(solve_quasi_static(compile(scene), range).error.value_or("").find("joined by shafts"), std::string::npos);
}

}  // namespace
}  // namespace beltlife
