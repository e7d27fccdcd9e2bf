// Owns the tests of what is refused of a measurement: files and study files, in words with file and line.
#include "tests/unit/measurement_fixture.h"

namespace beltlife::measurement_test {
namespace {

TEST_F(MeasurementTest, BadFilesAreRefusedInWords) {
  const std::string head = "time_s,speed_rpm\n",
                    fine = csv("time_s,speed_rpm", Record{.rate = 1000, .seconds = 1}.values(), 1e-3);
  const auto with = [&](const std::string& line, const std::string& instead) {
    const std::size_t at = fine.find("\n" + line) + 1;
    EXPECT_NE(at, 0u);
    return fine.substr(0, at) + instead + fine.substr(fine.find('\n', at));
  };
  const std::string row = "0.5,";  // on line 502
  struct Bad {
    std::string text, words;
  };
  const Record another{.rate = 1000, .seconds = 1, .rpm = 1250, .mean = 1250 * ratio},
      no_mean{.rate = 1000, .seconds = 2, .rpm = 1600, .mean = 0};
  std::string noise = "time_s,speed_rpm\n";
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(mean_rpm, 5);
  for (int i = 0; i < 2000; ++i) noise += fmt::format("{},{}\n", i * 1e-3, normal(random));
  const Bad cases[] = {
      {"", "a.csv: spectrum.0.file: is empty"},
      {"# nothing\n\n", "is empty"},
      {head, "has a header but no numbers"},
      {with(row, "0.5,nan"), "a.csv:502: spectrum.0.file: \"nan\" in the column \"speed_rpm\" is no finite number"},
      {with(row, "0.5,inf"), "a.csv:502: spectrum.0.file: \"inf\""},
      {with(row, "0.5,1e999"), "a.csv:502: spectrum.0.file: \"1e999\""},
      {with(row, "0.5,broken"), "\"broken\" in the column"},
      {with(row, "0.5,4,9"), "a.csv:502: spectrum.0.file: \"0.5,4,9\" has more cells than the header's 2"},
      {with(row, "0.5"), "a.csv:502: spectrum.0.file: has no cell in the column \"speed_rpm\""},
      {with(row, "0.5,"), "a.csv:502: spectrum.0.file: has no cell in the column \"speed_rpm\""},
      {with(row, "0.499,4900"), "a.csv:502: spectrum.0.file: time (s) 0.499 does not come after 0.499"},
      {with(row, "# lost"), "a.csv:503: spectrum.0.file: a gap: time (s) goes from 0.499 to 0.501"},
      {fine.substr(0, fine.find("\n0.9,")), "is 0.9 s long, the simulation evaluates 1 s"},
      {csv("time_s,speed_rpm", Record{.rate = 40, .seconds = 3}.values(), 1. / 40), "is sampled at 40 Hz, too slowly"},
      {csv("x,speed_rpm", {1, 2, 3}, 1), "has no column of time, and no sample_rate_hz"},
      {csv("time_s,time_ms", {1, 2, 3}, 1), "has the columns time_s and time_ms"},
      {csv("time_s,sped_rpm", {1, 2, 3}, 1), "has no column \"drive_shaft.speed_rpm\""},
      {csv("speed_rpm,drive_shaft.speed_hz", {1}, 1), "has no column of time"},
      {csv("speed_rpm,speed_hz", {1}, 1), "has 2 columns for \"drive_shaft.speed_rpm\": speed_rpm, speed_hz"},
      {csv("time_s,speed", {1}, 1), "the column \"speed\" states no unit"},
      {csv("time_s,speed [furlong]", {1}, 1), "\"furlong\", the unit of the column"},
      {csv("time_s,speed [N m]", {1}, 1), "is in N m, the channel drive_shaft.speed_rpm in r/min"},
      {noise, "no order of 1500 r/min stands out"},
      {csv("time_s,speed_rpm", another.values(), 1e-3), "more than 10 % off"},
      {csv("time_s,speed_rpm", no_mean.values(), 1e-3), "is this range B100?"},
      {csv("time_s,speed_rpm", std::vector<double>(1500, mean_rpm), 1e-3), "no order of 1500 r/min stands out"},
      {csv("frequency_hz,speed_rpm", std::vector<double>(200, 1.0), 4), "a resolution of 4 Hz is too coarse"},
      {csv("frequency_hz,speed_rpm", std::vector<double>(500, -1.0), 1), "an amplitude of -1"},
      {csv("frequency_hz,speed_rpm", std::vector<double>(500, 1.0), 1), "no order of 1500 r/min stands out"}};
  for (const Bad& bad : cases) {
    write(bad.text);
    read();
    EXPECT_NE(problems.find(bad.words), problems.npos) << bad.words << "\n  was: " << problems;
    EXPECT_LE(count, 20u);
  }
  write(with(row, "0.5,x") + "y,z\n");
  read();
  EXPECT_EQ(count, 3u) << "all at once: " << problems;
  write("time_s,speed_rpm\n" + [] {
    std::string many;
    for (int i = 0; i < 50; ++i) many += "a,b\n";
    return many;
  }());
  read();
  EXPECT_EQ(count, 20u);
  spec.file = "missing.csv";
  read();
  EXPECT_NE(problems.find("missing.csv: spectrum.0.file: cannot be read"), problems.npos) << problems;
}

TEST_F(MeasurementTest, WhatTheStudyFileAsksForInVainIsRefused) {
  write(Record{.rate = 1000, .seconds = 1});
  const SpectrumSpec plain = spec;
  const auto refusal = [&](auto change) {
    spec = plain;
    change();
    read();
    return problems;
  };
  const auto expect = [](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), text.npos) << words << "\n  was: " << text;
  };
  expect(refusal([&] { spec.range = "B10"; }), "spectrum.0.range: no range 'B10'; did you mean 'B100'? (allowed: idle");
  expect(refusal([&] { spec.channel = "drive.speed_rpm"; }),
         "no channel 'drive.speed_rpm'; did you mean 'drive_shaft.speed_rpm'? (allowed: drive_shaft.speed_rpm, "
         "drive_shaft.torque_n_m)");
  expect(refusal([&] { spec.unit = "kN m"; }),
         "spectrum.0.unit: kN m is no unit of the channel drive_shaft.speed_rpm, which is in r/min");
  expect(refusal([&] { spec.unit = "mph"; }), "\"mph\" is no unit that is known");
  expect(refusal([&] { spec.unit = "Hz"; }), "is in rpm by its header, in Hz by the study file");
  expect(refusal([&] { spec.orders = {3, 3.2}; }), "order 3.2 has no quantity (allowed: 0.5, 1, 1.5");
  expect(refusal([&] { spec.orders = {3, 3}; }), "order 3 stands twice");
  expect(refusal([&] { spec.column = "drive_shaft.sped"; }), "has no column \"drive_shaft.sped\"; did you mean");
  expect(refusal([&] { spec.sample_rate_hz = 900; }), "its times make 1000 Hz, sample_rate_hz is 900");
  expect(refusal([&] { spec.crank_rpm = 1250; }), "1250 r/min is not the range B100 of 1500 r/min");
  EXPECT_EQ(refusal([&] { spec.range = "x", spec.orders = {0.7}, spec.unit = "mph"; }).empty(), false);
  EXPECT_EQ(count, 3u) << "all at once";
  scene.profile.evaluate_s = 0.03;  // two revolutions at 4000 r/min, 1.98 at 3960
  write(Record{.rate = 1000, .seconds = 1, .rpm = 3960, .mean = 3960 * ratio});
  scene.range[2].crank_rpm = 4000;
  expect(refusal([&] { spec.crank_rpm = 3960; }), "gives no orders: a window holds");
  scene.profile.evaluate_s = 0.02;
  expect(refusal([] {}), "hold less than two crank revolutions");
  scene.output.reset();
  expect(refusal([] {}), "the scene has no [output]");
}

}  // namespace
}  // namespace beltlife::measurement_test
