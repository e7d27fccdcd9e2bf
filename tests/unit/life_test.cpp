// Owns the tests of stresses, cycles and lives (thesis chapters 5 and 6) and of the energy account.
#include "sim/life/life.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "sim/life/loads.h"

namespace beltlife {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

// The worked example. E = 7 MPa, y = 3.5 mm, theta = 20 deg (tan 0.3639702, cos 0.9396926), strength 10 MPa,
// b = -0.068; EA = 140 kN, so 1 N of tension is 50 Pa of rubber stress; 8 ribs; flank height 0.5 mm, element 5 mm,
// so one flank of one element is 2.5e-6 m^2.
FatigueSpec example_fatigue() { return {.flank_height_mm = 0.5}; }

// Front-wrapped, R = 50 mm, tensions 1400 and 600 N, F_N = 80 N, F_T = 32 N on one element:
//   5.3   axial mean         1000 N x 50 Pa/N                    =  0.050000 MPa
//   5.4   axial alternating   400 N x 50 Pa/N                    =  0.020000 MPa
//   5.5   bending            -7 x 3.5 / 50                       = -0.490000 MPa (the pulley compresses the rib tip)
//   5.8   a rib               80 / 8                             = 10 N
//   5.10  F_z cos(theta)      10 / (2 x 0.3639702)               = 13.73739 N
//   5.11  transverse         -13.73739 / 2.5e-6                  = -5.494955 MPa
//   5.15  a rib               32 / 8                             =  4 N
//   5.16  shear               4 x 0.9396926 / (2 x 2.5e-6)       =  0.7517541 MPa
//   5.19  sigma_m             0.05 - 0.245 - 2.747477            = -2.942477 MPa
//         alternating: x = 0.02 - 0.245 = -0.225, z = -2.747477, tau = 0.3758770
//   5.20  sigma_a^2           0.050625 - 0.6181824 + 7.548632 + 3 x 0.1412836 = 7.404925;  sigma_a = 2.721199 MPa
//   6.4   2.721199 / (10 + 2.942477) = 0.2102534;  ln = -1.559442;  / -0.068 = 22.93297;  N_f = exp(22.93297) / 2
constexpr double front_cycles = 4.556515e9;
PulleyLoad front_pulley(std::string name = "crank") {
  return {.name = std::move(name),
          .side = Side::front,
          .radius_m = 0.05,
          .tension_high_n = 1400,
          .tension_low_n = 600,
          .normal_n = {80, 200, 400},
          .tangential_n = {32, 80, 160},
          .passes = 100};
}

// Back-wrapped, R = 20 mm, tensions 1400 and 1000 N; the contact forces act on the flat side and do not count:
//   axial 0.06 and 0.01, bending +7 x 3.5 / 20 = 1.225, sigma_m = 0.06 + 0.6125 = 0.6725,
//   sigma_a = 0.01 + 0.6125 = 0.6225;  0.6225 / 9.3275 = 0.06673814;  ln = -2.706979;  39.80851;  N_f = 9.718208e16
PulleyLoad back_pulley() {
  PulleyLoad load = front_pulley("idler");
  load.side = Side::back;
  load.radius_m = 0.02;
  load.tension_low_n = 1000;
  return load;
}

RangeLoad example_range(std::vector<PulleyLoad> pulleys, std::string name = "B100", double share = 1) {
  return {.name = std::move(name),
          .duty_share = share,
          .driver_rpm = 1500,
          .driver_radius_m = 0.15,
          .unstretched_length_m = 2.5,
          .element_length_m = 0.005,
          .axial_stiffness_n = 140000,
          .ribs = 8,
          .pulleys = std::move(pulleys)};
}

PulleyLife life_of(const PulleyLoad& load, const FatigueSpec& fatigue) {
  std::optional<std::string> error;
  PulleyLife life = pulley_life(load, example_range({}), fatigue, error);
  EXPECT_FALSE(error) << *error;
  return life;
}

// The worked example carries seven digits; 1 / 0.068 = 14.7 magnifies them in a number of cycles.
constexpr double stress_digits = 2e-7, cycle_digits = 14.7 * stress_digits;
#define EXPECT_RELATIVE(value, expected, tolerance) EXPECT_NEAR(value, expected, std::abs(expected) * (tolerance))

TEST(Life, FrontWrappedPulleyAgreesWithTheWorkedExample) {
  const PulleyLife life = life_of(front_pulley(), example_fatigue());
  EXPECT_RELATIVE(life.axial_mean, 0.05e6, 1e-12);
  EXPECT_RELATIVE(life.axial_alternating, 0.02e6, 1e-12);
  EXPECT_RELATIVE(life.bending, -0.49e6, 1e-12);
  EXPECT_RELATIVE(life.transverse, -5.494955e6, stress_digits);
  EXPECT_RELATIVE(life.shear, 0.7517541e6, stress_digits);
  EXPECT_RELATIVE(life.sigma_m, -2.942477e6, stress_digits);
  EXPECT_RELATIVE(life.sigma_a, 2.721199e6, stress_digits);
  EXPECT_RELATIVE(life.cycles, front_cycles, cycle_digits);
}

TEST(Life, BackWrappedPulleyAgreesWithTheWorkedExampleAndHasNoFlankStress) {
  const PulleyLife life = life_of(back_pulley(), example_fatigue());
  EXPECT_RELATIVE(life.bending, 1.225e6, 1e-12);
  EXPECT_EQ(life.transverse, 0);
  EXPECT_EQ(life.shear, 0);
  EXPECT_RELATIVE(life.sigma_m, 0.6725e6, 1e-12);
  EXPECT_RELATIVE(life.sigma_a, 0.6225e6, 1e-12);
  EXPECT_RELATIVE(life.cycles, 9.718208e16, cycle_digits);
}

TEST(Life, MinersSumAndHoursAgreeWithTheWorkedExample) {
  // 1/N_F = 2 / 4.556515e9 + 1 / 9.7e16, so N_F = 2.278258e9 (6.11). The crank of 0.3 m at 1500 r/min moves
  // pi x 0.3 x 1500 x 60 = 84823.00 m of belt an hour; rounds of 2.5 m: 2.278258e9 x 2.5 / 84823.00 = 67147.4 h (6.12).
  const RangeLife life =
      range_life(example_range({front_pulley(), back_pulley(), front_pulley("drive")}), example_fatigue());
  EXPECT_RELATIVE(life.cycles, 2.278258e9, cycle_digits);
  EXPECT_RELATIVE(life.life_h, 67147.4, cycle_digits);
  EXPECT_NEAR(life.pulleys[0].damage_share, 0.5, 1e-7);  // the idler's share is 2e-8
  EXPECT_EQ(life.pulleys[0].damage_share, life.pulleys[2].damage_share);
  EXPECT_LT(life.pulleys[1].damage_share, 1e-7);
}

TEST(Life, PassForceSelectsWhichContactForceCounts) {
  FatigueSpec fatigue = example_fatigue();
  const double sampled = life_of(front_pulley(), fatigue).transverse;
  fatigue.pass_force = PassForce::resolved;  // 200 N for 80 N
  EXPECT_RELATIVE(life_of(front_pulley(), fatigue).transverse, 2.5 * sampled, 1e-14);
  fatigue.pass_force = PassForce::percentile_99;
  EXPECT_RELATIVE(life_of(front_pulley(), fatigue).shear, 5 * 0.7517541e6, stress_digits);
}

TEST(Life, SinesInComponentsEqualsSinesInPrincipalStresses) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> force(1, 500);
  for (int i = 0; i < 50; ++i) {
    PulleyLoad load = front_pulley();
    load.tension_high_n = 1000 + force(generator);
    load.normal_n[0] = force(generator);
    load.tangential_n[0] = force(generator);
    const PulleyLife life = life_of(load, example_fatigue());
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  // axes: along the belt, across the rib, radial
    stress(0, 0) = life.axial_alternating + life.bending / 2;
    stress(1, 1) = life.transverse / 2;
    stress(0, 1) = stress(1, 0) = life.shear / 2;
    const Eigen::Vector3d s = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress).eigenvalues();
    const double sines =
        std::sqrt((std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) / 2);
    EXPECT_RELATIVE(life.sigma_a, sines, 1e-13);  // rounding of an eigenvalue solver
  }
}

