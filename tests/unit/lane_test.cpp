// The lanes' kernels equal the plain ones, and the lanes' solve a dense one.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/lanes/lane_belt.h"
#include "sim/scene/scene_io.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

/// The baseline a few ms after a brisk start, in lanes: every contact and anchor at work.
class Moving {
 public:
  explicit Moving(std::vector<std::string> settings, LaneUse use = LaneUse::arcs, double step = 1e-20)
      : model_(compile(read_scene(BELTLIFE_SCENES "/baseline.toml", with_size(std::move(settings))).scene)),
        profile_({0, 0.005}, {0, 20}, harmonics_of(*model_.scene.driver)),
        simulator_(model_, profile_, Scheme::symplectic_euler, stable_step(model_, Scheme::symplectic_euler)) {
    while (simulator_.time() < 0.006) simulator_.advance();
    Coordinates& q = simulator_.state().q;
    lanes_ = make_lane_belt({&model_}, use, step);
    for (int k = 0; k < lanes; ++k)
      for (int j = 0; j < lanes_.rows; ++j) {
        const int i = use == LaneUse::arcs ? k * lanes_.rows + j : j;
        lanes_.x.row(j)[k] = q.x[i];
        lanes_.y.row(j)[k] = q.y[i];
        lanes_.vx.row(j)[k] = q.vx[i];
        lanes_.vy.row(j)[k] = q.vy[i];
        lanes_.anchor.row(j)[k] = simulator_.state().anchor[i];
      }
    fill_lane_ghosts(lanes_);
  }

  const Model& model() const { return model_; }
  Simulator& simulator() { return simulator_; }
  LaneBelt& in_lanes() { return lanes_; }
  double at(const LaneArray& a, int node) const {
    return lanes_.use == LaneUse::arcs ? a.row(node % lanes_.rows)[node / lanes_.rows] : a.row(node)[0];
  }

  /// Contact in the lanes with the pulleys that the plain search found, row by row.
  void contact() {
    const State& s = simulator_.state();
    std::vector<LaneNumber> speeds(model_.pulleys + 1), changes(model_.pulleys + 1);
    for (int p = 0; p < model_.pulleys; ++p)
      for (int k = 0; k < lanes; ++k) speeds[p][k] = s.q.speed[p];
    for (int j = 0; j < lanes_.rows; ++j) {
      ContactBlock& block = lanes_.blocks.emplace_back();
      block.begin = j;
      block.end = j + 1;
      LanePulleys& p = block.of;
      for (int k = 0; k < lanes; ++k) {
        const int near = s.near[lanes_.use == LaneUse::arcs ? k * lanes_.rows + j : j];
        p.radius[k] = -1;
        if (near < 0) continue;
        const Centre c = pulley_centre(model_, s.q, near);
        p.x[k] = c.x;
        p.y[k] = c.y;
        p.vx[k] = c.vx;
        p.vy[k] = c.vy;
        p.radius[k] = model_.pulley_radius[near];
        block.pulley[k] = near;
        p.anchor_limit[k] = model_.contact.anchor_share * model_.pulley_friction[near];
        p.velocity_limit[k] = (1 - model_.contact.anchor_share) * model_.pulley_friction[near];
      }
    }
    lane_contact(lanes_, speeds.data(), changes.data());
  }

 private:
  static std::vector<std::string> with_size(std::vector<std::string> settings) {
    settings.push_back("belt.elements=256");
    return settings;
  }
  Model model_;
  SpeedProfile profile_;
  Simulator simulator_;
  LaneBelt lanes_;
};

// With a step of 1e-20 s nothing of the implicit step is left, so the two differ by rounding alone.
void expect_same_forces(const std::vector<std::string>& settings) {
  for (const LaneUse use : {LaneUse::arcs, LaneUse::drives}) {
    Moving drive(settings, use);
    Simulator& s = drive.simulator();
    s.evaluate(s.state().q, {s.time(), 0, 0, false});
    lane_elements(drive.in_lanes());
    drive.contact();
    double largest = 0;
    for (int i = 0; i < drive.model().belt.nodes; ++i) largest = std::max(largest, std::abs(s.work().fx[i]));
    int touching = 0;
    for (int i = 0; i < drive.model().belt.nodes; ++i) {
      EXPECT_NEAR(drive.at(drive.in_lanes().fx, i), s.work().fx[i], 1e-11 * largest) << "node " << i;
      EXPECT_NEAR(drive.at(drive.in_lanes().fy, i), s.work().fy[i], 1e-11 * largest) << "node " << i;
      if (s.work().normal[i] <= 0) continue;
      ++touching;
      EXPECT_NEAR(drive.at(drive.in_lanes().normal, i), s.work().normal[i], 1e-11 * largest) << "node " << i;
      EXPECT_NEAR(drive.at(drive.in_lanes().tangential, i), s.work().tangential[i], 1e-11 * largest) << "node " << i;
    }
    EXPECT_GT(touching, 50);
  }
}

