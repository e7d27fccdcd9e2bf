// Profiles and windows of a run: see plan.h.
#include "sim/plan.h"

#include <numbers>

namespace beltlife {
namespace {

constexpr double rad_s = std::numbers::pi / 30;

double hold_begin(const ProfileSpec& p, std::size_t range) {
  return p.settle_s + p.ramp_s + static_cast<double>(range) * (p.hold_s + p.transition_s);
}

SpeedProfile synthetic(const SceneSpec& scene, const std::vector<double>& t, const std::vector<double>& w) {
  return SpeedProfile(t, w, harmonics_of(*scene.driver), scene.driver->phase_rad);
}

// What is driven, not what the range is called after.
void take_measured_speed(RunPlan& plan) {
  for (Window& w : plan.windows)
    w.crank_rpm = (plan.profile.at(w.end_s).angle - plan.profile.at(w.begin_s).angle) / (w.end_s - w.begin_s) / rad_s;
}

Window window_of(const SceneSpec& scene, const RangeSpec& range, double hold_end) {
  return {range.name, range.crank_rpm, range.duty_share, hold_end - scene.profile.evaluate_s, hold_end};
}

}  // namespace

RunPlan plan_range(const SceneSpec& scene, const RangeSpec& range, const MeasuredSpeed* measured) {
  const ProfileSpec& p = scene.profile;
  const double start = p.settle_s + p.ramp_s;
  RunPlan plan{range.name, {}, {}, start + p.hold_s, {}, range.condition};
  std::vector<double> t{0, p.settle_s, start}, w{0, 0, range.crank_rpm * rad_s};
  if (measured) {
    std::size_t index = 0;
    while (index < scene.range.size() && scene.range[index].name != range.name) ++index;
    const double begin = hold_begin(p, index), end = begin + p.hold_s;
    const auto& mt = measured->time_s;
    const auto& mv = measured->speed_rpm;
    const auto at = [&](double time) {  // linear between samples, held outside
      if (time <= mt.front()) return mv.front();
      for (std::size_t i = 1; i < mt.size(); ++i)
        if (time <= mt[i]) return mv[i - 1] + (mv[i] - mv[i - 1]) * (time - mt[i - 1]) / (mt[i] - mt[i - 1]);
      return mv.back();
    };
    w.back() = at(begin) * rad_s;
    for (std::size_t i = 0; i < mt.size(); ++i)
      if (mt[i] > begin && mt[i] < end) {
        t.push_back(start + mt[i] - begin);
        w.push_back(mv[i] * rad_s);
      }
    t.push_back(start + p.hold_s);
    w.push_back(at(end) * rad_s);
    plan.profile = SpeedProfile(t, w);
  } else {
    plan.profile = synthetic(scene, t, w);
  }
  plan.windows.push_back(window_of(scene, range, plan.end_s));
  if (measured) take_measured_speed(plan);
  return plan;
}

RunPlan plan_profile(const SceneSpec& scene, const MeasuredSpeed* measured) {
  const ProfileSpec& p = scene.profile;
  RunPlan plan{"profile", {}, {}, 0};
  std::vector<double> t{0, p.settle_s}, w{0, 0};
  for (std::size_t i = 0; i < scene.range.size(); ++i) {
    const double begin = hold_begin(p, i), end = begin + p.hold_s;
    for (double time : {begin, end}) {
      t.push_back(time);
      w.push_back(scene.range[i].crank_rpm * rad_s);
    }
    plan.windows.push_back(window_of(scene, scene.range[i], end));
    plan.end_s = end;
  }
  if (measured) {
    std::vector<double> speed;
    for (double v : measured->speed_rpm) speed.push_back(v * rad_s);
    plan.profile = SpeedProfile(measured->time_s, speed);
    take_measured_speed(plan);
  } else {
    plan.profile = synthetic(scene, t, w);
  }
  return plan;
}

RunPlan plan_blocks(const SceneSpec& scene, const RangeSpec& range, const MeasuredSpeed* measured) {
  RunPlan plan = plan_range(scene, range, measured);
  const Window last = plan.windows.front();
  const double start = scene.profile.settle_s + scene.profile.ramp_s, length = last.end_s - last.begin_s;
  const int blocks = static_cast<int>((last.end_s - start) / length + 1e-9);
  for (int k = 1; k < blocks; ++k) {
    Window block = last;
    block.begin_s = last.begin_s - k * length;
    block.end_s = block.begin_s + length;
    plan.windows.insert(plan.windows.begin(), block);
  }
  if (measured) take_measured_speed(plan);
  plan.settled_within = scene.profile.settled_within;
  return plan;
}

RunPlan plan_sweep(const SceneSpec& scene, const SweepSpec& sweep) {
  const ProfileSpec& p = scene.profile;
  const double start = p.settle_s + p.ramp_s, begin = start + p.hold_s - p.evaluate_s, end = begin + sweep.seconds;
  std::vector<double> t{0, p.settle_s, start}, w{0, 0, sweep.from_rpm * rad_s};
  if (begin > start) {
    t.push_back(begin);
    w.push_back(w.back());
  }
  t.push_back(end);
  w.push_back(sweep.to_rpm * rad_s);
  return {"sweep", synthetic(scene, t, w), {{"sweep", sweep.from_rpm, 0, begin, end, false}}, end};
}

RunPlan plan_event(const SceneSpec& scene) {
  const ProfileSpec& p = scene.profile;
  const EventSpec& event = *scene.event;
  const double first = event.speeds_rpm.front() * rad_s;
  std::vector<double> t{0}, w{0};
  if (p.settle_s > 0) {
    t.push_back(p.settle_s);
    w.push_back(0);
  }
  if (first > 0) {
    t.push_back(t.back() + p.ramp_s);
    w.push_back(first);
    t.push_back(t.back() + p.hold_s);
    w.push_back(first);
  }
  const double begin = t.back();
  for (std::size_t i = 1; i < event.times_s.size(); ++i) {
    t.push_back(begin + event.times_s[i]);
    w.push_back(event.speeds_rpm[i] * rad_s);
  }
  return {"event", synthetic(scene, t, w), {{"event", event.speeds_rpm.front(), 0, begin, t.back(), false}}, t.back()};
}

RunPlan plan_rest(const SceneSpec& scene) {
  const ProfileSpec& p = scene.profile;
  RunPlan plan{"rest", {}, {}, p.settle_s + p.hold_s};
  plan.windows.push_back({"rest", 0, 0, plan.end_s - p.evaluate_s, plan.end_s});
  return plan;
}

}  // namespace beltlife
