// Owns the small scene that the scene tests start from, and what they ask of texts and scenes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/scene_io.h"
#include "sim/scene/spec_path.h"

namespace beltlife::scene_fixture {

inline const std::string small_scene = R"(format = 1
title = "small"
[belt]
unstretched_length_mm = 1500
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
name = "idler_2"
x_mm = 500
y_mm = 0
pitch_diameter_mm = 80
side = "front"
inertia_kg_m2 = 0.001
[tensioner]
pulley = "idler_2"
pivot_x_mm = 450
pivot_y_mm = 50
mass_kg = 0.5
inertia_kg_m2 = 1e-4
spring_torque_n_m = 20
[[body]]
name = "rotor"
inertia_kg_m2 = 0.002
[[torsional_spring]]
name = "shaft"
from = "rotor"
to = "idler_2"
stiffness_n_m_per_rad = 100
[[gear_pair]]
name = "mesh"
pinion = "rotor"
gear = "crank"
pinion_teeth = 20
gear_teeth = 40
module_mm = 2
stiffness_n_per_m = 1e8
[[torque]]
name = "load"
body = "idler_2"
speeds_rpm = [0, 1000, 2000]
torques_n_m = [0, -5, -7.5]
[driver]
body = "crank"
[[driver.harmonic]]
name = "order_3"
order = 3
speeds_rpm = [700, 1500]
amplitudes_rpm = [10, 20]
[output]
body = "rotor"
spring = "shaft"
[[range]]
name = "idle"
crank_rpm = 700
duty_share = 0.25
[[range]]
name = "B100"
crank_rpm = 1500
duty_share = 0.75
[profile]
hold_s = 2
evaluate_s = 1
)";

inline std::vector<Problem> problems_of(std::string_view text, const std::vector<std::string>& settings = {}) {
  try {
    (void)parse_scene(text, "test.toml", settings);
  } catch (const BadInput& bad) {
    return bad.problems();
  }
  return {};
}

template <class Act>
std::string message_of(Act act) {
  try {
    act();
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

inline int line_of(std::string_view text, std::string_view part) {
  const auto before = text.substr(0, text.find(part));
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

/// Every value of a scene with its path, doubles as their bits.
inline std::vector<std::string> values_of(SceneSpec scene) {
  std::vector<std::string> values;
  const auto bits = [](double value) { return std::to_string(std::bit_cast<std::uint64_t>(value)); };
  for_each_leaf(scene, [&]<class T>(const SpecPath& path, T& value, const Rule&) {
    std::string text;
    if constexpr (std::same_as<T, double>) {
      text = bits(value);
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      text = value ? bits(*value) : "absent";
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      for (const double element : value) text += bits(element) + " ";
    } else if constexpr (std::same_as<T, AbsentSection>) {
      text = "absent";
    } else if constexpr (OptionalType<T>) {
      text = value ? spell(*value) : "absent";
    } else {
      text = spell(value);
    }
    values.push_back(path.shown + " = " + text);
  });
  return values;
}

}  // namespace beltlife::scene_fixture
