// The linearly implicit scheme: see lane_simulator.h.
#include "sim/lanes/lane_simulator.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace beltlife {
namespace {

constexpr double margin = 5e-3;           // m above a pulley's surface within which a node is looked at
constexpr double search_interval = 1e-4;  // s

// Squares of the largest nodal velocity in each lane.
BELTLIFE_VECTOR void fastest(int rows, const double* vx, const double* vy, LaneNumber& most) {
  for (int j = 0; j < rows; ++j) {
    const double *u = vx + j * lanes, *v = vy + j * lanes;
    BELTLIFE_EACH_LANE(k) {
      const double v2 = u[k] * u[k] + v[k] * v[k];
      most[k] = v2 > most[k] ? v2 : most[k];
    }
  }
}

// The nearest pulley of every node within `reach` of its surface; -1 where there is none. Nearness is the power
// (d^2 - r^2)/2r, the gap to first order, which needs no root.
BELTLIFE_VECTOR void nearest_pulleys(int rows, int pulleys, const LaneNumber& reach, const LaneNumber* cx,
                                     const LaneNumber* cy, const LaneNumber* radius, const double* x, const double* y,
                                     double* gaps, double* found) {
  for (int i = 0; i < rows * lanes; ++i) {
    gaps[i] = 1e300;
    found[i] = -1;
  }
  for (int p = 0; p < pulleys; ++p) {
    const double* px = cx[p].of;
    const double* py = cy[p].of;
    const double number = p;
    alignas(64) double far2[lanes], r2[lanes], scale[lanes];
    for (int k = 0; k < lanes; ++k) {
      const double r = radius[p][k], far = r + reach[k];
      far2[k] = far * far;
      r2[k] = r * r;
      scale[k] = 0.5 / r;
    }
    for (int j = 0; j < rows; ++j) {
      const double *xj = x + j * lanes, *yj = y + j * lanes;
      double *gap = gaps + j * lanes, *out = found + j * lanes;
      BELTLIFE_EACH_LANE(k) {
        const double dx = xj[k] - px[k], dy = yj[k] - py[k];
        const double d2 = dx * dx + dy * dy;
        const double here = d2 < far2[k] ? (d2 - r2[k]) * scale[k] : 1e301;
        const double before = gap[k];
        out[k] = here < before ? number : out[k];
        gap[k] = here < before ? here : before;
      }
    }
  }
}

// Elements' turn rates for the energy account, at t_n: the bending damper has done its work at the mean of the
// velocities half a step before and after. Half a step later squares are larger, by what the mean takes off short
// waves.
BELTLIFE_VECTOR void damper_rates(int nodes, const double* dvx, const double* dvy, const double* ux, const double* uy,
                                  const double* inverse_length, double* __restrict turn_rate) {
  for (int i = -1; i < nodes; ++i)
    turn_rate[i] -= 0.5 * (ux[i] * (dvy[i + 1] - dvy[i]) - uy[i] * (dvx[i + 1] - dvx[i])) * inverse_length[i];
}

BELTLIFE_VECTOR void back_by(double half, int nodes, const double* dv, const double* v, double* __restrict x) {
  for (int i = 0; i < nodes; ++i) x[i] -= half * (v[i] + 0.25 * dv[i]);
}

}  // namespace

LaneSimulator::LaneSimulator(const std::vector<LaneDrive>& drives, LaneUse use, double step)
    : step_(step), search_steps_(std::max<std::int64_t>(1, static_cast<std::int64_t>(search_interval / step + 1e-9))) {
  std::vector<const Model*> models;
  for (const LaneDrive& d : drives) models.push_back(d.model);
  belt_ = make_lane_belt(models, use, step);
  for (const LaneDrive& d : drives) {
    const Model& m = *d.model;
    drives_.push_back(std::make_unique<Drive>(Drive{
        d.model, d.profile, m.initial, m.initial, make_work(m), ImplicitTrain(m, *d.profile, step), force_program(m),
        std::vector<double>(m.pulleys), std::vector<double>(m.pulleys), std::vector<double>(m.pulleys)}));
    drives_.back()->work.normal_peak = drives_.back()->work.tangential_peak = NodeArray(m.belt.nodes);
  }
  const int nodes = models.front()->belt.nodes;
  for (int k = 0; k < lanes; ++k) {
    const State& s = drives_[k < this->drives() ? k : 0]->state;
    for (int j = 0; j < belt_.rows; ++j) {
      const int i = use == LaneUse::arcs ? k * belt_.rows + j : j;
      if (i >= nodes) continue;
      belt_.x.row(j)[k] = s.q.x[i];
      belt_.y.row(j)[k] = s.q.y[i];
      belt_.vx.row(j)[k] = s.q.vx[i];
      belt_.vy.row(j)[k] = s.q.vy[i];
    }
  }
  parts_ = parts_of(*models.front());
  near_.assign(static_cast<std::size_t>(belt_.rows) * lanes, -1);
  const int pulleys = models.front()->pulleys;
  for (auto* v : {&centre_x_, &centre_y_, &centre_vx_, &centre_vy_, &radii_, &speeds_, &changes_})
    v->resize(pulleys + 1);
  for (int k = 0; k < lanes; ++k) centre_x_.back()[k] = 1e3;  // none is far from every node: no distance is 0
  last_change_x_ = last_change_y_ = NodeArray(nodes);
  gaps_.resize(near_.size());
  found_.resize(near_.size());
  loads_.resize(pulleys + 1);
}