TEST(Life, IsInfiniteWithoutAlternatingStressAndWithoutMotion) {
  PulleyLoad load = back_pulley();
  load.tension_low_n = load.tension_high_n;
  load.radius_m = endless;  // straight belt: no bending
  const RangeLoad steady = example_range({load});
  const RangeLife life = range_life(steady, example_fatigue());
  EXPECT_EQ(life.pulleys[0].sigma_a, 0);
  EXPECT_EQ(life.pulleys[0].cycles, endless);
  EXPECT_EQ(life.pulleys[0].damage_share, 0);
  EXPECT_EQ(life.life_h, endless);
  EXPECT_EQ(duty_cycle_life({steady}, example_fatigue()).life_h, endless);

  RangeLoad standing = example_range({front_pulley()});
  standing.driver_rpm = 0;
  standing.pulleys[0].normal_n[0] = std::nan("");  // no pass was recorded
  EXPECT_EQ(range_life(standing, example_fatigue()).life_h, endless);
}

TEST(Life, MeanStressAtTheStrengthIsAnErrorInWordsWithBothNumbers) {
  FatigueSpec fatigue = example_fatigue();
  fatigue.strength_mpa = 0.5;  // below the idler's mean of 0.6725 MPa
  const Life life = duty_cycle_life({example_range({front_pulley(), back_pulley()})}, fatigue);
  ASSERT_TRUE(life.error);
  for (const char* word : {"range B100", "pulley idler", "0.6725 MPa", "0.5 MPa", "fatigue.strength_mpa"})
    EXPECT_NE(life.error->find(word), std::string::npos) << *life.error;
  EXPECT_EQ(life.error->find("crank"), std::string::npos) << "the crank's mean stress is compressive";
  EXPECT_TRUE(std::isnan(life.life_h));
  EXPECT_TRUE(std::isnan(life.ranges[0].life_h));
}

