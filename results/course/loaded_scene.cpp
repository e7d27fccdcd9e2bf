// Reading a scene for a command: see loaded_scene.h.
#include "results/course/loaded_scene.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "results/store/whole_file.h"
#include "sim/eval/remarks.h"
#include "sim/plan.h"

namespace beltlife {
namespace {

// A measurement that misses part of the profile would run on at its last speed. One sampling interval is forgiven.
void refuse_short(const MeasuredSpeed& measured, const SceneSpec& scene, const std::string& file) {
  if (scene.range.empty()) return;
  const auto& t = measured.time_s;
  const double wanted = plan_profile(scene, &measured).end_s;
  if (t.front() <= t[1] - t.front() && t.back() + (t.back() - t[t.size() - 2]) >= wanted) return;
  throw BadInput(
      {Problem{file, 0, "driver.speed_csv",
               fmt::format("covers {:g} to {:g} s, the profile runs from 0 to {:g} s", t.front(), t.back(), wanted),
               "a measurement of the whole profile, or shorter profile.hold_s, or fewer ranges"}});
}

}  // namespace

LoadedScene load_scene(const std::string& path, const std::vector<std::string>& settings, const std::string& out) {
  LoadedScene l{read_scene(path, settings), {}, {}, out, {}};
  if (!l.out.empty()) check_writable(l.out);
  try {
    l.model = compile(l.file.scene, path);
  } catch (const BadInput& bad) {
    throw located(l.file, bad);
  }
  if (l.file.scene.driver && l.file.scene.driver->speed_csv) {
    const auto csv = l.file.path.parent_path() / *l.file.scene.driver->speed_csv;
    l.measured = read_speed_csv(csv);
    refuse_short(*l.measured, l.file.scene, csv.string());
  }
  if (const std::string words = coarse_mesh(l.model); !words.empty()) fmt::print(stderr, "warning: {}\n", words);
  if (!l.out.empty()) l.solved = solve_drive(l.model);
  return l;
}

}  // namespace beltlife
