// Search for nodes near pulleys: see contact_search.h.
#include "sim/contact_search.h"

#include <algorithm>
#include <cmath>

#include "sim/kernels/kernel.h"

namespace beltlife {
namespace {

constexpr double margin = 5e-3;   // m above the surface within which a node is looked at
constexpr double longest = 1e-4;  // s between searches

}  // namespace

void find_contacts(const Model& m, double step, State& state, Work& work) {
  const Coordinates& q = state.q;
  const int n = m.belt.nodes;
  double fastest2 = 0;
  for (int i = 0; i < n; ++i) fastest2 = std::max(fastest2, q.vx[i] * q.vx[i] + q.vy[i] * q.vy[i]);

  const int arm_pulley = m.tensioner.pulley;
  const Centre moving = arm_pulley >= 0 ? pulley_centre(m, q, arm_pulley) : Centre{};
  state.segments.clear();
  int previous = -1;
  for (int i = 0; i < n; ++i) {
    int nearest = -1;
    double least = margin;
    for (int p = 0; p < m.pulleys; ++p) {
      const double dx = q.x[i] - (p == arm_pulley ? moving.x : m.pulley_x[p]);
      const double dy = q.y[i] - (p == arm_pulley ? moving.y : m.pulley_y[p]);
      const double reach = m.pulley_radius[p] + margin;
      const double d2 = dx * dx + dy * dy;
      if (d2 >= reach * reach) continue;
      const double gap = std::sqrt(d2) - m.pulley_radius[p];
      if (gap < least) {
        least = gap;
        nearest = p;
      }
    }
    if (nearest != state.near[i]) {
      state.anchor[i] = 0;
      work.normal[i] = work.tangential[i] = work.slip[i] = 0;
      state.near[i] = nearest;
    }
    if (nearest >= 0 && nearest == previous)
      state.segments.back().end = i + 1;
    else if (nearest >= 0)
      state.segments.push_back({nearest, i, i + 1});
    previous = nearest;
  }

  const double fastest = std::sqrt(fastest2);
  const double interval = fastest > 0 ? std::min(longest, 0.5 * margin / fastest) : longest;
  state.refresh_step = state.step + std::max<std::int64_t>(1, static_cast<std::int64_t>(interval / step));
}

}  // namespace beltlife
