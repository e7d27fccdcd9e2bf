// Owns the linearly implicit scheme: up to eight drives, or eight arcs of one, advanced in lockstep.
#pragma once

#include <memory>
#include <vector>

#include "sim/lanes/implicit_train.h"
#include "sim/lanes/lane_belt.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

/// One drive of a pack; model and profile must outlive the simulator.
struct LaneDrive {
  const Model* model = nullptr;
  const SpeedProfile* profile = nullptr;
};

/// Drives of equal topology, element count and step. What a drive does depends neither on its lane nor on its mates.
class LaneSimulator {
 public:
  LaneSimulator(const std::vector<LaneDrive>& drives, LaneUse use, double step);

  void advance();
  int drives() const { return static_cast<int>(drives_.size()); }
  std::int64_t steps() const { return step_count_; }
  double time() const { return step_ * static_cast<double>(step_count_); }
  double step() const { return step_; }

  /// The drive at time() - h/2, where positions and velocities are known together: brings state and work up to date.
  /// Forces come from the same kernels as the explicit schemes'.
  DriveView observe(int drive);
  /// What a step of this drive goes through, in order; a feature that the drive does not have is not there.
  static std::vector<std::string> kernel_names(const Model& model);
  void profile_kernels(bool on);
  const std::vector<KernelTime>& kernel_times() const { return times_; }

  /// Whether the largest contact forces between observations are kept; off at first.
  void keep_peaks(bool on) { belt_.peaks = on; }

  /// Whether the next step begins with a search for contacts: until then every node keeps its candidate pulley.
  bool search_due() const { return step_count_ >= next_search_; }

 private:
  struct Drive {
    const Model* model;
    const SpeedProfile* profile;
    State state;     ///< bodies, arm and its anchor are kept here
    State observed;  ///< the whole drive, when last observed
    Work work;
    ImplicitTrain train;
    std::vector<Kernel> program;
    std::vector<double> belt_torque, hub_x, hub_y;
  };

  const Drive& drive_of(int lane) const { return *drives_[belt_.use == LaneUse::drives && lane < drives() ? lane : 0]; }
  struct Part {
    const char* name;
    void (LaneSimulator::*run)();
  };
  static std::vector<Part> parts_of(const Model& model);

  void expect();
  void place_pulleys();
  void search_when_due();
  void ghosts();
  void elements();
  void contact();
  void solve();
  void reactions();
  void motion();
  void bodies();
  void search();
  void describe(ContactBlock& block) const;
  void follow_pulleys();

  double step_;
  std::int64_t step_count_ = 0, next_search_ = 0, search_steps_ = 1;
  LaneBelt belt_;
  std::vector<Part> parts_;
  bool timing_ = false;
  std::vector<KernelTime> times_;
  std::vector<std::unique_ptr<Drive>> drives_;
  std::vector<int> near_;                    // candidate pulley of each row and lane, -1: none
  std::vector<double> gaps_, found_;         // the same, while searching
  NodeArray last_change_x_, last_change_y_;  // of the velocities of the drive observed, m/s
  bool placed_ = false;
  // By pulley; the one behind the last stands for none.
  std::vector<LaneNumber> centre_x_, centre_y_, centre_vx_, centre_vy_, radii_, speeds_, changes_;
  std::vector<LaneLoads> loads_;
};

}  // namespace beltlife
