// Owns the coordinates in which a fit works: logarithms or scaled values, their bounds, steps that stay inside.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sim/eval/point.h"
#include "sim/eval/problem_spec.h"

namespace beltlife {

/// One parameter p as the fit's u: ln p, or p over a scale of its own (the width between its bounds, else its start).
class Coordinate {
 public:
  explicit Coordinate(const ParameterSpec& p)
      : log_(p.log),
        lower_(p.lower.value_or(-infinity)),
        upper_(p.upper.value_or(infinity)),
        start_(p.start.value_or(0)) {
    if (log_) return;
    if (p.lower && p.upper)
      scale_ = *p.upper - *p.lower;
    else if (start_ != 0)
      scale_ = std::abs(start_);
  }

  double at(double p) const { return log_ ? std::log(p) : p / scale_; }
  /// Never outside the bounds, whatever rounding does.
  double value(double u) const { return std::clamp(log_ ? std::exp(u) : u * scale_, lower_, upper_); }
  double start() const { return at(start_); }
  double lower() const { return lower_ == -infinity ? -infinity : at(lower_); }
  double upper() const { return upper_ == infinity ? infinity : at(upper_); }
  /// Between the bounds, in u; infinite without them.
  double width() const { return upper() - lower(); }
  bool bounded() const { return std::isfinite(width()); }
  /// dp/du
  double slope(double u) const { return log_ ? std::exp(u) : scale_; }
  bool log() const { return log_; }

  /// A step of relative size `h` at u; of a value near 0 relative to a third of its scale. Fits between the bounds.
  double step(double u, double h) const { return std::min(log_ ? h : h * std::max(std::abs(u), 0.3), 0.25 * width()); }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  bool log_;
  double lower_, upper_, start_, scale_ = 1;
};

inline std::vector<Coordinate> coordinates_of(const std::vector<ParameterSpec>& parameters) {
  return {parameters.begin(), parameters.end()};
}

inline Point point_at(const std::vector<Coordinate>& c, const std::vector<double>& u) {
  Point p;
  for (std::size_t i = 0; i < c.size(); ++i) p.emplace_back(c[i].value(u[i]));
  return p;
}

}  // namespace beltlife
