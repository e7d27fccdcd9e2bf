// Owns the tests of measurements: known signals come back from CSV files, whatever their rate, unit and form.
#include "calibrate/records/measurement.h"

#include "calibrate/records/record_reduction.h"
#include "sim/eval/quantities.h"
#include "sim/eval/run_ranges.h"
#include "sim/schemes/scheme.h"
#include "tests/unit/measurement_fixture.h"

namespace beltlife::measurement_test {
namespace {

TEST_F(MeasurementTest, KnownOrdersComeBackFromAnyRateWithTheirCrankSpeedFound) {
  spec.mean = true;
  for (const double rate : {1000.0, 2048.0, 5000.0, 800.0})
    for (const double seconds : {1.0, 6.3}) {
      Record r{.rate = rate, .seconds = seconds};
      write(r);
      const Measurement m = good();
      EXPECT_EQ(m.windows, static_cast<int>(seconds));
      // Without noise the search ends where rounding hides the maximum: 1e-8 of the speed and less.
      EXPECT_NEAR(m.crank_rpm, 1515, 1e-3) << rate;
      for (const auto& [order, amplitude] : known)
        EXPECT_NEAR(value(m, fmt::format("order_{:g}", order)), amplitude, 1e-4) << rate << " " << order;
      // Windows do not hold whole revolutions: order 0.5 leaves up to 2 / (pi 12.6), as it does in the simulation's.
      EXPECT_NEAR(value(m, "mean"), mean_rpm, 0.06);
      EXPECT_EQ(m.values.size(), known.size() + 1) << "nothing else stands out";
      EXPECT_EQ(m.left_out.size(), 18 - known.size());
    }
}

TEST_F(MeasurementTest, InNoiseOrdersComeBackWithinTheNoiseThatIsStated) {
  for (const auto& [rate, seconds] : {std::pair{2048.0, 6.0}, {5000.0, 6.0}, {1000.0, 25.0}, {2048.0, 2.0}}) {
    write(Record{.rate = rate, .seconds = seconds, .noise = 5});
    const Measurement m = good();
    ASSERT_GT(m.noise, 0);
    for (const MeasuredValue& v : m.values) {
      const double order = std::stod(v.quantity.substr(v.quantity.rfind('_') + 1));
      ASSERT_TRUE(known.contains(order)) << v.quantity << " is noise";
      EXPECT_NEAR(v.value, known.at(order), 4 * m.noise) << v.quantity;
      EXPECT_EQ(v.floor, m.noise);
      EXPECT_TRUE(v.logarithm);
      EXPECT_NEAR(v.sigma, std::hypot(0.02, m.noise / (v.value + m.noise)), 1e-12);  // rounding
    }
    // The crank speed scatters by sqrt(6 / N) sigma / (pi A order T): of 2 s 2.5e-4 Hz of the crank, 0.015 r/min.
    EXPECT_NEAR(m.crank_rpm, 1515, 0.05);
  }
}

TEST_F(MeasurementTest, TheNoiseIsThatOfTheAmplitudes) {
  for (const double seconds : {2.0, 8.0}) {
    double stated = 0, squares = 0;
    int amplitudes = 0;
    constexpr int seeds = 12;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Record r{.rate = 1000, .seconds = seconds, .noise = 5, .seed = seed};
      const ReductionSettings s{1000, 1, 25, 1515.0 / 60};
      const Reduction reduced = reduce_record(r.values(), r.rate, s);
      // sigma sqrt(2 / N); with windows, the median of 18 deviations of 14 degrees of freedom scatters by 5 %.
      const double truth = 5 * std::sqrt(2 / (1000 * seconds));
      EXPECT_NEAR(reduced.noise, truth, 0.2 * truth) << seconds << " " << seed;
      stated += reduced.noise / seeds;
      for (const ReducedOrder& o : reduced.orders)
        if (known.contains(o.order)) squares += std::pow(o.amplitude - known.at(o.order), 2), ++amplitudes;
    }
    // 84 amplitudes: their scatter is known to 8 %.
    EXPECT_NEAR(std::sqrt(squares / amplitudes), stated, 0.25 * stated) << seconds;
  }
}

TEST_F(MeasurementTest, ASpectrumGivesTheOrdersOfItsTimeSeries) {
  const Record r{.rate = 2048, .seconds = 4, .noise = 2};
  write(r);
  const Measurement series = good();
  const Spectrum s = amplitude_spectrum(r.values(), r.rate);
  write(csv("frequency_hz,speed_rpm", s.amplitude, s.frequency_hz[1]));
  const Measurement m = good();
  EXPECT_EQ(m.windows, 0);
  EXPECT_NEAR(m.crank_rpm, 1515, 0.5);  // a twentieth of the bin of 0.25 Hz, over order 3 and 9
  for (const auto& [order, amplitude] : known) {
    const std::string name = fmt::format("order_{:g}", order);
    // The series' noise is 2 sqrt(2 / 4096) = 0.044; about a line, five bins of noise add half of its square to A.
    if (std::isnan(value(m, name))) continue;  // below the noise of the spectrum
    EXPECT_NEAR(value(m, name), value(series, name), 0.15) << name;
  }
  EXPECT_FALSE(std::isnan(value(m, "order_3")));
  EXPECT_FALSE(std::isnan(value(m, "order_1")));
  std::vector<double> orders_axis = s.frequency_hz;
  std::string text = "order;speed_rad_s\n";
  for (std::size_t k = 0; k < s.amplitude.size(); ++k)
    text += fmt::format("{};{}\n", s.frequency_hz[k] / 25.25, s.amplitude[k] * pi / 30);
  write(text);
  EXPECT_NEAR(value(good(), "order_3"), value(m, "order_3"), 1e-3);  // the same bins but for the crank speed found
}

TEST_F(MeasurementTest, TimesOfFewDigitsAreTheEvenTimesThatWereMeant) {
  for (const double rate : {1000.0, 2048.0, 1024.5}) {
    const auto values = Record{.rate = rate, .seconds = 1}.values();
    std::string text = "time_s,speed_rpm\n";
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format("{:.4f},{}\n", static_cast<double>(i) / rate, values[i]);
    write(text);
    const Measurement m = good();
    EXPECT_EQ(m.windows, 1);
    EXPECT_NEAR(m.crank_rpm, 1515, 0.1);  // half a digit at either end: 1e-4 s of 1 s and less
    EXPECT_NEAR(value(m, "order_3"), 40, 0.01);
  }
}

TEST_F(MeasurementTest, WindowsLieAtTheEndOfTheRecord) {
  std::vector<double> values = Record{.rate = 1000, .seconds = 2.6}.values();
  for (std::size_t i = 0; i < 600; ++i) values[i] += 30 * std::sin(0.4712 * static_cast<double>(i));  // 75 Hz, at first
  write(csv("time_s,speed_rpm", values, 1e-3));
  const Measurement m = good();
  EXPECT_EQ(m.windows, 2);
  // What the beginning does to the crank speed found, 1e-4 of it, turns order 3 by 0.02 rad in a window: 1e-4 of 40.
  EXPECT_NEAR(value(m, "order_3"), 40, 0.02);
}

TEST_F(MeasurementTest, SpectraOfOtherWindowsGiveTheSameOrders) {
  const Record r{.rate = 1000, .seconds = 2, .rpm = 1500, .mean = 0};
  const std::vector<double> signal = r.values();
  const auto n = static_cast<double>(signal.size());
  for (const SpectrumWindow window : {SpectrumWindow::flat_top, SpectrumWindow::rectangular}) {
    std::vector<double> amplitude;
    for (int k = 0; k < 600; ++k) {
      double real = 0, imaginary = 0, sum = 0;
      for (std::size_t i = 0; i < signal.size(); ++i) {
        const double turn = 2 * pi * static_cast<double>(i) / n;
        const double flat_top = 0.21557895 - 0.41663158 * std::cos(turn) + 0.277263158 * std::cos(2 * turn) -
                                0.083578947 * std::cos(3 * turn) + 0.006947368 * std::cos(4 * turn);
        const double w = window == SpectrumWindow::flat_top ? flat_top : 1;
        real += w * signal[i] * std::cos(k * turn);
        imaginary += w * signal[i] * std::sin(k * turn);
        sum += w;
      }
      amplitude.push_back(2 * std::hypot(real, imaginary) / sum);
    }
    write(csv("frequency_hz,speed_rpm", amplitude, 0.5));
    spec.window = window;
    const Measurement m = good();
    for (const auto& [order, expected] : known)  // 3.77 is rounded: 1e-4
      EXPECT_NEAR(value(m, fmt::format("order_{:g}", order)), expected, 2e-4 * expected) << order;
  }
}

TEST_F(MeasurementTest, AWanderingSpeedTakesNothingFromTheOrders) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0, 2);
  std::vector<double> values;
  double turns = 0;
  for (int i = 0; i < 30000; ++i) {
    turns += 25 * (1 + 1e-3 * std::sin(2 * pi * i / 17000.)) / 1000;  // 0.1 %: order 9 comes 6 periods out of step
    double x = mean_rpm + normal(random);
    for (const auto& [order, amplitude] : known) x += amplitude * std::cos(2 * pi * order * turns + order);
    values.push_back(x);
  }
  write(csv("time_s,speed_rpm", values, 1e-3));
  const Measurement m = good();
  // In a window, order 9 turns by up to 0.7 rad against the mean speed: 4 %, order 3 by 0.24 rad: 0.5 %.
  for (const auto& [order, amplitude] : known)
    EXPECT_NEAR(value(m, fmt::format("order_{:g}", order)), amplitude, 0.005 * order * amplitude + 4 * m.noise);
}

