// Owns the account of a search: budget, memo of what was asked, history in the order of asking.
#pragma once

#include <map>

#include "optimize/search/search_problem.h"

namespace beltlife {

/// What the algorithms call a design. Drivers, to whom a Point is another thing, do not include this.
using Point = Design;

/// All algorithms ask through it, so none can overspend, leave the cube or pay twice for a point.
class SearchLedger {
 public:
  /// `problem` must outlive the ledger.
  SearchLedger(const SearchProblem& problem, int budget, int batch);

  /// Evaluates what is new among `points`, in batches, as far as the budget goes. Coordinates are cut to [0, 1].
  void ask(const std::vector<Point>& points);
  /// The answer at x, evaluated if it is new; nullptr if it is new and the budget is spent. Valid until the next ask.
  const Trial* ask(const Point& x);
  /// The answer at x if it was asked before.
  const Trial* known(const Point& x) const;

  /// Free and finite; empty if the problem has none.
  std::vector<double> geometry(const Point& x) const;
  bool geometry_feasible(const Point& x) const { return shortfall(geometry(x)) == 0; }

  int left() const { return budget_ - static_cast<int>(history_.size()); }
  int batch() const { return batch_; }
  const SearchProblem& problem() const { return problem_; }
  const std::vector<Trial>& history() const { return history_; }

  /// Indices into history, from `first` on, best first; equals in the order of asking.
  std::vector<std::size_t> ranked(std::size_t first = 0) const;

 private:
  const SearchProblem& problem_;
  int budget_, batch_;
  std::vector<Trial> history_;
  std::map<Point, std::size_t> memo_;
};

/// x with every coordinate cut to [0, 1].
Point in_cube(Point x);

/// Euclidean distance.
double distance(const Point& a, const Point& b);

}  // namespace beltlife
