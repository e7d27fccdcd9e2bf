// Given speed of the driven body: see speed_profile.h.
#include "sim/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beltlife {

double Table1::operator()(double at) const {
  if (!(at > 0)) return 0;  // nor of what is no number: a drive that blows up looks here too
  if (at >= x.back()) return y.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  if (next == 0) return y[0] * at / x[0];
  const double s = (at - x[next - 1]) / (x[next] - x[next - 1]);
  return y[next - 1] + s * (y[next] - y[next - 1]);
}

SpeedProfile::SpeedProfile(const std::vector<double>& times, const std::vector<double>& speeds,
                           std::vector<Harmonic> harmonics, double phase)
    : harmonics_(std::move(harmonics)), phase_(phase) {
  double angle = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0) angle += 0.5 * (times[i] - times[i - 1]) * (speeds[i] + speeds[i - 1]);
    knots_.push_back({times[i], speeds[i], angle});
  }
}

SpeedProfile::Value SpeedProfile::at(double time) const {
  Value v;
  if (knots_.empty()) return v;
  const auto next =
      std::upper_bound(knots_.begin(), knots_.end(), time, [](double t, const Knot& knot) { return t < knot.time; });
  if (next == knots_.begin() || next == knots_.end()) {
    const Knot& k = next == knots_.begin() ? knots_.front() : knots_.back();
    v.mean = k.speed;
    v.angle = k.angle + k.speed * (time - k.time);
  } else {
    const Knot& a = *(next - 1);
    const double rate = (next->speed - a.speed) / (next->time - a.time), dt = time - a.time;
    v.mean = a.speed + rate * dt;
    v.angle = a.angle + dt * (a.speed + 0.5 * rate * dt);
    v.acceleration = rate;
  }
  v.speed = v.mean;
  for (const Harmonic& h : harmonics_) {
    const double amplitude = h.amplitude(v.mean);
    if (amplitude == 0) continue;
    const double angle = h.order * (v.angle + phase_) + h.phase;
    v.speed += amplitude * std::cos(angle);
    v.acceleration -= amplitude * h.order * v.mean * std::sin(angle);
  }
  return v;
}

std::vector<Harmonic> harmonics_of(const DriverSpec& driver) {
  constexpr double rad_s = std::numbers::pi / 30;
  std::vector<Harmonic> out;
  for (const auto& h : driver.harmonic) {
    Harmonic harmonic{h.order, h.phase_rad, {h.speeds_rpm, h.amplitudes_rpm}};
    for (double& x : harmonic.amplitude.x) x *= rad_s;
    for (double& y : harmonic.amplitude.y) y *= rad_s * driver.ripple_scale;
    out.push_back(std::move(harmonic));
  }
  return out;
}

}  // namespace beltlife
