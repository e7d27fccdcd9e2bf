// Owns the formulas of thesis chapters 5 and 6: stresses at a pulley, Sines, Basquin with mean stress, Miner, duty
// cycle.
#include "sim/life/life.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>

namespace beltlife {

namespace {

constexpr double pa_per_mpa = 1e6;
constexpr double no_life = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

std::string place(const RangeLoad& range, const PulleyLoad& pulley) {
  return "range " + range.name + ", pulley " + pulley.name + ": ";
}

std::string in_mpa(double stress_pa) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g MPa", stress_pa / pa_per_mpa);
  return text;
}

std::string not_finite(const RangeLoad& range, const PulleyLoad& pulley) {
  if (!std::isfinite(pulley.tension_high_n + pulley.tension_low_n))
    return place(range, pulley) + "the window holds no finite belt tension";
  if (pulley.passes == 0)
    return place(range, pulley) +
           "no belt element passed the pulley completely inside the window; evaluate a longer "
           "window (profile.evaluate_s) or a higher speed";
  if (pulley.passes == pulley.passes_unsampled)
    return place(range, pulley) + "none of " + std::to_string(pulley.passes) +
           " passes was sampled in contact; raise solver.sample_rate_hz or set fatigue.pass_force = \"resolved\"";
  return place(range, pulley) + "the loads are not finite numbers";
}

void append(std::optional<std::string>& all, const std::string& one) { all = all ? *all + "; " + one : one; }

}  // namespace

PulleyLife pulley_life(const PulleyLoad& load, const RangeLoad& range, const FatigueSpec& fatigue,
                       std::optional<std::string>& error) {
  const double modulus = fatigue.rubber_modulus_mpa * pa_per_mpa;
  const double strength = fatigue.strength_mpa * pa_per_mpa;
  PulleyLife life;
  life.name = load.name;

  // Rubber and cord share the strain T / EA, so the rubber carries T E / EA (5.1, 5.2); mean and alternating
  // (5.3, 5.4).
  const double stress_per_newton = modulus / range.axial_stiffness_n;
  life.axial_mean = 0.5 * (load.tension_high_n + load.tension_low_n) * stress_per_newton;
  life.axial_alternating = 0.5 * (load.tension_high_n - load.tension_low_n) * stress_per_newton;

  // E y / R at the rib tip (5.5), which a back-wrapped pulley stretches and a front-wrapped one compresses.
  const double bending = modulus * fatigue.cord_to_rib_tip_mm * 1e-3 / load.radius_m;
  life.bending = load.side == Side::back ? bending : -bending;

  // Only a pulley that touches the ribs squeezes and shears their flanks.
  if (load.side == Side::front) {
    const double angle = fatigue.flank_angle_deg * std::numbers::pi / 180;
    const double flank_area = fatigue.flank_height_mm * 1e-3 * range.element_length_m;
    const auto which = static_cast<std::size_t>(fatigue.pass_force);
    const double normal_per_rib = load.normal_n[which] / range.ribs;          // (5.8)
    const double tangential_per_rib = load.tangential_n[which] / range.ribs;  // (5.15)
    const double transverse_force = normal_per_rib / (2 * std::tan(angle));   // F_z cos(theta), (5.10)
    life.transverse = -transverse_force / flank_area;                         // (5.11)
    life.shear = tangential_per_rib * std::cos(angle) / (2 * flank_area);     // (5.16)
  }

  // Bending, transverse and shear stress come and go with each pass: mean = alternating = half
  // (5.6, 5.7, 5.12, 5.13, 5.17, 5.18). Sines' mean (5.19).
  life.sigma_m = life.axial_mean + 0.5 * life.bending + 0.5 * life.transverse;

  // Sines' alternating stress (5.20) of the plane stress state (x along the belt, z across the rib, in phase, third
  // principal stress zero), written in components: the same as with principal values.
  const double along = life.axial_alternating + 0.5 * life.bending;
  const double across = 0.5 * life.transverse;
  const double shear = 0.5 * life.shear;
  life.sigma_a = std::sqrt(along * along - along * across + across * across + 3 * shear * shear);

  if (!std::isfinite(life.sigma_m) || !std::isfinite(life.sigma_a)) {
    append(error, not_finite(range, load));
    life.cycles = no_life;
  } else if (life.sigma_m >= strength) {
    append(error, place(range, load) + "the mean stress " + in_mpa(life.sigma_m) +
                      " is not below the fatigue strength " + in_mpa(strength) +
                      " (fatigue.strength_mpa), so no life can be stated");
    life.cycles = no_life;
  } else if (life.sigma_a == 0) {
    life.cycles = endless;
  } else {
    life.cycles = 0.5 * std::pow(life.sigma_a / (strength - life.sigma_m), 1 / fatigue.exponent);  // (6.4)
  }
  return life;
}