void LaneSimulator::search() {
  const int pulleys = drives_.front()->model->pulleys, rows = belt_.rows;
  LaneNumber reach;
  fastest(rows, belt_.vx.data(), belt_.vy.data(), reach);
  if (belt_.use == LaneUse::arcs) {
    const double most = *std::max_element(reach.of, reach.of + lanes);
    for (int k = 0; k < lanes; ++k) reach[k] = most;
  }
  for (int k = 0; k < lanes; ++k) reach[k] = std::max(margin, 1.5 * std::sqrt(reach[k]) * search_interval);
  for (int k = 0; k < lanes; ++k)
    for (int p = 0; p < pulleys; ++p) radii_[p][k] = drive_of(k).model->pulley_radius[p];
  nearest_pulleys(rows, pulleys, reach, centre_x_.data(), centre_y_.data(), radii_.data(), belt_.x.data(),
                  belt_.y.data(), gaps_.data(), found_.data());
  for (std::size_t at = 0; at < near_.size(); ++at) {
    const int nearest = static_cast<int>(found_[at]);
    if (near_[at] == nearest) continue;
    near_[at] = nearest;
    for (LaneArray* a : {&belt_.anchor, &belt_.normal, &belt_.tangential, &belt_.normal_tangent,
                         &belt_.tangential_tangent, &belt_.normal_x, &belt_.normal_y, &belt_.normal_last,
                         &belt_.normal_before, &belt_.lag, &belt_.tangential_now, &belt_.creep})
      a->data()[at] = 0;
  }
  belt_.blocks.clear();
  for (int j = 0; j < rows; ++j) {
    const int* row = near_.data() + static_cast<std::size_t>(j) * lanes;
    if (std::all_of(row, row + lanes, [](int p) { return p < 0; })) continue;
    int wanted[lanes];
    for (int k = 0; k < lanes; ++k) wanted[k] = row[k] >= 0 ? row[k] : pulleys;
    if (!belt_.blocks.empty() && belt_.blocks.back().end == j &&
        std::equal(wanted, wanted + lanes, belt_.blocks.back().pulley)) {
      belt_.blocks.back().end = j + 1;
      continue;
    }
    ContactBlock& b = belt_.blocks.emplace_back();
    b.begin = j;
    b.end = j + 1;
    std::copy(wanted, wanted + lanes, b.pulley);
    describe(b);
  }
}

// What lasts until the next search of the pulleys of a block.
void LaneSimulator::describe(ContactBlock& block) const {
  const int none = drives_.front()->model->pulleys;
  block.on_arm = false;
  for (int k = 0; k < lanes; ++k) {
    const int p = block.pulley[k];
    const Model& m = *drive_of(k).model;
    const bool any = p < none;
    const double friction = any ? m.pulley_friction[p] : 0.0, share = m.contact.anchor_share;
    block.of.radius[k] = any ? m.pulley_radius[p] : -1.0;
    block.of.anchor_limit[k] = share * friction;
    block.of.velocity_limit[k] = (1 - share) * friction;
    block.of.x[k] = centre_x_[p][k];
    block.of.y[k] = centre_y_[p][k];
    block.of.vx[k] = centre_vx_[p][k];
    block.of.vy[k] = centre_vy_[p][k];
    block.on_arm = block.on_arm || (any && p == m.tensioner.pulley);
  }
}

