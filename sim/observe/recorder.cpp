// Recording of a running drive: see recorder.h.
#include "sim/observe/recorder.h"

#include <algorithm>

namespace beltlife {
namespace {

constexpr double history_s = 5e-5;  // of the travelling element: 1 mm at 20 m/s

}  // namespace

Recorder::Recorder(const Model& model, const RunPlan& plan, RunRecord& record, int frames)
    : model_(model), plan_(plan), record_(record), sensors_(model), frames_(model, frames) {
  record.trace.channels = channels_of(model);
  const auto samples = static_cast<std::size_t>(plan.end_s * model.scene.solver.sample_rate_hz) + 2;
  record.trace.time_s.reserve(samples);
  for (Channel& c : record.trace.channels) c.values.reserve(samples);
  for (const Window& w : plan.windows) {
    WindowRecord r;
    r.range = w.range;
    r.crank_rpm = w.crank_rpm;
    r.duty_share = w.duty_share;
    r.begin_s = w.begin_s;
    r.end_s = w.end_s;
    if (!w.contact_forces) {
      record.windows.push_back(std::move(r));
      trackers_.push_back(nullptr);
      continue;
    }
    const auto points = static_cast<std::size_t>((w.end_s - w.begin_s) / history_s) + 16;
    for (auto* v : {&r.element.time_s, &r.element.normal_n, &r.element.tangential_n, &r.element.tension_n})
      v->reserve(points);
    r.element.pulley.reserve(points);
    record.windows.push_back(std::move(r));
    trackers_.push_back(std::make_unique<PassTracker>(model, w.end_s - w.begin_s));
  }
}

void Recorder::sample(const DriveView& s) {
  record_.trace.time_s.push_back(s.time());
  sensors_.sample(s, record_.trace.channels);
}

bool Recorder::turn(const DriveView& s) {
  const double edge = 0.5 * s.step();
  const bool closed = open_ && s.time() >= plan_.windows[next_].end_s - edge;
  if (closed) close(s, true);
  if (!open_ && next_ < plan_.windows.size() && s.time() >= plan_.windows[next_].begin_s - edge) {
    open_ = true;
    begin_ = stored_energy(s);
    last_observed_ = s.time();
    last_history_ = s.time() - history_s;
    record_.windows[next_].first_sample = record_.trace.time_s.size();
    if (trackers_[next_]) trackers_[next_]->open(s.state());
    frames_.open(plan_.windows[next_], s.profile(), record_.windows[next_].frames);
  }
  return closed;
}

void Recorder::close(const DriveView& s, bool complete) {
  if (!open_) return;
  WindowRecord& w = record_.windows[next_];
  const StoredEnergy end = stored_energy(s);
  w.energy[Energy::stored] = end.total - begin_.total;
  w.energy[Energy::lost_friction] -= end.anchors - begin_.anchors;
  w.energy[Energy::lost_tensioner_friction] -= end.arm_anchor - begin_.arm_anchor;
  w.last_sample = record_.trace.time_s.size();
  if (trackers_[next_]) w.passes = trackers_[next_]->take();
  w.complete = complete;
  const Coordinates& q = s.state().q;
  w.loop.x_m.assign(q.x.data(), q.x.data() + q.x.size());
  w.loop.y_m.assign(q.y.data(), q.y.data() + q.y.size());
  w.loop.tension_n.assign(s.work().tension.data(), s.work().tension.data() + q.x.size());
  if (plan_.settled_within && next_ > 0) record_.windows[next_ - 1].frames = {};  // of stretches the last one stays
  open_ = false;
  ++next_;
}

void Recorder::searched(const DriveView& s) {
  if (open_ && trackers_[next_]) trackers_[next_]->searched(s.state());
}

void Recorder::observe(const DriveView& s, bool sample) {
  const double elapsed = s.time() - last_observed_;
  last_observed_ = s.time();
  WindowRecord& w = record_.windows[next_];
  const EnergyAccount p = powers(s);
  for (std::size_t i = 0; i < p.joule.size(); ++i) w.energy.joule[i] += elapsed * p.joule[i];
  frames_.observe(s, w.frames);
  if (model_.pulleys == 0) return;
  double largest = 0;
  if (trackers_[next_])
    largest = trackers_[next_]->observe(s.state(), s.work(), sample);
  else
    for (int i = 0; i < model_.belt.nodes; ++i) largest = std::max(largest, s.work().normal[i]);
  double friction = 0;
  for (double mu : model_.pulley_friction) friction = std::max(friction, mu);
  const bool explicit_scheme = model_.scene.solver.scheme != Scheme::linearly_implicit;
  if (explicit_scheme && s.step() * (axial_damping_rate(model_) + friction_damping_rate(model_, friction, largest)) > 2)
    record_.friction_overdamped_s += elapsed;
  if (!trackers_[next_]) return;
  if (s.time() - last_history_ >= history_s - 0.5 * s.step()) {
    last_history_ = s.time();
    ElementHistory& e = w.element;
    e.time_s.push_back(s.time());
    e.normal_n.push_back(s.work().normal[0]);
    e.tangential_n.push_back(s.work().tangential[0]);
    e.tension_n.push_back(s.work().tension[0]);
    e.pulley.push_back(s.work().normal[0] > 0 ? s.state().near[0] : -1);
  }
}

}  // namespace beltlife
