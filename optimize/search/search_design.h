// Owns the points that a search lays out before it knows anything: low-discrepancy, screened by free geometry.
#pragma once

#include <cstdint>

#include "optimize/search/search_ledger.h"

namespace beltlife {

/// A random sequence of its own (SplitMix64): the same bits on every machine.
class SearchRandom {
 public:
  explicit SearchRandom(std::int64_t seed) : state_(static_cast<std::uint64_t>(seed)) {}
  std::uint64_t bits();
  double uniform();  ///< in [0, 1)

 private:
  std::uint64_t state_;
};

/// Halton's sequence with every base's digits permuted at random, which breaks the bands that its higher dimensions
/// show at first. Any number of variables.
class HaltonSequence {
 public:
  HaltonSequence(std::size_t variables, std::int64_t seed);
  Point next();

 private:
  std::vector<unsigned> bases_;
  std::vector<std::vector<unsigned>> digits_;  ///< permutation of each base's digits
  std::vector<double> shift_;
  std::uint64_t index_ = 0;
};

/// The nearest point to x of feasible geometry that a free local search finds; where it finds none, the least
/// violating.
Point repaired(const SearchLedger& ledger, const Point& x);

/// `count` distinct points, as far as possible of feasible geometry: of a few thousand laid out those that are
/// feasible, then the least violating ones repaired. Costs no simulation.
std::vector<Point> screened(const SearchLedger& ledger, HaltonSequence& sequence, std::size_t count);

}  // namespace beltlife
