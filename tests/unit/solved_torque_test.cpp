// Owns the tests of a spring torque that is solved for a pretension, and of the layout's base, which is stated so.
#include <cmath>
#include <numbers>

#include "optimize/layout/layout_base.h"
#include "sim/model.h"
#include "sim/scene/pulley_place.h"
#include "sim/statics/quasi_static.h"
#include "tests/unit/scene_fixture.h"

namespace beltlife {
namespace {

using scene_fixture::message_of;
using scene_fixture::problems_of;
using scene_fixture::replaced;

constexpr double pi = std::numbers::pi;
constexpr double distance = 0.5, radius = 0.06, arm = 0.2, tension = 700, stiffness = 1e5, rate = 30;

// Two equal pulleys; the right one on an arm that stands upright on its pivot. Turned by a, counterclockwise, the
// centres are d(a) apart and the path is 2 d + 2 pi r.
const std::string drive = R"(format = 1
[belt]
elements = 64
pretension_n = 700
balanced_as_placed = true
axial_stiffness_n = 1e5
mass_kg_per_m = 0.1
ribs = 6
friction_front = 0.6
friction_back = 0.5
[[pulley]]
name = "crank"
x_mm = 0
y_mm = 0
pitch_diameter_mm = 120
side = "front"
inertia_kg_m2 = 0.01
[[pulley]]
name = "rider"
x_mm = 500
y_mm = 0
pitch_diameter_mm = 120
side = "front"
inertia_kg_m2 = 0.001
mass_kg = 1
[tensioner]
pulley = "rider"
pivot_x_mm = 500
pivot_y_mm = -200
mass_kg = 0.5
inertia_kg_m2 = 1e-4
spring_rate_n_m_per_rad = 30
)";
const std::string balanced = "balanced_as_placed = true\n";

double centres(double a) { return std::hypot(distance - arm * std::sin(a), arm * std::cos(a) - arm); }
double path(double a) { return 2 * centres(a) + 2 * pi * radius; }
double path_per_angle(double a) { return 2 * (-distance * arm * std::cos(a) + arm * arm * std::sin(a)) / centres(a); }

SceneSpec with_length(double unstretched) {
  SceneSpec scene = parse_scene(drive, "drive");
  scene.belt.balanced_as_placed.reset();
  scene.belt.unstretched_length_mm = 1e3 * unstretched;
  return scene;
}

SceneSpec shipped(const std::string& name) {
  return read_scene(std::string(BELTLIFE_SCENES "/") + name + ".toml").scene;
}

TEST(SolvedTorque, AsPlacedIsPretensionTimesTheArmsLeverage) {
  const StaticState s = solve_statics(parse_scene(drive, "drive"));
  const double rounding = 1e-13;  // of some dozen operations
  EXPECT_NEAR(s.spring_torque, tension * 2 * arm, rounding * 1e3);
  EXPECT_NEAR(s.unstretched_length, path(0) / (1 + tension / stiffness), rounding);
  EXPECT_NEAR(s.balance.tension, tension, stiffness * 1e-14);  // the strain's rounding times EA
  EXPECT_EQ(s.balance.arm_angle, 0);
}

TEST(SolvedTorque, WithAGivenLengthTheArmRestsWhereThePathFitsAndTheTorqueIsThatOfThePlacedPosition) {
  for (double a : {0.2, 0.05, -0.05}) {  // counterclockwise shortens the path
    const StaticState s = solve_statics(with_length(path(a) / (1 + tension / stiffness)));
    EXPECT_NEAR(s.balance.arm_angle, a, 1e-13);     // bisected to the last bit; the path's own rounding over its slope
    EXPECT_NEAR(s.balance.tension, tension, 1e-8);  // 1e-14 of the path times EA
    EXPECT_NEAR(s.spring_torque, -tension * path_per_angle(a) - rate * a, 1e-9) << a;
    const double at_rest = s.spring_torque + rate * a;  // more, where the arm is turned so that the path is shorter
    EXPECT_NEAR(at_rest / -s.balance.length_per_arm_angle, tension, 1e-8) << a;
  }
}

TEST(SolvedTorque, WithAnEffectiveLengthIsThatOfTheLengthAlongTheCord) {
  const SceneSpec plain = with_length(1.365);
  SceneSpec effective = plain;
  effective.belt.unstretched_length_mm.reset();
  effective.belt.effective_line_differential_mm = 2;
  effective.belt.effective_length_mm = 1365 - 4 * pi;
  validate(effective);
  EXPECT_NEAR(solve_statics(effective).spring_torque, solve_statics(plain).spring_torque, 1e-9);
}

TEST(SolvedTorque, OfTheCatalogueTakesTheLengthNearestToThatOfAnArmAsPlaced) {
  const double wanted = 1e3 * path(0) / (1 + tension / stiffness);
  SceneSpec scene = parse_scene(drive, "drive");
  scene.belt.balanced_as_placed.reset();
  scene.belt.length_catalogue_mm = {wanted + 20, wanted - 3, wanted + 4, 100};
  validate(scene);
  const StaticState s = solve_statics(scene), same = solve_statics(with_length(1e-3 * (wanted - 3)));
  EXPECT_NEAR(1e3 * s.unstretched_length, wanted - 3, 1e-9);
  EXPECT_NEAR(s.spring_torque, same.spring_torque, 1e-9);
  EXPECT_LT(std::abs(s.balance.arm_angle - 3e-3 * (1 + tension / stiffness) / (2 * arm)), 1e-4);  // second order
  EXPECT_EQ(scene_fixture::values_of(parse_scene(write_scene(scene), "again")), scene_fixture::values_of(scene));
}

TEST(SolvedTorque, StandsInTheModelWhichStatesTheSameDriveAgain) {
  SceneSpec catalogue = parse_scene(drive, "drive");
  catalogue.belt.balanced_as_placed.reset();
  catalogue.belt.length_catalogue_mm = {1360, 1370, 1380};
  for (const SceneSpec& scene : {parse_scene(drive, "drive"), with_length(1.365), catalogue}) {
    const Model model = compile(scene);
    ASSERT_TRUE(model.scene.tensioner->spring_torque_n_m);
    EXPECT_EQ(*model.scene.tensioner->spring_torque_n_m, model.statics.spring_torque);
    EXPECT_EQ(model.tensioner.spring_torque, -model.statics.spring_torque);  // clockwise lengthens
    ASSERT_NO_THROW(validate(model.scene));
    const Model again = compile(model.scene);
    EXPECT_NEAR(again.statics.balance.tension, tension, 1e-6);  // EA times the angle's rounding
    EXPECT_NEAR(again.statics.balance.arm_angle, model.statics.balance.arm_angle, 1e-9);
    EXPECT_NEAR(again.belt.unstretched_length, model.belt.unstretched_length, 1e-12);
  }
}

TEST(SolvedTorque, OfASceneThatStatesItIsThatOne) {
  SceneSpec scene = shipped("baseline");
  EXPECT_EQ(get_number(scene, "tensioner.spring_torque_n_m"), 45.368);
  set_number(scene, "tensioner.spring_torque_n_m", 47);
  EXPECT_EQ(solve_statics(scene).spring_torque, 47);
  EXPECT_EQ(compile(scene).scene.tensioner->spring_torque_n_m, 47);
  EXPECT_EQ(compile(scene).scene.belt.unstretched_length_mm, scene.belt.unstretched_length_mm);
}

struct Mistake {
  const char *from, *to, *key, *what;
};

TEST(SolvedTorque, IsRefusedWhereTheSceneSaysTooMuchOrTooLittle) {
  const std::string given = replaced(drive, "[tensioner]\n", "[tensioner]\nspring_torque_n_m = 20\n");
  const char* const torque = "tensioner.spring_torque_n_m";
  const char* const length = "belt.unstretched_length_mm";
  for (const Mistake& m : {
           Mistake{"pretension_n = 700\n", "", torque, "missing key"},
           Mistake{"pretension_n = 700\nbalanced_as_placed = true\n", "", torque, "missing key"},
           Mistake{"pretension_n = 700\nbalanced_as_placed = true\n", "unstretched_length_mm = 1370\n", torque,
                   "missing"},
           Mistake{"balanced_as_placed = true\n", "", torque, "pretension_n alone does not say where the arm rests"},
           Mistake{"balanced_as_placed = true\n", "balanced_as_placed = false\n", torque, "alone"},
           Mistake{"[belt]\n", "[belt]\nunstretched_length_mm = 1370\n", length, "2 of four ways to say where"},
           Mistake{"[belt]\n", "[belt]\nlength_catalogue_mm = [1370]\n", length, "2 of four ways to say where"},
           Mistake{"balanced_as_placed = true", "length_catalogue_mm = []", "belt.length_catalogue_mm", "no entries"},
           Mistake{"balanced_as_placed = true", "length_catalogue_mm = [-5]", "belt.length_catalogue_mm.0", "limits"},
           Mistake{"[tensioner]\n", "[tensioner]\narm_angle_deg = 90\n", "tensioner.arm_length_mm", "missing key"},
           Mistake{"[tensioner]\n", "[tensioner]\narm_length_mm = 90\n", "tensioner.arm_angle_deg", "missing key"},
       }) {
    const auto problems = problems_of(replaced(drive, m.from, m.to));
    ASSERT_EQ(problems.size(), 1u) << m.to << message_of([&] { parse_scene(replaced(drive, m.from, m.to), "t"); });
    EXPECT_EQ(problems[0].key, m.key) << m.to;
    EXPECT_NE(problems[0].what.find(m.what), std::string::npos) << problems[0].what;
    EXPECT_FALSE(problems[0].allowed.empty());
    EXPECT_GT(problems[0].line, 0);
  }
  ASSERT_EQ(problems_of(given).size(), 1u);
  EXPECT_EQ(problems_of(given)[0].key, length);
  EXPECT_NE(problems_of(given)[0].allowed.find("without tensioner.spring_torque_n_m"), std::string::npos);
  const auto idle = problems_of(replaced(replaced(given, "pretension_n = 700\n", ""), balanced,
                                         "unstretched_length_mm = 1370\nlength_catalogue_mm = [1370]\n"));
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_EQ(idle[0].key, "belt.length_catalogue_mm");
  SceneSpec unlisted = parse_scene(drive, "drive");
  unlisted.belt.balanced_as_placed.reset();
  unlisted.belt.length_catalogue_mm = {-1};
  EXPECT_NE(message_of([&] { validate(unlisted); }).find("length_catalogue_mm.0"), std::string::npos);
}

TEST(SolvedTorque, IsRefusedInWordsWhereNoArmPositionOrNoSpringCanHoldTheBelt) {
  const auto words = [](const SceneSpec& scene) { return message_of([&] { solve_statics(scene); }); };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const double longest = 2 * std::hypot(distance, arm) + 2 * arm + 2 * pi * radius;
  EXPECT_TRUE(has(words(with_length(1.01 * longest)), "belt.unstretched_length_mm: no arm angle gives"));
  SceneSpec stopped = with_length(path(0.2) / (1 + tension / stiffness));
  stopped.tensioner->stop_shortening_deg = 10;
  EXPECT_TRUE(has(words(stopped), "tensioner.stop_shortening_deg: the arm would rest 1.5 degrees beyond"));
  stopped.tensioner->stop_shortening_deg = 12;
  EXPECT_EQ(words(stopped), "");
  SceneSpec steep = with_length(path(0.2) / (1 + tension / stiffness));
  steep.tensioner->spring_rate_n_m_per_rad = 5000;
  EXPECT_TRUE(has(words(steep), "tensioner.spring_torque_n_m: to hold 700 N"));
  SceneSpec stretched = parse_scene(drive, "drive");
  stretched.belt.pretension_n = 2e4;
  EXPECT_TRUE(has(words(stretched), "belt.pretension_n: the belt would be stretched by 20 %"));
}

TEST(ArmAngle, PlacesThePulleyThatTheArmCarries) {
  const SceneSpec plain = parse_scene(drive, "drive");
  SceneSpec angled = parse_scene(replaced(replaced(drive, "x_mm = 500", "x_mm = -77"), "[tensioner]\n",
                                          "[tensioner]\narm_angle_deg = 90\narm_length_mm = 200\n"),
                                 "angled");
  EXPECT_NEAR(solve_statics(angled).spring_torque, solve_statics(plain).spring_torque, 1e-11);
  const Model model = compile(angled);
  EXPECT_NEAR(model.pulley_x[1], 0.5, 1e-15);
  EXPECT_EQ(model.scene.pulley[1].x_mm, 1e3 * model.pulley_x[1]);
  set_number(angled, "tensioner.arm_angle_deg", 90 + 180 / pi * 0.1);
  EXPECT_NEAR(solve_statics(angled).placed.route.length, path(0.1), 1e-13);
  EXPECT_NEAR(pulley_place(angled, angled.pulley[1]).x_mm, 500 - 200 * std::sin(0.1), 1e-10);
  EXPECT_EQ(pulley_place(angled, angled.pulley[0]).x_mm, 0);
}

// Torque with which spring and stops turn the arm, at its angle from the base's place.
double arm_torque(const Model& m, double angle) {
  return m.tensioner.spring_torque - m.tensioner.spring_rate * angle + m.tensioner.stops.elastic_torque(angle);
}

class LayoutBase : public testing::TestWithParam<const char*> {};

TEST_P(LayoutBase, IsTheSameDrive) {
  SceneSpec scene = shipped(GetParam());
  scene.belt.bending_damping_n_m2_s = 0;  // it knows nothing of the arm, and takes nearly all the time
  const SceneSpec base = layout_base(scene);
  ASSERT_NO_THROW(validate(base));
  ASSERT_TRUE(base.belt.pretension_n && !base.belt.unstretched_length_mm && !base.belt.effective_length_mm);
  const Model was = compile(scene), is = compile(base);
  const double turned = was.statics.balance.arm_angle;
  EXPECT_NEAR(is.statics.balance.tension / was.statics.balance.tension, 1, 1e-9);
  EXPECT_NEAR(is.belt.unstretched_length, was.belt.unstretched_length, 1e-12);  // m, of lengths of some 3 m
  EXPECT_EQ(is.statics.balance.arm_angle, 0);
  if (base.tensioner) {
    EXPECT_FALSE(base.tensioner->spring_torque_n_m);
    for (double angle = -0.5; angle < 0.5; angle += 0.01)
      // The balance angle of the original is bisected to 1e-16 rad, which EA turns into some 1e-8 of the torque; a stop
      // is placed to 1e-15 rad and has 3e4 N m/rad.
      ASSERT_NEAR(arm_torque(is, angle), arm_torque(was, turned + angle), 1e-7 * std::abs(arm_torque(was, turned)))
          << angle;
  }
  for (const RangeSpec& range : scene.range) {
    const QuasiStaticRange a = solve_quasi_static(was, range), b = solve_quasi_static(is, range);
    ASSERT_EQ(a.error, b.error);
    for (std::size_t i = 0; i < a.spans.size(); ++i) {
      EXPECT_NEAR(a.spans[i].tension, b.spans[i].tension, 1e-3) << a.name;  // N; Newton's own tolerance is 1e-8 of EA
      EXPECT_NEAR(a.spans[i].tension_low, b.spans[i].tension_low, 1e-3) << a.name;
    }
    if (a.arm_angle) {
      EXPECT_NEAR(*b.arm_angle, *a.arm_angle - turned, 1e-7);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LayoutBase,
                         testing::Values("baseline", "alternative_1", "alternative_2", "alternative_3",
                                         "accessory_drive", "overrunning_alternator", "two_pulley"),
                         [](const auto& info) { return std::string(info.param); });

TEST(LayoutBaseForm, KeepsAnArmThatIsGivenByItsAngle) {
  SceneSpec scene = shipped("baseline");
  const TensionerSpec& t = *scene.tensioner;
  const double x = scene.pulley[5].x_mm - t.pivot_x_mm, y = scene.pulley[5].y_mm - t.pivot_y_mm;
  scene.tensioner->arm_angle_deg = std::atan2(y, x) * 180 / pi;
  scene.tensioner->arm_length_mm = std::hypot(x, y);
  const SceneSpec angled = layout_base(scene), plain = layout_base(shipped("baseline"));
  const PulleyPlace a = pulley_place(angled, angled.pulley[5]), b = pulley_place(plain, plain.pulley[5]);
  EXPECT_NEAR(a.x_mm, b.x_mm, 1e-9);
  EXPECT_NEAR(a.y_mm, b.y_mm, 1e-9);
  EXPECT_NEAR(*angled.tensioner->arm_angle_deg - *scene.tensioner->arm_angle_deg, -0.3906 * 180 / pi, 0.01);
}

TEST(LayoutBaseForm, RefusesAnArmThatRestsOnAStop) {
  SceneSpec scene = shipped("baseline");
  scene.tensioner->stop_shortening_deg = 10;  // it would rest 22 degrees from where it is placed
  EXPECT_NE(message_of([&] { layout_base(scene); }).find("rests on this stop"), std::string::npos);
}

}  // namespace
}  // namespace beltlife