TEST(Lanes, ForcesOfTheBeltAreThoseOfThePlainKernels) { expect_same_forces({}); }
TEST(Lanes, ForcesWithBendingStiffnessAreThoseOfThePlainKernels) {
  expect_same_forces({"belt.bending_stiffness_n_m2=0.01"});
}
TEST(Lanes, ForcesWithoutBendingAreThoseOfThePlainKernels) { expect_same_forces({"belt.bending_damping_n_m2_s=0"}); }
TEST(Lanes, ForcesWithSeparationDampingAreThoseOfThePlainKernels) {
  expect_same_forces({"contact.separation_factor=0.5"});
}

// The step's matrix from its definition: a mass a node, an axial and a geometric spring an element, a bending damper a
// node between its two elements, a normal and a tangential spring a contact.
Eigen::VectorXd dense_solution(Moving& drive) {
  const LaneBelt& b = drive.in_lanes();
  const int n = drive.model().belt.nodes;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd rhs(2 * n);
  const auto direction = [&](int e) { return Eigen::Vector2d(drive.at(b.ux, e), drive.at(b.uy, e)); };
  const auto normal = [](Eigen::Vector2d u) { return Eigen::Vector2d(-u.y(), u.x()); };
  const auto add = [&](const Eigen::VectorXd& pattern, double factor) { a += factor * pattern * pattern.transpose(); };
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n, before = (i + n - 1) % n;
    a(2 * i, 2 * i) += b.mass[0];
    a(2 * i + 1, 2 * i + 1) += b.mass[0];
    Eigen::VectorXd stretch = Eigen::VectorXd::Zero(2 * n), turn = stretch, bend = stretch, press = stretch,
                    slide = stretch;
    stretch.segment<2>(2 * next) = direction(i);
    stretch.segment<2>(2 * i) = -direction(i);
    add(stretch, b.axial_tangent[0]);
    turn.segment<2>(2 * next) = normal(direction(i));
    turn.segment<2>(2 * i) = -normal(direction(i));
    add(turn, drive.at(b.geometric, i));
    const Eigen::Vector2d q = normal(direction(i)) * drive.at(b.inverse_length, i);
    const Eigen::Vector2d p = normal(direction(before)) * drive.at(b.inverse_length, before);
    bend.segment<2>(2 * next) += q;
    bend.segment<2>(2 * i) -= q + p;
    bend.segment<2>(2 * before) += p;
    add(bend, b.bend_tangent[0]);
    const Eigen::Vector2d out(drive.at(b.normal_x, i), drive.at(b.normal_y, i));
    press.segment<2>(2 * i) = out;
    add(press, drive.at(b.normal_tangent, i));
    slide.segment<2>(2 * i) = normal(out);
    add(slide, drive.at(b.tangential_tangent, i));
    rhs[2 * i] = b.step * drive.at(b.fx, i);
    rhs[2 * i + 1] = b.step * drive.at(b.fy, i);
  }
  return a.ldlt().solve(rhs);
}

double solve_error(const std::vector<std::string>& settings, LaneUse use, double step, bool whole_fill) {
  Moving drive(settings, use, step);
  LaneBelt& b = drive.in_lanes();
  if (whole_fill) std::fill(b.fill_rows, b.fill_rows + lanes, b.rows - 2);
  lane_elements(b);
  drive.contact();
  lane_solve(b);
  const Eigen::VectorXd wanted = dense_solution(drive);
  double error = 0;
  for (int i = 0; i < drive.model().belt.nodes; ++i) {
    error = std::max(error, std::abs(drive.at(b.dvx, i) - wanted[2 * i]));
    error = std::max(error, std::abs(drive.at(b.dvy, i) - wanted[2 * i + 1]));
  }
  return error / wanted.cwiseAbs().maxCoeff();
}

TEST(Lanes, SolveWithCoupledInterfacesIsExact) {
  for (const LaneUse use : {LaneUse::arcs, LaneUse::drives}) {
    EXPECT_LT(solve_error({}, use, 2e-5, true), 1e-10);
    EXPECT_LT(solve_error({"belt.bending_damping_n_m2_s=0"}, use, 2e-5, true), 1e-10);
    EXPECT_LT(solve_error({"belt.axial_damping_n_s=1000"}, use, 2e-5, true), 1e-9);
  }
}

// At 256 elements an arc has 32 rows and the left interface's part is cut where 1e-4 of it is left.
TEST(Lanes, SolveWithFadedFillIsWithinWhatWasCut) {
  EXPECT_LT(solve_error({}, LaneUse::drives, 2e-5, false), 1e-4);
  EXPECT_LT(solve_error({}, LaneUse::arcs, 5e-6, false), 1e-4);
}

TEST(Lanes, StiffBeltCouplesItsInterfacesByItself) {
  EXPECT_LT(solve_error({"belt.axial_damping_n_s=1000"}, LaneUse::arcs, 2e-5, false), 1e-9);
}

}  // namespace
}  // namespace beltlife
