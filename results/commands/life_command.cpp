// Owns the command life: ranges in parallel, stresses and life, several drives side by side.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "results/commands/scene_runs.h"
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

}  // namespace

int run_life(const CommandOptions& o) {
  if (!o.details.empty()) check_writable(o.details);
  std::string details;
  std::vector<LoadedScene> drives;  // all inputs are checked before the first is run
  std::vector<std::vector<RunPlan>> plans_of_drive;
  for (const auto& path : o.scenes) {
    drives.push_back(load_scene(path, o));
    if (drives.back().file.scene.range.empty())
      throw BadInput(
          {Problem{path, 0, "range", "the scene has no operating range, so no life", "at least one [[range]]"}});
    for (std::size_t i = 0; i + 1 < drives.size(); ++i)
      if (!drives[i].out.empty() && drives[i].out == drives.back().out)
        throw BadInput({Problem{path, 0, "--out", "its results would overwrite those of " + o.scenes[i],
                                "scenes with different file names"}});
    plans_of_drive.push_back(plans_of(drives.back().file.scene, o.ranges, drives.back().speed()));
  }
  bool failed = false;
  nlohmann::json all = nlohmann::json::array();
  std::vector<std::string> header{"life h"};
  for (const RangeSpec& range : drives.front().file.scene.range) header.push_back(range.name);
  const std::string over = life_over(o.ranges);
  header.push_back(o.ranges.empty() ? "duty cycle" : "these ranges");
  header.push_back("log10");
  Table comparison(header);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const LoadedScene& l = drives[i];
    const auto& plans = plans_of_drive[i];
    double wall = 0;
    const auto records = records_of(run_all(l, plans, o, wall));
    const auto loads = loads_of(l, records);
    const Life life = life_of(l, loads, records);
    write_file(l, records, loads.empty() ? nullptr : &life, o);
    const bool bad = report_failures(records, plans) || life.error;
    failed = failed || bad;
    nlohmann::json j = json_of(life);
    j["runs"] = json_of_runs(records, plans);
    for (const RangeLoad& load : loads) j["ranges"][load.name]["loads"] = json_of(load);
    j["scene"] = l.file.path.string();
    j["status"] = bad ? "failed" : "ok";
    j["partial"] = !o.ranges.empty();
    comparison.row(comparison_row(l, life, drives.front().file.scene.range));
    const auto summaries = summaries_of(l, records);
    details += heading(l) + "\n";
    for (const RangeSummary& summary : summaries) {
      details += text_of(summary) + "\n";
      if (summary.complete) j["ranges"][summary.name]["power_w"] = json_of(summary)["power_w"];
    }
    if (!o.json)
      fmt::print("{}\n{}\n{}{}\n", heading(l), loss_table(summaries), settling_lines(l, records), text_of(life, over));
    if (o.flank_for_life_h > 0) {
      const auto height = flank_height_for_life(loads, l.file.scene.fatigue, o.flank_for_life_h);
      if (height) j["flank_height_mm_for_life"] = *height;
      if (!o.json)
        fmt::print("{}\n\n",
                   height ? fmt::format("fatigue.flank_height_mm = {:.4f} gives {:g} h", *height, o.flank_for_life_h)
                          : fmt::format("no flank height between 0.05 and 10 mm gives {:g} h", o.flank_for_life_h));
    }
    all.push_back(std::move(j));
  }
  if (!o.details.empty() && !(std::ofstream(o.details) << details << std::flush))
    throw BadInput({Problem{o.details, 0, "", "cannot be written", "free space on the disk, or a path elsewhere"}});
  if (o.json)
    fmt::print("{}\n", json_text(all.size() == 1 ? all[0] : nlohmann::json{{"scenes", all}}));
  else if (drives.size() > 1)
    fmt::print("{}", comparison.text(0));
  return failed ? 3 : 0;
}

}  // namespace beltlife
