// Owns the verification of the belt path: lengths, wraps, spans, static balance, derivative, refusals in words.
#include "sim/route/route.h"

#include <vector>

#include "drives.h"
#include "sim/route/layout.h"

namespace beltlife {
namespace {

using drives::pi;

constexpr double mm = 1e-3, degree = pi / 180;
// The expected lengths, wraps and tensions below are rounded to their last digit printed.
constexpr double length_rounding = 0.05 * mm, wrap_rounding = 0.05 * degree, tension_rounding = 0.5;

void expect_all(const std::vector<double>& values, const std::vector<double>& expected, double unit, double rounding) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i] * unit, rounding) << "index " << i;
}

std::vector<double> spans_of(const Route& route) {
  std::vector<double> lengths;
  for (const Span& s : route.spans) lengths.push_back(s.length);
  return lengths;
}

std::string refusal(const SceneSpec& scene) {
  try {
    solve_statics(scene);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Route, BaselineAsPlacedHasTheWrapsAndSpansOfAn8PK2630) {
  const StaticState s = solve_statics(drives::shipped("baseline"));
  EXPECT_NEAR(s.placed.route.length, 2635.0 * mm, length_rounding);
  expect_all(s.placed.route.wrap, {194.3, 33.9, 45.6, 215.7, 58.7, 103.1, 14.9}, degree, wrap_rounding);
  expect_all(spans_of(s.placed.route), {254.1, 166.4, 363.2, 345.4, 46.0, 218.9, 256.2}, mm, length_rounding);
}

TEST(Route, ABaselineBeltOf2578MillimetresCarries683NewtonsWithTheArm0_39RadOff) {
  SceneSpec scene = drives::shipped("baseline");
  scene.belt.unstretched_length_mm = 2578;
  const StaticState s = solve_statics(scene);
  EXPECT_NEAR(s.balance.route.length, 2590.5 * mm, length_rounding);
  EXPECT_NEAR(std::abs(s.balance.arm_angle), 0.39, 0.005);  // two digits given
  // One in the last digit: half of it rounding, the rest what 0.1 mm of belt, L0's own rounding, moves.
  expect_all(s.balance.route.wrap, {194.3, 33.9, 45.6, 215.7, 28.0, 67.7, 10.2}, degree, 2 * wrap_rounding);
  EXPECT_NEAR(s.balance.route.spans[4].length, 73.9 * mm, 2 * length_rounding);
  EXPECT_NEAR(s.balance.route.spans[5].length, 194.8 * mm, 2 * length_rounding);
  EXPECT_NEAR(s.balance.tension, 683, tension_rounding);
  // A millimetre of belt is 16 N: lengths that round to 2.578 m carry 675 to 691 N, 684 to 686 N among them.
  scene.belt.unstretched_length_mm = 2577;
  const double per_millimetre = solve_statics(scene).balance.tension - s.balance.tension;
  EXPECT_NEAR(per_millimetre, 16, 0.5);
  std::printf("    arm %.5f rad, path %.3f mm, tension %.2f N, %.2f N more a millimetre of belt less\n",
              s.balance.arm_angle, 1e3 * s.balance.route.length, s.balance.tension, per_millimetre);
}

TEST(Route, TheShippedBaselineHasThePretensionOfTheAlternatives) {
  const double tension = solve_statics(drives::shipped("baseline")).balance.tension;
  EXPECT_GT(tension, 682);  // the range that the alternatives' torques span
  EXPECT_LT(tension, 689);
  std::printf("    shipped baseline: %.2f N\n", tension);
}

TEST(Route, TheBeltOf2629MillimetresRestsNearThePrintedPositionAt322Newtons) {
  SceneSpec scene = drives::shipped("baseline");
  scene.belt.unstretched_length_mm = 2629;
  const StaticState s = solve_statics(scene);
  EXPECT_NEAR(s.balance.tension, 322, 1);      // "about"
  EXPECT_NEAR(s.balance.arm_angle, 0, 0.005);  // 0.1 mm of path is 0.0007 rad here
}

struct Alternative {
  const char* scene;
  double length_mm, tension_n;
};

TEST(Route, AlternativesHaveThePathLengthsAndTensionsOfTheirTorques) {
  for (const Alternative& a : {Alternative{"alternative_1", 2697.9, 682}, Alternative{"alternative_2", 2855.5, 687},
                               Alternative{"alternative_3", 3033.1, 689}}) {
    const StaticState s = solve_statics(drives::shipped(a.scene));
    EXPECT_NEAR(s.placed.route.length, a.length_mm * mm, length_rounding) << a.scene;
    EXPECT_NEAR(s.balance.tension, a.tension_n, tension_rounding) << a.scene;
    EXPECT_NEAR(s.balance.arm_angle, 0, 1e-9) << a.scene;  // the unstretched length is solved for this
    std::printf("    %s: %.2f mm, %.2f N\n", a.scene, 1e3 * s.placed.route.length, s.balance.tension);
  }
}

TEST(Route, InBalanceSpringTorqueIsTensionTimesLengthDerivative) {
  for (const char* name : {"baseline", "alternative_1", "alternative_2", "alternative_3", "accessory_drive"}) {
    const SceneSpec scene = drives::shipped(name);
    const StaticState s = solve_statics(scene);
    const double sense = s.placed.length_per_arm_angle > 0 ? 1 : -1;
    const double torque =
        sense * *scene.tensioner->spring_torque_n_m - scene.tensioner->spring_rate_n_m_per_rad * s.balance.arm_angle;
    // The angle is bisected to the last bit; the tension of a stiff belt turns 1e-16 rad into some 1e-9 of itself.
    EXPECT_NEAR(s.balance.tension * s.balance.length_per_arm_angle / torque, 1, 1e-8) << name;
    const double strain = s.balance.route.length / s.unstretched_length - 1;
    EXPECT_NEAR(s.balance.tension / (scene.belt.axial_stiffness_n * strain), 1, 1e-12) << name;
  }
}

TEST(Route, LengthDerivativeMatchesCentralDifferences) {
  for (const char* name : {"baseline", "alternative_1", "alternative_2", "alternative_3", "accessory_drive"}) {
    const SceneSpec scene = drives::shipped(name);
    const StaticState s = solve_statics(scene);
    for (const Layout* layout : {&s.placed, &s.balance}) {
      const double h = 1e-5;
      Route low, high;
      ASSERT_TRUE(make_route(circles_of(scene, s.orientation, layout->arm_angle - h), low));
      ASSERT_TRUE(make_route(circles_of(scene, s.orientation, layout->arm_angle + h), high));
      // Truncation h^2 L''' / 6 and rounding 1e-15 L / h are both near 1e-10.
      EXPECT_NEAR((high.length - low.length) / (2 * h), layout->length_per_arm_angle, 2e-9) << name;
    }
  }
}

TEST(Route, TwoPulleyPathMatchesTheClosedForm) {
  const double distance = 500, r1 = 60, r2 = 40;  // mm
  const StaticState s = solve_statics(drives::two_pulleys(200, distance, 2 * r1, 2 * r2, 600));
  const double lean = std::asin((r1 - r2) / distance);
  const double span = std::sqrt(distance * distance - (r1 - r2) * (r1 - r2));
  const double length = 2 * span + r1 * (pi + 2 * lean) + r2 * (pi - 2 * lean);
  const double rounding = 1e-14;  // a dozen operations on numbers of size 1
  EXPECT_NEAR(s.placed.route.length, length * mm, 10 * rounding);
  expect_all(s.placed.route.wrap, {pi + 2 * lean, pi - 2 * lean}, 1, rounding);
  expect_all(spans_of(s.placed.route), {span, span}, mm, rounding);
  EXPECT_NEAR(s.balance.tension, 600, 1e-8);  // the strain, 4e-3, is a difference of lengths: 1e-16 EA
}

TEST(Route, EveryShippedDriveClosesAsASimpleLoopThatTurnsOnce) {
  for (const char* name : {"baseline", "baseline_322n", "baseline_448n", "alternative_1", "alternative_2",
                           "alternative_3", "two_pulley", "accessory_drive"}) {
    const StaticState s = solve_statics(drives::shipped(name));
    double turning = 0;
    for (std::size_t i = 0; i < s.balance.route.wrap.size(); ++i)
      turning += s.balance.route.circles[i].turn * s.balance.route.wrap[i];
    EXPECT_NEAR(std::abs(turning), 2 * pi, 1e-12) << name;  // rounding of seven arc tangents
  }
}

TEST(Route, OverlappingPulleysAreRefusedByName) {
  SceneSpec scene = drives::shipped("baseline");
  scene.pulley[1].x_mm = -130;
  scene.pulley[1].y_mm = 440;
  const std::string words = refusal(scene);
  EXPECT_NE(words.find("pulleys idler_2 and idler_3 overlap by"), words.npos) << words;
}

TEST(Route, AVanishedWrapIsRefusedByName) {
  SceneSpec scene = drives::two_pulleys(200, 500, 120, 80, 600);
  scene.pulley.insert(scene.pulley.begin() + 1, drives::pulley("idler", 250, -70, 60));
  scene.pulley[1].side = Side::back;
  EXPECT_EQ(refusal(scene), "");  // pressed 10 mm into the lower span
  scene.pulley[1].y_mm = -90;     // 10 mm below it
  const std::string words = refusal(scene);
  EXPECT_NE(words.find("the wrap on idler vanishes: the belt would pass it on its front side by"), words.npos)
      << (words.empty() ? "accepted, but the belt crosses itself" : words);
}

TEST(Route, ABeltThatCouldOnlyCloseByCrossingItselfIsRefused) {
  SceneSpec scene = drives::shipped("baseline");
  scene.pulley[6].y_mm += 65;  // idler_7 no longer reaches the belt between tensioner and drive pulley
  EXPECT_NE(refusal(scene), "") << "accepted with a tension of " << solve_statics(scene).balance.tension << " N";
}

TEST(Route, ABeltThroughAPulleyIsRefusedByName) {
  SceneSpec scene = drives::two_pulleys(200, 500, 120, 80, 600);
  scene.pulley.insert(scene.pulley.begin() + 1, drives::pulley("fan", 140, 200, 80));
  scene.pulley[1].side = Side::back;
  scene.pulley.push_back(drives::pulley("top", 250, 300, 60));
  const std::string words = refusal(scene);
  EXPECT_NE(words.find("the belt between top and driver runs through pulley fan by"), words.npos) << words;
}

TEST(Route, ABeltLongerThanAnyArmPositionTakesUpIsRefused) {
  SceneSpec scene = drives::shipped("baseline");
  scene.belt.unstretched_length_mm = 3500;
  const std::string words = refusal(scene);
  EXPECT_NE(words.find("the belt is slack: even where the arm's spring runs out"), words.npos)
      << (words.empty() ? "accepted with a tension of " + std::to_string(solve_statics(scene).balance.tension) + " N"
                        : words);
}

}  // namespace
}  // namespace beltlife
