// The group /statics of a result file: see statics_group.h.
#include "results/store/statics_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "results/store/file_paths.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi, rpm = 30 / std::numbers::pi, mpa = 1e6;

const double none = std::nan("");

template <typename Rows, typename Value>
std::vector<double> column(const Rows& rows, Value value) {
  std::vector<double> out;
  for (const auto& row : rows) out.push_back(value(row));
  return out;
}

template <typename Rows, typename Value>
std::vector<std::string> words(const Rows& rows, Value value) {
  std::vector<std::string> out;
  for (const auto& row : rows) out.push_back(value(row));
  return out;
}

void put_take_up(Hdf5Image& file, const std::vector<TakeUpRow>& rows) {
  const std::string at(names::take_up);
  file.group(at, "belt lengths that the tensioner can hold, one row a position of the arm, longest belt first");
  put(file, at, names::take_up_position, words(rows, [](const auto& r) { return r.name; }));
  put(file, at, names::take_up_arm, column(rows, [](const auto& r) { return r.arm_angle; }));
  put(file, at, names::take_up_path, column(rows, [](const auto& r) { return r.path_length; }));
  put(file, at, names::take_up_unstretched, column(rows, [](const auto& r) { return r.unstretched_length; }));
  put(file, at, names::take_up_tension, column(rows, [](const auto& r) { return r.tension; }));
  put(file, at, names::take_up_ended_by, words(rows, [](const auto& r) { return r.reason; }));
}

void put_spans(Hdf5Image& file, const std::string& at, const std::vector<QuasiStaticSpan>& spans) {
  file.group(at, "tensions, one row a span in scene order");
  put(file, at, names::span_of_row, words(spans, [](const auto& s) { return s.name; }));
  put(file, at, names::span_tension, column(spans, [](const auto& s) { return s.tension; }));
  put(file, at, names::span_tension_low, column(spans, [](const auto& s) { return s.tension_low; }));
  put(file, at, names::span_tension_high, column(spans, [](const auto& s) { return s.tension_high; }));
}

void put_pulleys(Hdf5Image& file, const std::string& at, const std::vector<QuasiStaticPulley>& pulleys,
                 const RangeLife* life) {
  file.group(at, "loads, safety, losses and estimated stresses, one row a pulley in scene order");
  const auto put_column = [&](const names::Dataset& as, auto value) { put(file, at, as, column(pulleys, value)); };
  put(file, at, names::life_pulley, words(pulleys, [](const auto& p) { return p.name; }));
  put_column(names::pulley_speed, [](const auto& p) { return p.speed * rpm; });
  put_column(names::pulley_torque, [](const auto& p) { return p.torque; });
  put_column(names::pulley_wrap, [](const auto& p) { return p.wrap * degree; });
  put_column(names::hub_load, [](const auto& p) { return p.hub_load; });
  put_column(names::hub_load_low, [](const auto& p) { return p.hub_load_low; });
  put_column(names::hub_load_high, [](const auto& p) { return p.hub_load_high; });
  put_column(names::hub_direction, [](const auto& p) { return std::atan2(p.hub_y, p.hub_x) * degree; });
  put_column(names::slip_safety, [](const auto& p) { return p.slip_safety.value_or(none); });
  put_column(names::bending_loss, [](const auto& p) { return p.bending_loss; });
  put_column(names::rigid_bending_loss, [](const auto& p) { return p.rigid_loss; });
  put_column(names::creep_loss, [](const auto& p) { return p.creep_loss; });
  const auto put_estimate = [&](const names::Dataset& as, double PulleyLife::*member, double unit) {
    std::vector<double> values(pulleys.size(), none);
    for (std::size_t i = 0; life && i < std::min(values.size(), life->pulleys.size()); ++i)
      values[i] = life->pulleys[i].*member / unit;
    put(file, at, as, values);
  };
  put_estimate(names::estimated_sigma_m, &PulleyLife::sigma_m, mpa);
  put_estimate(names::estimated_sigma_a, &PulleyLife::sigma_a, mpa);
  put_estimate(names::estimated_cycles, &PulleyLife::cycles, 1);
  put_estimate(names::estimated_damage, &PulleyLife::damage_share, 1);
}

