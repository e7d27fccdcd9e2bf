// What a report page is about: see report_subject.h.
#include "results/pages/run/report_subject.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/eval/remarks.h"
#include "sim/life/loads.h"
#include "sim/scene/scene_io.h"

namespace beltlife {

Subject subject_of(const ResultFile& file, const std::string& name) {
  Subject s;
  s.file = file;
  s.model = compile(parse_scene(file.provenance.scene_text, name), name);
  std::vector<RangeLoad> loads;
  for (const RunRecord& run : s.file.runs)
    for (const WindowRecord& window : run.windows) {
      if (window.last_sample <= window.first_sample) continue;
      s.ranges.push_back({&run, &window, summarise(s.model, run, window), "range-" + window.range});
      if (window.complete && !s.model.scene.range.empty())
        loads.push_back(range_load(s.model.scene, s.model.statics.unstretched_length, run, window));
    }
  if (!loads.empty()) s.life = duty_cycle_life(loads, s.model.scene.fatigue);
  return s;
}

Governing governing(const Life& life) {
  Governing g;
  for (const RangeLife& range : life.ranges)
    if (!g.range || range.damage_share > g.range->damage_share) g.range = &range;
  if (g.range)
    for (const PulleyLife& pulley : g.range->pulleys)
      if (!g.pulley || pulley.damage_share > g.pulley->damage_share) g.pulley = &pulley;
  return g;
}

const Subject::Range* shown_range(const Subject& s) {
  if (s.ranges.empty()) return nullptr;
  if (s.life && !s.life->error)
    if (const RangeLife* worst = governing(*s.life).range)
      for (const auto& range : s.ranges)
        if (range.window->range == worst->name) return &range;
  return &s.ranges.front();
}

std::span<const double> in_window(const Subject::Range& r, const std::string& channel) {
  const Channel* c = r.run->trace.find(channel);
  if (!c) return {};
  return std::span(c->values).subspan(r.window->first_sample, r.window->last_sample - r.window->first_sample);
}

std::vector<double> window_time(const Subject::Range& r) {
  std::vector<double> t;
  for (std::size_t i = r.window->first_sample; i < r.window->last_sample; ++i)
    t.push_back(r.run->trace.time_s[i] - r.window->begin_s);
  return t;
}

DrawnState drawn_state(const Subject& s, const Subject::Range* range) {
  const Layout& rest = s.model.statics.balance;
  DrawnState state{std::vector<double>(static_cast<std::size_t>(s.model.pulleys), rest.tension), rest.arm_angle};
  if (!range) return state;
  for (std::size_t i = 0; i < range->summary.spans.size(); ++i)
    state.tension[i] = range->summary.spans[i].tension_n_mean;
  state.arm = range->summary.arm_angle_mean.value_or(rest.arm_angle);
  return state;
}

bool slips(const QuasiStaticPulley& p) {
  constexpr double rounding = 1e-6;  // a locked pulley slides at exactly 1
  return p.slip_safety && *p.slip_safety < 1 - rounding;
}

std::vector<std::string> warnings(const Subject& s) {
  std::vector<std::string> out;
  if (std::string words = coarse_mesh(s.model); !words.empty()) {
    words[0] = 'E';
    out.push_back(words + ".");
  }
  for (const RunRecord& run : s.file.runs) {
    if (!run.status.ok())
      out.push_back(fmt::format("A run ended early: {} at {:.4f} s, {}; likely cause: {}; try: {}.",
                                to_string(run.status.state), run.status.time_s, run.status.where, run.status.cause,
                                run.status.advice));
    if (run.friction_overdamped_s > 0)
      out.push_back(
          fmt::format("During {:.3g} s the step was too long for the friction slope, which then dissipates too much.",
                      run.friction_overdamped_s));
  }
  for (const auto& range : s.ranges) {
    if (range.summary.drift > 0.03)
      out.push_back(fmt::format("{} has not settled: a span's mean tension changes by {:.0f} % within the window.",
                                range.window->range, 100 * range.summary.drift));
    if (std::abs(range.summary.energy_residual) > 0.005)
      out.push_back(fmt::format("{}: {:.2f} % of the energy that went through is not accounted for.",
                                range.window->range, 100 * range.summary.energy_residual));
    if (const ArmStops& stops = s.model.tensioner.stops;
        range.summary.arm_angle_mean && stops.any() &&
        (*range.summary.arm_angle_min < stops.low || *range.summary.arm_angle_max > stops.high))
      out.push_back(fmt::format("{}: the tensioner's arm strikes a stop.", range.window->range));
    for (const PulleySummary& p : range.summary.pulleys)
      if (p.slip_percent && std::abs(*p.slip_percent) > 3)
        out.push_back(fmt::format("{}: {} slips by {:.1f} % against the driven pulley.", range.window->range, p.name,
                                  *p.slip_percent));
  }
  const auto unbalanced = [&](const char* what, const EnergyAccount& account) {
    if (std::abs(account.relative_residual()) > 0.005)
      out.push_back(fmt::format("{}: {:.2f} % of the energy that went through is not accounted for.", what,
                                100 * std::abs(account.relative_residual())));
  };
  if (s.file.sweep) unbalanced("Sweep", s.file.sweep->energy);
  if (s.file.event) unbalanced("Event", s.file.event->energy);
  if (s.file.statics)
    for (const QuasiStaticRange& range : s.file.statics->ranges) {
      if (range.error) out.push_back(fmt::format("{}: no quasi-static solution: {}.", range.name, *range.error));
      if (range.arm_angle && s.model.tensioner.stops.any() &&
          s.model.tensioner.stops.at(*range.arm_angle, s.model.tensioner.lengthening) != ArmStop::none)
        out.push_back(fmt::format("{}: by the statics the tensioner's arm rests on a stop.", range.name));
      for (const QuasiStaticPulley& p : range.pulleys)
        if (slips(p))
          out.push_back(fmt::format(
              "{}: {} needs more wrap or tension: by its quasi-static slip safety of {:.2f} the belt slips.",
              range.name, p.name, *p.slip_safety));
    }
  if (s.life && s.life->error) {
    const auto before = out.size();
    for (const RangeLife& range : s.life->ranges)
      if (range.error) out.push_back("No life: " + *range.error + ".");
    if (out.size() == before) out.push_back("No life: " + *s.life->error + ".");
  }
  return out;
}

std::string life_over(const Subject& s) {
  if (s.life->ranges.size() >= s.model.scene.range.size()) return "its duty cycle";
  std::string names;
  for (const RangeLife& range : s.life->ranges) names += (names.empty() ? "" : ", ") + range.name;
  return "range" + std::string(s.life->ranges.size() > 1 ? "s " : " ") + names + " alone";
}

}  // namespace beltlife
