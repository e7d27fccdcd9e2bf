// Owns a number with its confidence interval, as answers state it.
#pragma once

#include "results/answer/answer_shape.h"

namespace beltlife {

/// Ends are not known where there is no interval.
struct Estimate {
  double value = not_known, low = not_known, high = not_known;

  double width() const { return high - low; }

  template <class V>
  void visit(V& v) {
    v("value", value, unit_of_its_name, "estimate");
    v("low", low, unit_of_its_name, "lower end of its confidence interval");
    v("high", high, unit_of_its_name, "upper end of its confidence interval");
  }
};

/// An interval alone.
struct Interval {
  double low = not_known, high = not_known;

  template <class V>
  void visit(V& v) {
    v("low", low, unit_of_its_name, "lower end");
    v("high", high, unit_of_its_name, "upper end");
  }
};

}  // namespace beltlife
