// Shafts and gears of a steady drive: see trains.h.
#include "sim/statics/trains.h"

#include <fmt/format.h>

namespace beltlife {

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
  driver_speed = driven_body_speed * m.speed_ratio[driver_pulley] / m.speed_ratio[m.driver.body];
}

double Trains::load_on(const Model& m, int pulley, double speed) const {
  double torque = 0;
  for (const TorqueTable& t : m.torques) {
    if (pulley_of[t.body] != pulley) continue;
    const double ratio = m.speed_ratio[t.body] / m.speed_ratio[pulley];
    torque -= ratio * t.factor * t.torque(ratio * speed);
  }
  return torque;
}

}  // namespace beltlife
