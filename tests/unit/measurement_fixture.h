// Owns what tests of measurements share: a record with known orders, and a folder to read its file from.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>

#include "calibrate/records/measurement.h"

namespace beltlife::measurement_test {

using std::numbers::pi;

inline constexpr double ratio = 338.3 / 104.4;  // crank to drive pulley of the baseline
inline constexpr double mean_rpm = 1515 * ratio;

/// What every synthetic record holds: 1 % above B100's 1500 r/min.
inline const std::map<double, double> known{{0.5, 2}, {1, 3}, {1.5, 0.8}, {3, 40}, {4.5, 1.2}, {6, 9}, {9, 1.5}};

struct Record {
  double rate = 2048, seconds = 6, rpm = 1515, mean = mean_rpm, noise = 0;
  unsigned seed = 1;

  std::vector<double> values() const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, 1);
    std::vector<double> v;
    for (int i = 0; i < static_cast<int>(std::lround(rate * seconds)); ++i) {
      double x = mean + noise * normal(random);
      for (const auto& [order, amplitude] : known)
        x += amplitude * std::cos(2 * pi * order * rpm / 60 * i / rate + order * order);
      v.push_back(x);
    }
    return v;
  }
};

class MeasurementTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "beltlife_csv_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    spec.file = "a.csv";
    spec.range = "B100";
    spec.channel = "drive_shaft.speed_rpm";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& text) const { std::ofstream(folder / "a.csv", std::ios::binary) << text; }
  static std::string csv(const std::string& header, const std::vector<double>& values, double step) {
    std::string text = header + "\n";
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format("{},{}\n", static_cast<double>(i) * step, values[i]);
    return text;
  }
  void write(const Record& r) const { write(csv("time_s,drive_shaft.speed_rpm", r.values(), 1 / r.rate)); }

  Measurement read() {
    ReadLog log;
    log.file = "study.toml";
    const Measurement m = read_measurement(spec, scene, folder, SpecPath{}.child("spectrum").element(0), log);
    problems.clear();
    for (const Problem& p : log.problems) problems += to_string(p) + "\n";
    count = log.problems.size();
    return m;
  }
  Measurement good() {
    const Measurement m = read();
    EXPECT_EQ(problems, "");
    return m;
  }
  static double value(const Measurement& m, const std::string& ending) {
    for (const MeasuredValue& v : m.values)
      if (v.quantity == m.spec.range + "." + m.spec.channel + "." + ending) return v.value;
    return std::nan("");
  }

  std::filesystem::path folder;
  SpectrumSpec spec;
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml").scene;
  std::string problems;
  std::size_t count = 0;
};

}  // namespace beltlife::measurement_test
