// Owns the layout of a result file.
#include "results/store/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/store/energy_group.h"
#include "results/store/file_paths.h"
#include "results/store/frames_group.h"
#include "results/store/modes_group.h"
#include "results/store/statics_group.h"
#include "results/store/sweep_group.h"
#include "results/store/whole_file.h"
#include "sim/scene/scene_io.h"
#include "sim/signal/spectrum.h"

namespace beltlife {

namespace {

void put_root(Hdf5Image& file, const Provenance& provenance) {
  file.attribute("/", "description",
                 "result of a simulated belt drive; results/store/result_files.md explains every name");
  file.attribute("/", names::root_format, std::int64_t{names::format});
  file.attribute("/", names::root_program, "beltlife");
  file.attribute("/", names::root_version, provenance.version);
  file.attribute("/", names::root_command_line, provenance.command_line);
  file.attribute("/", names::root_scene_path, provenance.scene_path);
  file.attribute("/", names::root_scene_text, provenance.scene_text);
  file.attribute("/", names::root_compiler, provenance.compiler);
  file.attribute("/", names::root_revision, provenance.revision);
  file.attribute("/", names::root_scheme, provenance.scheme);
  file.attribute("/", names::root_elements, std::int64_t{provenance.elements});
}

void put_run(Hdf5Image& file, const std::string& at, const RunRecord& run) {
  file.group(at, "one simulated run");
  file.attribute(at, names::run_state, to_string(run.status.state));
  file.attribute(at, names::run_failed_at_s, run.status.time_s);
  file.attribute(at, names::run_failed_element, std::int64_t{run.status.element});
  file.attribute(at, names::run_where, run.status.where);
  file.attribute(at, names::run_cause, run.status.cause);
  file.attribute(at, names::run_advice, run.status.advice);
  file.attribute(at, names::run_simulated_s, run.simulated_s);
  file.attribute(at, names::run_wall_s, run.wall_s);
  file.attribute(at, names::run_step_s, run.step_s);
  file.attribute(at, names::run_steps, run.steps);
  file.attribute(at, names::run_settling_change, run.settling_change.value_or(std::nan("")));
  file.attribute(at, names::run_friction_overdamped_s, run.friction_overdamped_s);

  const std::string trace = at + std::string(names::trace);
  file.group(trace, "channels sampled at a constant rate, all at the times of time_s");
  put(file, trace, names::time, run.trace.time_s);
  UniqueNames unique;
  unique.take(std::string(names::time.name));
  for (const Channel& channel : run.trace.channels)
    file.dataset(join(trace, unique.take(channel.name)), channel.values, channel.unit, channel.description);
}

/// Pulleys in scene order, read off the hub load channels; numbers where a run recorded none.
std::vector<std::string> pulley_names(const RunRecord& run, std::size_t count) {
  constexpr std::string_view before = "pulley.", after = ".hub_load_x_n";
  std::vector<std::string> found;
  for (const Channel& channel : run.trace.channels)
    if (channel.name.starts_with(before) && channel.name.ends_with(after))
      found.push_back(channel.name.substr(before.size(), channel.name.size() - before.size() - after.size()));
  if (found.size() == count) return found;
  found.clear();
  for (std::size_t i = 0; i < count; ++i) found.push_back(std::to_string(i));
  return found;
}

void put_passes(Hdf5Image& file, const std::string& at, const PassForces& forces) {
  file.group(at, "contact forces of every complete pass of a belt element over this pulley inside the window");
  file.attribute(at, names::passes_unsampled, static_cast<std::int64_t>(forces.unsampled));
  put(file, at, names::normal_resolved, forces.normal_resolved);
  put(file, at, names::tangential_resolved, forces.tangential_resolved);
  put(file, at, names::normal_sampled, forces.normal_sampled);
  put(file, at, names::tangential_sampled, forces.tangential_sampled);
}

void put_element(Hdf5Image& file, const std::string& at, const ElementHistory& element) {
  file.group(at, "what one belt element met as it travelled");
  put(file, at, names::time, element.time_s);
  put(file, at, names::element_normal, element.normal_n);
  put(file, at, names::element_tangential, element.tangential_n);
  put(file, at, names::element_tension, element.tension_n);
  file.dataset(join(at, names::element_pulley.name), element.pulley, names::element_pulley.unit,
               names::element_pulley.about);
}

void put_loop(Hdf5Image& file, const std::string& at, const LoopSnapshot& loop) {
  file.group(at, "the whole belt at the end of the window, node by node in the scene's pulley order");
  put(file, at, names::loop_x, loop.x_m);
  put(file, at, names::loop_y, loop.y_m);
  put(file, at, names::loop_tension, loop.tension_n);
}

/// Amplitude spectra of every channel over the window; nothing where the run ended before the window did.
void put_spectra(Hdf5Image& file, const std::string& at, const Trace& trace, const WindowRecord& window) {
  const std::size_t first = window.first_sample, last = std::min(window.last_sample, trace.time_s.size());
  if (!window.complete || last < first + 2) return;
  const std::size_t count = last - first;
  const double rate_hz = static_cast<double>(count - 1) / (trace.time_s[last - 1] - trace.time_s[first]);
  file.group(at,
             "one-sided amplitude spectra of the window: mean removed, Hann window, a sine on a bin shows its "
             "amplitude");
  put(file, at, names::frequency,
      amplitude_spectrum(std::span(trace.time_s).subspan(first, count), rate_hz).frequency_hz);
  UniqueNames unique;
  unique.take(std::string(names::frequency.name));
  for (const Channel& channel : trace.channels) {
    if (channel.values.size() < last) continue;
    const Spectrum spectrum = amplitude_spectrum(std::span(channel.values).subspan(first, count), rate_hz);
    file.dataset(join(at, unique.take(channel.name)), spectrum.amplitude, channel.unit,
                 "amplitude spectrum of: " + channel.description);
  }
}

void put_window(Hdf5Image& file, const std::string& at, std::size_t run_number, const RunRecord& run,
                const WindowRecord& window) {
  const std::vector<std::string> pulleys = pulley_names(run, window.passes.size());
  file.group(at, "evaluated window of one operating range");
  file.attribute(at, names::name, window.range);
  file.attribute(at, names::range_run, static_cast<std::int64_t>(run_number));
  file.attribute(at, names::range_crank_rpm, window.crank_rpm);
  file.attribute(at, names::duty_share, window.duty_share);
  file.attribute(at, names::range_begin_s, window.begin_s);
  file.attribute(at, names::range_end_s, window.end_s);
  file.attribute(at, names::range_complete, std::int64_t{window.complete});
  file.attribute(at, names::range_first_sample, static_cast<std::int64_t>(window.first_sample));
  file.attribute(at, names::range_last_sample, static_cast<std::int64_t>(window.last_sample));
  file.attribute(at, names::range_pulleys, std::span<const std::string>(pulleys));

  const std::string passes = at + std::string(names::passes);
  file.group(passes, "contact forces by pulley");
  UniqueNames unique;
  for (std::size_t i = 0; i < pulleys.size(); ++i)
    put_passes(file, join(passes, unique.take(pulleys[i])), window.passes[i]);
  put_energy(file, at + std::string(names::energy), window.energy);
  put_element(file, at + std::string(names::element), window.element);
  put_loop(file, at + std::string(names::loop), window.loop);
  put_frames(file, at + std::string(names::frames), window.frames);
  put_spectra(file, at + std::string(names::spectra), run.trace, window);
}

void put_range_life(Hdf5Image& file, const std::string& at, const RangeLife& life) {
  file.group(at, "stresses and life in one operating range, one row a pulley");
  file.attribute(at, names::name, life.name);
  file.attribute(at, names::duty_share, life.duty_share);
  file.attribute(at, names::life_cycles, life.cycles);
  file.attribute(at, names::life_h, life.life_h);
  file.attribute(at, names::damage_share, life.damage_share);
  file.attribute(at, names::life_error, life.error.value_or(""));

  std::vector<std::string> pulleys;
  for (const PulleyLife& pulley : life.pulleys) pulleys.push_back(pulley.name);
  file.dataset(join(at, names::life_pulley.name), pulleys, names::life_pulley.about);
  const auto column = [&](const names::Dataset& as, double PulleyLife::*member, double unit) {
    std::vector<double> values;
    for (const PulleyLife& pulley : life.pulleys) values.push_back(pulley.*member / unit);
    put(file, at, as, values);
  };
  constexpr double mpa = 1e6;
  column(names::axial_mean, &PulleyLife::axial_mean, mpa);
  column(names::axial_alternating, &PulleyLife::axial_alternating, mpa);
  column(names::bending, &PulleyLife::bending, mpa);
  column(names::transverse, &PulleyLife::transverse, mpa);
  column(names::shear, &PulleyLife::shear, mpa);
  column(names::sigma_m, &PulleyLife::sigma_m, mpa);
  column(names::sigma_a, &PulleyLife::sigma_a, mpa);
  column(names::cycles, &PulleyLife::cycles, 1);
  column(names::pulley_damage, &PulleyLife::damage_share, 1);
}

void put_life(Hdf5Image& file, const Life& life) {
  const std::string at(names::life);
  file.group(at, "life of the belt over the duty cycle");
  file.attribute(at, names::life_h, life.life_h);
  file.attribute(at, names::life_log10_life_h, life.log10_life_h);
  file.attribute(at, names::life_error, life.error.value_or(""));
  UniqueNames unique;
  for (const RangeLife& range : life.ranges) put_range_life(file, join(at, unique.take(range.name)), range);
}

std::vector<char> image_of(const Provenance& provenance, const std::vector<RunRecord>& runs, const Life* life,
                           const SolvedDrive* solved, const RunExtras& extras) {
  Hdf5Image file;
  put_root(file, provenance);
  file.group(std::string(names::runs), "simulated runs: the whole profile, or one for each range");
  file.group(std::string(names::ranges), "evaluated windows by operating range");
  UniqueNames unique;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    put_run(file, join(names::runs, std::to_string(i)), runs[i]);
    for (const WindowRecord& window : runs[i].windows)
      put_window(file, join(names::ranges, unique.take(window.range)), i, runs[i], window);
  }
  if (life) put_life(file, *life);
  if (solved) {
    put_statics(file, solved->statics);
    put_modes(file, solved->model, solved->modes);
  }
  if (extras.sweep) put_sweep(file, *extras.sweep);
  if (extras.event) put_event(file, *extras.event);
  return file.bytes();
}

}  // namespace

void write_results(const std::filesystem::path& path, const Provenance& provenance, const std::vector<RunRecord>& runs,
                   const Life* life, const SolvedDrive* solved, const RunExtras& extras) {
  check_writable(path);
  // A failure of the library in memory is a bug of ours, not of the path: it passes through.
  write_whole_file(path, image_of(provenance, runs, life, solved, extras));
}

}  // namespace beltlife
