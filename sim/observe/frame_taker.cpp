// Frames of the moving drive: see frame_taker.h.
#include "sim/observe/frame_taker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace beltlife {
namespace {

constexpr double revolutions = 2;         // of the driven body
constexpr double without_driver_s = 0.1;  // covered where nothing drives at a known speed

/// When the last revolutions of the window begin, s; the window's begin if it has fewer.
double begin_of(const Window& w, const SpeedProfile& profile) {
  const double angle = profile.at(w.end_s).angle - revolutions * 2 * std::numbers::pi;
  double before = w.begin_s, after = w.end_s;
  if (profile.at(before).angle >= angle) return before;
  for (int i = 0; i < 50; ++i) {  // the angle never falls
    const double middle = 0.5 * (before + after);
    (profile.at(middle).angle < angle ? before : after) = middle;
  }
  return after;
}

double rounded(double value, double step) { return std::round(value / step) * step; }

void add(std::vector<double>& to, const double* values, std::size_t count, double step) {
  for (std::size_t i = 0; i < count; ++i) to.push_back(rounded(values[i], step));
}

}  // namespace

void FrameTaker::open(const Window& w, const SpeedProfile& profile, Frames& frames) {
  if (count_ <= 0) return;
  end_s_ = w.end_s;
  begin_s_ = model_.driver.body >= 0 ? begin_of(w, profile) : std::max(w.begin_s, w.end_s - without_driver_s);
  next_ = 0;
  const auto count = static_cast<std::size_t>(count_);
  frames.time_s.reserve(count);
  for (auto* v : {&frames.x_m, &frames.y_m, &frames.tension_n})
    v->reserve(count * static_cast<std::size_t>(model_.belt.nodes));
  for (auto* v : {&frames.pulley_angle_rad, &frames.pulley_x_m, &frames.pulley_y_m})
    v->reserve(count * static_cast<std::size_t>(model_.pulleys));
}

double FrameTaker::due() const {
  if (next_ >= count_) return std::numeric_limits<double>::infinity();
  return end_s_ - (end_s_ - begin_s_) * (count_ - 1 - next_) / std::max(1, count_ - 1);
}

void FrameTaker::observe(const DriveView& s, Frames& frames) {
  const double now = s.time() + 0.5 * s.step();
  if (now < due()) return;
  while (now >= due()) ++next_;  // two may fall due between observations: one frame is all there is to see
  const Coordinates& q = s.state().q;
  frames.time_s.push_back(s.time());
  add(frames.x_m, q.x.data(), q.x.size(), Frames::position_step);
  add(frames.y_m, q.y.data(), q.y.size(), Frames::position_step);
  add(frames.tension_n, s.work().tension.data(), q.x.size(), Frames::tension_step);
  for (int p = 0; p < model_.pulleys; ++p) {
    const Centre centre = pulley_centre(model_, q, p);
    frames.pulley_angle_rad.push_back(rounded(q.angle[static_cast<std::size_t>(p)], Frames::angle_step));
    frames.pulley_x_m.push_back(rounded(centre.x, Frames::position_step));
    frames.pulley_y_m.push_back(rounded(centre.y, Frames::position_step));
  }
}

}  // namespace beltlife
