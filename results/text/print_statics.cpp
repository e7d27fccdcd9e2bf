// Tables and JSON of the statics: see print_statics.h.
#include "results/text/print_statics.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "results/text/print.h"
#include "results/text/table.h"
#include "sim/eval/solved_drive.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi, rpm = 30 / std::numbers::pi;

double direction(const QuasiStaticPulley& p) { return std::atan2(p.hub_y, p.hub_x) * degree; }

std::string band(double value, double low, double high) {
  return high - low >= 1 ? fmt::format("{:.0f} ({:.0f} to {:.0f})", value, low, high) : fmt::format("{:.0f}", value);
}

std::string safety_text(const QuasiStaticPulley& p) {
  if (!p.slip_safety) return "-";
  return fmt::format("{:.{}f}{}", *p.slip_safety, *p.slip_safety < 10 ? 2 : 1, p.slips ? " slips" : "");
}

std::string arm_text(const QuasiStaticRange& r) {
  const double low = *r.arm_angle_low * degree, high = *r.arm_angle_high * degree;
  const std::string angle = fixed_text(*r.arm_angle * degree, 1);
  return high - low < 0.05 ? angle : fmt::format("{} ({} to {})", angle, fixed_text(low, 1), fixed_text(high, 1));
}

nlohmann::json json_of(const QuasiStaticRange& r) {
  if (r.error) return {{"crank_rpm", r.crank_rpm}, {"error", *r.error}};
  nlohmann::json j{{"remarks", r.remarks},
                   {"crank_rpm", r.crank_rpm},
                   {"belt_speed_m_s", r.belt_speed},
                   {"centrifugal_n", r.centrifugal},
                   {"driver_power_w", r.driver_power},
                   {"torque_table_power_w", r.table_power},
                   {"loss_w", r.loss},
                   {"spans", nlohmann::json::array()},
                   {"pulleys", nlohmann::json::array()}};
  if (r.arm_angle) {
    j["arm_angle_rad"] = *r.arm_angle;
    j["arm_angle_rad_low"] = *r.arm_angle_low;
    j["arm_angle_rad_high"] = *r.arm_angle_high;
  }
  for (const QuasiStaticSpan& s : r.spans)
    j["spans"].push_back({{"name", s.name},
                          {"tension_n", s.tension},
                          {"tension_n_low", s.tension_low},
                          {"tension_n_high", s.tension_high}});
  for (const QuasiStaticPulley& p : r.pulleys)
    j["pulleys"].push_back({{"name", p.name},
                            {"speed_rpm", p.speed * rpm},
                            {"torque_n_m", p.torque},
                            {"wrap_deg", p.wrap * degree},
                            {"hub_load_n", p.hub_load},
                            {"hub_load_n_low", p.hub_load_low},
                            {"hub_load_n_high", p.hub_load_high},
                            {"hub_direction_deg", direction(p)},
                            {"slip_safety", p.slip_safety ? finite(*p.slip_safety) : nlohmann::json(nullptr)},
                            {"bending_loss_w", p.bending_loss},
                            {"rigid_bending_loss_w", p.rigid_loss},
                            {"creep_loss_w", p.creep_loss}});
  return j;
}

std::string tensions_text(const std::vector<QuasiStaticRange>& ranges) {
  std::vector<std::string> header{"span tension N"};
  const QuasiStaticRange* first = nullptr;
  for (const QuasiStaticRange& r : ranges)
    if (!r.error) {
      header.push_back(r.name);
      if (!first) first = &r;
    }
  std::string out;
  if (first) {
    Table table(header);
    for (std::size_t i = 0; i < first->spans.size(); ++i) {
      std::vector<std::string> row{first->spans[i].name};
      for (const QuasiStaticRange& r : ranges)
        if (!r.error) row.push_back(band(r.spans[i].tension, r.spans[i].tension_low, r.spans[i].tension_high));
      table.row(row);
    }
    const auto add = [&](const char* name, auto value) {
      std::vector<std::string> row{name};
      for (const QuasiStaticRange& r : ranges)
        if (!r.error) row.push_back(value(r));
      table.row(row);
    };
    add("centrifugal part of each", [](const auto& r) { return fmt::format("{:.0f}", r.centrifugal); });
    add("belt speed m/s", [](const auto& r) { return fmt::format("{:.1f}", r.belt_speed); });
    if (first->arm_angle) add("arm angle deg", [](const auto& r) { return arm_text(r); });
    add("driver W", [](const auto& r) { return fixed_text(r.driver_power, 0); });
    add("torque tables W", [](const auto& r) { return fixed_text(r.table_power, 0); });
    add("losses W", [](const auto& r) { return fmt::format("{:.0f}", r.loss); });
    out += table.text(0);
  }
  for (const QuasiStaticRange& r : ranges)
    if (r.error) out += fmt::format("{}: no quasi-static solution: {}\n", r.name, *r.error);
  for (const QuasiStaticRange& r : ranges)
    for (const std::string& words : r.remarks) out += fmt::format("{}: {}\n", r.name, words);
  return out + "\n";
}

