// Words and numbers of an event: see event_text.h.
#include "results/text/event_text.h"

#include <fmt/format.h>

#include <numbers>

#include "results/text/print.h"
#include "results/text/table.h"

namespace beltlife {
namespace {

constexpr double degree = 180 / std::numbers::pi;

std::string at(const Timed& t) { return fmt::format("{:.3f}", t.time_s); }

EventTable load_table(const EventSummary& s) {
  EventTable loads{"loads", {"load", "highest", "at s", "lowest", "at s"}, {}};
  const auto add = [&](const std::string& name, const TimedExtent& e, double unit = 1, int digits = 1) {
    loads.rows.push_back(
        {name, fixed_text(unit * e.high.value, digits), at(e.high), fixed_text(unit * e.low.value, digits), at(e.low)});
  };
  add("driver speed r/min", s.driver_rpm);
  add("driver torque N m", s.driver_torque_n_m);
  if (s.output_rpm) add("output speed r/min", *s.output_rpm);
  if (s.output_torque_n_m) add("output torque N m", *s.output_torque_n_m);
  for (const EventLoad& k : s.springs) add(k.name + " N m", k.load, 1, 2);
  for (const EventLoad& g : s.gears) add(g.name + " N", g.load, 1, 0);
  if (s.arm) add("tensioner arm deg", s.arm->angle_rad, degree, 2);
  return loads;
}

nlohmann::json json_of(const Timed& t) { return {{"value", finite(t.value)}, {"time_s", t.time_s}}; }
nlohmann::json json_of(const TimedExtent& e) { return {{"high", json_of(e.high)}, {"low", json_of(e.low)}}; }

}  // namespace

std::vector<EventTable> event_tables(const EventSummary& s) {
  EventTable spans{"spans", {"span", "highest tension N", "at s", "lowest N", "at s", "slack s"}, {}};
  for (const EventSpan& span : s.spans)
    spans.rows.push_back({span.name, fixed_text(span.tension_n.high.value, 0), at(span.tension_n.high),
                          fixed_text(span.tension_n.low.value, 0), at(span.tension_n.low),
                          fixed_text(span.slack_s, 3)});
  EventTable pulleys{"pulleys",
                     {"pulley", "largest slip m/s", "at s", "sliding s", "slip energy J", "largest hub load N", "at s"},
                     {}};
  for (const EventPulley& p : s.pulleys)
    pulleys.rows.push_back({p.name, fixed_text(p.slip_m_s.value, 3), at(p.slip_m_s), fixed_text(p.sliding_s, 3),
                            fixed_text(p.slip_energy_j, 1), fixed_text(p.hub_load_n.value, 0), at(p.hub_load_n)});
  std::vector<EventTable> tables;
  if (!spans.rows.empty()) tables = {std::move(spans), std::move(pulleys)};
  tables.push_back(load_table(s));
  return tables;
}

std::string event_sentence(const EventSummary& s) {
  std::string text = fmt::format("Event of {:g} s{}: driver between {} and {} r/min; times count from its beginning.",
                                 s.duration_s, s.complete ? "" : " (broken off)", fixed_text(s.driver_rpm.low.value, 0),
                                 fixed_text(s.driver_rpm.high.value, 0));
  if (s.arm)
    text += fmt::format(" The arm turns at {:.1f} rad/s at the most, at {} s.", s.arm->rate_rad_s.value,
                        at(s.arm->rate_rad_s));
  if (s.arm && s.arm->stop_n_m)
    text += s.arm->on_stop_s > 0 ? fmt::format(" It is on a stop for {:.3f} s, with {:.1f} N m at the most.",
                                               s.arm->on_stop_s, s.arm->stop_n_m->value)
                                 : " It meets no stop.";
  return text;
}

std::string text_of(const EventSummary& s) {
  std::string text = event_sentence(s) + "\n\n";
  for (const EventTable& t : event_tables(s)) {
    Table table(t.header);
    for (const auto& row : t.rows) table.row(row);
    text += table.text(2) + "\n";
  }
  return text;
}

nlohmann::json json_of(const EventSummary& s) {
  nlohmann::json j{{"duration_s", s.duration_s},
                   {"complete", s.complete},
                   {"driver_rpm", json_of(s.driver_rpm)},
                   {"driver_torque_n_m", json_of(s.driver_torque_n_m)},
                   {"spans", nlohmann::json::array()},
                   {"pulleys", nlohmann::json::array()},
                   {"springs", nlohmann::json::object()},
                   {"gears", nlohmann::json::object()},
                   {"energy_residual", finite(s.energy_residual)}};
  if (s.output_rpm) j["output_rpm"] = json_of(*s.output_rpm);
  if (s.output_torque_n_m) j["output_torque_n_m"] = json_of(*s.output_torque_n_m);
  for (const EventSpan& span : s.spans)
    j["spans"].push_back({{"name", span.name}, {"tension_n", json_of(span.tension_n)}, {"slack_s", span.slack_s}});
  for (const EventPulley& p : s.pulleys)
    j["pulleys"].push_back({{"name", p.name},
                            {"speed_rpm", json_of(p.speed_rpm)},
                            {"slip_m_s", json_of(p.slip_m_s)},
                            {"sliding_s", p.sliding_s},
                            {"slip_energy_j", finite(p.slip_energy_j)},
                            {"hub_load_n", json_of(p.hub_load_n)}});
  for (const EventLoad& k : s.springs) j["springs"][k.name] = json_of(k.load);
  for (const EventLoad& g : s.gears) j["gears"][g.name] = json_of(g.load);
  if (s.arm) {
    j["arm"] = {{"angle_rad", json_of(s.arm->angle_rad)}, {"rate_rad_s", json_of(s.arm->rate_rad_s)}};
    if (s.arm->stop_n_m) {
      j["arm"]["stop_n_m"] = json_of(*s.arm->stop_n_m);
      j["arm"]["on_stop_s"] = s.arm->on_stop_s;
    }
  }
  return j;
}

}  // namespace beltlife
