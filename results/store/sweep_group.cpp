// The groups /sweep and /event of a result file: see sweep_group.h.
#include "results/store/sweep_group.h"

#include "results/store/energy_group.h"
#include "results/store/file_paths.h"
#include "results/store/modes_group.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

std::vector<double> rows_of(const std::vector<std::vector<double>>& matrix) {
  std::vector<double> flat;
  for (const auto& row : matrix) flat.insert(flat.end(), row.begin(), row.end());
  return flat;
}

std::vector<std::vector<double>> matrix_of(const Hdf5Source& file, const std::string& path, std::size_t rows,
                                           std::size_t columns) {
  if (file.extents(path) != std::vector{rows, columns})
    throw BadInput({Problem{file.name(), 0, path, "does not fit the orders and places beside it",
                            "a row an order, a column a place"}});
  const auto flat = file.numbers(path);
  std::vector<std::vector<double>> out;
  for (std::size_t i = 0; i < rows; ++i)
    out.emplace_back(flat.begin() + static_cast<std::ptrdiff_t>(i * columns),
                     flat.begin() + static_cast<std::ptrdiff_t>((i + 1) * columns));
  return out;
}

}  // namespace

void put_sweep(Hdf5Image& file, const Sweep& s) {
  const std::string at(names::sweep);
  file.group(at, "a steady change of crank speed: orders of the output over crank speed");
  file.attribute(at, names::sweep_from, s.asked.from_rpm);
  file.attribute(at, names::sweep_to, s.asked.to_rpm);
  file.attribute(at, names::sweep_seconds, s.asked.seconds);
  file.attribute(at, names::range_begin_s, s.begin_s);
  file.attribute(at, names::range_end_s, s.end_s);
  file.attribute(at, names::range_complete, std::int64_t{s.complete});
  file.attribute(at, names::sweep_window, s.window_revolutions);
  put(file, at, names::time, s.time_s);
  put(file, at, names::sweep_speed, s.crank_rpm);
  put(file, at, names::sweep_order, s.orders);
  const std::string amplitude = at + std::string(names::sweep_amplitude);
  file.group(amplitude, "amplitudes by channel; a row an order, a column a place of the sweep");
  for (const SweepChannel& c : s.channels) {
    const std::string path = join(amplitude, c.name);
    if (s.time_s.empty())  // ended before a window was full, and no dataset has rows of no length
      file.dataset(path, std::span<const double>(), c.unit, names::sweep_amplitude_about);
    else
      file.matrix(path, rows_of(c.amplitude), s.time_s.size(), c.unit, names::sweep_amplitude_about);
  }
  put_energy(file, at + std::string(names::energy), s.energy);
  if (s.modes.crank_rpm.empty()) return;
  put_map(file, at + std::string(names::sweep_modes), s.modes);
  put_crossings(file, at + std::string(names::sweep_crossings), s.crossings);
}

std::optional<Sweep> read_sweep(const Hdf5Source& file) {
  const std::string at(names::sweep);
  if (file.kind(at) != Hdf5Kind::group) return std::nullopt;
  Sweep s;
  s.asked = {file.number(at, names::sweep_from), file.number(at, names::sweep_to),
             file.number(at, names::sweep_seconds)};
  s.begin_s = file.number(at, names::range_begin_s);
  s.end_s = file.number(at, names::range_end_s);
  s.complete = file.integer(at, names::range_complete) != 0;
  s.window_revolutions = file.number(at, names::sweep_window);
  s.time_s = file.numbers(join(at, names::time.name));
  s.crank_rpm = file.numbers(join(at, names::sweep_speed.name), s.time_s.size());
  s.orders = file.numbers(join(at, names::sweep_order.name));
  const std::string amplitude = at + std::string(names::sweep_amplitude);
  for (const std::string& name : file.children(amplitude)) {
    const std::string path = join(amplitude, name);
    s.channels.push_back({name, file.text(path, "unit"),
                          s.time_s.empty() ? std::vector<std::vector<double>>(s.orders.size())
                                           : matrix_of(file, path, s.orders.size(), s.time_s.size())});
  }
  s.energy = read_energy(file, at + std::string(names::energy));
  s.modes = read_map(file, at + std::string(names::sweep_modes));
  s.crossings = read_crossings(file, at + std::string(names::sweep_crossings));
  return s;
}

void put_event(Hdf5Image& file, const WindowRecord& event) {
  const std::string at(names::event);
  file.group(at, "the event of the scene: a stretch of the first run");
  file.attribute(at, names::range_crank_rpm, event.crank_rpm);
  file.attribute(at, names::range_begin_s, event.begin_s);
  file.attribute(at, names::range_end_s, event.end_s);
  file.attribute(at, names::range_complete, std::int64_t{event.complete});
  file.attribute(at, names::range_first_sample, static_cast<std::int64_t>(event.first_sample));
  file.attribute(at, names::range_last_sample, static_cast<std::int64_t>(event.last_sample));
  put_energy(file, at + std::string(names::energy), event.energy);
}

std::optional<WindowRecord> read_event(const Hdf5Source& file) {
  const std::string at(names::event);
  if (file.kind(at) != Hdf5Kind::group) return std::nullopt;
  WindowRecord w;
  w.range = "event";
  w.crank_rpm = file.number(at, names::range_crank_rpm);
  w.begin_s = file.number(at, names::range_begin_s);
  w.end_s = file.number(at, names::range_end_s);
  w.complete = file.integer(at, names::range_complete) != 0;
  w.first_sample = static_cast<std::size_t>(file.integer(at, names::range_first_sample));
  w.last_sample = static_cast<std::size_t>(file.integer(at, names::range_last_sample));
  w.energy = read_energy(file, at + std::string(names::energy));
  return w;
}

}  // namespace beltlife