TEST_F(MeasurementTest, TheSimulationsOwnRecordGivesItsOwnNumbers) {
  scene = read_scene(BELTLIFE_SCENES "/two_pulley.toml",
                     {"solver.scheme=linearly_implicit", "solver.step_s=2e-5", "belt.elements=64",
                      "profile.settle_s=0.01", "profile.ramp_s=0.05", "profile.hold_s=0.12", "profile.evaluate_s=0.06"})
              .scene;
  const Model model = compile(scene);
  const RunPlan plan = plan_range(scene, scene.range[1]);
  const auto outcomes = run_plans(model, {plan}, 1);
  const RunRecord& run = outcomes[0].record;
  const WindowRecord& window = run.windows[0];
  const OutputSummary expected = *summarise(model, run, window).output;
  const auto& torque = run.trace.find("driven.torque_n_m")->values;
  const std::vector<double> values(torque.begin() + static_cast<std::ptrdiff_t>(window.first_sample),
                                   torque.begin() + static_cast<std::ptrdiff_t>(window.last_sample));
  spec.range = "fast";
  spec.channel = "driven.torque_n_m";
  spec.crank_rpm = 2500;
  spec.orders = default_orders();
  spec.mean = true;
  write(csv("time_s,torque [N m]", values, 1e-3));
  const Measurement m = good();
  // Both are the same least squares; CSV keeps every bit, the angle differs by its beginning: rounding.
  for (const OrderLine& line : expected.orders)
    EXPECT_NEAR(value(m, fmt::format("order_{:g}", line.order)), line.torque_n_m, 1e-9 * expected.orders[3].torque_n_m);
  EXPECT_NEAR(value(m, "mean"), expected.torque_n_m_mean, 1e-9);
  const Reduction reduced = reduce_record(values, 1000, {1000, 0.06, 2500.0 / 60, 2500.0 / 60});
  for (std::size_t b = 0; b < octave_bands.size(); ++b) {
    EXPECT_EQ(std::isnan(reduced.bands[b]), std::isnan(expected.bands[b].torque_n_m)) << b;
    if (b < 3) continue;  // not a number in so short a window
    EXPECT_NEAR(reduced.bands[b], expected.bands[b].torque_n_m, 1e-9 * expected.orders[3].torque_n_m);
  }
  EXPECT_FALSE(std::isnan(expected.bands[4].torque_n_m));
}

