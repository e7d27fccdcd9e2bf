// Generalised symmetric eigenproblem of the linearised drive, and travelling strings: see modes.h.
#include "sim/modes/modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/modes/linear_drive.h"

namespace beltlife {
namespace {

constexpr double resonant = std::numbers::sqrt2 / 2;  // an oscillator damped more has no peak at any frequency

// A row's share is Re conj(x_i) (M x)_i; `x` real or complex, at any scale.
template <class Vector>
EnergyShares energy_of(const Model& m, const LinearDrive& d, const Vector& x) {
  const Eigen::VectorXd all = x.conjugate().cwiseProduct(d.mass * x).real();
  const Eigen::VectorXd share = all / all.sum();
  EnergyShares energy{std::vector<double>(m.bodies, 0.0), 0, share.tail(share.size() - d.belt_row).sum()};
  for (int b = 0; b < m.bodies; ++b)
    if (const int row = d.body_row[b]; row >= 0) energy.body[b] = share[row];
  if (d.arm_row >= 0) energy.arm = share[d.arm_row];
  return energy;
}

Mode mode_of(const Model& m, const OperatingPoint& loop, const LinearDrive& d, double omega2,
             const Eigen::VectorXd& x) {
  Mode mode{std::sqrt(std::max(omega2, 0.0)) / (2 * std::numbers::pi), {}, 0, energy_of(m, d, x)};
  mode.body_shape.assign(m.bodies, 0.0);
  double largest = 0;
  const auto note = [&](double shape) {
    if (std::abs(shape) > std::abs(largest)) largest = shape;
    return shape;
  };
  for (int b = 0; b < m.bodies; ++b)
    if (const int row = d.body_row[b]; row >= 0) mode.body_shape[b] = note(m.sense[b] * x[row] / m.speed_ratio[b]);
  if (d.arm_row >= 0) {
    const Circle& c = loop.route.circles[m.tensioner.pulley];
    mode.arm_shape = note(x[d.arm_row] * std::hypot(c.x - m.tensioner.pivot_x, c.y - m.tensioner.pivot_y));
  }
  if (largest != 0) {
    for (double& shape : mode.body_shape) shape /= largest;
    mode.arm_shape /= largest;
  }
  return mode;
}

// In the basis x of the lowest undamped modes (unit modal mass, frequencies W), for z = (W q, q'):
// z' = [0 W; -W -x^T C x] z.
std::vector<DampedMode> damped_modes(const Model& m, const LinearDrive& d, const Eigen::VectorXd& omega2,
                                     const Eigen::MatrixXd& x, double highest_hz) {
  const Eigen::Index n = omega2.size();
  const Eigen::VectorXd omega = omega2.cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n) = omega.asDiagonal();
  a.bottomLeftCorner(n, n) = (-omega).asDiagonal();
  a.bottomRightCorner(n, n) = -x.transpose() * d.damping * x;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  std::vector<DampedMode> modes;
  if (solver.info() != Eigen::Success) return modes;
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    const std::complex<double> s = solver.eigenvalues()[k];
    const double hz = s.imag() / (2 * std::numbers::pi);
    const double ratio = -s.real() / std::abs(s);
    if (hz < 0.1 || hz > highest_hz || ratio > resonant) continue;
    const Eigen::VectorXcd velocity = x * solver.eigenvectors().col(k).tail(n);
    modes.push_back({hz, ratio, energy_of(m, d, velocity)});
  }
  std::sort(modes.begin(), modes.end(), [](const auto& p, const auto& q) { return p.frequency_hz < q.frequency_hz; });
  return modes;
}

ArmModes rotational(const Model& m, const OperatingPoint& loop, ArmState arm, const ModesOptions& options) {
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
  modes.damped =
      damped_modes(m, d, solver.eigenvalues().head(basis), solver.eigenvectors().leftCols(basis), options.highest_hz);
  return modes;
}

SpanModes string_modes(const Model& m, const OperatingPoint& loop, std::size_t k) {
  SpanModes s;
  s.name = span_name(m.scene, k);
  s.length = loop.route.spans[k].length;
  s.tension = loop.tension[k];
  const double stretch = 1 + s.tension / m.belt.axial_stiffness, mass = m.scene.belt.mass_kg_per_m / stretch;
  s.wave_speed = std::sqrt(std::max(s.tension, 0.0) / mass);
  const double c = s.wave_speed, v = loop.belt_speed * stretch;
  if (c > v)
    for (int n = 1; n <= 2; ++n) s.frequency_hz[n - 1] = n * (c * c - v * v) / (2 * s.length * c);
  return s;
}

}  // namespace

Modes solve_modes(const Model& m, const RangeSpec& range, const ModesOptions& options) {
  require_condition(m, range.condition);
  Modes modes{range, {}, {}, {}};
  if (m.pulleys == 0) return modes;
  modes.loop = operating_point(m, range.crank_rpm);
  for (const ArmState arm : arm_states(m)) modes.arms.push_back(rotational(m, modes.loop, arm, options));
  for (std::size_t k = 0; k < modes.loop.route.spans.size(); ++k) modes.spans.push_back(string_modes(m, modes.loop, k));
  return modes;
}

std::string describe(const Model& m, const EnergyShares& energy) {
  std::vector<std::pair<double, std::string>> shares;
  for (int b = 0; b < m.bodies; ++b) shares.emplace_back(energy.body[b], m.body_name[b]);
  shares.emplace_back(energy.arm, "tensioner arm");
  shares.emplace_back(energy.belt, "belt");
  std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(shares.size(), 3) && shares[i].first >= 0.1; ++i)
    text += fmt::format("{}{} {:.0f} %", i ? ", " : "", shares[i].second, 100 * shares[i].first);
  return text;
}

}  // namespace beltlife
