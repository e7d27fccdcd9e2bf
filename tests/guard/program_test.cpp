// Owns the guard that a drive pays for nothing it does not have: kernels and arrays by feature.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/kernels/kernel.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using Names = std::vector<std::string>;

SceneSpec scene_of(const char* name, const std::vector<std::string>& settings = {}) {
  return read_scene(std::string(BELTLIFE_SCENES "/") + name, settings).scene;
}

Names program_of(const SceneSpec& scene) {
  Names names;
  for (const Kernel& k : force_program(compile(scene))) names.push_back(k.name);
  return names;
}

Names without(Names names, const char* name) {
  EXPECT_EQ(std::erase(names, name), 1u) << name;
  return names;
}

TEST(Program, OfTheBaselineIsThis) {
  EXPECT_EQ(program_of(scene_of("baseline.toml")),
            (Names{"belt ghosts", "belt axial and turning", "belt bending damping", "belt forces", "clear torques",
                   "contact", "torsional springs", "gear mesh", "torque tables", "tensioner arm"}));
}

TEST(Program, OfARingHasNoBodiesAndNoContact) {
  EXPECT_EQ(program_of(scene_of("spinning_ring.toml", {"belt.bending_damping_n_m2_s=0"})),
            (Names{"belt ghosts", "belt axial", "belt forces"}));
}

TEST(Program, OfTwoPulleysHasNoShaftsGearsOrTensioner) {
  EXPECT_EQ(program_of(scene_of("two_pulley.toml")),
            (Names{"belt ghosts", "belt axial and turning", "belt bending damping", "belt forces", "clear torques",
                   "contact", "torque tables"}));
}

TEST(Program, LosesBendingWithItsConstants) {
  EXPECT_EQ(program_of(scene_of("two_pulley.toml", {"belt.bending_damping_n_m2_s=0"})),
            (Names{"belt ghosts", "belt axial", "belt forces", "clear torques", "contact", "torque tables"}));
}

TEST(Program, TakesBendingStiffnessOnlyWhereThereIsSome) {
  const Names stiff = program_of(scene_of("two_pulley.toml", {"belt.bending_stiffness_n_m2=0.1"}));
  EXPECT_EQ(std::count(stiff.begin(), stiff.end(), "belt bending"), 1);
  EXPECT_EQ(std::count(stiff.begin(), stiff.end(), "belt bending damping"), 0);
}

TEST(Program, LosesEachFeatureWithItsTable) {
  SceneSpec full = scene_of("baseline.toml");
  full.torque[0].referred_to.reset();  // without the gears there is no speed ratio to refer to
  const Names names = program_of(full);
  SceneSpec scene = full;
  scene.gear_pair.clear();
  EXPECT_EQ(program_of(scene), without(names, "gear mesh"));
  scene = full;
  scene.torsional_spring.clear();
  scene.gear_pair.clear();
  EXPECT_EQ(program_of(scene), without(without(names, "torsional springs"), "gear mesh"));
  scene = full;
  scene.torque.clear();
  EXPECT_EQ(program_of(scene), without(names, "torque tables"));
  scene = full;
  scene.tensioner->locked = true;
  EXPECT_EQ(program_of(scene), without(names, "tensioner arm"));
  scene = full;
  scene.tensioner.reset();
  EXPECT_EQ(program_of(scene), without(names, "tensioner arm"));
}

TEST(Program, HasStopsSensesAndClutchesOnlyWhereTheSceneHasThem) {
  const Names names = program_of(scene_of("accessory_drive.toml"));
  EXPECT_EQ(names.back(), "tensioner arm");
  Names wanted = names;
  wanted.push_back("arm stops");
  EXPECT_EQ(program_of(scene_of("accessory_drive.toml", {"tensioner.stop_shortening_deg=10"})), wanted);
  wanted = names;
  wanted.back() = "tensioner arm, directional";
  EXPECT_EQ(program_of(scene_of("accessory_drive.toml", {"tensioner.damping_shortening_n_m_s_per_rad=0"})), wanted);
  EXPECT_EQ(program_of(scene_of("accessory_drive.toml", {"tensioner.friction_torque_shortening_n_m=1"})), wanted);
  EXPECT_EQ(program_of(scene_of("accessory_drive.toml",
                                {"tensioner.stop_shortening_deg=10", "tensioner.damping_shortening_n_m_s_per_rad=0",
                                 "tensioner.locked=true"})),
            without(names, "tensioner arm"));
  Names clutch = program_of(scene_of("overrunning_alternator.toml"));
  EXPECT_EQ(std::count(clutch.begin(), clutch.end(), "torsional springs, one-way"), 1);
  clutch = program_of(scene_of("overrunning_alternator.toml", {"torsional_spring.clutch.one_way=false"}));
  EXPECT_EQ(std::count(clutch.begin(), clutch.end(), "torsional springs"), 1);
  EXPECT_EQ(std::count(clutch.begin(), clutch.end(), "torsional springs, one-way"), 0);
}

TEST(Program, HasAControllerOnlyWhereTheDriverHasOne) {
  Names names = program_of(scene_of("baseline.toml"));
  names.push_back("pid driver");
  EXPECT_EQ(program_of(scene_of("baseline.toml", {"driver.control=pid"})), names);
}

TEST(Arrays, OfBendingAreNotAllocatedWithoutIt) {
  const Work with = make_work(compile(scene_of("two_pulley.toml")));
  const Work none = make_work(compile(scene_of("two_pulley.toml", {"belt.bending_damping_n_m2_s=0"})));
  EXPECT_EQ(with.moment.size(), 264);
  EXPECT_EQ(with.turn_rate.size(), 264);
  EXPECT_EQ(none.moment.size(), 0);
  EXPECT_EQ(none.turn_rate.size(), 0);
}

TEST(Arrays, OfClutchesAreNotAllocatedWithoutOne) {
  EXPECT_EQ(compile(scene_of("overrunning_alternator.toml")).initial.free_wheel.size(), 1u);
  EXPECT_TRUE(compile(scene_of("baseline.toml")).initial.free_wheel.empty());
}

TEST(Arrays, OfContactAreNotAllocatedForARing) {
  const Work ring = make_work(compile(scene_of("spinning_ring.toml")));
  for (const NodeArray* a :
       {&ring.normal, &ring.tangential, &ring.slip, &ring.contact_x, &ring.contact_y, &ring.contact_moment})
    EXPECT_EQ(a->size(), 0);
  EXPECT_TRUE(ring.torque.empty());
}

}  // namespace
}  // namespace beltlife
