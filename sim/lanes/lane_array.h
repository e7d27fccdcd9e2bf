// Owns the storage of per-node numbers in eight lanes, and how loops over the lanes are written.
//
// A row holds one number of each lane. The lanes are either eight arcs of one belt or eight drives; loops over the
// lanes are plain loops of length eight without dependence between them, which the compiler turns into the vector
// instructions of whatever machine it compiles for. No sum crosses lanes inside them, so the bits are the same on all.
#pragma once

#include <vector>

#include "sim/node_array.h"

// NOLINTNEXTLINE(bugprone-macro-parentheses): the argument is declared
#define BELTLIFE_EACH_LANE(k) _Pragma("GCC ivdep") _Pragma("GCC unroll 1") for (int k = 0; k < ::beltlife::lanes; ++k)

namespace beltlife {

inline constexpr int lanes = 8;

/// One number a lane.
struct alignas(64) LaneNumber {
  double of[lanes] = {};
  double& operator[](int k) { return of[k]; }
  double operator[](int k) const { return of[k]; }
};

/// Rows 0 .. rows-1 of eight numbers, with two ghost rows at either end.
class LaneArray {
 public:
  static constexpr int ghosts = 2;

  LaneArray() = default;
  explicit LaneArray(int rows) : rows_(rows), values_(static_cast<std::size_t>(rows + 2 * ghosts) * lanes, 0.0) {}

  int rows() const { return rows_; }
  double* data() { return values_.data() + ghosts * lanes; }
  const double* data() const { return values_.data() + ghosts * lanes; }
  double* row(int j) { return data() + j * lanes; }
  const double* row(int j) const { return data() + j * lanes; }

 private:
  int rows_ = 0;
  std::vector<double, AlignedAllocator<double>> values_;
};

}  // namespace beltlife
