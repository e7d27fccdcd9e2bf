// Owns the command replay: one point of a study once more, with full output, beside what was recorded of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/commands/commands.h"
#include "results/course/scene_runs.h"
#include "results/course/shared_options.h"
#include "results/store/study_file.h"
#include "results/store/whole_file.h"
#include "results/text/print.h"
#include "results/text/table.h"
#include "sim/eval/command_model.h"
#include "sim/eval/drive_model.h"
#include "sim/eval/parallel_for.h"
#include "sim/eval/quantities.h"
#include "sim/eval/settling.h"
#include "sim/lanes/run_pack.h"
#include "sim/range_models.h"
#include "sim/run.h"
#include "sim/scene/spec_reader.h"

namespace beltlife {
namespace {

struct ReplayOptions : CommonOptions {
  std::string file;
  std::size_t point = 0;  ///< --point
  std::string out;        ///< --out, empty: no file
  int frames = 96;        ///< --frames
};

const StudyPoint& point_of(const StudyRecord& record, const ReplayOptions& o) {
  for (const StudyPoint& p : record.points)
    if (p.number == o.point) return p;
  throw BadInput({Problem{
      o.file, 0, "--point", fmt::format("the study has no point {}", o.point),
      record.points.empty() ? "none: it has no points" : fmt::format("from 0 to {}", record.points.back().number)}});
}

std::string text_of_setting(const Setting& s) {
  return std::holds_alternative<double>(s) ? fmt::format("{}", std::get<double>(s)) : std::get<std::string>(s);
}

LoadedScene scene_of(const StudyRecord& record, const StudyPoint& point, const ReplayOptions& o) {
  const SceneSpec base = parse_scene(record.head.scene_text, o.file);
  LoadedScene l;
  l.file.scene = scene_at(base, record.head.parameters, point.settings);
  l.file.path = record.head.scene_path;
  l.out = o.out;
  if (!l.out.empty()) check_writable(l.out);
  l.model = compile(l.file.scene, o.file);
  if (base.driver && base.driver->speed_csv)
    l.measured = read_speed_csv(l.file.path.parent_path() / *base.driver->speed_csv);
  if (!l.out.empty()) l.solved = solve_drive(l.model);
  return l;
}

// As the evaluator ran it, so that the bits are the same: lanes as noted, once more at half the step if it failed.
std::vector<RunRecord> run_again(const LoadedScene& l, const std::vector<RunPlan>& plans, bool drives,
                                 const ReplayOptions& o) {
  const RangeModels models(l.model);
  std::vector<RunRecord> records(plans.size());
  const auto run_one = [&](const Model& model, const RunPlan& plan) {
    RunOptions options;
    options.frames = l.out.empty() ? 0 : o.frames;
    if (plan.settled_within)
      options.enough = [&](const RunRecord& record) { return settled(model, record, *plan.settled_within); };
    RunRecord record =
        model.scene.solver.scheme == Scheme::linearly_implicit
            ? std::move(run_pack({{&model, &plan}}, drives ? LaneUse::drives : LaneUse::arcs, options).front().record)
            : run(model, plan, options).record;
    if (plan.settled_within) keep_last_window(model, record);
    return record;
  };
  parallel_for(static_cast<int>(plans.size()), o.threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const Model& model = models.of(plans[k].condition);
    records[k] = run_one(model, plans[k]);
    if (records[k].status.ok() || !drives) return;
    SceneSpec finer = l.file.scene;
    finer.solver.step_s = 0.5 * run_step(model);
    records[k] = run_one(compile(finer, model.condition), plans[k]);
  });
  return records;
}

/// Quantities of the records by name.
nlohmann::json quantities_of(const LoadedScene& l, const std::vector<RangeSummary>& summaries,
                             const std::vector<RangeLoad>& loads, const Life& life) {
  nlohmann::json all = nlohmann::json::object();
  for (const RangeSummary& s : summaries)
    for (const Quantity& q : quantities_of(s)) all[q.name] = q.value;
  for (const RangeLoad& load : loads)
    for (const Quantity& q : quantities_of(load, range_life(load, l.file.scene.fatigue))) all[q.name] = q.value;
  for (const Quantity& q : duty_quantities(summaries, life)) all[q.name] = q.value;
  return all;
}

int compare(const StudyRecord& record, const StudyPoint& point, const nlohmann::json& again, nlohmann::json j,
            const ReplayOptions& o) {
  j["point"] = point.number;
  j["state"] = std::string(to_string(point.answer.state));
  j["reason"] = point.answer.reason;
  for (std::size_t i = 0; i < point.settings.size(); ++i)
    std::visit([&](const auto& v) { j["settings"][record.head.parameters[i]] = v; }, point.settings[i]);
  Table table({"quantity", "recorded", "again", "difference"});
  bool identical = true;
  for (std::size_t q = 0; q < point.answer.values.size(); ++q) {
    const std::string& name = record.head.quantities[q];
    const double was = point.answer.values[q];
    const double is = again.contains(name) ? again[name].get<double>() : std::nan("");
    identical = identical && was == is;
    j["quantities"][name] = {{"recorded", was}, {"again", finite(is)}};
    table.row({name, fmt::format("{:.9g}", was), fmt::format("{:.9g}", is),
               was == is ? "none" : fmt::format("{:.2g}", is - was)});
  }
  if (!point.answer.values.empty()) j["identical"] = identical;  // else there is nothing to compare
  if (o.json) {
    fmt::print("{}\n", json_text(j));
    return 0;
  }
  fmt::print("Point {} of {}, recorded as {}{}\n\n", point.number, record.head.driver, to_string(point.answer.state),
             point.answer.reason.empty() ? "" : ": " + point.answer.reason);
  for (std::size_t i = 0; i < point.settings.size(); ++i)
    fmt::print("  {} = {}\n", record.head.parameters[i], text_of_setting(point.settings[i]));
  if (!point.answer.values.empty())
    fmt::print("\n{}\n{}\n", table.text(),
               identical
                   ? "The same to the last bit."
                   : fmt::format("Not the same: recorded by version {}, revision {}, now {}, {}.", record.head.version,
                                 record.head.revision, o.program.version, o.program.revision));
  return 0;
}

int replay_command(const StudyRecord& record, const StudyPoint& point, const ReplayOptions& o) {
  if (!o.out.empty())
    throw BadInput({Problem{o.file, 0, "--out", "the study is of another program, which has no result file", ""}});
  const TomlNode study = parse_toml(record.head.study_text, o.file);
  const TomlEntry* entry = study.table()->find("command");
  if (!entry) throw BadInput({Problem{o.file, 0, "", "holds neither a scene nor a command", ""}});
  ReadLog log;
  log.file = o.file;
  const auto spec = read_spec<CommandSpec>(entry->node, log);
  throw_problems(std::move(log.problems));
  const auto folder = std::filesystem::absolute(record.head.study_path).parent_path();
  const Answer again =
      command_model(spec, folder, record.head.parameters, record.head.quantities, 1)({point.settings}, {}).front();
  nlohmann::json values = nlohmann::json::object();
  for (std::size_t q = 0; q < again.values.size(); ++q) values[record.head.quantities[q]] = again.values[q];
  const int code = compare(record, point, values, {{"again", std::string(to_string(again.state))}}, o);
  if (!again.ok()) fmt::print(stderr, "{}: {}\n", to_string(again.state), again.reason);
  return again.ok() ? code : 3;
}

int run_replay(const ReplayOptions& o) {
  const StudyRecord record = read_study_record(o.file);
  const StudyPoint& point = point_of(record, o);
  if (record.head.scene_text.empty()) return replay_command(record, point, o);
  const LoadedScene l = scene_of(record, point, o);
  const auto plans = plans_of(l.file.scene, ranges_for(l.file.scene, record.head.quantities), l.speed());
  std::vector<RunRecord> records = run_again(l, plans, record.head.lanes != "arcs", o);
  const auto loads = loads_of(l, records);
  const Life life = life_of(l, loads, records);
  const auto summaries = summaries_of(l, records);
  const bool failed = report_failures(records, plans);
  nlohmann::json j{{"runs", json_of_runs(records, plans)}};
  if (!o.json)
    for (const RangeSummary& s : summaries) fmt::print("{}\n", text_of(s));
  write_file(l, records, loads.empty() ? nullptr : &life, o);
  const int code = compare(record, point, quantities_of(l, summaries, loads, life), std::move(j), o);
  return failed ? 3 : code;
}

}  // namespace

void add_replay_command(CommandLine& line) {
  auto o = std::make_shared<ReplayOptions>();
  Command command = line.command("replay", "run one point of a study again, with full output");
  command.input("file", o->file, "log (.jsonl) or result file (.h5) of a study, calibration or search")
      .required_whole("--point", o->point, {}, "number of the point, from 0")
      .text("--out", o->out, "FILE.h5", "write an HDF5 result file, for beltlife report");
  frames_flag(command, o->frames);
  command.flag("--json", o->json, "print one JSON object on standard output")
      .flag("--quiet", o->quiet, "no progress on standard error")
      .footer("Example:\n  beltlife replay noise.jsonl --point 3 --out point3.h5 && beltlife report point3.h5")
      .runs(o, run_replay);
}

}  // namespace beltlife