TEST_F(MeasurementTest, BandsAreWhatIsLeftAboveTheNoise) {
  Record r{.rate = 2048, .seconds = 8, .noise = 2};
  std::vector<double> values = r.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += 3 * std::cos(2 * pi * 233.4 * static_cast<double>(i) / r.rate) +
                 1.5 * std::cos(2 * pi * 56.6 * static_cast<double>(i) / r.rate);
  write(csv("time_s,speed_rpm", values, 1 / r.rate));
  spec.bands = true;
  const Measurement m = good();
  // The orders take some per cent of a sine between them; the noise of a band's power, 2 % of it, comes on top.
  EXPECT_NEAR(value(m, "band_160_320_hz"), 3, 0.15);
  EXPECT_NEAR(value(m, "band_40_80_hz"), 1.5, 0.15);
  EXPECT_TRUE(std::isnan(value(m, "band_10_20_hz"))) << "noise alone";
  EXPECT_TRUE(std::isnan(value(m, "band_80_160_hz"))) << "noise alone";
}

TEST_F(MeasurementTest, TheTraceIsTheMeanOverTwoRevolutions) {
  write(Record{.rate = 2048, .seconds = 4, .noise = 1});
  const Measurement m = good();
  ASSERT_EQ(m.trace.size(), 144u);
  EXPECT_EQ(m.angle_deg[1], 5);
  double worst = 0;
  for (std::size_t p = 0; p < m.trace.size(); ++p) {
    double x = 0;
    for (const auto& [order, amplitude] : known)
      x += amplitude * std::cos(order * m.angle_deg[p] * pi / 180 + order * order);
    worst = std::max(worst, std::abs(x - m.trace[p]));
  }
  EXPECT_LT(worst, 0.5);  // noise of 0.7 over 47 cycles is 0.1; four of it among 144
  EXPECT_EQ(m.amplitude.size(), 501u);
}

