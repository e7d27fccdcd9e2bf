// Shafts and gears of a steady drive: see trains.h.
#include "sim/statics/trains.h"

#include <fmt/format.h>

#include <algorithm>

namespace beltlife {
namespace {

// Bodies that a train's one-way springs divide, and what passes between them.
struct Clutches {
  const Model& m;
  int pulley;
  double speed;              // rad/s, of the pulley
  std::vector<bool> seen;    // bodies
  std::vector<int> overrun;  // springs

  Clutches(const Model& model, int of, double at) : m(model), pulley(of), speed(at), seen(model.bodies, false) {}

  // By body: whether it is `first` or joined to it by shafts and gears alone.
  std::vector<bool> joined_to(int first) const {
    std::vector<bool> joined(m.bodies, false);
    joined[first] = true;
    const auto join = [&](int a, int b) { joined[a] = joined[b] = joined[a] || joined[b]; };
    for (int pass = 0; pass < m.bodies; ++pass) {
      for (const TorsionalSpring& s : m.springs)
        if (!s.one_way) join(s.from, s.to);
      for (const GearPair& g : m.gears) join(g.pinion, g.gear);
    }
    return joined;
  }

  // N m, referred to the pulley, that `first` and what is joined to it take, with what hangs on engaged clutches.
  double load(int first) {
    const std::vector<bool> joined = joined_to(first);
    for (int b = 0; b < m.bodies; ++b) seen[b] = seen[b] || joined[b];
    double torque = 0;
    for (const TorqueTable& t : m.torques) {
      if (!joined[t.body]) continue;
      const double ratio = m.speed_ratio[t.body] / m.speed_ratio[pulley];
      torque -= ratio * t.factor * t.torque(ratio * speed);
    }
    for (std::size_t i = 0; i < m.springs.size(); ++i) {
      const TorsionalSpring& s = m.springs[i];
      const bool drives = joined[s.from];
      const int there = drives ? s.to : s.from;
      if (!s.one_way || drives == joined[s.to] || seen[there]) continue;
      const double behind = load(there);
      if (drives ? behind > 0 : behind < 0)
        torque += behind;
      else
        overrun.push_back(static_cast<int>(i));
    }
    return torque;
  }
};

}  // namespace

Trains::Trains(const Model& m, double driven_body_speed) : pulley_of(m.bodies, -1) {
  if (m.driver.body < 0) {
    error = "no driver gives the drive its speed";
    return;
  }
  if (driven_body_speed <= 0) {
    error = "the drive stands still: see the layout at rest";
    return;
  }
  for (int p = 0; p < m.pulleys; ++p) pulley_of[p] = p;
  const auto join = [&](int a, int b) {
    if (pulley_of[a] < 0) pulley_of[a] = pulley_of[b];
    if (pulley_of[b] < 0) pulley_of[b] = pulley_of[a];
    if (pulley_of[a] != pulley_of[b])
      error =
          fmt::format("the pulleys {} and {} are joined by shafts or gears: how they share the load depends on slip",
                      m.body_name[pulley_of[a]], m.body_name[pulley_of[b]]);
  };
  for (int pass = 0; pass < m.bodies && !error; ++pass) {
    for (const TorsionalSpring& s : m.springs) join(s.from, s.to);
    for (const GearPair& g : m.gears) join(g.pinion, g.gear);
  }
  if (error) return;
  driver_pulley = pulley_of[m.driver.body];
  if (driver_pulley < 0) {
    error = "the driven body " + m.body_name[m.driver.body] + " does not turn any pulley";
    return;
  }
  if (!Clutches(m, driver_pulley, 1).joined_to(driver_pulley)[m.driver.body]) {
    error = "the driven body " + m.body_name[m.driver.body] + " turns the belt through a one-way spring";
    return;
  }
  driver_speed = driven_body_speed * m.speed_ratio[driver_pulley] / m.speed_ratio[m.driver.body];
}

double Trains::load_on(const Model& m, int pulley, double speed) const {
  if (m.has_one_way()) return Clutches(m, pulley, speed).load(pulley);
  double torque = 0;
  for (const TorqueTable& t : m.torques) {
    if (pulley_of[t.body] != pulley) continue;
    const double ratio = m.speed_ratio[t.body] / m.speed_ratio[pulley];
    torque -= ratio * t.factor * t.torque(ratio * speed);
  }
  return torque;
}

std::vector<int> Trains::released(const Model& m, int pulley, double speed) const {
  Clutches clutches(m, pulley, speed);
  clutches.load(pulley);
  return clutches.overrun;
}

}  // namespace beltlife
