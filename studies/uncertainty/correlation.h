// Owns which parameters scatter together: what a study file says of it, and whether that can hold.
#pragma once

#include <string>
#include <vector>

#include "sim/eval/study_input.h"
#include "studies/sample.h"

namespace beltlife {

struct CorrelationSpec {
  std::vector<std::string> between;
  double value = 0;

  template <class V>
  void visit(V& v) {
    v("between", between, required_text, "paths of two parameters");
    v("value", value, required(within(-1, 1)),
      "correlation of the normal scores behind them (normal copula); of two normal parameters their own");
  }
};

/// The correlations as rows of a matrix over the parameters; empty where none is stated. What is wrong with them goes
/// to `log`.
Rows correlation_of(const std::vector<CorrelationSpec>& stated, const std::vector<std::string>& parameters,
                    ReadLog& log);

}  // namespace beltlife