TEST(Life, MissingLoadsAreAnErrorThatSaysWhatToDo) {
  PulleyLoad load = front_pulley();
  load.normal_n[0] = std::nan("");
  load.passes_unsampled = load.passes;
  EXPECT_NE(range_life(example_range({load}), example_fatigue()).error->find("solver.sample_rate_hz"),
            std::string::npos);
  load.passes = load.passes_unsampled = 0;
  EXPECT_NE(range_life(example_range({load}), example_fatigue()).error->find("profile.evaluate_s"), std::string::npos);
  load.tension_high_n = std::nan("");
  EXPECT_NE(range_life(example_range({load}), example_fatigue()).error->find("tension"), std::string::npos);
}

TEST(Life, DutyCycleAddsDamagesByShare) {
  PulleyLoad hard = front_pulley();
  hard.normal_n[0] *= 1.2;
  const RangeLoad a = example_range({front_pulley()}, "idle", 0.25);
  const RangeLoad b = example_range({hard}, "B100", 0.75);
  const double ha = range_life(a, example_fatigue()).life_h, hb = range_life(b, example_fatigue()).life_h;
  const Life life = duty_cycle_life({a, b}, example_fatigue());
  EXPECT_RELATIVE(life.life_h, 1 / (0.25 / ha + 0.75 / hb), 1e-14);  // (6.13)
  EXPECT_RELATIVE(life.log10_life_h, std::log10(life.life_h), 1e-15);
  EXPECT_RELATIVE(life.ranges[1].damage_share, 0.75 / hb * life.life_h, 1e-14);
  EXPECT_NEAR(life.ranges[0].damage_share + life.ranges[1].damage_share, 1, 1e-14);
  // Part of a duty cycle: the life of the part.
  EXPECT_RELATIVE(duty_cycle_life({b}, example_fatigue()).life_h, hb, 1e-14);
}