void put_range(Hdf5Image& file, const std::string& at, const QuasiStaticRange& r, const RangeLife* life) {
  file.group(at, "steady running at the mean speed of one operating range, without ripple");
  file.attribute(at, names::name, r.name);
  file.attribute(at, names::error, r.error.value_or(""));
  file.attribute(at, names::remarks, fmt::format("{}", fmt::join(r.remarks, "\n")));
  file.attribute(at, names::range_crank_rpm, r.crank_rpm);
  file.attribute(at, names::belt_speed_m_s, r.belt_speed);
  file.attribute(at, names::centrifugal_n, r.centrifugal);
  file.attribute(at, names::driver_power_w, r.driver_power);
  file.attribute(at, names::torque_table_power_w, r.table_power);
  file.attribute(at, names::loss_w, r.loss);
  file.attribute(at, names::arm_angle_rad, r.arm_angle.value_or(none));
  file.attribute(at, names::arm_angle_low_rad, r.arm_angle_low.value_or(none));
  file.attribute(at, names::arm_angle_high_rad, r.arm_angle_high.value_or(none));
  file.attribute(at, names::estimated_life_h, life ? life->life_h : none);
  put_spans(file, at + std::string(names::spans), r.spans);
  put_pulleys(file, at + std::string(names::pulleys), r.pulleys, life);
}

const RangeLife* life_in(const Life& life, const std::string& range) {
  for (const RangeLife& r : life.ranges)
    if (r.name == range) return &r;
  return nullptr;
}

