// Owns the claim that any JSON survives in an HDF5 file, and the spelling of units in names.
#include "results/store/json_group.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "results/store/whole_file.h"
#include "sim/eval/quantity_unit.h"
#include "tests/unit/study_fixture.h"

namespace beltlife {
namespace {

using nlohmann::json;

namespace fs = std::filesystem;

class JsonGroup : public study_test::InFolder {
 protected:
  json there_and_back(const json& value) {
    {
      Hdf5Image file;
      put_json(file, "/answer", value, "answer", "what was found");
      write_whole_file(path(), file.bytes());
    }
    return get_json(Hdf5Source(path().string()), "/answer");
  }
  /// Equal is not enough: 1 and 1.0 are.
  void expect_survives(const json& value) { EXPECT_EQ(there_and_back(value).dump(), value.dump()); }
  fs::path path() const { return folder / "answer.h5"; }
};

TEST_F(JsonGroup, KeepsEveryKindOfValue) {
  expect_survives({{"real", 0.1},
                   {"whole_real", 2.0},
                   {"integer", 7},
                   {"negative", std::numeric_limits<std::int64_t>::min()},
                   {"largest", std::numeric_limits<std::int64_t>::max()},
                   {"beyond", std::numeric_limits<std::uint64_t>::max()},
                   {"text", "\xC2\xB5 and \"more\"\n"},
                   {"no_text", ""},
                   {"yes", true},
                   {"no", false},
                   {"nothing", nullptr}});
  expect_survives({{"reals", {0.5, -0.0, 5e-324, nullptr}},
                   {"integers", {1, -2, std::numeric_limits<std::int64_t>::max()}},
                   {"texts", {"a", "", "c"}},
                   {"truths", {true, false}},
                   {"matrix", {{1.0, 0.5}, {0.5, 1.0}, {nullptr, 2.0}}},
                   {"mixed", {1, 2.5, "three", true, nullptr, json::array(), json::object()}},
                   {"rows_of_integers", {{1, 2}, {3}}},
                   {"ragged", {{1.0, 2.0}, {3.0}}},
                   {"beyond", {1, std::numeric_limits<std::uint64_t>::max()}}});
  expect_survives({{"empty", json::object()}, {"none", json::array()}, {"rows", {json::array(), json::array()}}});
}

TEST_F(JsonGroup, KeepsTablesAndWhatOnlyResemblesOne) {
  expect_survives({{"table", {{{"name", "a"}, {"x_mm", 1.0}, {"n", 1}}, {{"name", "b"}, {"x_mm", nullptr}, {"n", 2}}}},
                   {"one_row", {{{"x", 1.0}}}},
                   {"mixed_column", {{{"x", 1.0}}, {{"x", "one"}}, {{"x", nullptr}}}},
                   {"other_keys", {{{"x", 1.0}}, {{"y", 1.0}}}},
                   {"deeper", {{{"x", {1.0}}}, {{"x", {2.0}}}}},
                   {"nothing_in_them", {json::object(), json::object()}}});
  const json table = {{{"name", "a"}, {"x_mm", 1.0}}, {{"name", "b"}, {"x_mm", 2.0}}};
  there_and_back({{"table", table}});
  const Hdf5Source file(path().string());
  EXPECT_EQ(file.integer("/answer/table", "table"), 2);
  EXPECT_EQ(file.numbers("/answer/table/x_mm"), (std::vector{1.0, 2.0}));
  EXPECT_EQ(file.text("/answer/table/x_mm", "unit"), "mm");
}

TEST_F(JsonGroup, KeepsKeysThatNoPathCanSpell) {
  expect_survives({{"a/b", 1}, {"a_b", 2}, {"", 3}, {".", 4}, {"..", 5}, {"_", 6}, {"\xC2\xB5 ", 7}, {"table", 8}});
  expect_survives({{"outer/inner", {{"x/y", {1.0}}}}, {"rows", {{{"p/q", 1.0}}, {{"p/q", 2.0}}}}});
  expect_survives({{std::string("zero\0key", 8), 1}, {"text", std::string("a\0b", 3)}});
  expect_survives({{"texts", {std::string("a\0b", 3), "c"}}});
}

TEST_F(JsonGroup, KeepsWhatIsNoObject) {
  for (const json& value : {json(1.5), json(3), json("text"), json(true), json(), json::array({1.0}), json::array()})
    expect_survives(value);
}

TEST_F(JsonGroup, TurnsNanIntoNullAndKeepsInfinity) {
  const json back = there_and_back({{"a", std::nan("")}, {"b", {std::nan(""), INFINITY}}});
  EXPECT_TRUE(back["a"].is_null());
  EXPECT_TRUE(back["b"][0].is_null());
  EXPECT_EQ(back["b"][1].get<double>(), INFINITY);
}

TEST_F(JsonGroup, KeepsALargeMatrixAndALongColumn) {
  json matrix = json::array(), column = json::array();
  for (int i = 0; i < 300; ++i) {
    json row = json::array();
    for (int j = 0; j < 200; ++j) row.push_back(i + 0.001 * j);
    matrix.push_back(row);
  }
  for (int i = 0; i < 20000; ++i) column.push_back(i);
  expect_survives({{"matrix", matrix}, {"column", column}});
}

json random_json(std::mt19937& random, int depth) {
  const auto below = [&](unsigned n) { return random() % n; };
  const auto scalar = [&](unsigned kind) -> json {
    switch (kind) {
      case 0:
        return std::ldexp(static_cast<double>(random()), static_cast<int>(below(200)) - 100);
      case 1:
        return static_cast<int>(random());
      case 2:
        return std::string(below(4), static_cast<char>('a' + below(3)));
      case 3:
        return below(2) == 0;
      default:
        return nullptr;
    }
  };
  if (depth == 0 || below(3) == 0) return scalar(below(5));
  json value = below(2) ? json::array() : json::object();
  const unsigned count = below(4), kind = below(5);
  const bool alike = below(2) == 0;
  for (unsigned i = 0; i < count; ++i) {
    json child = alike ? scalar(kind) : random_json(random, depth - 1);
    if (value.is_array())
      value.push_back(std::move(child));
    else
      value[std::string(1, "ab/."[below(4)])] = std::move(child);
  }
  return value;
}

TEST_F(JsonGroup, KeepsJsonOfAnyShape) {
  std::mt19937 random(7);
  Hdf5Image file;
  std::vector<json> values;
  for (int i = 0; i < 400; ++i) {
    values.push_back(random_json(random, 5));
    put_json(file, "/" + std::to_string(i), values.back(), std::to_string(i), "any");
  }
  write_whole_file(path(), file.bytes());
  const Hdf5Source back(path().string());
  for (int i = 0; i < 400; ++i)
    EXPECT_EQ(get_json(back, "/" + std::to_string(i)).dump(), values[static_cast<std::size_t>(i)].dump());
}

TEST(Unit, IsReadOffTheEndOfAName) {
  const std::pair<const char*, const char*> cases[] = {{"B100.drive_shaft.torque_n_m.order_3", "N m"},
                                                       {"B100.drive_shaft.speed_rpm.order_0.5", "r/min"},
                                                       {"idle.span.crank-tensioner.tension_n.mean", "N"},
                                                       {"idle.pulley.crank.normal_n.percentile_99", "N"},
                                                       {"idle.pulley.crank.sigma_m_mpa", "MPa"},
                                                       {"idle.pulley.crank.slip_percent", "%"},
                                                       {"idle.power_w.lost_friction", "W"},
                                                       {"idle.tensioner.arm_angle_rad.max", "rad"},
                                                       {"log10_life_h", "log10 h"},
                                                       {"idle.life_h", "h"},
                                                       {"tensioner.damping_n_m_s_per_rad", "N m s/rad"},
                                                       {"belt.bending_stiffness_n_m2", "N m2"},
                                                       {"belt.axial_damping_n_s", "N s"},
                                                       {"contact.friction_speed_m_s", "m/s"},
                                                       {"torque.load.torques_n_m.4", "N m"},
                                                       {"tensioner.stop_shortening_deg", "deg"},
                                                       {"solver.sample_rate_hz", "Hz"},
                                                       {"pulley.x_n.friction", ""},
                                                       {"range_s.drift", ""},
                                                       {"belt.friction_front", ""},
                                                       {"", ""},
                                                       {".", ""}};
  for (const auto& [name, unit] : cases) EXPECT_EQ(unit_of_name(name), unit) << name;
}

TEST(Unit, IsKnownOfEveryFieldOfASceneThatNamesOne) {
  // What a field's name ends in, if it is short, is a unit; these are the words that are none.
  for (const char* scene : {"baseline", "accessory_drive", "overrunning_alternator"})
    for (const std::string& path :
         number_paths(read_scene(fs::path(BELTLIFE_SCENES) / (std::string(scene) + ".toml")).scene)) {
      const std::size_t end = path.find_last_not_of("0123456789.") + 1;
      const std::string name = path.substr(0, end), last = name.substr(name.rfind('_') + 1);
      if (last.size() <= 2 && name.rfind('_') != name.npos) {
        EXPECT_NE(unit_of_name(path), "") << path;
      }
    }
}

}  // namespace
}  // namespace beltlife
