// From an HDF5 result file back to records: see result_reader.h.
#include "results/store/result_reader.h"

#include <cmath>

#include "results/store/energy_group.h"
#include "results/store/frames_group.h"
#include "results/store/hdf5_source.h"
#include "results/store/modes_group.h"
#include "results/store/names.h"
#include "results/store/statics_group.h"
#include "results/store/sweep_group.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

std::string below(const std::string& parent, std::string_view name) { return parent + "/" + std::string(name); }

RunStatus status_of(const Hdf5Source& file, const std::string& at) {
  RunStatus status;
  const std::string state = file.text(at, names::run_state);
  for (RunState candidate : {RunState::ok, RunState::diverged, RunState::off_pulley})
    if (state == to_string(candidate)) status.state = candidate;
  status.time_s = file.number(at, names::run_failed_at_s);
  status.element = static_cast<int>(file.integer(at, names::run_failed_element));
  status.where = file.text(at, names::run_where);
  status.cause = file.text(at, names::run_cause);
  status.advice = file.text(at, names::run_advice);
  return status;
}

RunRecord run_of(const Hdf5Source& file, const std::string& at) {
  RunRecord run;
  run.status = status_of(file, at);
  run.simulated_s = file.number(at, names::run_simulated_s);
  run.wall_s = file.number(at, names::run_wall_s);
  run.step_s = file.number(at, names::run_step_s);
  run.steps = file.integer(at, names::run_steps);
  if (file.has(at, names::run_settling_change))  // older files do not hold it
    if (const double change = file.number(at, names::run_settling_change); !std::isnan(change))
      run.settling_change = change;
  run.friction_overdamped_s = file.number(at, names::run_friction_overdamped_s);
  const std::string trace = at + std::string(names::trace);
  run.trace.time_s = file.numbers(below(trace, names::time.name));
  for (const std::string& name : file.children(trace)) {
    if (name == names::time.name) continue;
    const std::string path = below(trace, name);
    run.trace.channels.push_back({name, file.text(path, "unit"), file.text(path, "description"), file.numbers(path)});
  }
  return run;
}

PassForces passes_of(const Hdf5Source& file, const std::string& at) {
  PassForces p;
  p.normal_resolved = file.numbers(below(at, names::normal_resolved.name));
  p.tangential_resolved = file.numbers(below(at, names::tangential_resolved.name));
  p.normal_sampled = file.numbers(below(at, names::normal_sampled.name));
  p.tangential_sampled = file.numbers(below(at, names::tangential_sampled.name));
  p.unsampled = static_cast<std::size_t>(file.integer(at, names::passes_unsampled));
  return p;
}

WindowRecord window_of(const Hdf5Source& file, const std::string& at) {
  WindowRecord w;
  w.range = file.text(at, names::name);
  w.crank_rpm = file.number(at, names::range_crank_rpm);
  w.duty_share = file.number(at, names::duty_share);
  w.begin_s = file.number(at, names::range_begin_s);
  w.end_s = file.number(at, names::range_end_s);
  w.complete = file.integer(at, names::range_complete) != 0;
  w.first_sample = static_cast<std::size_t>(file.integer(at, names::range_first_sample));
  w.last_sample = static_cast<std::size_t>(file.integer(at, names::range_last_sample));
  const std::string passes = at + std::string(names::passes);
  for (const std::string& pulley : file.children(passes)) w.passes.push_back(passes_of(file, below(passes, pulley)));
  const std::string energy = at + std::string(names::energy);
  w.energy = read_energy(file, energy);
  const std::string element = at + std::string(names::element);
  w.element.time_s = file.numbers(below(element, names::time.name));
  w.element.normal_n = file.numbers(below(element, names::element_normal.name));
  w.element.tangential_n = file.numbers(below(element, names::element_tangential.name));
  w.element.tension_n = file.numbers(below(element, names::element_tension.name));
  w.element.pulley = file.integers(below(element, names::element_pulley.name));
  const std::string loop = at + std::string(names::loop);
  w.loop.x_m = file.numbers(below(loop, names::loop_x.name));
  w.loop.y_m = file.numbers(below(loop, names::loop_y.name));
  w.loop.tension_n = file.numbers(below(loop, names::loop_tension.name));
  w.frames = read_frames(file, at + std::string(names::frames));
  return w;
}

}  // namespace

ResultFile read_results(const std::filesystem::path& path) {
  const Hdf5Source file(path.string());
  if (file.integer("/", names::root_format) != names::format)
    throw BadInput({Problem{path.string(), 0, std::string(names::root_format), "another format version",
                            "format " + std::to_string(names::format)}});
  ResultFile out;
  Provenance& p = out.provenance;
  p.version = file.text("/", names::root_version);
  p.command_line = file.text("/", names::root_command_line);
  p.scene_path = file.text("/", names::root_scene_path);
  p.scene_text = file.text("/", names::root_scene_text);
  p.compiler = file.text("/", names::root_compiler);
  p.revision = file.text("/", names::root_revision);
  p.scheme = file.text("/", names::root_scheme);
  p.elements = static_cast<int>(file.integer("/", names::root_elements));
  const std::string runs(names::runs), ranges(names::ranges);
  for (const std::string& run : file.children(runs)) out.runs.push_back(run_of(file, below(runs, run)));
  for (const std::string& range : file.children(ranges)) {
    const std::string at = below(ranges, range);
    const auto run = static_cast<std::size_t>(file.integer(at, names::range_run));
    if (run >= out.runs.size())
      throw BadInput({Problem{path.string(), 0, at, "belongs to a run that the file lacks", "a whole result file"}});
    out.runs[run].windows.push_back(window_of(file, at));
  }
  out.statics = read_statics(file);
  out.modes = read_modes(file);
  out.sweep = read_sweep(file);
  out.event = read_event(file);
  if (out.event && (out.runs.empty() || out.event->first_sample > out.event->last_sample ||
                    out.event->last_sample > out.runs.front().trace.time_s.size()))
    throw BadInput({Problem{path.string(), 0, std::string(names::event), "lies outside the trace of the first run",
                            "a whole result file"}});
  return out;
}

}  // namespace beltlife
