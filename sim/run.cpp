// A run from rest to the end of its plan: see run.h.
#include "sim/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "sim/energy.h"
#include "sim/pass_tracker.h"
#include "sim/sensors.h"

namespace beltlife {
namespace {

constexpr double observation_s = 5e-6;  // entry peaks last 1e-4 s and more
constexpr double history_s = 5e-5;      // of the travelling element: 1 mm at 20 m/s
constexpr double check_s = 1e-4;        // divergence is seen within this

std::string place_of(const Simulator& s, int element) {
  const Model& m = s.model();
  if (m.pulleys == 0) return "ring";
  const auto& near = s.state().near;
  const int n = m.belt.nodes;
  if (near[element] >= 0) return "pulley " + m.body_name[near[element]];
  for (int k = 1; k < n; ++k)
    if (const int p = near[(element + k) % n]; p >= 0)
      return "span " + span_name(m.scene, static_cast<std::size_t>((p + m.pulleys - 1) % m.pulleys));
  return "belt";
}

void explain(const Simulator& s, RunStatus& status) {
  const auto limits = step_limits(s.model(), s.model().scene.solver.scheme);
  std::string exceeded;
  for (const StepLimit& limit : limits)
    if (s.step() > limit.limit_s)
      exceeded += fmt::format("{}{} ({:.3g} s)", exceeded.empty() ? "" : ", ", limit.name, limit.limit_s);
  if (!exceeded.empty()) {
    status.cause = fmt::format("step {:.3g} s is longer than the limit of {}", s.step(), exceeded);
    status.advice = fmt::format("leave solver.step_s out, or set it to {:.2g}",
                                stable_step(s.model(), s.model().scene.solver.scheme));
  } else {
    status.cause = "loads, speed or slack beyond what this belt and tensioner can follow";
    status.advice = fmt::format(
        "halve solver.step_s (now {:.3g}); if it fails at the same time again, check pretension, torques and ramp_s",
        s.step());
  }
}

// First thing that is no longer a belt drive, if any.
std::optional<RunStatus> failure(const Simulator& s) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  const double l0 = m.belt.element_length;
  RunStatus status{RunState::diverged, s.time(), -1, "", "", ""};
  for (int i = 0; i < m.belt.nodes; ++i) {
    const double stretch = 1 / (s.work().inverse_length[i] * l0) - 1;
    if (std::abs(stretch) < 0.5 && std::isfinite(q.vx[i]) && std::isfinite(q.vy[i])) continue;
    status.element = i;
    status.where = place_of(s, i);
    explain(s, status);
    return status;
  }
  for (int b = 0; b < m.bodies; ++b)
    if (!(std::abs(q.speed[b]) < 1e6)) {
      status.where = m.body_name[b];
      explain(s, status);
      return status;
    }
  if (!(std::abs(q.arm_rate) < 1e6)) {
    status.where = "tensioner arm";
    explain(s, status);
    return status;
  }
  for (const ContactSegment& segment : s.state().segments) {
    const Centre c = pulley_centre(m, q, segment.pulley);
    for (int i = segment.begin; i < segment.end; ++i)
      if (std::hypot(q.x[i] - c.x, q.y[i] - c.y) < 0.5 * m.pulley_radius[segment.pulley]) {
        status.state = RunState::off_pulley;
        status.element = i;
        status.where = "pulley " + m.body_name[segment.pulley];
        status.cause = "the belt was pressed through the pulley: the contact penalty cannot carry the load";
        status.advice = "raise contact.stiffness_n_per_m3, or check tension and speed";
        return status;
      }
  }
  return std::nullopt;
}

// Everything that is recorded while stepping. Buffers are reserved up front; the loop allocates nothing.
class Recorder {
 public:
  Recorder(const Model& model, const RunPlan& plan, RunRecord& record)
      : model_(model), plan_(plan), record_(record), sensors_(model) {
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
      const auto points = static_cast<std::size_t>((w.end_s - w.begin_s) / history_s) + 16;
      for (auto* v : {&r.element.time_s, &r.element.normal_n, &r.element.tangential_n, &r.element.tension_n})
        v->reserve(points);
      r.element.pulley.reserve(points);
      record.windows.push_back(std::move(r));
      trackers_.push_back(std::make_unique<PassTracker>(model, w.end_s - w.begin_s));
    }
  }

  bool open() const { return open_; }

  void sample(const Simulator& s) {
    record_.trace.time_s.push_back(s.time());
    sensors_.sample(s, record_.trace.channels);
  }

