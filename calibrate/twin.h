// Owns twins: records made by the model itself with hidden parameter values and noise, to try a calibration on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/course/options.h"
#include "sim/eval/study_input.h"

namespace beltlife {

struct TwinSpec {
  int format = 1;
  std::string scene;
  std::vector<std::string> set;
  std::vector<std::string> ranges;
  double seconds = 5;
  double sample_rate_hz = 1000;
  double speed_noise_rpm = 0;
  double torque_noise_n_m = 0;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v("format", format, within(1, 1), "version of the format");
    v("scene", scene, required_text, "scene file, relative to this file");
    v("set", set, any_text,
      "settings PATH=VALUE: the truth that a calibration is to find, a finer mesh, a smaller step");
    v("ranges", ranges, any_text, "operating ranges to record; none: all");
    v("seconds", seconds, above(0, 10000), "length of each record, after the drive has settled");
    v("sample_rate_hz", sample_rate_hz, above(0, 1e6), "of the records");
    v("speed_noise_rpm", speed_noise_rpm, within(0, 1e6),
      "standard deviation of white noise on every sample of the speed");
    v("torque_noise_n_m", torque_noise_n_m, within(0, 1e6), "likewise of the torque");
    v("seed", seed, within(0, 9e15), "of the noise");
  }
};

struct TwinOptions : CommonOptions {
  std::string file;
  std::string out;                    ///< --out: PREFIX of the files' names; empty: the file's name
  std::optional<std::uint64_t> seed;  ///< --seed, in place of the file's
};

/// Runs the ranges of the file and writes PREFIX_RANGE.csv each with time, speed and torque of the scene's output. The
/// exit code.
int run_twin(const TwinOptions& options);

}  // namespace beltlife