std::string pulleys_text(const std::vector<QuasiStaticRange>& ranges) {
  Table table({"range", "pulley", "hub load N", "direction deg", "torque N m", "slip safety", "bending loss W"});
  bool any = false;
  for (const QuasiStaticRange& r : ranges)
    for (const QuasiStaticPulley& p : r.pulleys) {
      any = true;
      table.row({r.name, p.name, band(p.hub_load, p.hub_load_low, p.hub_load_high), fixed_text(direction(p), 0),
                 fixed_text(p.torque, 2), safety_text(p), fmt::format("{:.0f}", p.bending_loss)});
    }
  return any ? table.text(0) + "\n" : "";
}

std::string life_text(const Life& life) {
  Table table({"range", "pulley", "sigma_m MPa", "sigma_a MPa", "damage %"});
  for (const RangeLife& range : life.ranges)
    for (const PulleyLife& p : range.pulleys)
      table.row({range.name, p.name, fmt::format("{:.3f}", 1e-6 * p.sigma_m), fmt::format("{:.3f}", 1e-6 * p.sigma_a),
                 fmt::format("{:.1f}", 100 * p.damage_share)});
  Table ranges({"range", "time %", "estimated life h", "log10", "damage %"});
  for (const RangeLife& range : life.ranges)
    ranges.row({range.name, fmt::format("{:.0f}", 100 * range.duty_share), number_text(range.life_h, "{:.3g}"),
                number_text(std::log10(range.life_h), "{:.1f}"), number_text(100 * range.damage_share, "{:.1f}")});
  return table.text(0) + "\n" + ranges.text(0) + "\n" +
         (life.error ? "no estimate of the life: " + *life.error + "\n\n"
                     : fmt::format("estimated life over the duty cycle: {:.3g} h (log10 {:.1f})\n\n", life.life_h,
                                   life.log10_life_h));
}

}  // namespace

std::string statics_text(const Model& m) {
  std::string out;
  const DriveStatics statics = drive_statics(m);
  if (const auto& rows = statics.take_up; !rows.empty()) {
    Table table({"take-up", "arm deg", "belt path mm", "unstretched mm", "tension N", "ended by"});
    for (const TakeUpRow& r : rows)
      table.row({r.name, fixed_text(r.arm_angle * degree, 1), fmt::format("{:.1f}", 1e3 * r.path_length),
                 fmt::format("{:.1f}", 1e3 * r.unstretched_length), fmt::format("{:.0f}", r.tension), r.reason});
    out += table.text(0) + "\n";
  }
  const auto& ranges = statics.ranges;
  if (ranges.empty()) return out;
  out += fmt::format("quasi-static: steady running at the mean speed, no ripple{}\n\n",
                     m.tensioner.pulley >= 0 ? "; in brackets between the arm's friction limits" : "");
  out += tensions_text(ranges) + pulleys_text(ranges);
  bool solved = false;
  for (const QuasiStaticRange& r : ranges) solved = solved || !r.error;
  if (solved)
    out += fmt::format(
               "estimate of stress and life, from steady tensions alone: ranks drives, says no hours (`beltlife life` "
               "simulates)\npeak normal forces are tension x element length / radius x {:.2f} (sampled) or {:.2f} "
               "(resolved)\n\n",
               sampled_peak_factor, resolved_peak_factor) +
           life_text(statics.estimate);
  return out;
}

void add_statics(const Model& m, nlohmann::json& answer) {
  const DriveStatics statics = drive_statics(m);
  if (const auto& rows = statics.take_up; !rows.empty()) {
    answer["take_up"] = nlohmann::json::array();
    for (const TakeUpRow& r : rows)
      answer["take_up"].push_back({{"name", r.name},
                                   {"arm_angle_rad", r.arm_angle},
                                   {"path_length_mm", 1e3 * r.path_length},
                                   {"unstretched_length_mm", 1e3 * r.unstretched_length},
                                   {"tension_n", finite(r.tension)},
                                   {"ended_by", r.reason}});
  }
  for (const QuasiStaticRange& r : statics.ranges) answer["quasi_static"][r.name] = json_of(r);
  for (const RangeLife& range : statics.estimate.ranges) {
    auto& target = answer["quasi_static"][range.name];
    target["estimated_life_h"] = finite(range.life_h);
    for (std::size_t i = 0; i < range.pulleys.size(); ++i) {
      target["pulleys"][i]["estimated_sigma_m_mpa"] = finite(1e-6 * range.pulleys[i].sigma_m);
      target["pulleys"][i]["estimated_sigma_a_mpa"] = finite(1e-6 * range.pulleys[i].sigma_a);
    }
  }
}

}  // namespace beltlife
