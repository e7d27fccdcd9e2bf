// Owns what a run leaves behind: sampled channels, contact forces per belt pass, and the energy account.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/status.h"

namespace beltlife {

/// One recorded quantity. Names are fixed spellings: "crank.speed_rpm", "span.crank-idler_3.tension_n",
/// "pulley.crank.hub_load_x_n", "spring.turbine_shaft.torque_n_m", "tensioner.arm_angle_rad", ...
struct Channel {
  std::string name;
  std::string unit;
  std::string description;
  std::vector<double> values;  ///< one per sample
};

/// Channels sampled together at a constant rate.
struct Trace {
  std::vector<double> time_s;
  std::vector<Channel> channels;

  /// The channel of this name, or nullptr.
  const Channel* find(std::string_view name) const {
    for (const auto& channel : channels)
      if (channel.name == name) return &channel;
    return nullptr;
  }
};

/// Largest contact forces (N, on one element's length of belt) of every complete pass of a belt node over one pulley.
/// All vectors but `sampled_*` have one entry a pass; a pass that no 1000 Hz sample caught in contact is left out of
/// the sampled ones and counted.
struct PassForces {
  std::vector<double> normal_resolved;
  std::vector<double> tangential_resolved;  ///< absolute value
  std::vector<double> normal_sampled;
  std::vector<double> tangential_sampled;  ///< absolute value
  std::size_t unsampled = 0;
};

/// Mechanisms of the energy account. Work is positive into the drive; what a mechanism dissipates is positive.
enum class Energy {
  work_driver,
  work_torque_tables,
  lost_belt_axial,
  lost_belt_bending,
  lost_contact_normal,
  lost_friction,
  lost_shafts,
  lost_gears,
  lost_tensioner_damping,
  lost_tensioner_friction,
  stored,  ///< kinetic and elastic; differences matter
  count
};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Energy::count)> energy_names{
    "work_driver",   "work_torque_tables", "lost_belt_axial", "lost_belt_bending",      "lost_contact_normal",
    "lost_friction", "lost_shafts",        "lost_gears",      "lost_tensioner_damping", "lost_tensioner_friction",
    "stored"};

/// Joules over a window: work in, losses, change of what is stored.
struct EnergyAccount {
  std::array<double, static_cast<std::size_t>(Energy::count)> joule{};

  double& operator[](Energy e) { return joule[static_cast<std::size_t>(e)]; }
  double operator[](Energy e) const { return joule[static_cast<std::size_t>(e)]; }
  /// What is not accounted for: work - losses - change of stored energy, J.
  double residual() const;
  /// What went through the drive: the sum of the positive works and what the stores gave up, J.
  double throughput() const;
  /// residual / throughput; 0 for a drive that nothing went through.
  double relative_residual() const;
};

/// Force history of one belt node as it travels (thesis Figures 5.3 and 5.5).
struct ElementHistory {
  std::vector<double> time_s;
  std::vector<double> normal_n;
  std::vector<double> tangential_n;
  std::vector<double> tension_n;
  std::vector<int> pulley;  ///< index of the pulley in contact, -1 on a span
};

/// The whole belt at one instant, node by node in the scene's pulley order.
struct LoopSnapshot {
  std::vector<double> x_m, y_m;
  std::vector<double> tension_n;  ///< of the element that begins at the node
};

/// The moving drive, frame by frame: at equal times, each taken at the next observation (up to 1e-4 s later), the last
/// one at the window's end. Matrices are one frame after the other. Rounded to what nobody sees: files stay small.
struct Frames {
  static constexpr double position_step = 1.0 / (1 << 20);  ///< m, 1 micrometre
  static constexpr double tension_step = 1.0 / (1 << 6);    ///< N
  static constexpr double angle_step = 1.0 / (1 << 16);     ///< rad

  std::vector<double> time_s;                  ///< in the run's own time
  std::vector<double> x_m, y_m, tension_n;     ///< by frame and node, as in LoopSnapshot
  std::vector<double> pulley_angle_rad;        ///< by frame and pulley, counterclockwise since the start of the run
  std::vector<double> pulley_x_m, pulley_y_m;  ///< centres; only the tensioner's moves

  std::size_t nodes() const { return time_s.empty() ? 0 : x_m.size() / time_s.size(); }
  std::size_t pulleys() const { return time_s.empty() ? 0 : pulley_x_m.size() / time_s.size(); }
};

/// What one evaluated window (the last second of a range) recorded.
struct WindowRecord {
  std::string range;
  double crank_rpm = 0;  ///< mean speed of the driven body; 0 without one
  double duty_share = 0;
  double begin_s = 0;  ///< in the run's own time
  double end_s = 0;
  bool complete = false;         ///< false where the run failed before the window ended
  std::size_t first_sample = 0;  ///< samples [first, last) of the trace
  std::size_t last_sample = 0;
  std::vector<PassForces> passes;  ///< one per pulley, scene order
  EnergyAccount energy;
  ElementHistory element;
  LoopSnapshot loop;  ///< at the end of the window
  Frames frames;      ///< empty unless asked for
};

/// Everything a run leaves behind.
struct RunRecord {
  RunStatus status;
  Trace trace;
  std::vector<WindowRecord> windows;
  double simulated_s = 0;
  double wall_s = 0;
  double step_s = 0;
  std::int64_t steps = 0;
  /// Of a range that may end early: largest relative change between its last two stretches (`sim/eval/settling`).
  std::optional<double> settling_change;
  double friction_overdamped_s = 0;  ///< simulated time during which the friction slope exceeded what the step resolves
};

}  // namespace beltlife