// Speeds of all pulleys, and the arm's place in the blocks at its pulley.
void LaneSimulator::follow_pulleys() {
  const int pulleys = drives_.front()->model->pulleys;
  for (int k = 0; k < lanes; ++k) {
    const Drive& d = drive_of(k);
    for (int p = 0; p < pulleys; ++p) {
      speeds_[p][k] = d.state.q.speed[p];
      changes_[p][k] = d.train.speed_change()[p];
    }
  }
  for (ContactBlock& b : belt_.blocks) {
    if (!b.on_arm) continue;
    for (int k = 0; k < lanes; ++k) {
      b.of.x[k] = centre_x_[b.pulley[k]][k];
      b.of.y[k] = centre_y_[b.pulley[k]][k];
      b.of.vx[k] = centre_vx_[b.pulley[k]][k];
      b.of.vy[k] = centre_vy_[b.pulley[k]][k];
    }
  }
}

// Only the pulley on the arm moves; the others are placed once.
void LaneSimulator::place_pulleys() {
  const int pulleys = drives_.front()->model->pulleys, on_arm = drives_.front()->model->tensioner.pulley;
  for (int p = placed_ ? std::max(on_arm, 0) : 0; p < pulleys; ++p) {
    if (placed_ && p != on_arm) break;
    for (int k = 0; k < lanes; ++k) {
      if (k > 0 && (belt_.use == LaneUse::arcs || k >= drives())) {
        for (auto* v : {&centre_x_, &centre_y_, &centre_vx_, &centre_vy_}) (*v)[p][k] = (*v)[p][0];
        continue;
      }
      const Centre c = pulley_centre(*drive_of(k).model, drive_of(k).state.q, p);
      centre_x_[p][k] = c.x;
      centre_y_[p][k] = c.y;
      centre_vx_[p][k] = c.vx;
      centre_vy_[p][k] = c.vy;
    }
  }
  placed_ = true;
}

void LaneSimulator::expect() {
  for (auto& d : drives_) d->train.expect(d->state, time());
}

void LaneSimulator::search_when_due() {
  if (!search_due()) return;
  search();
  next_search_ = step_count_ + search_steps_;
}

void LaneSimulator::ghosts() { fill_lane_ghosts(belt_); }

void LaneSimulator::elements() { lane_elements(belt_); }

void LaneSimulator::contact() {
  follow_pulleys();
  lane_contact(belt_, speeds_.data(), changes_.data());
}

void LaneSimulator::solve() { lane_solve(belt_); }

void LaneSimulator::reactions() {
  for (LaneLoads& l : loads_) l = {};
  lane_reactions(belt_, loads_.data());
}

void LaneSimulator::motion() { lane_advance(belt_); }

void LaneSimulator::bodies() {
  const int pulleys = drives_.front()->model->pulleys;
  for (int i = 0; i < drives(); ++i) {
    Drive& d = *drives_[i];
    for (int p = 0; p < pulleys; ++p) {
      const LaneLoads& l = loads_[p];
      double x = l.x[i], y = l.y[i], moment = l.moment[i];
      if (belt_.use == LaneUse::arcs)
        for (int k = 1; k < lanes; ++k) {
          x += l.x[k];
          y += l.y[k];
          moment += l.moment[k];
        }
      d.hub_x[p] = x;
      d.hub_y[p] = y;
      d.belt_torque[p] = moment;
    }
    d.train.advance(d.state, time(), d.belt_torque.data(), d.hub_x.data(), d.hub_y.data());
  }
}

std::vector<LaneSimulator::Part> LaneSimulator::parts_of(const Model& m) {
  const bool bending = m.belt.bending_damping > 0 || m.belt.bending_stiffness > 0, pulleys = m.pulleys > 0;
  std::vector<Part> list;
  if (m.bodies > 0) list.push_back({"expected speeds", &LaneSimulator::expect});
  if (pulleys) list.push_back({"pulley centres", &LaneSimulator::place_pulleys});
  if (pulleys) list.push_back({"contact search", &LaneSimulator::search_when_due});
  list.push_back({"belt ghosts", &LaneSimulator::ghosts});
  list.push_back({bending ? "belt elements, axial and bending" : "belt elements, axial", &LaneSimulator::elements});
  if (pulleys) list.push_back({"contact", &LaneSimulator::contact});
  list.push_back({bending ? "belt solve, axial and bending" : "belt solve, axial", &LaneSimulator::solve});
  if (pulleys) list.push_back({"contact reactions", &LaneSimulator::reactions});
  list.push_back({"belt motion", &LaneSimulator::motion});
  if (m.bodies > 0) list.push_back({"bodies", &LaneSimulator::bodies});
  return list;
}

