// What is no longer a belt drive: see divergence.h.
#include "sim/divergence.h"

#include <fmt/format.h>

#include <cmath>

namespace beltlife {
namespace {

std::string place_of(const DriveView& s, int element) {
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

void explain(const DriveView& s, RunStatus& status) {
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

}  // namespace

std::optional<RunStatus> failure(const DriveView& s) {
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

}  // namespace beltlife
