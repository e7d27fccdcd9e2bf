// The group /modes of a result file: see modes_group.h.
#include "results/store/modes_group.h"

#include <algorithm>

#include "results/store/file_paths.h"

namespace beltlife {
namespace {

// Modes of all states of the arm below each other, one row a mode.
template <typename M>
struct Row {
  ArmState arm;
  const M* mode;
};

template <typename M>
std::vector<Row<M>> rows_of(const std::vector<ArmModes>& arms, std::vector<M> ArmModes::*list) {
  std::vector<Row<M>> rows;
  for (const ArmModes& arm : arms)
    for (const M& mode : arm.*list) rows.push_back({arm.arm, &mode});
  return rows;
}

template <typename Rows, typename Value>
std::vector<double> column(const Rows& rows, Value value) {
  std::vector<double> out;
  for (const auto& row : rows) out.push_back(value(row));
  return out;
}

template <typename Rows, typename Value>
std::vector<std::string> words(const Rows& rows, Value value) {
  std::vector<std::string> out;
  for (const auto& row : rows) out.push_back(std::string(value(row)));
  return out;
}

// One dataset a body, so that a column has a name.
template <typename Rows, typename Value>
void put_bodies(Hdf5Image& file, const std::string& at, const Model& m, const names::Dataset& as, const Rows& rows,
                Value value) {
  UniqueNames unique;
  for (int b = 0; b < m.bodies; ++b)
    file.dataset(join(at, unique.take(m.body_name[b])), column(rows, [&](const auto& r) { return value(*r.mode)[b]; }),
                 as.unit, as.about);
}

// What damped and undamped vibrations have in common.
template <typename Rows>
void put_vibrations(Hdf5Image& file, const std::string& at, const Model& m, const Rows& rows) {
  put(file, at, names::mode_arm, words(rows, [](const auto& r) { return name_of(r.arm); }));
  put(file, at, names::mode_frequency, column(rows, [](const auto& r) { return r.mode->frequency_hz; }));
  put(file, at, names::mode_moving, words(rows, [&](const auto& r) { return describe(m, r.mode->energy); }));
  put(file, at, names::mode_arm_energy, column(rows, [](const auto& r) { return r.mode->energy.arm; }));
  put(file, at, names::mode_belt_energy, column(rows, [](const auto& r) { return r.mode->energy.belt; }));
  const std::string energy = at + std::string(names::energy_shares);
  file.group(energy, "share of the kinetic energy by body");
  put_bodies(file, energy, m, names::body_energy, rows, [](const auto& mode) { return mode.energy.body; });
}

void put_point(Hdf5Image& file, const std::string& at, const Model& m, const Modes& p) {
  file.group(at, "natural frequencies about steady running in one operating range");
  file.attribute(at, names::name, p.range.name);
  file.attribute(at, names::range_crank_rpm, p.range.crank_rpm);
  file.attribute(at, names::belt_speed_m_s, p.loop.belt_speed);
  file.attribute(at, names::centrifugal_n, p.loop.centrifugal);
  file.attribute(at, names::arm_angle_rad, p.loop.arm_angle);
  file.attribute(at, names::balanced, std::int64_t{p.loop.balanced});
  file.attribute(at, names::slack, std::int64_t{p.loop.slack});
  file.attribute(at, names::instead, p.loop.instead);

  const std::string damped = at + std::string(names::damped), undamped = at + std::string(names::undamped);
  file.group(damped, "rotational vibrations with the viscous dampers, one row each, lowest first for each arm state");
  const auto vibrations = rows_of(p.arms, &ArmModes::damped);
  put_vibrations(file, damped, m, vibrations);
  put(file, damped, names::mode_damping, column(vibrations, [](const auto& r) { return r.mode->damping_ratio; }));
  file.group(undamped, "rotational modes without dampers, one row each, lowest first for each arm state");
  const auto modes = rows_of(p.arms, &ArmModes::modes);
  put_vibrations(file, undamped, m, modes);
  put(file, undamped, names::mode_arm_shape, column(modes, [](const auto& r) { return r.mode->arm_shape; }));
  const std::string shape = undamped + std::string(names::shapes);
  file.group(shape, "mode shapes by body");
  put_bodies(file, shape, m, names::body_shape, modes, [](const auto& mode) { return mode.body_shape; });

  const std::string spans = at + std::string(names::transverse_modes);
  file.group(spans, "transverse natural frequencies of the free spans, one row a span in scene order");
  put(file, spans, names::span_of_row, words(p.spans, [](const auto& s) { return s.name; }));
  put(file, spans, names::span_length, column(p.spans, [](const auto& s) { return s.length; }));
  put(file, spans, names::span_tension_estimate, column(p.spans, [](const auto& s) { return s.tension; }));
  put(file, spans, names::span_wave_speed, column(p.spans, [](const auto& s) { return s.wave_speed; }));
  put(file, spans, names::span_first, column(p.spans, [](const auto& s) { return s.frequency_hz[0]; }));
  put(file, spans, names::span_second, column(p.spans, [](const auto& s) { return s.frequency_hz[1]; }));
}

ArmState arm_of(const std::string& name) {
  for (const ArmState arm : {ArmState::free, ArmState::stuck, ArmState::locked})
    if (name == name_of(arm)) return arm;
  return ArmState::none;
}

// Energy shares or shapes by body: an entry a mode in each dataset becomes an entry a body in each mode.
std::vector<std::vector<double>> bodies_of(const Hdf5Source& file, const std::string& at, std::size_t modes) {
  std::vector<std::vector<double>> of_mode(modes);
  for (const std::string& body : file.children(at)) {
    const auto values = file.numbers(join(at, body), modes);
    for (std::size_t i = 0; i < modes; ++i) of_mode[i].push_back(values[i]);
  }
  return of_mode;
}

// Adds the vibrations of a group to the lists of the arm states, which appear as they come.
template <typename M, typename Extra>
void take_vibrations(const Hdf5Source& file, const std::string& at, std::vector<ArmModes>& arms,
                     std::vector<M> ArmModes::*list, Extra extra) {
  const auto arm = file.texts(join(at, names::mode_arm.name));
  const auto frequency = file.numbers(join(at, names::mode_frequency.name), arm.size()),
             arm_energy = file.numbers(join(at, names::mode_arm_energy.name), arm.size()),
             belt_energy = file.numbers(join(at, names::mode_belt_energy.name), arm.size());
  const auto energy = bodies_of(file, at + std::string(names::energy_shares), arm.size());
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const ArmState state = arm_of(arm[i]);
    auto found = std::find_if(arms.begin(), arms.end(), [&](const ArmModes& a) { return a.arm == state; });
    if (found == arms.end()) found = arms.insert(arms.end(), ArmModes{state, {}, {}});
    M mode;
    mode.frequency_hz = frequency[i];
    mode.energy = {energy[i], arm_energy[i], belt_energy[i]};
    extra(mode, i);
    ((*found).*list).push_back(std::move(mode));
  }
}

Modes point_of(const Hdf5Source& file, const std::string& at) {
  Modes p;
  p.range.name = file.text(at, names::name);
  p.range.crank_rpm = p.loop.crank_rpm = file.number(at, names::range_crank_rpm);
  p.loop.belt_speed = file.number(at, names::belt_speed_m_s);
  p.loop.centrifugal = file.number(at, names::centrifugal_n);
  p.loop.arm_angle = file.number(at, names::arm_angle_rad);
  p.loop.balanced = file.integer(at, names::balanced) != 0;
  p.loop.slack = file.integer(at, names::slack) != 0;
  p.loop.instead = file.text(at, names::instead);

  const std::string damped = at + std::string(names::damped), undamped = at + std::string(names::undamped);
  const auto rows = [&](const std::string& group) { return file.texts(join(group, names::mode_arm.name)).size(); };
  const auto ratio = file.numbers(join(damped, names::mode_damping.name), rows(damped));
  take_vibrations(file, damped, p.arms, &ArmModes::damped,
                  [&](DampedMode& mode, std::size_t i) { mode.damping_ratio = ratio[i]; });
  const auto arm_shape = file.numbers(join(undamped, names::mode_arm_shape.name), rows(undamped));
  const auto shape = bodies_of(file, undamped + std::string(names::shapes), arm_shape.size());
  take_vibrations(file, undamped, p.arms, &ArmModes::modes, [&](Mode& mode, std::size_t i) {
    mode.arm_shape = arm_shape[i];
    mode.body_shape = shape[i];
  });

  const std::string spans = at + std::string(names::transverse_modes);
  const auto span = file.texts(join(spans, names::span_of_row.name));
  const auto values = [&](const names::Dataset& as) { return file.numbers(join(spans, as.name), span.size()); };
  const auto length = values(names::span_length), tension = values(names::span_tension_estimate),
             wave = values(names::span_wave_speed), first = values(names::span_first),
             second = values(names::span_second);
  for (std::size_t i = 0; i < span.size(); ++i) {
    p.spans.push_back({span[i], length[i], tension[i], wave[i], {first[i], second[i]}});
    p.loop.tension.push_back(tension[i]);
  }
  return p;
}

}  // namespace

