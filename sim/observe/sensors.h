// Owns the virtual sensors: from a simulator's state to one sample of every recorded channel.
#pragma once

#include <vector>

#include "sim/record.h"
#include "sim/route/route.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

/// Channels of this model in the order in which `sample` writes them, without values. Spellings:
/// BODY.speed_rpm and OUTPUT.torque_n_m (in the running sense), driver.angle_rad, driver.torque_n_m,
/// span.A-B.{tension_n, deflection_mm, nodes}, pulley.NAME.{slip_percent, normal_force_n, tangential_force_n,
/// hub_load_x_n, hub_load_y_n, torque_n_m; of a scene with an event also slip_speed_m_s, slip_power_w},
/// spring.NAME.torque_n_m, gear_pair.NAME.force_n, tensioner.{arm_angle_rad, arm_rate_rad_s, friction_torque_n_m},
/// belt.tension_{mean,max,min}_n.
std::vector<Channel> channels_of(const Model& model);

/// Writes samples without allocating. One per run.
class Sensors {
 public:
  explicit Sensors(const Model& model);
  void sample(const DriveView& s, std::vector<Channel>& channels);

 private:
  void spans(const DriveView& s, std::vector<Channel>& channels, std::size_t& at);
  std::vector<Circle> circles_;
  Route route_;
};

}  // namespace beltlife
