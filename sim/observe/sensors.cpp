// Virtual sensors: see sensors.h.
#include "sim/observe/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace beltlife {
namespace {

constexpr double rpm = 30 / std::numbers::pi;

void put(std::vector<Channel>& channels, std::size_t& at, double value) { channels[at++].values.push_back(value); }

// Index into springs of the output's spring, -1 if the output torque is the belt's.
int output_spring(const Model& m) {
  const auto& list = m.scene.torsional_spring;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (m.scene.output->spring && list[i].name == *m.scene.output->spring) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::vector<Channel> channels_of(const Model& m) {
  std::vector<Channel> c;
  const auto add = [&](std::string name, std::string unit, std::string text) {
    c.push_back({std::move(name), std::move(unit), std::move(text), {}});
  };
  for (const auto& name : m.body_name) add(name + ".speed_rpm", "r/min", "speed in the running sense");
  if (m.scene.output)
    add(m.scene.output->body + ".torque_n_m", "N m",
        m.scene.output->spring ? "torque of the output spring from its `from` to its `to`, in the running sense"
                               : "torque of the pulley on the belt, in the running sense");
  if (m.driver.body >= 0) {
    add("driver.angle_rad", "rad", "nominal angle of the driven body, without ripple");
    add("driver.torque_n_m", "N m", "torque that the driver puts in, in the running sense");
  }
  add("belt.tension_mean_n", "N", "mean tension of all elements");
  add("belt.tension_min_n", "N", "lowest tension of all elements");
  add("belt.tension_max_n", "N", "highest tension of all elements");
  for (int p = 0; p < m.pulleys; ++p) {
    const std::string span = "span." + span_name(m.scene, p);
    add(span + ".tension_n", "N", "tension of the element in mid-span");
    add(span + ".deflection_mm", "mm", "deflection in mid-span, to the left of the scene's pulley order");
    add(span + ".nodes", "1", "belt nodes in the sensor box between the tangent points");
  }
  for (int p = 0; p < m.pulleys; ++p) {
    const std::string pulley = "pulley." + m.body_name[p];
    if (m.driver.body >= 0 && m.driver.body < m.pulleys)
      add(pulley + ".slip_percent", "%", "surface speed behind that of the driven pulley, in per cent of it");
    add(pulley + ".torque_n_m", "N m", "torque of the belt on the pulley, in the running sense");
    add(pulley + ".normal_force_n", "N", "sum of the normal contact forces");
    add(pulley + ".tangential_force_n", "N",
        "sum of the tangential contact forces on the pulley, in the running sense");
    add(pulley + ".hub_load_x_n", "N", "force of the belt on the pulley");
    add(pulley + ".hub_load_y_n", "N", "force of the belt on the pulley");
    if (!m.scene.event) continue;
    add(pulley + ".slip_speed_m_s", "m/s",
        "speed of the belt ahead of the pulley's surface, mean over the contact by normal force, in the running sense");
    add(pulley + ".slip_power_w", "W", "dissipated by friction between belt and pulley");
  }
  for (const auto& s : m.scene.torsional_spring) {
    add("spring." + s.name + ".torque_n_m", "N m", "torque from " + s.from + " to " + s.to + ", in the running sense");
    if (s.one_way)
      add("spring." + s.name + ".overrun_rad", "rad", "how far " + s.to + " has run ahead of " + s.from + " so far");
  }
  for (const auto& g : m.scene.gear_pair)
    add("gear_pair." + g.name + ".force_n", "N", "tooth force, positive when the pinion drives");
  if (m.tensioner.pulley >= 0) {
    add("tensioner.arm_angle_rad", "rad", "from where the scene places the arm, counterclockwise");
    add("tensioner.arm_rate_rad_s", "rad/s", "counterclockwise");
    add("tensioner.friction_torque_n_m", "N m", "dry friction on the arm, counterclockwise");
    if (m.tensioner.stops.any()) add("tensioner.stop_torque_n_m", "N m", "stops on the arm, counterclockwise");
  }
  return c;
}

Sensors::Sensors(const Model& m) {
  for (int p = 0; p < m.pulleys; ++p)
    circles_.push_back({m.pulley_x[p], m.pulley_y[p], m.pulley_radius[p],
                        m.scene.pulley[p].side == Side::front ? m.statics.orientation : -m.statics.orientation});
  if (!circles_.empty()) make_route(circles_, route_);
}

void Sensors::spans(const DriveView& s, std::vector<Channel>& channels, std::size_t& at) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  if (m.tensioner.pulley >= 0) {
    const Centre c = pulley_centre(m, q, m.tensioner.pulley);
    circles_[m.tensioner.pulley].x = c.x;
    circles_[m.tensioner.pulley].y = c.y;
  }
  const bool closed = make_route(circles_, route_);
  const int n = m.belt.nodes;
  for (int p = 0; p < m.pulleys; ++p) {
    if (!closed) {  // the arm swung into a pulley
      for (int k = 0; k < 3; ++k) put(channels, at, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const Span& span = route_.spans[p];
    const Vec2 u = span.direction, mid{0.5 * (span.from.x + span.to.x), 0.5 * (span.from.y + span.to.y)};
    const double half = 0.5 * span.length, height = std::max(0.01, 0.125 * span.length);
    int nearest = 0, inside = 0;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < n; ++i) {
      const double dx = q.x[i] - mid.x, dy = q.y[i] - mid.y;
      const double along = dx * u.x + dy * u.y, across = dy * u.x - dx * u.y;
      inside += std::abs(along) < half && std::abs(across) < height;
      if (dx * dx + dy * dy < least) {
        least = dx * dx + dy * dy;
        nearest = i;
      }
    }
    // Nodes count up along the scene's pulley order: the element in mid-span begins at the last node before it.
    const auto along = [&](int i) { return (q.x[i] - mid.x) * u.x + (q.y[i] - mid.y) * u.y; };
    const int a = along(nearest) <= 0 ? nearest : (nearest + n - 1) % n, b = (a + 1) % n;
    const double sa = along(a), sb = along(b), weight = sb > sa ? std::clamp(-sa / (sb - sa), 0.0, 1.0) : 0.0;
    const double x = q.x[a] + weight * (q.x[b] - q.x[a]) - mid.x, y = q.y[a] + weight * (q.y[b] - q.y[a]) - mid.y;
    put(channels, at, s.work().tension[a]);
    put(channels, at, 1e3 * (y * u.x - x * u.y));
    put(channels, at, inside);
  }
}

void Sensors::sample(const DriveView& s, std::vector<Channel>& channels) {
  const Model& m = s.model();
  const Coordinates& q = s.state().q;
  const Work& w = s.work();
  std::size_t at = 0;
  for (int b = 0; b < m.bodies; ++b) put(channels, at, m.sense[b] * q.speed[b] * rpm);
  if (m.scene.output) {
    const int body = body_index(m, m.scene.output->body), spring = output_spring(m);
    put(channels, at,
        spring >= 0 ? m.sense[m.springs[spring].from] * w.spring_torque[spring] : -m.sense[body] * w.belt_torque[body]);
  }
  if (m.driver.body >= 0) {
    const int d = m.driver.body;
    const auto given = s.profile().at(s.time());
    put(channels, at, given.angle);
    put(channels, at,
        m.prescribed() ? m.inertia[d] * given.acceleration - m.sense[d] * w.torque[d] : m.sense[d] * w.driver_torque);
  }
  double low = std::numeric_limits<double>::max(), high = -low;
  for (int i = 0; i < m.belt.nodes; ++i) {
    low = std::min(low, w.tension[i]);
    high = std::max(high, w.tension[i]);
  }
  put(channels, at, sum(w.tension.data(), m.belt.nodes) / m.belt.nodes);
  put(channels, at, low);
  put(channels, at, high);
  if (m.pulleys > 0) spans(s, channels, at);
  const int d = m.driver.body;
  for (int p = 0; p < m.pulleys; ++p) {
    if (d >= 0 && d < m.pulleys) {
      const double reference = m.sense[d] * q.speed[d] * m.pulley_radius[d];
      const double surface = m.sense[p] * q.speed[p] * m.pulley_radius[p];
      put(channels, at, reference > 1e-3 ? 100 * (1 - surface / reference) : 0.0);
    }
    put(channels, at, m.sense[p] * w.belt_torque[p]);
    double normal = 0, tangential = 0, sliding = 0, power = 0;
    for (const ContactSegment& segment : s.state().segments)
      if (segment.pulley == p) {
        normal += sum(w.normal.data() + segment.begin, segment.end - segment.begin);
        tangential -= sum(w.tangential.data() + segment.begin, segment.end - segment.begin);
        for (int i = segment.begin; m.scene.event && i < segment.end; ++i) {
          sliding += w.normal[i] * w.slip[i];
          power -= w.tangential[i] * w.slip[i];
        }
      }
    put(channels, at, normal);
    put(channels, at, m.sense[p] * tangential);
    put(channels, at, w.hub_x[p]);
    put(channels, at, w.hub_y[p]);
    if (!m.scene.event) continue;
    put(channels, at, normal > 0 ? m.sense[p] * sliding / normal : 0.0);
    put(channels, at, power);
  }
  for (std::size_t i = 0; i < m.springs.size(); ++i) {
    put(channels, at, m.sense[m.springs[i].from] * w.spring_torque[i]);
    if (m.springs[i].one_way) put(channels, at, -s.state().free_wheel[i]);
  }
  for (double f : w.gear_force) put(channels, at, f);
  if (m.tensioner.pulley >= 0) {
    put(channels, at, q.arm_angle);
    put(channels, at, q.arm_rate);
    put(channels, at, w.arm_friction);
    if (m.tensioner.stops.any()) put(channels, at, w.arm_stop_torque);
  }
}

}  // namespace beltlife