void put_map(Hdf5Image& file, const std::string& at, const Campbell& map) {
  file.group(at, "natural frequencies over crank speed, one dataset a curve");
  put(file, at, names::map_speed, map.crank_rpm);
  UniqueNames unique;
  unique.take(std::string(names::map_speed.name));
  for (const FrequencyCurve& curve : map.curves) {
    const std::string path = join(at, unique.take(curve.name));
    file.dataset(path, curve.frequency_hz, names::map_curve.unit, names::map_curve.about);
    file.attribute(path, names::name, curve.name);
    file.attribute(path, names::curve_arm, curve.arm ? name_of(*curve.arm) : "");
    file.attribute(path, names::curve_damping_ratio, curve.damping_ratio);
  }
}

Campbell read_map(const Hdf5Source& file, const std::string& at) {
  Campbell map;
  if (file.children(at).empty()) return map;
  map.crank_rpm = file.numbers(join(at, names::map_speed.name));
  for (const std::string& name : file.children(at)) {
    if (name == names::map_speed.name) continue;
    const std::string path = join(at, name), arm = file.text(path, names::curve_arm);
    map.curves.push_back({file.text(path, names::name), arm.empty() ? std::nullopt : std::optional(arm_of(arm)),
                          file.numbers(path, map.crank_rpm.size()), file.number(path, names::curve_damping_ratio)});
  }
  return map;
}

