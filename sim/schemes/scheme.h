// Owns the choice of time integrator, the simulator that advances a state with it, and the predicted stable step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/kernels/kernel.h"

namespace beltlife {

/// Time per kernel, filled only when profiling.
struct KernelTime {
  std::string name;
  double seconds = 0;
  std::int64_t calls = 0;
};

/// A drive at an instant, as sensors, trackers and the energy account read it.
class DriveView {
 public:
  DriveView(const Model& model, const SpeedProfile& profile, const State& state, const Work& work, double time,
            double step, double behind = 0)
      : model_(model), profile_(profile), state_(state), work_(work), time_(time), step_(step), behind_(behind) {}
  const Model& model() const { return model_; }
  const SpeedProfile& profile() const { return profile_; }
  const State& state() const { return state_; }
  const Work& work() const { return work_; }
  double time() const { return time_; }
  /// When the state was such, s: where positions and velocities are half a step apart, that much before time().
  double state_time() const { return time_ - behind_; }
  double step() const { return step_; }

 private:
  const Model& model_;
  const SpeedProfile& profile_;
  const State& state_;
  const Work& work_;
  double time_, step_, behind_;
};

/// Advances one drive in time with an explicit scheme. The model and the profile must outlive it.
class Simulator {
 public:
  Simulator(const Model& model, const SpeedProfile& profile, Scheme scheme, double step);

  void advance();
  double time() const { return step_ * static_cast<double>(state_.step); }
  double step() const { return step_; }
  const Model& model() const { return model_; }
  const SpeedProfile& profile() const { return profile_; }
  State& state() { return state_; }
  const State& state() const { return state_; }
  /// Forces of the last evaluation; with the thesis scheme that at the predicted state.
  const Work& work() const { return work_; }
  DriveView view() const { return {model_, profile_, state_, work_, time(), step_}; }
  /// Replaces the state, e.g. by one saved before; goes on bit for bit as the saved one would have.
  void restore(const State& state);
  const std::vector<Kernel>& program() const { return program_; }
  void profile_kernels(bool on);
  const std::vector<KernelTime>& kernel_times() const { return times_; }

  /// Forces at coordinates q (also for tests).
  void evaluate(Coordinates& q, const Pass& pass);

 private:
  friend void advance_thesis(Simulator& s);
  friend void advance_symplectic_euler(Simulator& s);

  /// Sets the driven body's given speed at `time`.
  void prescribe(Coordinates& q, double time) const;

  const Model& model_;
  const SpeedProfile& profile_;
  void (*scheme_)(Simulator&);
  double step_;
  State state_;
  Work work_;
  Coordinates predicted_;
  NodeArray first_fx_, first_fy_;
  std::vector<double> first_torque_;
  double first_arm_torque_ = 0;
  std::vector<Kernel> program_;
  bool timing_ = false;
  std::vector<KernelTime> times_;
};

/// Explicit trapezoidal predictor-corrector, two force evaluations a step (thesis 2.3-2.6).
void advance_thesis(Simulator& s);
/// Semi-implicit Euler, one evaluation a step: v += h a(x, v), x += h v.
void advance_symplectic_euler(Simulator& s);

/// One bound on the step of the explicit schemes.
struct StepLimit {
  std::string name;
  std::string formula;
  double limit_s = 0;
};

/// Every bound of this drive under a scheme, shortest first: of stability for the explicit ones, of accuracy for the
/// linearly implicit one. `stable_step` is the shortest times a margin.
std::vector<StepLimit> step_limits(const Model& model, Scheme scheme);
double stable_step(const Model& model, Scheme scheme);

/// Longest stable step of one mode x'' + damping x' + omega^2 x = 0 (damping 1/s, omega^2 1/s^2); the same for both
/// explicit schemes.
double mode_limit(double omega2, double damping);

/// Rate (1/s) that the axial damping puts on the shortest wave, 4 CA / (l0 m), and that a normal force adds through
/// the slope of the velocity friction, mu F_n (1 - beta) / (v_s m): an explicit step h damps rightly only while
/// h x (both) < 2.
double axial_damping_rate(const Model& model);
double friction_damping_rate(const Model& model, double friction, double normal_force);

}  // namespace beltlife
