// Owns the claims about scenes: the files that we ship, writing, --set, paths, and the table of fields.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <set>

#include "sim/scene/scene_io.h"
#include "sim/scene/spec_path.h"
#include "sim/scene/spec_reader.h"
#include "sim/scene/toml_tree.h"
#include "tests/unit/scene_fixture.h"

namespace beltlife {
namespace {

using namespace scene_fixture;

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(BELTLIFE_SCENES)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

SceneSpec scene_of(const std::string& file) { return read_scene(std::filesystem::path(BELTLIFE_SCENES) / file).scene; }

// ---------------------------------------------------------------- the scenes that we ship

TEST(SceneFiles, AllOfThemReadBackToTheSameBitsWhenWritten) {
  ASSERT_EQ(scene_files().size(), 13u);
  for (const auto& path : scene_files()) {
    const SceneFile file = read_scene(path);
    EXPECT_FALSE(file.text.empty());
    EXPECT_EQ(file.path, path);
    const SceneSpec again = parse_scene(write_scene(file.scene), "written");
    EXPECT_EQ(values_of(again), values_of(file.scene)) << path;
  }
}

TEST(SceneFiles, TheReadingsOfThePretensionDifferInBeltLengthAndTitleOnly) {
  for (const auto& [file, length] : {std::pair{"baseline_448n.toml", 2600.0}, {"baseline_322n.toml", 2629.0}}) {
    SceneSpec other = scene_of(file);
    const SceneSpec baseline = scene_of("baseline.toml");
    EXPECT_EQ(other.belt.unstretched_length_mm, length);
    other.belt.unstretched_length_mm = baseline.belt.unstretched_length_mm;
    other.title = baseline.title;
    EXPECT_EQ(values_of(other), values_of(baseline));
  }
}

TEST(SceneFiles, AlternativesHaveTheBaselinesBeltTrainDriverAndDutyCycle) {
  for (const char* file : {"alternative_1.toml", "alternative_2.toml", "alternative_3.toml"}) {
    SceneSpec alternative = scene_of(file);
    SceneSpec baseline = scene_of("baseline.toml");
    EXPECT_EQ(alternative.pulley.size(), 6u);
    EXPECT_EQ(alternative.belt.balanced_as_placed, true);
    for (SceneSpec* scene : {&alternative, &baseline}) {
      scene->title.clear();
      scene->pulley.clear();
      scene->belt.unstretched_length_mm.reset();
      scene->belt.balanced_as_placed.reset();
      scene->tensioner->pivot_x_mm = scene->tensioner->pivot_y_mm = 0;
      scene->tensioner->spring_torque_n_m = 0;
    }
    EXPECT_EQ(values_of(alternative), values_of(baseline)) << file;
  }
}

// ---------------------------------------------------------------- writing

TEST(WriteScene, KeepsAnyFiniteDoubleToTheBit) {
  std::mt19937_64 random(1);
  SceneSpec scene = parse_scene(small_scene, "small");
  for (int i = 0; i < 200; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::abs(value) <= 1e5) scene.pulley[0].x_mm = value;  // the field's limits; half of all bit patterns
    scene.pulley[0].y_mm = static_cast<double>(static_cast<std::int32_t>(random())) / 65536;
    ASSERT_EQ(values_of(parse_scene(write_scene(scene), "written")), values_of(scene));
  }
  for (const double value : {-0.0, 0.1, 1e-7, 5e-324, 2.2250738585072009e-308, 1.0 / 3, 99999.999999999985}) {
    scene.pulley[0].x_mm = value;
    EXPECT_EQ(values_of(parse_scene(write_scene(scene), "written")), values_of(scene)) << value;
  }
}

TEST(WriteScene, KeepsAnyText) {
  SceneSpec scene = parse_scene(small_scene, "small");
  scene.title = "a \"quoted\" \\ title,\n\ttwo lines, \x01\x7f, é, # no comment";
  EXPECT_EQ(parse_scene(write_scene(scene), "written").title, scene.title);
}

TEST(WriteScene, LeavesOutWhatIsAbsent) {
  const std::string text = write_scene(parse_scene(small_scene, "small"));
  for (const char* absent : {"pretension_n", "balanced_as_placed", "[ring]", "step_s", "speed_csv"}) {
    EXPECT_EQ(text.find(absent), text.npos) << absent;
  }
  EXPECT_NE(text.find("[[driver.harmonic]]"), text.npos);
}

// ---------------------------------------------------------------- --set and paths

TEST(SetField, SetsEveryKindOfValue) {
  const std::vector<std::string> settings = {"tensioner.friction_torque_n_m=3.5",
                                             "range.B100.crank_rpm = 1400",
                                             "belt.elements=256",
                                             "solver.scheme=thesis",
                                             "pulley.crank.side=\"back\"",
                                             "title=two words",
                                             "tensioner.locked=true",
                                             "solver.step_s=1e-7",
                                             "torque.load.torques_n_m=[1, 2.5, 3]",
                                             "torque.load.speeds_rpm.2=.5e4",
                                             "belt.unstretched_length_mm=",
                                             "belt.pretension_n=+600"};
  const SceneSpec scene = parse_scene(small_scene, "small", settings);
  EXPECT_EQ(scene.tensioner->friction_torque_n_m, 3.5);
  EXPECT_EQ(scene.range[1].crank_rpm, 1400);
  EXPECT_EQ(scene.belt.elements, 256);
  EXPECT_EQ(scene.solver.scheme, Scheme::thesis);
  EXPECT_EQ(scene.pulley[0].side, Side::back);
  EXPECT_EQ(scene.title, "two words");
  EXPECT_TRUE(scene.tensioner->locked);
  EXPECT_EQ(scene.solver.step_s, 1e-7);
  EXPECT_EQ(scene.torque[0].torques_n_m, (std::vector<double>{1, 2.5, 3}));
  EXPECT_EQ(scene.torque[0].speeds_rpm[2], 5000);
  EXPECT_FALSE(scene.belt.unstretched_length_mm);
  EXPECT_EQ(scene.belt.pretension_n, 600);
}

TEST(SetField, ExplainsASettingThatCannotBe) {
  const std::pair<const char*, const char*> cases[] = {
      {"range.B10.crank_rpm=1", "did you mean 'range.B100.crank_rpm'? (allowed: range.idle, range.B100)"},
      {"belt.ribbs=6", "did you mean 'belt.ribs'?"},
      {"belt.ribs=many", "found text \"many\", wanted an integer (allowed: from 1 to 100)"},
      {"belt.ribs=6.5", "wanted an integer"},
      {"belt.ribs=1000", "out of limits"},
      {"belt.ribs=nan", "wanted an integer"},
      {"belt.friction_front=nan", "not a finite number"},
      {"solver.scheme=thsis", "did you mean 'thesis'?"},
      {"ring.speed_rad_s=1", "no table [ring], and a setting cannot create it"},
      {"pulley.crank=1", "is a table or a name, not a value"},
      {"torque.load.speeds_rpm.7=1", "no such field"},
      {"belt.ribs", "is no setting (allowed: PATH=VALUE)"},
      {"=3", "is no setting"},
      {"driver.body=", "is empty"},
  };
  SceneSpec scene = parse_scene(small_scene, "small");
  const auto before = values_of(scene);
  for (const auto& [setting, words] : cases) {
    const std::string message = message_of([&] { set_field(scene, setting); });
    EXPECT_NE(message.find(words), message.npos) << setting << " -> " << message;
  }
  EXPECT_EQ(values_of(scene), before);
}

TEST(SetField, ContradictionsThatSettingsMakeAreFoundAndNotBlamedOnTheFile) {
  const auto problems = problems_of(small_scene, {"driver.body=nobody", "belt.nothing=1"});
  ASSERT_EQ(problems.size(), 2u);
  for (const Problem& problem : problems) EXPECT_EQ(problem.line, 0) << problem.key;
}

TEST(Paths, ReachEveryNumberAndPutItBack) {
  SceneSpec scene = scene_of("baseline.toml");
  const auto before = values_of(scene);
  const auto paths = number_paths(scene);
  EXPECT_EQ(std::set<std::string>(paths.begin(), paths.end()).size(), paths.size());
  for (const std::string& path : paths) set_number(scene, path, get_number(scene, path));
  EXPECT_EQ(values_of(scene), before);
  for (const char* path : {"tensioner.friction_torque_n_m", "pulley.idler_2.x_mm", "range.B100.crank_rpm",
                           "driver.harmonic.order_0_5.phase_rad", "torque.turbine_torque.torques_n_m.3"}) {
    EXPECT_TRUE(std::count(paths.begin(), paths.end(), path)) << path;
  }
  EXPECT_EQ(get_number(scene, "torque.turbine_torque.torques_n_m.3"), 15);
}

TEST(Paths, RefuseWhatIsNoNumber) {
  SceneSpec scene = parse_scene(small_scene, "small");
  EXPECT_THROW(get_number(scene, "solver.scheme"), BadInput);
  EXPECT_THROW(get_number(scene, "belt.pretension_n"), BadInput);  // absent
  EXPECT_THROW(get_number(scene, "belt.pretention"), BadInput);
  EXPECT_THROW(set_number(scene, "title", 1), BadInput);
  EXPECT_THROW(set_number(scene, "belt.ribs", 2.5), BadInput);
  EXPECT_THROW(set_number(scene, "belt.friction_front", -1), BadInput);
  set_number(scene, "belt.ribs", 4);
  EXPECT_EQ(scene.belt.ribs, 4);
}

TEST(Validate, ChecksScenesMadeInCodeWithoutLines) {
  SceneSpec scene = parse_scene(small_scene, "small");
  EXPECT_NO_THROW(validate(scene));
  scene.belt.mass_kg_per_m = -1;
  scene.range[0].name = "";
  scene.torque[0].speeds_rpm.clear();
  scene.torque[0].torques_n_m.clear();
  const std::string message = message_of([&] { validate(scene, "made"); });
  EXPECT_NE(message.find("made: belt.mass_kg_per_m: -1 is out of limits"), message.npos) << message;
  EXPECT_NE(message.find("made: range.0.name: '' cannot be used"), message.npos) << message;
  EXPECT_NE(message.find("made: torque.load.speeds_rpm: has no entries"), message.npos) << message;
}

// ---------------------------------------------------------------- the reference, and other people's Specs

struct KeyCollector {
  std::vector<std::string> keys;
  template <class T>
  void operator()(std::string_view key, T&, const Rule&, std::string_view) {
    keys.emplace_back(key);
    if constexpr (SpecType<T>) T{}.visit(*this);
    if constexpr (SpecList<T> || OptionalSpec<T>) typename T::value_type{}.visit(*this);
  }
};

TEST(FieldReference, MentionsEveryKey) {
  const std::string reference = field_reference();
  KeyCollector all;
  SceneSpec{}.visit(all);
  EXPECT_GT(all.keys.size(), 100u);
  for (const std::string& key : all.keys) EXPECT_NE(reference.find(key), reference.npos) << key;
  EXPECT_NE(reference.find("| `elements` | integer | 512 | from 16 to 20000 | number of belt"), reference.npos);
}

struct StudySpec {
  std::vector<std::string> quantities;
  std::optional<SolverSpec> solver;
  std::uint64_t seed = 0;
  template <class V>
  void visit(V& v) {
    v("quantities", quantities, required(any_text), "what to record");
    v("solver", solver, any_text, "an inline table will do");
    v("seed", seed, any_text, "any integer");
  }
};

TEST(ReadSpec, ReadsAnySpecWithAVisitList) {
  ReadLog log;
  const auto study = read_spec<StudySpec>(parse_toml("quantities = ['a', 'b']\nsolver = { step_s = 1e-6 }", "s"), log);
  EXPECT_TRUE(log.problems.empty());
  EXPECT_EQ(study.quantities, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(study.solver->step_s, 1e-6);
  (void)read_spec<StudySpec>(parse_toml("quantities = [1]\nseed = -1\nsolver = { step = 1e-6 }", "s"), log);
  ASSERT_EQ(log.problems.size(), 3u);
  EXPECT_EQ(log.problems[0].key, "quantities.0");
  EXPECT_EQ(log.problems[1].key, "solver.step");
  EXPECT_EQ(log.problems[2].what, "-1 is out of limits");
}

}  // namespace
}  // namespace beltlife
