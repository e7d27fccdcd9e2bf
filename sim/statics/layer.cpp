// Boundary layer of a pass: see layer.h, and README.md for the equations.
#include "sim/statics/layer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace beltlife {
namespace {

constexpr double root3_half = 0.86602540378443864676;

// Curvature k - k''' = load of a unit load at 0, and its derivatives: one growing root upstream, two decaying
// downstream.
struct Response {
  double k = 0, first = 0, second = 0;
};

Response response(double t) {
  if (t < 0) {
    const double e = std::exp(t) / 3;
    return {e, e, e};
  }
  const double e = std::exp(-0.5 * t) / 3, c = std::cos(root3_half * t), s = std::sin(root3_half * t);
  return {e * (c + 2 * root3_half * s), e * (c - 2 * root3_half * s), -2 * e * c};
}

// Height of the belt above its entering line, and slope, under a unit load at 0: twice the integral of -k.
double height(double t) { return -response(t).first - std::max(t, 0.0); }
double slope(double t) { return -response(t).second - (t >= 0 ? 1 : 0); }

}  // namespace

PassLayer pass_layer(double softness, double arc) {
  // A longer arc only adds uniform pressure between its two layers; a shorter one is a kink under a point load.
  constexpr double longest = 8, margin = 1.5;
  const double b = std::clamp(arc, 0.1, longest), begin = -0.5 * b - margin, step = b < 1 ? 0.05 : 0.1;
  const int m = static_cast<int>((b + 2 * margin) / step) + 1;
  const auto at = [&](int i) { return begin + i * step; };

  // Penetration and its rate at node i are linear in the pressures and the entering line's height a0.
  std::vector<double> heights(2 * m - 1);
  for (int i = 0; i < 2 * m - 1; ++i) heights[i] = height((i - m + 1) * step);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(m);
  double a0 = 0.125 * b * b;
  for (int i = 0; i < m; ++i) p[i] = std::abs(at(i)) < 0.5 * b ? 1 : 0;
  Eigen::MatrixXd jacobian(m + 1, m + 1);
  Eigen::VectorXd residual(m + 1), depth(m);
  const auto evaluate = [&] {
    for (int i = 0; i < m; ++i) {
      double z = a0 + 0.5 * b * at(i);
      for (int j = 0; j < m; ++j) z += step * p[j] * heights[i - j + m - 1];
      depth[i] = (-0.5 * at(i) * at(i) - z) / softness;
    }
  };
  std::vector<int> state(m, -1);
  bool converged = false;
  for (int iteration = 0; iteration < 60 && !converged; ++iteration) {
    evaluate();
    bool changed = false;
    for (int i = 0; i < m; ++i) {
      const int now = depth[i] > 0;
      changed = changed || now != state[i];
      state[i] = now;
      for (int j = 0; j < m; ++j) jacobian(i, j) = (i == j) + (now ? step / softness * heights[i - j + m - 1] : 0);
      jacobian(i, m) = now ? 1 / softness : 0;
      residual[i] = p[i] - (now ? depth[i] : 0);
    }
    jacobian.row(m).setConstant(step);
    jacobian(m, m) = 0;
    residual[m] = step * p.sum() - b;
    if (!changed && residual.cwiseAbs().maxCoeff() < 1e-8) {
      converged = true;
      break;
    }
    const Eigen::VectorXd change = jacobian.partialPivLu().solve(residual);
    if (!change.allFinite()) break;
    const double share = iteration < 15 ? 1 : 0.5;  // the sets of nodes may flip to and fro
    p -= share * change.head(m);
    a0 -= share * change[m];
  }
  PassLayer layer;
  layer.converged = converged;
  if (!converged) return layer;

  double moment = 0;
  layer.peak = p.maxCoeff();
  for (int i = 0; i < m; ++i) moment += step * p[i] * at(i);
  layer.offset_in = a0 - 0.125 * b * b;
  layer.offset_out = layer.offset_in + moment;

  // Length: half the squared slope, over the arc and so far beside it that the layers have died out.
  const int before = 120, after = 240;
  double length = 0;
  for (int i = -before; i < m + after; ++i) {
    double dz = 0.5 * b;
    for (int j = 0; j < m; ++j)
      if (p[j] > 0) dz += step * p[j] * slope((i - j) * step);
    length += 0.5 * step * (dz * dz - 0.25 * b * b);
  }
  layer.excess = length + 0.5 * b * (layer.offset_in + layer.offset_out) + b * b * b / 12 + softness * b;
  return layer;
}

}  // namespace beltlife
