// Passes of belt nodes over pulleys: see pass_tracker.h.
#include "sim/observe/pass_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {

PassTracker::PassTracker(const Model& m, double window_s)
    : passes_(m.pulleys),
      near_(m.belt.nodes, -1),
      counts_(m.belt.nodes, 0),
      sampled_(m.belt.nodes, 0),
      normal_(m.belt.nodes),
      tangential_(m.belt.nodes),
      sampled_normal_(m.belt.nodes),
      sampled_tangential_(m.belt.nodes) {
  // Rounds of the belt within the window at the fastest range, and half again for slip.
  double rounds = 1;
  for (const auto& range : m.scene.range)
    rounds = std::max(rounds, 1.5 * window_s * range.crank_rpm * std::numbers::pi / 30 /
                                  (m.speed_ratio[m.driver.body] * m.belt.unstretched_length));
  for (PassForces& p : passes_)
    for (auto* v : {&p.normal_resolved, &p.tangential_resolved, &p.normal_sampled, &p.tangential_sampled})
      v->reserve(static_cast<std::size_t>((rounds + 2) * m.belt.nodes));
}

void PassTracker::open(const State& state) {
  near_ = state.near;
  std::fill(counts_.begin(), counts_.end(), 0);
}

void PassTracker::finish(int i) {
  if (near_[i] < 0 || !counts_[i] || normal_[i] <= 0) return;
  PassForces& p = passes_[near_[i]];
  p.normal_resolved.push_back(normal_[i]);
  p.tangential_resolved.push_back(tangential_[i]);
  if (sampled_[i]) {
    p.normal_sampled.push_back(sampled_normal_[i]);
    p.tangential_sampled.push_back(sampled_tangential_[i]);
  } else {
    ++p.unsampled;
  }
}

void PassTracker::searched(const State& state) {
  for (int i = 0; i < static_cast<int>(near_.size()); ++i) {
    if (state.near[i] == near_[i]) continue;
    finish(i);
    near_[i] = state.near[i];
    counts_[i] = 1;
    sampled_[i] = 0;
    normal_[i] = tangential_[i] = sampled_normal_[i] = sampled_tangential_[i] = 0;
  }
}

double PassTracker::observe(const State& state, const Work& work, bool sample) {
  double largest = 0;
  const bool peaks = work.normal_peak.size() > 0;
  for (const ContactSegment& s : state.segments)
    for (int i = s.begin; i < s.end; ++i) {
      const double normal = work.normal[i], tangential = std::abs(work.tangential[i]);
      largest = std::max(largest, normal);
      normal_[i] = std::max(normal_[i], peaks ? work.normal_peak[i] : normal);
      tangential_[i] = std::max(tangential_[i], peaks ? work.tangential_peak[i] : tangential);
      if (sample && normal > 0) {
        sampled_[i] = 1;
        sampled_normal_[i] = std::max(sampled_normal_[i], normal);
        sampled_tangential_[i] = std::max(sampled_tangential_[i], tangential);
      }
    }
  return largest;
}

}  // namespace beltlife