std::optional<double> stated(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

std::optional<std::string> stated(std::string text) {
  return text.empty() ? std::nullopt : std::optional(std::move(text));
}

QuasiStaticRange range_of(const Hdf5Source& file, const std::string& at) {
  QuasiStaticRange r;
  r.name = file.text(at, names::name);
  r.error = stated(file.text(at, names::error));
  std::istringstream remarks(file.text(at, names::remarks));
  for (std::string line; std::getline(remarks, line);) r.remarks.push_back(line);
  r.crank_rpm = file.number(at, names::range_crank_rpm);
  r.belt_speed = file.number(at, names::belt_speed_m_s);
  r.centrifugal = file.number(at, names::centrifugal_n);
  r.driver_power = file.number(at, names::driver_power_w);
  r.table_power = file.number(at, names::torque_table_power_w);
  r.loss = file.number(at, names::loss_w);
  r.arm_angle = stated(file.number(at, names::arm_angle_rad));
  r.arm_angle_low = stated(file.number(at, names::arm_angle_low_rad));
  r.arm_angle_high = stated(file.number(at, names::arm_angle_high_rad));

  const std::string spans = at + std::string(names::spans), pulleys = at + std::string(names::pulleys);
  for (const std::string& name : file.texts(join(spans, names::span_of_row.name))) r.spans.push_back({name, 0, 0, 0});
  for (const std::string& name : file.texts(join(pulleys, names::life_pulley.name))) {
    r.pulleys.emplace_back();
    r.pulleys.back().name = name;
  }
  const auto fill = [&](auto& rows, const std::string& group, const names::Dataset& as, auto set) {
    const auto values = file.numbers(join(group, as.name), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) set(rows[i], values[i]);
  };
  fill(r.spans, spans, names::span_tension, [](auto& s, double v) { s.tension = v; });
  fill(r.spans, spans, names::span_tension_low, [](auto& s, double v) { s.tension_low = v; });
  fill(r.spans, spans, names::span_tension_high, [](auto& s, double v) { s.tension_high = v; });
  fill(r.pulleys, pulleys, names::pulley_speed, [](auto& p, double v) { p.speed = v / rpm; });
  fill(r.pulleys, pulleys, names::pulley_torque, [](auto& p, double v) { p.torque = v; });
  fill(r.pulleys, pulleys, names::pulley_wrap, [](auto& p, double v) { p.wrap = v / degree; });
  fill(r.pulleys, pulleys, names::hub_load, [](auto& p, double v) { p.hub_load = v; });
  fill(r.pulleys, pulleys, names::hub_load_low, [](auto& p, double v) { p.hub_load_low = v; });
  fill(r.pulleys, pulleys, names::hub_load_high, [](auto& p, double v) { p.hub_load_high = v; });
  fill(r.pulleys, pulleys, names::hub_direction, [](auto& p, double v) {
    p.hub_x = p.hub_load * std::cos(v / degree);
    p.hub_y = p.hub_load * std::sin(v / degree);
  });
  fill(r.pulleys, pulleys, names::slip_safety, [](auto& p, double v) { p.slip_safety = stated(v); });
  fill(r.pulleys, pulleys, names::bending_loss, [](auto& p, double v) { p.bending_loss = v; });
  fill(r.pulleys, pulleys, names::rigid_bending_loss, [](auto& p, double v) { p.rigid_loss = v; });
  fill(r.pulleys, pulleys, names::creep_loss, [](auto& p, double v) { p.creep_loss = v; });
  return r;
}

RangeLife estimate_of(const Hdf5Source& file, const std::string& at) {
  RangeLife life;
  life.name = file.text(at, names::name);
  life.life_h = file.number(at, names::estimated_life_h);
  const std::string pulleys = at + std::string(names::pulleys);
  for (const std::string& name : file.texts(join(pulleys, names::life_pulley.name))) {
    life.pulleys.emplace_back();
    life.pulleys.back().name = name;
  }
  const auto fill = [&](const names::Dataset& as, double PulleyLife::*member, double unit) {
    const auto values = file.numbers(join(pulleys, as.name), life.pulleys.size());
    for (std::size_t i = 0; i < values.size(); ++i) life.pulleys[i].*member = values[i] * unit;
  };
  fill(names::estimated_sigma_m, &PulleyLife::sigma_m, mpa);
  fill(names::estimated_sigma_a, &PulleyLife::sigma_a, mpa);
  fill(names::estimated_cycles, &PulleyLife::cycles, 1);
  fill(names::estimated_damage, &PulleyLife::damage_share, 1);
  return life;
}

std::vector<TakeUpRow> take_up_of(const Hdf5Source& file) {
  std::vector<TakeUpRow> rows;
  const std::string at(names::take_up);
  if (file.children(at).empty()) return rows;
  const auto position = file.texts(join(at, names::take_up_position.name));
  const auto column = [&](const names::Dataset& as) { return file.numbers(join(at, as.name), position.size()); };
  const auto arm = column(names::take_up_arm), path = column(names::take_up_path),
             unstretched = column(names::take_up_unstretched), tension = column(names::take_up_tension);
  const auto ended_by = file.texts(join(at, names::take_up_ended_by.name), position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
    rows.push_back({position[i], arm[i], path[i], unstretched[i], tension[i], ended_by[i]});
  return rows;
}

}  // namespace

void put_statics(Hdf5Image& file, const DriveStatics& s) {
  if (s.take_up.empty() && s.ranges.empty()) return;
  const std::string at(names::statics), ranges(names::statics_ranges);
  file.group(at, "the drive before any time step: take-up of the tensioner, steady running in every range");
  if (!s.take_up.empty()) put_take_up(file, s.take_up);
  if (s.ranges.empty()) return;
  file.attribute(at, names::estimated_life_h, s.estimate.life_h);
  file.attribute(at, names::estimated_log10_life_h, s.estimate.log10_life_h);
  file.attribute(at, names::estimated_error, s.estimate.error.value_or(""));
  file.group(ranges, "steady running by operating range, all of the scene's");
  UniqueNames unique;
  for (const QuasiStaticRange& r : s.ranges)
    put_range(file, join(ranges, unique.take(r.name)), r, life_in(s.estimate, r.name));
}

std::optional<DriveStatics> read_statics(const Hdf5Source& file) {
  const std::string at(names::statics), ranges(names::statics_ranges);
  if (file.children(at).empty()) return std::nullopt;
  DriveStatics s;
  s.take_up = take_up_of(file);
  for (const std::string& range : file.children(ranges)) {
    s.ranges.push_back(range_of(file, join(ranges, range)));
    if (!s.ranges.back().error) s.estimate.ranges.push_back(estimate_of(file, join(ranges, range)));
  }
  if (s.ranges.empty()) return s;
  s.estimate.life_h = file.number(at, names::estimated_life_h);
  s.estimate.log10_life_h = file.number(at, names::estimated_log10_life_h);
  s.estimate.error = stated(file.text(at, names::estimated_error));
  return s;
}

}  // namespace beltlife