TEST_F(MeasurementTest, UnitsSeparatorsAndCommentsAreTakenAsTheyCome) {
  const Record r{.rate = 1000, .seconds = 1};
  const auto rpm = r.values();
  struct Form {
    const char *header, *unit, *line;
    double scale, step;
  };
  const Form forms[] = {
      {"time_s,speed_rpm", "", "{},{}\n", 1, 1e-3},
      {"\xEF\xBB\xBF# from the bench\r\n\r\ntime_ms;drive_shaft.speed_rad_s", "", "{};{}\r\n", pi / 30, 1},
      {"t_s\tspeed_hz", "", "{}\t{}\n", 1. / 60, 1e-3},
      {"\"time [s]\",\"Speed [r/min]\"", "", "{},\"{}\"\n", 1, 1e-3},
      {"time_s,speed", "rad/s", "{}, {}\n", pi / 30, 1e-3},
      {"time_s,drive_shaft.speed (1/min)", "", "{},+{}\n", 1, 1e-3}};
  for (const Form& form : forms) {
    std::string text = std::string(form.header) + "\n";
    for (std::size_t i = 0; i < rpm.size(); ++i)
      text += fmt::format(fmt::runtime(form.line), static_cast<double>(i) * form.step, rpm[i] * form.scale);
    write(text);
    spec.unit.reset();
    if (*form.unit) spec.unit = form.unit;
    EXPECT_NEAR(value(good(), "order_3"), 40, 1e-4) << form.header;
  }
  spec.unit.reset();
  spec.channel = "drive_shaft.torque_n_m";
  spec.column = "Md";
  spec.unit = "kN m";
  spec.sample_rate_hz = 1000;
  std::string text = "n,Md\n";
  for (const double x : rpm) text += fmt::format("0,{}\n", 1e-3 * (x - mean_rpm));
  write(text);
  EXPECT_NEAR(value(good(), "order_3"), 40, 1e-4);
}

}  // namespace
}  // namespace beltlife::measurement_test
