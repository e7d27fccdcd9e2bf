// Owns the way from recorded loads to the life of the belt: stresses (thesis ch. 5), Sines, Basquin, Miner (ch. 6).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/record.h"
#include "sim/scene/scene.h"

namespace beltlife {

/// What one pulley does to the belt in one range, from the simulation alone.
struct PulleyLoad {
  std::string name;
  Side side = Side::front;
  double radius_m = 0;
  double tension_high_n = 0;  ///< T_hi: highest sampled tension on the side whose mean is larger
  double tension_low_n = 0;   ///< T_lo: lowest sampled tension on the other side
  double normal_n[3] = {};    ///< F_N by PassForce: sampled mean, resolved mean, 99th percentile; on one element length
  double tangential_n[3] = {};  ///< |F_T| likewise
  std::size_t passes = 0;
  std::size_t passes_unsampled = 0;
};

struct RangeLoad {
  std::string name;
  double duty_share = 0;
  double driver_rpm = 0;
  double driver_radius_m = 0;
  double belt_speed_m_s = 0;  ///< mean, pi D rpm / 60 of the driven pulley
  double unstretched_length_m = 0;
  double element_length_m = 0;  ///< l = L0 / N, to which the contact forces belong
  double axial_stiffness_n = 0;
  int ribs = 0;
  std::vector<PulleyLoad> pulleys;  ///< scene order
};

/// Stresses in Pa and life at one pulley.
struct PulleyLife {
  std::string name;
  double axial_mean = 0, axial_alternating = 0;
  double bending = 0;     ///< sigma_B, signed: + on back-wrapped pulleys (rib tip in tension), - on front-wrapped
  double transverse = 0;  ///< sigma_Z <= 0; 0 on back-wrapped pulleys
  double shear = 0;       ///< sigma_tau >= 0; 0 on back-wrapped pulleys
  double sigma_m = 0, sigma_a = 0;
  double cycles = 0;        ///< N_f; infinite where sigma_a = 0
  double damage_share = 0;  ///< of its range's damage, 0..1
};

struct RangeLife {
  std::string name;
  double duty_share = 0;
  std::vector<PulleyLife> pulleys;
  double cycles = 0;                 ///< N_F of one belt round over all pulleys
  double life_h = 0;                 ///< h_f
  double damage_share = 0;           ///< of the duty cycle's damage, 0..1
  std::optional<std::string> error;  ///< in words where no life can be stated (sigma_m >= sigma_f)
};

struct Life {
  std::vector<RangeLife> ranges;
  double life_h = 0;  ///< over the duty cycle; equal shares if the scene gives none
  double log10_life_h = 0;
  std::optional<std::string> error;
};

/// Stresses and cycles at one pulley. `error` is added to, in words, if sigma_m >= sigma_f or a load is missing;
/// numbers that cannot be stated (cycles here, lives below) are then NaN.
PulleyLife pulley_life(const PulleyLoad& load, const RangeLoad& range, const FatigueSpec& fatigue,
                       std::optional<std::string>& error);
RangeLife range_life(const RangeLoad& range, const FatigueSpec& fatigue);
Life duty_cycle_life(const std::vector<RangeLoad>& ranges, const FatigueSpec& fatigue);

/// The flank height (mm) at which the duty-cycle life is `life_h`, all else as given; nothing if there is none
/// between 0.05 and 10 mm; the smallest, if several do. Contact constants must be fixed before.
std::optional<double> flank_height_for_life(const std::vector<RangeLoad>& ranges, FatigueSpec fatigue, double life_h);

}  // namespace beltlife
