// Owns the tests of compiling a scene: senses and speed ratios through shafts and gears, and what is refused.
#include <gtest/gtest.h>

#include "sim/model.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

SceneSpec two_pulley() { return read_scene(BELTLIFE_SCENES "/two_pulley.toml").scene; }

std::string refusal(const SceneSpec& scene) {
  try {
    compile(scene);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Compile, TurnsBodiesBehindGearsTheOtherWayAtTheirRatio) {
  const Model m = compile(read_scene(BELTLIFE_SCENES "/baseline.toml").scene);
  const int drive = body_index(m, "drive"), shaft = body_index(m, "drive_shaft"), turbine = body_index(m, "turbine");
  EXPECT_EQ(m.sense[drive], -1);  // a front pulley of a clockwise drive
  EXPECT_EQ(m.sense[body_index(m, "idler_2")], 1);
  EXPECT_EQ(m.sense[shaft], m.sense[drive]);
  EXPECT_EQ(m.sense[turbine], -m.sense[drive]);
  EXPECT_EQ(m.speed_ratio[shaft], m.speed_ratio[drive]);
  EXPECT_NEAR(m.speed_ratio[turbine] / m.speed_ratio[drive], 191.0 / 19, 1e-13);  // rounding of two divisions
  EXPECT_NEAR(m.torques[0].factor, 19.0 / 191, 1e-15);
}

TEST(Compile, RefusesATorqueReferredToABodyThatNothingConnects) {
  SceneSpec scene = two_pulley();
  scene.body.push_back({"loose", 0.01});
  scene.torque[0].referred_to = "loose";
  EXPECT_NE(refusal(scene).find("loose is not connected to driven"), std::string::npos) << refusal(scene);
}

TEST(Compile, AcceptsATrainThatNoPulleyReaches) {
  SceneSpec scene = two_pulley();
  scene.body = {{"a", 0.01}, {"b", 0.02}};
  scene.gear_pair.push_back({"mesh", "a", "b", 10, 20, 1.5, 1e8, 100, 0});
  ASSERT_EQ(refusal(scene), "");
  const Model m = compile(scene);
  EXPECT_EQ(m.sense[body_index(m, "a")], -m.sense[body_index(m, "b")]);
}

TEST(Compile, RefusesAShaftBetweenBodiesThatTheDriveTurnsOppositely) {
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml").scene;
  scene.torsional_spring.push_back({"wrong", "turbine", "drive", 100, 0});
  // Which link of the contradictory loop is named depends on where the senses spread from.
  EXPECT_NE(refusal(scene).find("which the rest of the drive turns in"), std::string::npos) << refusal(scene);
}

TEST(Compile, RefusesABeltThatItsLayoutWouldTear) {
  SceneSpec scene = two_pulley();
  scene.belt.pretension_n.reset();
  scene.belt.unstretched_length_mm = 800;
  EXPECT_NE(refusal(scene).find("would be stretched by 64 %"), std::string::npos) << refusal(scene);  // 1315 / 800
}

}  // namespace
}  // namespace beltlife
