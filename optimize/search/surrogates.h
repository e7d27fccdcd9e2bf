// Owns what a surrogate search believes: processes of objective, constraints and failure around a centre.
#pragma once

#include <optional>

#include "optimize/search/kriging.h"
#include "optimize/search/search_ledger.h"

namespace beltlife {

/// How a bound is drawn: mean minus `bold` deviations of the objective; mean minus `careful` of each constraint.
struct Boldness {
  double bold = 0, careful = 0;
};

class Surrogates {
 public:
  /// Fits to the trials nearest to `centre`; `shapes` holds the last fits' shapes and is brought up to date. Needs one
  /// trial that is ok.
  Surrogates(const SearchLedger& ledger, const Point& centre, std::vector<KrigingShape>& shapes);

  /// Number of values that `constraints` gives.
  std::size_t constraint_count() const { return constraints_.size(); }
  /// Lower confidence bound in units of the objective's spread near the centre.
  double objective(const Point& x, Boldness boldness) const;
  /// Feasible where >= 0; the last one is about failure if trials failed.
  std::vector<double> constraints(const Point& x, Boldness boldness) const;
  /// Takes the means at x for true.
  void believe(const Point& x);

 private:
  std::optional<Kriging> objective_;
  std::vector<Kriging> constraints_;
  std::size_t failure_ = 0;  ///< 1 if the last constraint is about failure
};

}  // namespace beltlife
