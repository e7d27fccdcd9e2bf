// Making of twins: see twin.h.
#include "calibrate/twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "results/course/loaded_scene.h"
#include "results/course/scene_runs.h"
#include "results/store/whole_file.h"

namespace beltlife {
namespace {

/// Numbers of a normal distribution with the same bits everywhere: the standard library's own may differ between
/// compilers.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : bits_(seed) {}
  double operator()() {
    double x = 0, y = 0, square = 0;
    do {  // Marsaglia's polar method
      x = uniform();
      y = uniform();
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    return x * std::sqrt(-2 * std::log(square) / square);
  }

 private:
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-52 - 1; }
  std::mt19937_64 bits_;
};

std::string csv_of(const TwinSpec& spec, const RunRecord& record, const std::string& body, std::uint64_t seed,
                   const std::string& file) {
  const WindowRecord& window = record.windows.back();
  const auto values = [&](const char* what) -> const std::vector<double>& {
    return record.trace.find(body + what)->values;
  };
  const auto &speed = values(".speed_rpm"), &torque = values(".torque_n_m");
  Noise noise(seed);
  std::string text = fmt::format(
      "# A twin, not a measurement: made by the model from {}, noise of seed {}.\n"
      "time_s,{}.speed_rpm,{}.torque_n_m\n",
      file, seed, body, body);
  for (std::size_t i = window.first_sample; i < window.last_sample; ++i)
    text += fmt::format("{:.6f},{:.7g},{:.7g}\n", static_cast<double>(i - window.first_sample) / spec.sample_rate_hz,
                        speed[i] + spec.speed_noise_rpm * noise(), torque[i] + spec.torque_noise_n_m * noise());
  return text;
}

}  // namespace

int run_twin(const TwinOptions& o) {
  auto input = read_study<TwinSpec>(o.file);
  TwinSpec& spec = input.spec;
  throw_problems(std::move(input.log.problems));
  RangeOptions of_scene;
  static_cast<CommonOptions&>(of_scene) = o;
  of_scene.settings.insert(of_scene.settings.begin(), spec.set.begin(), spec.set.end());
  const std::string path = (input.path.parent_path() / spec.scene).string();
  LoadedScene scene = load_scene(path, of_scene.settings);
  if (!scene.file.scene.output)
    throw BadInput({Problem{path, 0, "output", "missing: there is nothing to record", "[output]"}});
  // Recorded is what follows the stretch in which the scene says the drive settles.
  ProfileSpec& profile = scene.file.scene.profile;
  profile.hold_s = std::max(profile.hold_s - profile.evaluate_s, 0.0) + spec.seconds;
  profile.evaluate_s = spec.seconds;
  profile.settled_within.reset();
  scene.file.scene.solver.sample_rate_hz = spec.sample_rate_hz;
  scene.model = compile(scene.file.scene);
  const auto plans = plans_of(scene.file.scene, spec.ranges, scene.speed());
  const std::string prefix = o.out.empty() ? input.path.stem().string() : o.out;
  std::vector<std::string> names;
  for (const RunPlan& plan : plans) {
    names.push_back(fmt::format("{}_{}.csv", prefix, plan.name));
    check_writable(names.back());
  }
  double wall = 0;
  const auto records = records_of(run_all(scene, plans, of_scene, wall));
  if (report_failures(records, plans)) return 3;
  const auto seed = o.seed.value_or(static_cast<std::uint64_t>(spec.seed));
  for (std::size_t r = 0; r < plans.size(); ++r) {
    const std::string text =
        csv_of(spec, records[r], scene.file.scene.output->body, 1000 * seed + r, input.path.filename().string());
    write_whole_file(names[r], text);
    if (!o.quiet) fmt::print(stderr, "wrote {}\n", names[r]);
  }
  return 0;
}

}  // namespace beltlife
