// Tables and JSON of summaries and lives: see print.h.
#include "results/text/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/text/table.h"
#include "sim/eval/quantities.h"

namespace beltlife {
namespace {

constexpr double mega = 1e-6, degree = 180 / std::numbers::pi;

}  // namespace

// Infinite is a statement (nothing wears), not a number is none.
std::string number_text(double value, const char* format) {
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "no end" : fmt::format(fmt::runtime(format), value);
}

nlohmann::json finite(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr); }

std::string json_text(const nlohmann::json& j) {
  return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json json_of(const RangeSummary& s) {
  nlohmann::json j;
  j["crank_rpm"] = s.crank_rpm;
  j["complete"] = s.complete;
  if (s.output) {
    nlohmann::json out{{"body", s.output->body},
                       {"speed_rpm_mean", finite(s.output->speed_rpm_mean)},
                       {"torque_n_m_mean", finite(s.output->torque_n_m_mean)},
                       {"orders", nlohmann::json::array()}};
    for (const OrderLine& line : s.output->orders)
      out["orders"].push_back({{"order", line.order},
                               {"hz", line.hz},
                               {"speed_rpm", finite(line.speed_rpm)},
                               {"torque_n_m", finite(line.torque_n_m)}});
    j["drive_shaft"] = std::move(out);
  } else {
    j["drive_shaft"] = nullptr;
  }
  j["spans"] = nlohmann::json::array();
  for (const SpanSummary& span : s.spans)
    j["spans"].push_back({{"name", span.name},
                          {"tension_n_mean", finite(span.tension_n_mean)},
                          {"tension_n_min", finite(span.tension_n_min)},
                          {"tension_n_max", finite(span.tension_n_max)}});
  j["pulleys"] = nlohmann::json::array();
  for (const PulleySummary& p : s.pulleys)
    j["pulleys"].push_back({{"name", p.name},
                            {"speed_rpm_mean", finite(p.speed_rpm_mean)},
                            {"slip_percent", p.slip_percent ? finite(*p.slip_percent) : nlohmann::json(nullptr)},
                            {"hub_load_n", finite(p.hub_load_n)},
                            {"hub_load_n_max", finite(p.hub_load_n_max)},
                            {"hub_direction_deg", finite(p.hub_direction_deg)}});
  j["power_w"] = json_of_powers(s.power_w);
  j["energy_residual"] = finite(s.energy_residual);
  j["drift"] = finite(s.drift);
  for (const Quantity& q : quantities_of(s)) j["quantities"][q.name] = finite(q.value);
  return j;
}

nlohmann::json json_of(const Life& life) {
  nlohmann::json j{{"life_h", finite(life.life_h)},
                   {"log10_life_h", finite(life.log10_life_h)},
                   {"infinite", std::isinf(life.life_h)},
                   {"ranges", nlohmann::json::object()}};
  if (life.error) j["error"] = *life.error;
  for (const RangeLife& range : life.ranges) {
    nlohmann::json r{{"life_h", finite(range.life_h)},
                     {"duty_share", range.duty_share},
                     {"damage_share", finite(range.damage_share)},
                     {"pulleys", nlohmann::json::array()}};
    if (range.error) r["error"] = *range.error;
    for (const PulleyLife& p : range.pulleys)
      r["pulleys"].push_back({{"name", p.name},
                              {"sigma_m_mpa", finite(p.sigma_m * mega)},
                              {"sigma_a_mpa", finite(p.sigma_a * mega)},
                              {"cycles", finite(p.cycles)},
                              {"damage_share", finite(p.damage_share)},
                              {"axial_mean_mpa", finite(p.axial_mean * mega)},
                              {"axial_alternating_mpa", finite(p.axial_alternating * mega)},
                              {"bending_mpa", finite(p.bending * mega)},
                              {"transverse_mpa", finite(p.transverse * mega)},
                              {"shear_mpa", finite(p.shear * mega)}});
    j["ranges"][range.name] = std::move(r);
  }
  return j;
}

nlohmann::json json_of(const RangeLoad& load) {
  nlohmann::json j = nlohmann::json::array();
  for (const PulleyLoad& p : load.pulleys) {
    nlohmann::json forces;
    for (std::size_t i = 0; i < EnumNames<PassForce>::names.size(); ++i) {
      const std::string kind(EnumNames<PassForce>::names[i]);
      forces["normal_n_per_m"][kind] = finite(p.normal_n[i] / load.element_length_m);
      forces["tangential_n_per_m"][kind] = finite(p.tangential_n[i] / load.element_length_m);
    }
    forces["name"] = p.name;
    forces["tension_high_n"] = finite(p.tension_high_n);
    forces["tension_low_n"] = finite(p.tension_low_n);
    forces["passes"] = p.passes;
    forces["passes_unsampled"] = p.passes_unsampled;
    j.push_back(std::move(forces));
  }
  return j;
}

nlohmann::json json_of(const RunStatus& status) {
  nlohmann::json j{{"state", to_string(status.state)}};
  if (!status.ok()) {
    j["time_s"] = status.time_s;
    j["element"] = status.element;
    j["where"] = status.where;
    j["cause"] = status.cause;
    j["advice"] = status.advice;
  }
  return j;
}

std::string text_of(const RunStatus& status) {
  if (status.ok()) return "ok";
  return fmt::format("{} at {:.6f} s, {}{}\n  likely cause: {}\n  try: {}", to_string(status.state), status.time_s,
                     status.where, status.element >= 0 ? fmt::format(", element {}", status.element) : "", status.cause,
                     status.advice);
}

std::string power_text(const std::vector<double>& power_w, double residual) {
  Table power({"power", "W"});
  for (std::size_t i = 0; i < power_w.size(); ++i)
    if (static_cast<Energy>(i) == Energy::stored || power_w[i] != 0)
      power.row({std::string(energy_names[i]), fixed_text(power_w[i], 1)});
  return power.text(2) + fmt::format("  not accounted for: {:.3f} % of the throughput\n", 100 * residual);
}

nlohmann::json json_of_powers(const std::vector<double>& power_w) {
  nlohmann::json j = nlohmann::json::object();
  for (std::size_t i = 0; i < power_w.size(); ++i) j[std::string(energy_names[i])] = finite(power_w[i]);
  return j;
}

std::string text_of(const RangeSummary& s) {
  std::string out = fmt::format("Range {}, {:g} r/min{}\n\n", s.name, s.crank_rpm, s.complete ? "" : " (incomplete)");
  Table spans({"span", "tension N mean", "min", "max", "deflection mm min", "max"});
  for (const SpanSummary& span : s.spans)
    spans.row({span.name, fmt::format("{:.0f}", span.tension_n_mean), fmt::format("{:.0f}", span.tension_n_min),
               fmt::format("{:.0f}", span.tension_n_max), fixed_text(span.deflection_mm_min, 1),
               fixed_text(span.deflection_mm_max, 1)});
  Table pulleys({"pulley", "speed r/min", "slip %", "hub load N", "max", "direction deg", "belt torque N m"});
  for (const PulleySummary& p : s.pulleys)
    pulleys.row({p.name, fmt::format("{:.1f}", p.speed_rpm_mean), p.slip_percent ? fixed_text(*p.slip_percent, 2) : "-",
                 fmt::format("{:.0f}", p.hub_load_n), fmt::format("{:.0f}", p.hub_load_n_max),
                 fixed_text(p.hub_direction_deg, 0), fixed_text(p.torque_n_m_mean, 2)});
  if (!s.spans.empty()) out += spans.text(2) + "\n" + pulleys.text(2) + "\n";
  if (s.output) {
    out += fmt::format("  {}: mean {:.1f} r/min, {:.2f} N m; amplitudes by crank order\n", s.output->body,
                       s.output->speed_rpm_mean, s.output->torque_n_m_mean);
    Table orders({"order", "Hz", "speed r/min", "torque N m"});
    for (const OrderLine& line : s.output->orders)
      if (line.order == 0.5 || line.order == std::floor(line.order))
        orders.row({fmt::format("{:g}", line.order), fmt::format("{:.1f}", line.hz),
                    number_text(line.speed_rpm, "{:.3f}"), number_text(line.torque_n_m, "{:.3f}")});
    out += orders.text(4) + "\n";
  }
  out += power_text(s.power_w, s.energy_residual);
  out +=
      fmt::format("  mean span tensions change by {:.2f} % at most from the first half of the window to the second\n",
                  100 * s.drift);
  if (s.arm_angle_mean)
    out += fmt::format("  tensioner arm {:.2f} deg from where the scene places it, between {:.2f} and {:.2f}\n",
                       *s.arm_angle_mean * degree, *s.arm_angle_min * degree, *s.arm_angle_max * degree);
  return out;
}

std::string settling_text(const RunRecord& run, const ProfileSpec& p) {
  if (!run.settling_change || !p.settled_within) return "";
  const double whole = p.settle_s + p.ramp_s + p.hold_s, change = 100 * *run.settling_change;
  if (*run.settling_change > *p.settled_within)
    return fmt::format("ran to its end of {:.4g} s: last two stretches of {:g} s differ by {:.3g} %", whole,
                       p.evaluate_s, change);
  return fmt::format("ended after {:.4g} of {:.4g} s: last two stretches of {:g} s agree within {:.3g} %",
                     run.simulated_s, whole, p.evaluate_s, change);
}

std::string loss_table(const std::vector<RangeSummary>& ranges) {
  Table table({"range", "torque tables W", "driver W", "belt bending loss W", "friction W", "other losses W",
               "not accounted %"});
  for (const RangeSummary& s : ranges) {
    const auto power = [&](Energy e) { return s.power_w[static_cast<std::size_t>(e)]; };
    const double other = power(Energy::lost_belt_axial) + power(Energy::lost_contact_normal) +
                         power(Energy::lost_shafts) + power(Energy::lost_gears) +
                         power(Energy::lost_tensioner_damping) + power(Energy::lost_tensioner_friction);
    table.row({s.name, fixed_text(power(Energy::work_torque_tables), 0), fixed_text(power(Energy::work_driver), 0),
               fmt::format("{:.0f}", power(Energy::lost_belt_bending)),
               fmt::format("{:.0f}", power(Energy::lost_friction)), fmt::format("{:.0f}", other),
               fixed_text(100 * s.energy_residual, 3)});
  }
  return table.text(0);
}

std::string text_of(const Life& life, const std::string& over) {
  std::string out;
  double shares = 0;
  for (const RangeLife& range : life.ranges) shares += range.duty_share;
  const auto share = [&](const RangeLife& range) {
    return shares > 0 ? range.duty_share / shares : 1.0 / static_cast<double>(life.ranges.size());
  };
  Table pulleys({"range", "pulley", "axial MPa mean", "alt", "bending", "transverse", "shear", "sigma_m", "sigma_a",
                 "rounds", "damage %"});
  for (const RangeLife& range : life.ranges)
    for (const PulleyLife& p : range.pulleys)
      pulleys.row({range.name, p.name, number_text(p.axial_mean * mega, "{:.3f}"),
                   number_text(p.axial_alternating * mega, "{:.3f}"), number_text(p.bending * mega, "{:.3f}"),
                   number_text(p.transverse * mega, "{:.3f}"), number_text(p.shear * mega, "{:.3f}"),
                   number_text(p.sigma_m * mega, "{:.3f}"), number_text(p.sigma_a * mega, "{:.3f}"),
                   number_text(p.cycles, "{:.3g}"), number_text(100 * p.damage_share, "{:.1f}")});
  Table ranges({"range", "time %", "rounds to failure", "life h", "log10", "damage %"});
  for (const RangeLife& range : life.ranges)
    ranges.row({range.name, number_text(100 * share(range), "{:.0f}"), number_text(range.cycles, "{:.3g}"),
                number_text(range.life_h, "{:.4g}"), number_text(std::log10(range.life_h), "{:.2f}"),
                number_text(100 * range.damage_share, "{:.1f}")});
  out += pulleys.text(0) + "\n" + ranges.text(0);
  for (const RangeLife& range : life.ranges)
    if (range.error) out += "  no life: " + *range.error + "\n";  // names the range
  const bool said = std::any_of(life.ranges.begin(), life.ranges.end(), [](const auto& r) { return r.error; });
  if (life.error)
    out += fmt::format("\nNo life over {}: {}\n", over,
                       said ? "some of its ranges have none, as said above" : *life.error);
  else if (std::isinf(life.life_h))
    out += fmt::format("\nLife over {}: no end\n", over);
  else
    out += fmt::format("\nLife over {}: {:.4g} h (log10 {:.2f})\n", over, life.life_h, life.log10_life_h);
  return out;
}

std::string text_of(const std::vector<KernelTime>& times, int nodes) {
  double total = 0;
  for (const KernelTime& t : times) total += t.seconds;
  Table table({"kernel", "share %", "ns per node and evaluation"});
  for (const KernelTime& t : times)
    table.row({t.name, number_text(100 * t.seconds / total, "{:.1f}"),
               fmt::format("{:.2f}", t.calls ? 1e9 * t.seconds / (double(t.calls) * nodes) : 0.0)});
  return table.text(0);
}

}  // namespace beltlife
