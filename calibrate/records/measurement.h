// Owns measurements: CSV files of one operating range and channel, reduced to the numbers that the simulator answers.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/eval/study_input.h"

namespace beltlife {

/// With what a measured spectrum was windowed: how much a line spreads over the bins beside it.
enum class SpectrumWindow { hann, flat_top, rectangular };
template <>
struct EnumNames<SpectrumWindow> {
  static constexpr std::array<std::string_view, 3> names{"hann", "flat_top", "rectangular"};
};

struct SpectrumSpec {
  std::string file;
  std::string range;
  std::string channel;
  std::optional<std::string> column;
  std::optional<std::string> unit;
  std::optional<double> sample_rate_hz;
  std::optional<double> crank_rpm;
  SpectrumWindow window = SpectrumWindow::hann;
  std::vector<double> orders;
  bool mean = false;
  bool bands = false;
  double sigma = 0.02;
  double model_error = 0;
  double mean_sigma = 0.005;
  double band_sigma = 0.2;
  std::optional<double> floor;
  double weight = 1;

  template <class V>
  void visit(V& v) {
    v("file", file, required_text, "CSV, a time series or an amplitude spectrum, relative to the study file");
    v("range", range, required_text, "operating range of the scene in which it was measured");
    v("channel", channel, required_text, "what was measured: the output body's speed or torque, drive_shaft.speed_rpm");
    v("column", column, any_text, "column of the file, by its header; absent: the one named like the channel");
    v("unit", unit, any_text, "of the column where its header states none: rpm, rad/s, Hz; N m, kN m");
    v("sample_rate_hz", sample_rate_hz, above(0, 1e7), "of a time series without a column of time");
    v("crank_rpm", crank_rpm, above(0, 1e5),
      "mean crank speed of the record; absent: found near the range's speed, at most 2 % off it");
    v("window", window, any_text, "of an amplitude spectrum; time series get the simulation's own");
    v("orders", orders, within(0.1, 100),
      "orders of crank rotation to compare; absent: all that stand out of the noise");
    v("mean", mean, any_text, "true: compare the mean too (of a time series)");
    v("bands", bands, any_text, "true: compare octave bands of what the orders leave too");
    v("sigma", sigma, above(0, 10), "relative standard deviation of a measured order amplitude, beside the noise seen");
    v("model_error", model_error, within(0, 10), "relative error of the simulation's amplitudes, added in squares");
    v("mean_sigma", mean_sigma, above(0, 10), "relative standard deviation of the mean");
    v("band_sigma", band_sigma, above(0, 10), "relative standard deviation of a band");
    v("floor", floor, above(0, 1e9),
      "amplitude below which nothing is compared, in the channel's unit; absent: the noise");
    v("weight", weight, above(0, 1e6), "of the squares of this file's residuals");
  }
};

/// A measured number beside the quantity of the simulator that should be like it.
struct MeasuredValue {
  std::string quantity;  ///< "idle.drive_shaft.speed_rpm.order_3", ".band_160_320_hz", ".mean"
  double value = 0;      ///< in the quantity's unit
  double sigma = 0;      ///< standard deviation: of ln(value + floor) with `logarithm`, else in the quantity's unit
  double floor = 0;      ///< amplitudes are compared as ln(A + floor)
  bool logarithm = false;
};

/// What a file holds, for calibration and for pages.
struct Measurement {
  SpectrumSpec spec;
  std::vector<MeasuredValue> values;
  std::vector<std::string> left_out;  ///< in words: orders below the noise, beyond the sampling
  double crank_rpm = 0;               ///< as found or given
  double noise = 0;                   ///< standard deviation of a measured order amplitude, in the channel's unit
  int windows = 0;                    ///< stretches of the simulation's evaluated length in the record; 0: a spectrum
  std::vector<double> frequency_hz, amplitude;  ///< amplitude spectrum, root mean square over the windows
  /// Mean over two crank revolutions at 144 angles from 0 to 715, deviation from its own mean; of a time series. Angle
  /// 0 is where the first window begins: a record does not say where the crank stood.
  std::vector<double> angle_deg, trace;
};

/// Reads and reduces a file. The simulation's sampling: `scene.solver.sample_rate_hz` over `scene.profile.evaluate_s`.
///
/// The file is a CSV with one header line; lines that begin with # are comments; cells are separated by comma,
/// semicolon or tab. A time series stands over time_s, t_s or time_ms, or has `sample_rate_hz`; an amplitude spectrum
/// over frequency_hz or order. A time series is brought to the simulation's rate and cut into windows of evaluate_s
/// from its end; each is tracked as the simulation's own, and amplitudes are averaged. Its noise is seen from
/// how windows differ (four or more), else from what the orders leave. Without `orders`, those are compared that exceed
/// four times the noise and 1 % of the largest. Bands are compared less the noise, taken as white.
///
/// Problems go to `log` under `at` (spectrum[2].file ...) or under the CSV's own name and line, at most 20 of a file;
/// the result is then not to be used.
Measurement read_measurement(const SpectrumSpec& spec, const SceneSpec& scene, const std::filesystem::path& folder,
                             const SpecPath& at, ReadLog& log);

}  // namespace beltlife
