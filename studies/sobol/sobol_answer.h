// Owns what a study of kind sobol answers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "results/answer/estimate.h"

namespace beltlife {

/// A share of a variance, with its confidence interval.
struct Share : Estimate {
  template <class V>
  void visit(V& v) {
    v("value", value, "", "share of the variance");
    v("low", low, "", "lower end of its confidence interval");
    v("high", high, "", "upper end of its confidence interval");
  }
};

struct QuantityShares {
  std::map<std::string, Share> first, total;
  Share sum_first;
  double mean = not_known, variance = not_known;
  bool converged = false;
  double widest_interval = not_known;
  std::string widest_parameter;
  double samples_needed = not_known;

  template <class V>
  void visit(V& v) {
    v("first", first, "", "first-order index by parameter: alone, whatever the others are");
    v("total", total, "", "total index by parameter: also what it does together with others");
    v("sum_first", sum_first, "", "sum of the first-order indices");
    v("mean", mean, unit_of_its_name, "of the quantity");
    v("variance", variance, unit_of_its_name, "of the quantity, in its unit squared");
    v("converged", converged, "", "whether no interval of a total index is wider than asked for");
    v("widest_interval", widest_interval, "", "width of the widest interval of a total index");
    v("widest_parameter", widest_parameter, "", "whose interval that is");
    v("samples_needed", samples_needed, "", "base rows with which it would be as narrow as asked for");
  }
};

struct SobolAnswer : DriverAnswer {
  std::vector<std::string> parameters;
  double confidence = not_known, convergence_width = not_known;
  std::int64_t rows = 0, rows_used = 0;
  std::map<std::string, QuantityShares> quantities;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, "", "paths, in the file's order");
    v("confidence", confidence, "", "of the intervals");
    v("convergence_width", convergence_width, "", "width that was asked for");
    v("rows", rows, "", "base rows");
    v("rows_used", rows_used, "", "of them without a failed point");
    v("quantities", quantities, "", "shares by quantity");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