void put_crossings(Hdf5Image& file, const std::string& at, const std::vector<Crossing>& crossings) {
  file.group(at, "orders of the driven body's rotation that meet a natural frequency, one row each");
  put(file, at, names::crossing_order, column(crossings, [](const auto& c) { return c.order; }));
  put(file, at, names::crossing_speed, column(crossings, [](const auto& c) { return c.crank_rpm; }));
  put(file, at, names::mode_frequency, column(crossings, [](const auto& c) { return c.frequency_hz; }));
  put(file, at, names::mode_damping, column(crossings, [](const auto& c) { return c.damping_ratio; }));
  put(file, at, names::crossing_mode, words(crossings, [](const auto& c) { return c.mode; }));
  put(file, at, names::crossing_near, words(crossings, [](const auto& c) { return c.near.value_or(""); }));
}

std::vector<Crossing> read_crossings(const Hdf5Source& file, const std::string& at) {
  std::vector<Crossing> found;
  if (file.children(at).empty()) return found;
  const auto order = file.numbers(join(at, names::crossing_order.name));
  const auto values = [&](const names::Dataset& as) { return file.numbers(join(at, as.name), order.size()); };
  const auto speed = values(names::crossing_speed), frequency = values(names::mode_frequency),
             damping = values(names::mode_damping);
  const auto mode = file.texts(join(at, names::crossing_mode.name), order.size()),
             near = file.texts(join(at, names::crossing_near.name), order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    found.push_back({frequency[i], order[i], speed[i], mode[i], damping[i],
                     near[i].empty() ? std::nullopt : std::optional(near[i])});
  return found;
}

void put_modes(Hdf5Image& file, const Model& m, const DriveModes& modes) {
  if (modes.points.empty()) return;
  const std::string ranges(names::modes_ranges);
  file.group(std::string(names::modes), "natural frequencies of the drive in steady running");
  file.group(ranges, "by operating range, all of the scene's; \"rest\" for a drive without ranges");
  UniqueNames unique;
  for (const Modes& point : modes.points) put_point(file, join(ranges, unique.take(point.range.name)), m, point);
  if (modes.map.crank_rpm.empty()) return;
  put_map(file, std::string(names::map), modes.map);
  put_crossings(file, std::string(names::crossings), modes.crossings);
}

std::optional<DriveModes> read_modes(const Hdf5Source& file) {
  const std::string ranges(names::modes_ranges);
  if (file.children(ranges).empty()) return std::nullopt;
  DriveModes modes;
  for (const std::string& range : file.children(ranges)) modes.points.push_back(point_of(file, join(ranges, range)));
  modes.map = read_map(file, std::string(names::map));
  modes.crossings = read_crossings(file, std::string(names::crossings));
  return modes;
}

}  // namespace beltlife
