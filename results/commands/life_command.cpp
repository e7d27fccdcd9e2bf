// Owns the command life: ranges in parallel, stresses and life, several drives side by side.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "results/commands/commands.h"
#include "results/course/scene_runs.h"
#include "results/course/shared_options.h"
#include "results/store/whole_file.h"
#include "results/text/print.h"
#include "results/text/table.h"

namespace beltlife {
namespace {

// Of what a life is: of the whole duty cycle only if all its ranges were run.
std::string life_over(const std::vector<std::string>& ranges) {
  if (ranges.empty()) return "the duty cycle";
  std::string names;
  for (const auto& name : ranges) names += (names.empty() ? "" : ", ") + name;
  return (ranges.size() == 1 ? "range " : "ranges ") + names + " alone";
}

std::string heading(const LoadedScene& l) {
  return l.file.path.stem().string() + (l.file.scene.title.empty() ? "" : ": " + l.file.scene.title) + "\n";
}

// One line of the comparison: the lives in the ranges of the first scene, then over the duty cycle.
std::vector<std::string> comparison_row(const LoadedScene& l, const Life& life, const std::vector<RangeSpec>& ranges) {
  std::vector<std::string> row{l.file.path.stem().string()};
  for (const RangeSpec& range : ranges) {
    const auto found =
        std::find_if(life.ranges.begin(), life.ranges.end(), [&](const RangeLife& r) { return r.name == range.name; });
    row.push_back(found == life.ranges.end() ? "-" : number_text(found->life_h, "{:.4g}"));
  }
  row.push_back(number_text(life.life_h, "{:.4g}"));
  row.push_back(number_text(life.log10_life_h, "{:.2f}"));
  return row;
}

struct LifeOptions : RangeOptions {
  std::vector<std::string> scenes;
  std::string details;          ///< --details: text file for what simulate prints, empty: none
  double flank_for_life_h = 0;  ///< --flank-for, 0: not asked
};

struct Drive {
  LoadedScene scene;
  std::vector<RunPlan> plans;
};

/// Of several scenes each result file has its scene's name.
std::string out_of(const std::string& scene, const LifeOptions& o) {
  if (o.out.empty() || o.scenes.size() == 1) return o.out;
  const std::filesystem::path path = o.out;
  return path.parent_path() /
         (path.stem().string() + "_" + std::filesystem::path(scene).stem().string() + path.extension().string());
}

/// All inputs are checked before the first is run.
std::vector<Drive> drives_of(const LifeOptions& o) {
  std::vector<Drive> drives;
  for (const auto& path : o.scenes) {
    LoadedScene scene = load_scene(path, o.settings, out_of(path, o));
    if (scene.file.scene.range.empty())
      throw BadInput(
          {Problem{path, 0, "range", "the scene has no operating range, so no life", "at least one [[range]]"}});
    for (std::size_t i = 0; i < drives.size(); ++i)
      if (!scene.out.empty() && drives[i].scene.out == scene.out)
        throw BadInput({Problem{path, 0, "--out", "its results would overwrite those of " + o.scenes[i],
                                "scenes with different file names"}});
    auto plans = plans_of(scene.file.scene, o.ranges, scene.speed());
    drives.push_back({std::move(scene), std::move(plans)});
  }
  return drives;
}

/// What was found of one drive.
struct DriveLife {
  nlohmann::json json;
  Life life;
  std::string details;
  bool failed = false;
};

/// Adds to the JSON, and prints, the flank height with which the drive would live as long as was asked.
void say_flank_height(const LifeOptions& o, const LoadedScene& l, const std::vector<RangeLoad>& loads,
                      nlohmann::json& j) {
  const auto height = flank_height_for_life(loads, l.file.scene.fatigue, o.flank_for_life_h);
  if (height) j["flank_height_mm_for_life"] = *height;
  if (!o.json)
    fmt::print("{}\n\n", height
                             ? fmt::format("fatigue.flank_height_mm = {:.4f} gives {:g} h", *height, o.flank_for_life_h)
                             : fmt::format("no flank height between 0.05 and 10 mm gives {:g} h", o.flank_for_life_h));
}

DriveLife run_drive(const Drive& drive, const LifeOptions& o) {
  const auto& [l, plans] = drive;
  double wall = 0;
  const auto records = records_of(run_all(l, plans, o, wall));
  const auto loads = loads_of(l, records);
  DriveLife found{{}, life_of(l, loads, records), heading(l) + "\n"};
  write_file(l, records, loads.empty() ? nullptr : &found.life, o);
  found.failed = report_failures(records, plans) || found.life.error;
  nlohmann::json& j = found.json;
  j = json_of(found.life);
  j["runs"] = json_of_runs(records, plans);
  for (const RangeLoad& load : loads) j["ranges"][load.name]["loads"] = json_of(load);
  j["scene"] = l.file.path.string();
  j["status"] = found.failed ? "failed" : "ok";
  j["partial"] = !o.ranges.empty();
  const auto summaries = summaries_of(l, records);
  for (const RangeSummary& summary : summaries) {
    found.details += text_of(summary) + "\n";
    if (summary.complete) j["ranges"][summary.name]["power_w"] = json_of(summary)["power_w"];
  }
  if (!o.json)
    fmt::print("{}\n{}\n{}{}\n", heading(l), loss_table(summaries), settling_lines(l, records),
               text_of(found.life, life_over(o.ranges)));
  if (o.flank_for_life_h > 0) say_flank_height(o, l, loads, j);
  return found;
}

int run_life(const LifeOptions& o) {
  if (!o.details.empty()) check_writable(o.details);
  const std::vector<Drive> drives = drives_of(o);
  const std::vector<RangeSpec>& ranges = drives.front().scene.file.scene.range;
  std::vector<std::string> header{"life h"};
  for (const RangeSpec& range : ranges) header.push_back(range.name);
  header.push_back(o.ranges.empty() ? "duty cycle" : "these ranges");
  header.push_back("log10");
  Table comparison(header);
  bool failed = false;
  std::string details;
  nlohmann::json all = nlohmann::json::array();
  for (const Drive& drive : drives) {
    DriveLife found = run_drive(drive, o);
    failed = failed || found.failed;
    details += found.details;
    comparison.row(comparison_row(drive.scene, found.life, ranges));
    all.push_back(std::move(found.json));
  }
  if (!o.details.empty() && !(std::ofstream(o.details) << details << std::flush))
    throw BadInput({Problem{o.details, 0, "", "cannot be written", "free space on the disk, or a path elsewhere"}});
  if (o.json)
    fmt::print("{}\n", json_text(all.size() == 1 ? all[0] : nlohmann::json{{"scenes", all}}));
  else if (drives.size() > 1)
    fmt::print("{}", comparison.text(0));
  return failed ? 3 : 0;
}

}  // namespace

void add_life_command(CommandLine& line) {
  auto o = std::make_shared<LifeOptions>();
  Command command =
      line.command("life", "run every range alone, in parallel, and print stresses and the life of the belt");
  range_flags(command, *o);
  command.inputs("scene", o->scenes, "one or more scene files (TOML)")
      .text("--details", o->details, "FILE.txt",
            "also write tensions, slip, hub loads, orders and energy of every range to a text file")
      .positive("--flank-for", o->flank_for_life_h, "HOURS",
                "also print the flank height at which the life is this many hours")
      .footer(
          "Examples:\n"
          "  beltlife life sim/scenes/two_pulley.toml\n"
          "  beltlife life sim/scenes/baseline.toml sim/scenes/alternative_1.toml")
      .runs(o, run_life);
}

}  // namespace beltlife
