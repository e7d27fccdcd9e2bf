// Generalised symmetric eigenproblem of the linearised drive, and travelling strings: see modes.h.
#include "sim/modes/modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace beltlife {
namespace {

// `x` is scaled to unit modal mass. A row's share of the kinetic energy is x_i (M x)_i; they sum to 1.
Mode mode_of(const Model& m, const LoopEstimate& loop, const LinearDrive& d, double omega2, const Eigen::VectorXd& x) {
  Mode mode;
  const double omega = std::sqrt(std::max(omega2, 0.0));
  mode.frequency_hz = omega / (2 * std::numbers::pi);
  // Rounding leaves some 1e-5 of the largest frequency where exact arithmetic leaves none.
  mode.damping_ratio = mode.frequency_hz > 0.01 ? x.dot(d.damping * x) / (2 * omega) : std::nan("");
  const Eigen::VectorXd energy = x.cwiseProduct(d.mass * x);
  mode.body_shape.assign(m.bodies, 0.0);
  mode.body_energy.assign(m.bodies, 0.0);
  double largest = 0;
  const auto note = [&](double shape) {
    if (std::abs(shape) > std::abs(largest)) largest = shape;
    return shape;
  };
  for (int b = 0; b < m.bodies; ++b)
    if (const int row = d.body_row[b]; row >= 0) {
      mode.body_shape[b] = note(m.sense[b] * x[row] / m.speed_ratio[b]);
      mode.body_energy[b] = energy[row];
    }
  if (d.arm_row >= 0) {
    const Circle& c = loop.route.circles[m.tensioner.pulley];
    mode.arm_shape = note(x[d.arm_row] * std::hypot(c.x - m.tensioner.pivot_x, c.y - m.tensioner.pivot_y));
    mode.arm_energy = energy[d.arm_row];
  }
  mode.belt_energy = energy.tail(energy.size() - d.belt_row).sum();
  if (largest != 0) {
    for (double& shape : mode.body_shape) shape /= largest;
    mode.arm_shape /= largest;
  }
  return mode;
}

// In the basis of the lowest undamped modes (unit modal mass): z' = [0 1; -W^2 -X^T C X] z.
std::vector<DampedMode> damped_modes(const Eigen::VectorXd& omega2, const Eigen::MatrixXd& damping, double highest_hz) {
  const Eigen::Index n = omega2.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = (-omega2).asDiagonal();
  a.bottomRightCorner(n, n) = -damping;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  std::vector<DampedMode> modes;
  if (solver.info() != Eigen::Success) return modes;
  for (const std::complex<double>& s : solver.eigenvalues()) {
    const double hz = s.imag() / (2 * std::numbers::pi);
    if (hz > 0.1 && hz <= highest_hz) modes.push_back({hz, -s.real() / std::abs(s)});
  }
  std::sort(modes.begin(), modes.end(), [](const auto& x, const auto& y) { return x.frequency_hz < y.frequency_hz; });
  return modes;
}

ArmModes rotational(const Model& m, const LoopEstimate& loop, ArmState arm, const ModesOptions& options) {
  const LinearDrive d = linearise(m, loop, arm, options.linear);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(d.stiffness, d.mass);
  ArmModes modes{arm, {}, {}};
  if (solver.info() != Eigen::Success) return modes;
  for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
    Mode mode = mode_of(m, loop, d, solver.eigenvalues()[k], solver.eigenvectors().col(k));
    if (mode.frequency_hz > options.highest_hz) break;
    modes.modes.push_back(std::move(mode));
  }
  const Eigen::Index basis = std::min<Eigen::Index>(options.damped_basis, solver.eigenvalues().size());
  if (basis > 0) {
    const auto x = solver.eigenvectors().leftCols(basis);
    modes.damped = damped_modes(solver.eigenvalues().head(basis), x.transpose() * d.damping * x, options.highest_hz);
  }
  return modes;
}

SpanModes string_modes(const Model& m, const LoopEstimate& loop, std::size_t k) {
  SpanModes s;
  s.name = span_name(m.scene, k);
  s.length = loop.route.spans[k].length;
  s.tension = loop.tension[k];
  const double mass = m.scene.belt.mass_kg_per_m / (1 + s.tension / m.belt.axial_stiffness);
  s.wave_speed = std::sqrt(std::max(s.tension, 0.0) / mass);
  const double c = s.wave_speed, v = loop.belt_speed;
  if (c > v)
    for (int n = 1; n <= 2; ++n) s.frequency_hz[n - 1] = n * (c * c - v * v) / (2 * s.length * c);
  return s;
}

}  // namespace

Modes solve_modes(const Model& m, const RangeSpec& range, const ModesOptions& options) {
  Modes modes{range, {}, {}, {}};
  if (m.pulleys == 0) return modes;
  modes.loop = estimate_loop(m, range.crank_rpm);
  for (const ArmState arm : arm_states(m)) modes.arms.push_back(rotational(m, modes.loop, arm, options));
  for (std::size_t k = 0; k < modes.loop.route.spans.size(); ++k) modes.spans.push_back(string_modes(m, modes.loop, k));
  return modes;
}

std::string describe(const Model& m, const Mode& mode) {
  std::vector<std::pair<double, std::string>> shares;
  for (int b = 0; b < m.bodies; ++b) shares.emplace_back(mode.body_energy[b], m.body_name[b]);
  shares.emplace_back(mode.arm_energy, "tensioner arm");
  shares.emplace_back(mode.belt_energy, "belt");
  std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(shares.size(), 3) && shares[i].first >= 0.1; ++i)
    text += fmt::format("{}{} {:.0f} %", i ? ", " : "", shares[i].second, 100 * shares[i].first);
  return text;
}

}  // namespace beltlife