TEST(Life, SharesOfZeroEverywhereAreEqualSharesAndElsewhereDoNotCount) {
  PulleyLoad hopeless = back_pulley();
  hopeless.radius_m = 1e-3;  // bending far above the strength
  RangeLoad a = example_range({front_pulley()}, "idle", 0), b = example_range({back_pulley()}, "B100", 0);
  const double ha = range_life(a, example_fatigue()).life_h, hb = range_life(b, example_fatigue()).life_h;
  EXPECT_RELATIVE(duty_cycle_life({a, b}, example_fatigue()).life_h, 1 / (0.5 / ha + 0.5 / hb), 1e-14);

  a.duty_share = 1;
  b.pulleys = {hopeless};
  const Life life = duty_cycle_life({a, b}, example_fatigue());
  EXPECT_FALSE(life.error);
  EXPECT_TRUE(life.ranges[1].error);
  EXPECT_RELATIVE(life.life_h, ha, 1e-14);
  EXPECT_TRUE(duty_cycle_life({}, example_fatigue()).error);
}

TEST(FlankHeight, IsFoundForTheLifeThatItGives) {
  const std::vector<RangeLoad> ranges{example_range({front_pulley(), back_pulley()})};
  for (const double height_mm : {0.06, 0.5, 3.0}) {
    FatigueSpec fatigue = example_fatigue();
    fatigue.flank_height_mm = height_mm;
    const double life_h = duty_cycle_life(ranges, fatigue).life_h;
    const auto found = flank_height_for_life(ranges, example_fatigue(), life_h);
    ASSERT_TRUE(found) << height_mm;
    EXPECT_RELATIVE(*found, height_mm, 1e-12);  // bisected to neighbouring doubles; life is much steeper than height
  }
}

TEST(FlankHeight, IsTheSmallestWhereLifeFallsAgainBeyondItsTurningPoint) {
  // A front pulley with x = -(0.245 - 0.02) MPa: README.md puts the turning point at u = 0.1101 MPa, 12.5 mm for
  // 80 N; at half the force it lies at 6.24 mm, inside the interval.
  PulleyLoad load = front_pulley();
  load.normal_n[0] /= 2;
  load.tangential_n[0] /= 2;
  const std::vector<RangeLoad> ranges{example_range({load})};
  const auto life_at = [&](double height_mm) {
    FatigueSpec fatigue = example_fatigue();
    fatigue.flank_height_mm = height_mm;
    return duty_cycle_life(ranges, fatigue).life_h;
  };
  constexpr double turning_point_mm = 6.24026;
  EXPECT_GT(life_at(turning_point_mm), life_at(0.999 * turning_point_mm));
  EXPECT_GT(life_at(turning_point_mm), life_at(1.001 * turning_point_mm));
  const auto found = flank_height_for_life(ranges, example_fatigue(), life_at(9));
  ASSERT_TRUE(found);
  EXPECT_LT(*found, turning_point_mm);
  EXPECT_RELATIVE(life_at(*found), life_at(9), 1e-11);
}

TEST(FlankHeight, IsAbsentWhereNoneGivesTheLife) {
  const std::vector<RangeLoad> ranges{example_range({front_pulley()})};
  EXPECT_FALSE(flank_height_for_life(ranges, example_fatigue(), 1e300));
  EXPECT_FALSE(flank_height_for_life(ranges, example_fatigue(), 0));
  EXPECT_FALSE(flank_height_for_life(ranges, example_fatigue(), endless));
  EXPECT_FALSE(flank_height_for_life({example_range({back_pulley()})}, example_fatigue(), 1000));
}

// Three pulleys, four samples of which the middle two are the window.
struct Recorded {
  SceneSpec scene;
  RunRecord run;
  Recorded() {
    scene.belt.elements = 100;
    scene.belt.axial_stiffness_n = 140000;
    scene.belt.ribs = 8;
    scene.pulley.resize(3);
    scene.pulley[0].name = "a";
    scene.pulley[0].pitch_diameter_mm = 100;
    scene.pulley[1].name = "b";
    scene.pulley[1].pitch_diameter_mm = 60;
    scene.pulley[2].name = "c";
    scene.driver.emplace().body = "a";
    run.trace.time_s = {0, 1, 2, 3};
    run.trace.channels = {{"span.a-b.tension_n", "N", "", {9000, 500, 540, 0}},
                          {"span.b-c.tension_n", "N", "", {0, 800, 700, 9000}},
                          {"span.c-a.tension_n", "N", "", {9000, 600, 650, 0}},
                          {"a.speed_rpm", "r/min", "", {0, -600, -600, 0}}};
    WindowRecord window;
    window.range = "B100";
    window.duty_share = 0.8;
    window.crank_rpm = -600;
    window.first_sample = 1;
    window.last_sample = 3;
    window.passes.resize(3);
    PassForces& passes = window.passes[0];
    for (int i = 0; i <= 100; ++i) passes.normal_resolved.push_back(100 - i);
    passes.tangential_resolved = {7, 9};
    passes.normal_sampled = {10, 20, 60};
    passes.tangential_sampled = {4, 8};
    passes.unsampled = 98;
    run.windows = {window};
  }
};