std::vector<std::string> LaneSimulator::kernel_names(const Model& m) {
  std::vector<std::string> names;
  for (const Part& part : parts_of(m)) names.push_back(part.name);
  // What the bodies' part goes through, under the names of the explicit schemes' kernels.
  bool bodies = false;
  for (const Kernel& k : force_program(m)) {
    if (bodies && k.apply != &beltlife::contact) names.push_back(k.name);
    bodies = bodies || k.apply == &clear_torques;
  }
  return names;
}

void LaneSimulator::profile_kernels(bool on) {
  timing_ = on;
  times_.clear();
  for (const Part& part : parts_) times_.push_back({part.name, 0, 0});
}

void LaneSimulator::advance() {
  if (!timing_) {
    for (const Part& part : parts_) (this->*part.run)();
  } else {
    auto last = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      (this->*parts_[i].run)();
      const auto now = std::chrono::steady_clock::now();
      times_[i].seconds += std::chrono::duration<double>(now - last).count();
      ++times_[i].calls;
      last = now;
    }
  }
  ++step_count_;
}

DriveView LaneSimulator::observe(int drive) {
  Drive& d = *drives_[drive];
  State& s = d.observed;
  s.q.angle = d.state.q.angle;
  s.q.speed = d.state.q.speed;
  s.q.arm_rate = d.state.q.arm_rate;
  s.q.arm_angle = d.state.q.arm_angle - 0.5 * step_ * s.q.arm_rate;
  s.q.reference_angle = d.state.q.reference_angle;
  s.arm_anchor = d.state.arm_anchor;
  s.free_wheel = d.state.free_wheel;
  const int nodes = d.model->belt.nodes, rows = belt_.rows;
  const double back = 0.5 * step_;
  s.step = step_count_;
  s.segments.clear();
  for (int first = 0; first < nodes; first += rows) {
    const int lane = belt_.use == LaneUse::arcs ? first / rows : drive;
    const auto take = [&](const LaneArray& from, NodeArray& to) {
      const double* source = from.data() + lane;
      double* target = to.data() + first;
      for (int j = 0; j < rows; ++j) target[j] = source[j * lanes];
    };
    take(belt_.vx, s.q.vx);
    take(belt_.vy, s.q.vy);
    take(belt_.x, s.q.x);
    take(belt_.y, s.q.y);
    take(belt_.dvx, last_change_x_);
    take(belt_.dvy, last_change_y_);
    take(belt_.anchor, s.anchor);
    take(belt_.normal_peak, d.work.normal_peak);
    take(belt_.tangential_peak, d.work.tangential_peak);
    for (int j = 0; j < rows; ++j) belt_.normal_peak.row(j)[lane] = belt_.tangential_peak.row(j)[lane] = 0;
    for (int j = 0; j < rows; ++j) {
      const int i = first + j, near = near_[static_cast<std::size_t>(j) * lanes + lane];
      if (near != s.near[i]) {
        d.work.normal[i] = d.work.tangential[i] = d.work.slip[i] = 0;
        s.near[i] = near;
      }
      if (near < 0) continue;
      if (!s.segments.empty() && s.segments.back().end == i && s.segments.back().pulley == near)
        s.segments.back().end = i + 1;
      else
        s.segments.push_back({near, i, i + 1});
    }
  }
  back_by(back, nodes, last_change_x_.data(), s.q.vx.data(), s.q.x.data());
  back_by(back, nodes, last_change_y_.data(), s.q.vy.data(), s.q.y.data());
  Evaluation e{*d.model, *d.profile, s.q, s, d.work, {time() - back, 0, back, false}};
  for (const Kernel& k : d.program) k.apply(e);
  if (d.model->belt.bending_damping > 0) {
    last_change_x_.fill_ghosts();
    last_change_y_.fill_ghosts();
    damper_rates(nodes, last_change_x_.data(), last_change_y_.data(), d.work.ux.data(), d.work.uy.data(),
                 d.work.inverse_length.data(), d.work.turn_rate.data());
  }
  return {*d.model, *d.profile, s, d.work, time(), step_, back};
}

}  // namespace beltlife
