// Owns the verification of effective diameters and lengths: the same drive as with the pitch values they stand for.
#include "sim/scene/pitch_line.h"

#include <gtest/gtest.h>

#include "drives.h"

namespace beltlife {
namespace {

const std::vector<std::string> effective_settings{
    "belt.effective_line_differential_mm=2",
    "pulley.crank.pitch_diameter_mm=", "pulley.crank.effective_diameter_mm=161",
    "pulley.alternator.pitch_diameter_mm=", "pulley.alternator.effective_diameter_mm=54"};

TEST(PitchLine, LiesTheDifferentialOutsideTheEffectiveDiameter) {
  const SceneSpec scene = read_scene(BELTLIFE_SCENES "/accessory_drive.toml", effective_settings).scene;
  EXPECT_EQ(pitch_diameter_mm(scene, scene.pulley[0]), 165);
  EXPECT_EQ(pitch_diameter_mm(scene, scene.pulley[1]), 70);  // the back-side tensioner states its own
  EXPECT_EQ(pitch_diameter_mm(scene, scene.pulley[2]), 58);
  EXPECT_EQ(get_number(scene, "pulley.crank.effective_diameter_mm"), 161);
  const SceneSpec again = parse_scene(write_scene(scene), "again");
  EXPECT_FALSE(again.pulley[0].pitch_diameter_mm);
  EXPECT_EQ(again.pulley[0].effective_diameter_mm, 161);
}

TEST(PitchLine, OfEffectiveDiametersMakesTheSameDriveBitForBit) {
  const auto tension = [](const std::vector<std::string>& settings) {
    drives::Drive d(read_scene(BELTLIFE_SCENES "/accessory_drive.toml", settings).scene, drives::ramp(100, 0.05));
    d.run_to(0.01);
    return std::pair(d.model.statics.balance.route.length, d.work().tension[7]);
  };
  EXPECT_EQ(tension({}), tension(effective_settings));
}

TEST(PitchLine, IsTwoPiDifferentialsLongerThanTheEffectiveLength) {
  // A 6PK1500 of 105 kN, 2 mm from effective line to cord, measured at 300 N a strand.
  SceneSpec scene = drives::two_pulleys(128, 500, 120, 120, 600);
  scene.belt.axial_stiffness_n = 105000;
  scene.belt.pretension_n.reset();
  scene.belt.effective_length_mm = 1360;
  scene.belt.effective_line_differential_mm = 2;
  scene.belt.measuring_tension_n = 300;
  validate(scene);
  const double pitch = 1360 + 4 * drives::pi, unstretched = pitch / (1 + 300.0 / 105000);
  EXPECT_NEAR(*unstretched_length_mm(scene.belt), unstretched, 1e-12 * pitch);
  const Model m = compile(scene);
  const double path = 2 * 500 + 120 * drives::pi;  // mm, equal pulleys
  const double tension = 105000 * (path / unstretched - 1);
  drives::report("tension at rest, N", m.statics.balance.tension, tension);
  EXPECT_NEAR(m.statics.balance.tension, tension, 1e-6);
}

TEST(PitchLine, IsWhatRefusalsOfALengthSpeakOf) {
  SceneSpec scene = drives::two_pulleys(128, 500, 120, 120, 600);
  scene.belt.pretension_n.reset();
  scene.belt.effective_length_mm = 1100;
  scene.belt.effective_line_differential_mm = 2;
  try {
    compile(scene);
    FAIL() << "a belt stretched by a quarter";
  } catch (const BadInput& bad) {
    EXPECT_EQ(bad.problems().at(0).key, "belt.effective_length_mm");
    EXPECT_NE(bad.problems().at(0).allowed.find("along the cord"), std::string::npos);
  }
}

}  // namespace
}  // namespace beltlife