TEST(Loads, TakeTheExtremesOfTheHighAndLowSideInsideTheWindow) {
  const Recorded recorded;
  const RangeLoad load = range_load(recorded.scene, 2.5, recorded.run, recorded.run.windows[0]);
  const double high[] = {650, 800, 800};  // on c-a (mean 625 against 520), b-c (750 against 520), b-c (750 against 625)
  const double low[] = {500, 500, 600};   // on a-b, a-b, c-a
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(load.pulleys[i].tension_high_n, high[i]);
    EXPECT_EQ(load.pulleys[i].tension_low_n, low[i]);
  }
  EXPECT_EQ(load.element_length_m, 0.025);
  EXPECT_EQ(load.duty_share, 0.8);
  EXPECT_EQ(load.pulleys[1].radius_m, 0.03);
}

TEST(Loads, AverageTheMaximaOfThePassesAndTakeTheirPercentile) {
  const Recorded recorded;
  const RangeLoad load = range_load(recorded.scene, 2.5, recorded.run, recorded.run.windows[0]);
  const PulleyLoad& pulley = load.pulleys[0];
  EXPECT_EQ(pulley.normal_n[static_cast<int>(PassForce::sampled)], 30);
  EXPECT_EQ(pulley.normal_n[static_cast<int>(PassForce::resolved)], 50);
  EXPECT_EQ(pulley.normal_n[static_cast<int>(PassForce::percentile_99)], 99);
  EXPECT_EQ(pulley.tangential_n[static_cast<int>(PassForce::sampled)], 6);
  EXPECT_NEAR(pulley.tangential_n[static_cast<int>(PassForce::percentile_99)], 8.98, 1e-14);  // between 7 and 9
  EXPECT_EQ(pulley.passes, 101u);
  EXPECT_EQ(pulley.passes_unsampled, 98u);
  EXPECT_TRUE(std::isnan(load.pulleys[1].normal_n[0])) << "no pass is no load, not a load of zero";
}

TEST(Loads, BeltSpeedComesFromTheDrivenPulleyOrElseFromTheFirst) {
  Recorded recorded;
  // pi x 0.1 m x 600 / 60 s = pi m/s, whichever way the belt runs
  EXPECT_NEAR(range_load(recorded.scene, 2.5, recorded.run, recorded.run.windows[0]).belt_speed_m_s, M_PI, 1e-14);
  recorded.scene.driver->body = "motor";
  recorded.run.windows[0].crank_rpm = 1e4;  // of the motor
  EXPECT_NEAR(range_load(recorded.scene, 2.5, recorded.run, recorded.run.windows[0]).belt_speed_m_s, M_PI, 1e-14);
  recorded.run.trace.channels.clear();
  EXPECT_THROW(range_load(recorded.scene, 2.5, recorded.run, recorded.run.windows[0]), std::logic_error);
}

TEST(EnergyAccount, ResidualIsWorkMinusLossesMinusChangeOfStored) {
  EnergyAccount account;
  EXPECT_EQ(account.relative_residual(), 0);
  account[Energy::work_driver] = -200;  // the drive pushes the crank
  account[Energy::work_torque_tables] = 1000;
  for (auto loss = Energy::lost_belt_axial; loss != Energy::stored; loss = Energy{static_cast<int>(loss) + 1})
    account[loss] = 100;
  account[Energy::stored] = -50;
  EXPECT_EQ(account.throughput(), 1000 + 50);  // the stores gave up 50
  EXPECT_EQ(account.residual(), -200 + 1000 - 8 * 100 + 50);
  EXPECT_DOUBLE_EQ(account.relative_residual(), 50.0 / 1050);
}

}  // namespace
}  // namespace beltlife
