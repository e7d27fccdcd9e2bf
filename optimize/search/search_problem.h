// Owns the language of a search: what is varied, what is free to know, what costs a simulation, what came of it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace beltlife {

/// One number a variable, each in [0, 1]. (A Point, to drivers, is what their models are asked: sim/eval/point.h.)
using Design = std::vector<double>;

/// What one evaluation said. Values are finite if ok.
struct Trial {
  Design x;
  bool ok = false;                  ///< simulated to its end; else the rest but `geometry` says nothing
  double objective = 0;             ///< to be minimised
  std::vector<double> constraints;  ///< satisfied where >= 0, each scaled so that 1 is a lot
  std::vector<double> geometry;     ///< likewise, known without simulating

  /// Simulated, and no constraint of either kind is violated.
  bool feasible() const;
  /// Sum of what is missing of all constraints; 0 if none is violated. Geometry only, unless ok.
  double violation() const;
};

/// A bounded minimisation with constraints of two kinds. All x are in the unit cube that the driver scales.
struct SearchProblem {
  std::size_t variables = 0;
  Design start;  ///< may be infeasible
  std::size_t constraints = 0, geometry_constraints = 0;
  /// Free: the signed distances of a layout. May be empty: no geometry.
  std::function<std::vector<double>(const Design& x)> geometry;
  /// Costs one simulation a point; batches run in parallel. Answers in order; stops by an exception of its own.
  std::function<std::vector<Trial>(const std::vector<Design>& points)> evaluate;
};

struct SearchResult {
  std::vector<Trial> history;  ///< every evaluation, in the order of asking
  std::string ended;           ///< why the search ended, in words
};

/// Sum of what is missing where `values` should be >= 0.
double shortfall(const std::vector<double>& values);

/// One finite number that orders all trials, the smaller the better: the feasible by objective, then the simulated by
/// violation, then the failed. It grows with the objective, but is not in its unit.
double rank_value(const Trial& trial);

/// The incumbent: the feasible trial of least objective (the first of equals); nullptr if none is feasible.
const Trial* best_of(const std::vector<Trial>& history);

}  // namespace beltlife
