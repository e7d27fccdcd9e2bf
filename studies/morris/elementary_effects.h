// Owns elementary effects: trajectories through the unit cube, and what a function does along them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "studies/sample.h"

namespace beltlife {

/// Trajectories of d + 1 points each, one after the other; between two points one coordinate moves by
/// p / (2 (p - 1)), up or down, p the number of levels (even). Where it starts, its order and the directions are by
/// chance (Morris, Technometrics 33, 1991), so that each level of each coordinate is as likely.
Rows trajectories(std::size_t count, std::size_t dimensions, int levels, std::int64_t seed);

struct Effects {
  std::size_t used = 0;                   ///< effects of which both points were there
  double mu = 0, mu_star = 0, sigma = 0;  ///< mean, mean of magnitudes, standard deviation, per unit of the cube
  double mu_star_error = 0;               ///< standard error of mu_star: scatter of the magnitudes / sqrt(used)
};

/// Effects of each coordinate from the values along trajectories(); a point without a value takes the one or two
/// effects with it that need it. NaN where no effect is left.
std::vector<Effects> elementary_effects(const Rows& at, const std::vector<std::optional<double>>& values);

/// Largest mu_star that noise of this standard deviation makes by itself: its mean over many effects, and twice the
/// scatter of that mean over `used`.
double mu_star_of_noise(double standard_deviation, int levels, std::size_t used);

}  // namespace beltlife
