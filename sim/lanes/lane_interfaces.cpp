// Coupled interfaces of the lanes: see lane_interfaces.h. Rarely needed, so written plainly.
#include "sim/lanes/lane_interfaces.h"

#include <Eigen/Dense>

namespace beltlife {
namespace {

using Block = Eigen::Matrix4d;

Block own(const LaneNumber (&block)[10], int k) {
  Block b;
  for (int s = 0, at = 0; s < 4; ++s)
    for (int t = s; t < 4; ++t) b(s, t) = b(t, s) = block[at++][k];
  return b;
}

Block to_left(const LaneNumber (&first)[8], const LaneNumber (&second)[8], int k) {
  Block b;
  for (int t = 0; t < 4; ++t) {
    b(0, t) = first[t][k];
    b(1, t) = first[4 + t][k];
    b(2, t) = second[t][k];
    b(3, t) = second[4 + t][k];
  }
  return b;
}

}  // namespace

void solve_coupled_interfaces(LaneUse use, const LaneNumber (&block)[10], const LaneNumber (&first)[8],
                              const LaneNumber (&second)[8], LaneNumber (&x)[4]) {
  if (use == LaneUse::drives) {
    for (int k = 0; k < lanes; ++k) {
      const Block g = to_left(first, second, k);
      const Eigen::Vector4d rhs(x[0][k], x[1][k], x[2][k], x[3][k]);
      const Block all = own(block, k) + g + g.transpose();
      const Eigen::Vector4d solved = all.ldlt().solve(rhs);
      for (int s = 0; s < 4; ++s) x[s][k] = solved[s];
    }
    return;
  }
  constexpr int size = 4 * lanes;
  Eigen::Matrix<double, size, size> all = Eigen::Matrix<double, size, size>::Zero();
  Eigen::Matrix<double, size, 1> rhs;
  for (int k = 0; k < lanes; ++k) {
    const int left = (k + lanes - 1) % lanes;
    const Block g = to_left(first, second, k);
    all.block<4, 4>(4 * k, 4 * k) += own(block, k);
    all.block<4, 4>(4 * k, 4 * left) += g;
    all.block<4, 4>(4 * left, 4 * k) += g.transpose();
    for (int s = 0; s < 4; ++s) rhs[4 * k + s] = x[s][k];
  }
  const Eigen::Matrix<double, size, 1> solved = all.ldlt().solve(rhs);
  for (int k = 0; k < lanes; ++k)
    for (int s = 0; s < 4; ++s) x[s][k] = solved[4 * k + s];
}

}  // namespace beltlife