RangeLife range_life(const RangeLoad& range, const FatigueSpec& fatigue) {
  RangeLife life;
  life.name = range.name;
  life.duty_share = range.duty_share;
  double damage = 0;  // of one belt round (6.10)
  for (const PulleyLoad& load : range.pulleys) {
    life.pulleys.push_back(pulley_life(load, range, fatigue, life.error));
    damage += 1 / life.pulleys.back().cycles;
  }
  if (range.driver_rpm == 0) life.error.reset();  // a belt that stands still passes no pulley: nothing to state wrongly
  if (life.error) {
    life.cycles = life.life_h = no_life;
    return life;
  }
  if (range.driver_rpm == 0) {
    life.cycles = life.life_h = endless;
    return life;
  }
  life.cycles = 1 / damage;  // N_F (6.11); infinite where nothing does damage
  const double rounds_m_per_h = std::numbers::pi * 2 * range.driver_radius_m * range.driver_rpm * 60;
  life.life_h = life.cycles * range.unstretched_length_m / rounds_m_per_h;  // (6.12)
  if (damage > 0)
    for (PulleyLife& pulley : life.pulleys) pulley.damage_share = 1 / pulley.cycles / damage;
  return life;
}

Life duty_cycle_life(const std::vector<RangeLoad>& ranges, const FatigueSpec& fatigue) {
  Life life;
  double sum_of_shares = 0;
  for (const RangeLoad& range : ranges) {
    life.ranges.push_back(range_life(range, fatigue));
    sum_of_shares += range.duty_share;
  }
  if (ranges.empty()) life.error = "no operating range was evaluated";
  const auto share = [&](const RangeLife& range) {
    return sum_of_shares > 0 ? range.duty_share / sum_of_shares : 1.0 / static_cast<double>(ranges.size());
  };

  double damage_per_h = 0;  // (6.13)
  for (const RangeLife& range : life.ranges) {
    if (share(range) == 0) continue;
    if (range.error) append(life.error, *range.error);
    damage_per_h += share(range) / range.life_h;
  }
  life.life_h = life.error ? no_life : 1 / damage_per_h;
  life.log10_life_h = std::log10(life.life_h);
  if (!life.error && damage_per_h > 0)
    for (RangeLife& range : life.ranges)
      if (share(range) > 0) range.damage_share = share(range) / range.life_h / damage_per_h;
  return life;
}

std::optional<double> flank_height_for_life(const std::vector<RangeLoad>& ranges, FatigueSpec fatigue, double life_h) {
  constexpr double lowest_mm = 0.05, highest_mm = 10;
  if (!(life_h > 0) || !std::isfinite(life_h)) return std::nullopt;

  // Life tends to zero as sigma_m approaches the strength, so "no life can be stated" counts as too short.
  const auto long_enough = [&](double log_height) {
    fatigue.flank_height_mm = std::exp(log_height);
    const Life life = duty_cycle_life(ranges, fatigue);
    return !life.error && life.life_h >= life_h;
  };

  // Life grows with the flank height only up to a turning point (README.md, "Flank height"), so the interval is
  // scanned from below for the first crossing, and the bisection works inside one scanning step.
  constexpr int scan_steps = 64;
  const double low = std::log(lowest_mm);
  const double step = (std::log(highest_mm) - low) / scan_steps;
  const bool at_low = long_enough(low);
  for (int i = 1; i <= scan_steps; ++i) {
    double left = low + (i - 1) * step, right = low + i * step;
    if (long_enough(right) == at_low) continue;
    for (double middle = std::midpoint(left, right); left < middle && middle < right;
         middle = std::midpoint(left, right))
      (long_enough(middle) == at_low ? left : right) = middle;
    return std::exp(std::midpoint(left, right));
  }
  return std::nullopt;
}

}  // namespace beltlife
