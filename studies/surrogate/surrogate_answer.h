// Owns what a study of kind surrogate answers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// The nominal point, which the surrogate was not fitted to.
struct NominalPoint {
  double predicted = not_known, simulated = not_known;

  template <class V>
  void visit(V& v) {
    v("predicted", predicted, unit_of_its_name, "by the surrogate");
    v("simulated", simulated, unit_of_its_name, "by the simulator; null if that point failed");
  }
};

struct QuantitySurrogate {
  double q2 = not_known;
  bool usable = false;
  std::int64_t terms = 0;
  std::map<std::string, double> first, total;
  NominalPoint nominal;

  template <class V>
  void visit(V& v) {
    v("q2", q2, "", "share of the variance that is predicted at points left out in turn; null where nothing varies");
    v("usable", usable, "", "whether that is at least 0.9");
    v("terms", terms, "", "coefficients that were fitted");
    v("first", first, "", "first-order index by parameter, of the surrogate");
    v("total", total, "", "total index by parameter, of the surrogate");
    v("nominal", nominal, "", "the nominal point");
  }
};

struct SurrogateAnswer : DriverAnswer {
  std::vector<std::string> parameters;
  std::string method;
  std::int64_t samples = 0, samples_used = 0;
  std::map<std::string, QuantitySurrogate> quantities;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, "", "paths, in the file's order");
    v("method", method, "", "chaos or kriging");
    v("samples", samples, "", "points to fit to");
    v("samples_used", samples_used, "", "of them ok");
    v("quantities", quantities, "", "surrogate by quantity");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
