// Names and values of all quantities: see quantities.h.
#include "sim/eval/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/signal/spectrum.h"

namespace beltlife {

std::vector<Quantity> quantities_of(const RangeSummary& s) {
  std::vector<Quantity> q;
  const auto add = [&](const std::string& name, double value) { q.push_back({s.name + "." + name, value}); };
  if (s.output) {
    add(s.output->body + ".speed_rpm.mean", s.output->speed_rpm_mean);
    add(s.output->body + ".speed_rpm.min", s.output->speed_rpm_min);
    add(s.output->body + ".speed_rpm.max", s.output->speed_rpm_max);
    add(s.output->body + ".speed_rpm.peak_hz", s.output->speed_peak_hz);
    add(s.output->body + ".torque_n_m.mean", s.output->torque_n_m_mean);
    add(s.output->body + ".torque_n_m.min", s.output->torque_n_m_min);
    add(s.output->body + ".torque_n_m.max", s.output->torque_n_m_max);
    add(s.output->body + ".torque_n_m.peak_hz", s.output->torque_peak_hz);
    for (const OrderLine& line : s.output->orders) {
      add(fmt::format("{}.speed_rpm.order_{:g}", s.output->body, line.order), line.speed_rpm);
      add(fmt::format("{}.torque_n_m.order_{:g}", s.output->body, line.order), line.torque_n_m);
    }
    for (const BandLine& line : s.output->bands) {
      add(s.output->body + ".speed_rpm." + band_name(line.band), line.speed_rpm);
      add(s.output->body + ".torque_n_m." + band_name(line.band), line.torque_n_m);
    }
  }
  for (const SpanSummary& span : s.spans) {
    add("span." + span.name + ".tension_n.mean", span.tension_n_mean);
    add("span." + span.name + ".tension_n.min", span.tension_n_min);
    add("span." + span.name + ".tension_n.max", span.tension_n_max);
  }
  for (const PulleySummary& p : s.pulleys) {
    if (p.slip_percent) add("pulley." + p.name + ".slip_percent", *p.slip_percent);
    add("pulley." + p.name + ".hub_load_n.mean", p.hub_load_n);
    add("pulley." + p.name + ".hub_load_n.max", p.hub_load_n_max);
  }
  for (std::size_t i = 0; i < s.power_w.size(); ++i)
    if (static_cast<Energy>(i) != Energy::stored) add("power_w." + std::string(energy_names[i]), s.power_w[i]);
  add("energy_residual", s.energy_residual);
  add("drift", s.drift);
  if (s.arm_angle_mean) {
    add("tensioner.arm_angle_rad.mean", *s.arm_angle_mean);
    add("tensioner.arm_angle_rad.min", *s.arm_angle_min);
    add("tensioner.arm_angle_rad.max", *s.arm_angle_max);
  }
  return q;
}

std::vector<Quantity> quantities_of(const RangeLoad& load, const RangeLife& life) {
  std::vector<Quantity> q;
  const auto add = [&](const std::string& name, double value) { q.push_back({life.name + "." + name, value}); };
  for (std::size_t p = 0; p < life.pulleys.size(); ++p) {
    const std::string prefix = "pulley." + life.pulleys[p].name;
    for (std::size_t f = 0; f < EnumNames<PassForce>::names.size(); ++f) {
      const std::string which(EnumNames<PassForce>::names[f]);
      add(prefix + ".normal_n." + which, load.pulleys[p].normal_n[f]);
      add(prefix + ".tangential_n." + which, load.pulleys[p].tangential_n[f]);
    }
    add(prefix + ".sigma_m_mpa", 1e-6 * life.pulleys[p].sigma_m);
    add(prefix + ".sigma_a_mpa", 1e-6 * life.pulleys[p].sigma_a);
  }
  add("life_h", life.life_h);
  add("log10_life_h", std::log10(life.life_h));
  return q;
}

std::vector<Quantity> duty_quantities(const std::vector<RangeSummary>& ranges, const Life& life) {
  double hub = 0, high = 0, low = std::numeric_limits<double>::infinity(), slip = 0;
  bool slips = false;
  for (const RangeSummary& s : ranges) {
    for (const SpanSummary& span : s.spans) {
      high = std::max(high, span.tension_n_max);
      low = std::min(low, span.tension_n_min);
    }
    for (const PulleySummary& p : s.pulleys) {
      hub = std::max(hub, p.hub_load_n_max);
      if (!p.slip_percent) continue;
      slips = true;
      slip = std::max(slip, std::abs(*p.slip_percent));
    }
  }
  std::vector<Quantity> q{{"life_h", life.life_h},
                          {"log10_life_h", life.log10_life_h},
                          {"hub_load_n.max", hub},
                          {"tension_n.max", high},
                          {"tension_n.min", low}};
  if (slips) q.push_back({"slip_percent.max", slip});
  return q;
}

std::vector<std::string> quantity_names(const Model& m) {
  std::vector<std::string> names;
  std::vector<RangeSummary> summaries;
  for (const auto& range : m.scene.range) {
    RangeSummary s;
    s.name = range.name;
    s.power_w.resize(energy_names.size());
    if (m.scene.output) {
      s.output.emplace();
      s.output->body = m.scene.output->body;
      for (double order : default_orders()) s.output->orders.push_back({order, 0, 0, 0});
      for (const Band& band : octave_bands) s.output->bands.push_back({band, 0, 0});
    }
    for (int p = 0; p < m.pulleys; ++p) {
      s.spans.push_back({span_name(m.scene, static_cast<std::size_t>(p)), 0, 0, 0, 0, 0});
      s.pulleys.emplace_back().name = m.body_name[p];
      if (m.driver.body >= 0 && m.driver.body < m.pulleys) s.pulleys.back().slip_percent = 0;
    }
    if (m.tensioner.pulley >= 0) s.arm_angle_mean = s.arm_angle_min = s.arm_angle_max = 0;
    RangeLife life;
    life.name = range.name;
    for (int p = 0; p < m.pulleys; ++p) life.pulleys.emplace_back().name = m.body_name[p];
    RangeLoad load;
    load.pulleys.resize(static_cast<std::size_t>(m.pulleys));
    for (auto& quantity : quantities_of(s)) names.push_back(std::move(quantity.name));
    for (auto& quantity : quantities_of(load, life)) names.push_back(std::move(quantity.name));
    summaries.push_back(std::move(s));
  }
  if (!m.scene.range.empty())
    for (auto& quantity : duty_quantities(summaries, {})) names.push_back(std::move(quantity.name));
  return names;
}

}  // namespace beltlife
