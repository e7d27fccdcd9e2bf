// Owns the distances of pulleys and belt from where they may not be.
#pragma once

#include "optimize/layout/layout_spec.h"
#include "sim/route/route.h"

namespace beltlife {

/// Signed distances of one keep-out, m: negative inside, by how deep. Its margin is taken off.
class KeepOutDistance {
 public:
  explicit KeepOutDistance(const KeepOutSpec& spec);
  double of(const Circle& circle) const;
  double of(const Span& span) const;

 private:
  double of_point(Vec2 p) const;

  std::vector<Vec2> corners_;  ///< a round keep-out has one, its centre
  double grown_ = 0;           ///< by radius and margin
};

}  // namespace beltlife
