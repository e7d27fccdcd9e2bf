// Owns what a study of kind uncertainty answers.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "results/answer/estimate.h"

namespace beltlife {

/// A life with its interval.
struct LifeEstimate : Estimate {
  template <class V>
  void visit(V& v) {
    v("value", value, "h", "life");
    v("low", low, "h", "lower end of its confidence interval; null: too few points for one");
    v("high", high, "h", "upper end of its confidence interval; null: too few points for one");
  }
};

/// The chance that a life falls short of what is asked for.
struct MissedTarget : Estimate {
  double if_failed_hold = not_known, if_failed_miss = not_known;

  template <class V>
  void visit(V& v) {
    v("value", value, "", "share of the points that are ok and live less than the target");
    v("low", low, "", "lower end of its confidence interval (Wilson)");
    v("high", high, "", "upper end of its confidence interval (Wilson)");
    v("if_failed_hold", if_failed_hold, "", "the share if every point that failed held the target");
    v("if_failed_miss", if_failed_miss, "", "the share if every point that failed missed it");
  }
};

struct QuantityScatter {
  double mean = not_known, standard_deviation = not_known, standard_error = not_known;
  std::map<std::string, double> percentiles;
  std::map<std::string, Interval> percentile_intervals;
  std::optional<std::map<std::string, Interval>> percentiles_by_failures;
  std::optional<LifeEstimate> b10_life_h;
  std::optional<MissedTarget> missing_target;

  template <class V>
  void visit(V& v) {
    v("mean", mean, unit_of_its_name, "of the points that are ok");
    v("standard_deviation", standard_deviation, unit_of_its_name, "of one of them");
    v("standard_error", standard_error, unit_of_its_name, "of the mean, for independent points");
    v("percentiles", percentiles, unit_of_its_name, "by percentage");
    v("percentile_intervals", percentile_intervals, "", "their confidence intervals by order statistics");
    v("percentiles_by_failures", percentiles_by_failures, "",
      "where they would be if all points that failed lay below, or above, the rest; absent if none failed");
    v("b10_life_h", b10_life_h, "", "life that nine of ten exceed; absent of what is no life");
    v("missing_target", missing_target, "", "chance to miss the target; absent without one");
  }
};

struct UncertaintyAnswer : DriverAnswer {
  std::int64_t samples = 0;
  double confidence = not_known, failed_share = not_known;
  std::optional<double> target_life_h;
  std::map<std::string, QuantityScatter> quantities;

  template <class V>
  void visit(V& v) {
    v("samples", samples, "", "points");
    v("confidence", confidence, "", "of the intervals");
    v("failed_share", failed_share, "", "share of the points that are not ok");
    v("target_life_h", target_life_h, "h", "life that is asked for; absent if none is");
    v("quantities", quantities, "", "scatter by quantity");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