  // Opens and closes windows whose edges have come.
  void turn(const Simulator& s) {
    const double edge = 0.5 * s.step();
    if (!open_ && next_ < plan_.windows.size() && s.time() >= plan_.windows[next_].begin_s - edge) {
      open_ = true;
      begin_ = stored_energy(s);
      last_observed_ = s.time();
      last_history_ = s.time() - history_s;
      record_.windows[next_].first_sample = record_.trace.time_s.size();
      trackers_[next_]->open(s.state());
    }
    if (open_ && s.time() >= plan_.windows[next_].end_s - edge) close(s, true);
  }

  void close(const Simulator& s, bool complete) {
    if (!open_) return;
    WindowRecord& w = record_.windows[next_];
    const StoredEnergy end = stored_energy(s);
    w.energy[Energy::stored] = end.total - begin_.total;
    w.energy[Energy::lost_friction] -= end.anchors - begin_.anchors;
    w.energy[Energy::lost_tensioner_friction] -= end.arm_anchor - begin_.arm_anchor;
    w.last_sample = record_.trace.time_s.size();
    w.passes = trackers_[next_]->take();
    w.complete = complete;
    const Coordinates& q = s.state().q;
    w.loop.x_m.assign(q.x.data(), q.x.data() + q.x.size());
    w.loop.y_m.assign(q.y.data(), q.y.data() + q.y.size());
    w.loop.tension_n.assign(s.work().tension.data(), s.work().tension.data() + q.x.size());
    open_ = false;
    ++next_;
  }

  void searched(const Simulator& s) {
    if (open_) trackers_[next_]->searched(s.state());
  }

  void observe(const Simulator& s, bool sample) {
    const double elapsed = s.time() - last_observed_;
    last_observed_ = s.time();
    WindowRecord& w = record_.windows[next_];
    const EnergyAccount p = powers(s);
    for (std::size_t i = 0; i < p.joule.size(); ++i) w.energy.joule[i] += elapsed * p.joule[i];
    if (model_.pulleys == 0) return;
    const double largest = trackers_[next_]->observe(s.state(), s.work(), sample);
    double friction = 0;
    for (double mu : model_.pulley_friction) friction = std::max(friction, mu);
    if (s.step() * (axial_damping_rate(model_) + friction_damping_rate(model_, friction, largest)) > 2)
      record_.friction_overdamped_s += elapsed;
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

 private:
  const Model& model_;
  const RunPlan& plan_;
  RunRecord& record_;
  Sensors sensors_;
  std::vector<std::unique_ptr<PassTracker>> trackers_;
  std::size_t next_ = 0;  // window that is open or comes next
  bool open_ = false;
  StoredEnergy begin_;
  double last_observed_ = 0, last_history_ = 0;
};

}  // namespace

double run_step(const Model& model) {
  const SolverSpec& solver = model.scene.solver;
  const double wanted = solver.step_s.value_or(stable_step(model, solver.scheme));
  return 1 / (solver.sample_rate_hz * std::ceil(1 / (solver.sample_rate_hz * wanted) - 1e-9));
}

RunOutcome run(const Model& model, const RunPlan& plan, const RunOptions& options) {
  RunOutcome out;
  RunRecord& record = out.record;
  const double h = run_step(model);
  Simulator s(model, plan.profile, model.scene.solver.scheme, h);
  s.profile_kernels(options.profile_kernels);
  Recorder recorder(model, plan, record);
  record.step_s = h;

  const auto steps_of = [&](double seconds) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(seconds / h));
  };
  const auto per_sample = static_cast<std::int64_t>(std::llround(1 / (model.scene.solver.sample_rate_hz * h)));
  const auto per_observation = std::min(per_sample, steps_of(observation_s)), per_check = steps_of(check_s);
  const auto last = static_cast<std::int64_t>(std::llround(plan.end_s / h));
  std::int64_t next_sample = per_sample, next_observation = per_observation, next_check = per_check, refresh = -1;
  const auto start = std::chrono::steady_clock::now();

  std::optional<RunStatus> failed;
  while (s.state().step < last && !failed) {
    const std::int64_t until = std::min({last, next_sample, next_observation, next_check});
    while (s.state().step < until) {
      s.advance();
      if (s.state().refresh_step != refresh) {
        refresh = s.state().refresh_step;
        recorder.searched(s);
      }
    }
    const std::int64_t now = s.state().step;
    const bool sample = now >= next_sample || now == last;
    if (now >= next_check) {
      failed = failure(s);
      next_check += per_check;
    }
    if (recorder.open()) recorder.observe(s, sample);
    if (now >= next_observation) next_observation = now + per_observation;
    if (sample) {
      if (!failed) recorder.sample(s);
      recorder.turn(s);
      next_sample += per_sample;
      next_observation = now + per_observation;
      if (options.progress) options.progress(s.time());
    }
  }
  if (failed) {
    record.status = *failed;
    recorder.close(s, false);
  }
  record.simulated_s = s.time();
  record.steps = s.state().step;
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.kernel_times = s.kernel_times();
  return out;
}

}  // namespace beltlife
