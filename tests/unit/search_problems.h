// Owns constrained problems whose optimum is known, as search problems in the unit cube, with noise and failures at
// will.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "optimize/search/search_design.h"

namespace beltlife::search_test {

/// Objective, then the geometry's distances, then the constraints; all of the latter satisfied where >= 0.
using Values = std::vector<double>;

struct KnownProblem {
  std::string name;
  std::vector<double> lower, upper;
  std::size_t geometry = 0;  ///< so many of the constraints are free to know
  double optimum = 0;
  Values (*values)(const std::vector<double>& x) = nullptr;

  std::size_t variables() const { return lower.size(); }
  Values at(const Point& unit) const {
    std::vector<double> x;
    for (std::size_t i = 0; i < unit.size(); ++i) x.push_back(lower[i] + unit[i] * (upper[i] - lower[i]));
    return values(x);
  }
};

inline double square(double v) { return v * v; }

/// Floudas & Pardalos 1990; G06 of Koziel & Michalewicz 1999. The feasible set is a sliver of 0.007 % of the box.
inline Values g06(const std::vector<double>& x) {
  return {std::pow(x[0] - 10, 3) + std::pow(x[1] - 20, 3), (square(x[0] - 5) + square(x[1] - 5) - 100) / 100,
          (82.81 - square(x[0] - 6) - square(x[1] - 5)) / 100};
}
/// G08 of Koziel & Michalewicz 1999: optimum at (1.2279713, 4.2453733).
inline Values g08(const std::vector<double>& x) {
  const double two_pi = 2 * std::numbers::pi;
  return {-std::pow(std::sin(two_pi * x[0]), 3) * std::sin(two_pi * x[1]) / (std::pow(x[0], 3) * (x[0] + x[1])),
          (x[1] - x[0] * x[0] - 1) / 10, (x[0] - 1 - square(x[1] - 4)) / 10};
}
/// Mishra 2006, "bird", in a disk: optimum at (-3.1302468, -1.5821422).
inline Values bird(const std::vector<double>& x) {
  return {std::sin(x[1]) * std::exp(square(1 - std::cos(x[0]))) +
              std::cos(x[0]) * std::exp(square(1 - std::sin(x[1]))) + square(x[0] - x[1]),
          (25 - square(x[0] + 5) - square(x[1] + 5)) / 25};
}
/// Gomez & Levy 1982, the six-hump camel with holes: optimum at (0.08984201, -0.7126564).
inline Values gomez_levy(const std::vector<double>& x) {
  const double a = x[0] * x[0], b = x[1] * x[1], pi = std::numbers::pi;
  return {4 * a - 2.1 * a * a + a * a * a / 3 + x[0] * x[1] - 4 * b + 4 * b * b,
          1.5 + std::sin(4 * pi * x[0]) - 2 * square(std::sin(2 * pi * x[1]))};
}
/// Rosenbrock 1960 in the disk that ends at its optimum (1, 1).
inline Values rosenbrock_disk(const std::vector<double>& x) {
  return {square(1 - x[0]) + 100 * square(x[1] - x[0] * x[0]), 2 - x[0] * x[0] - x[1] * x[1]};
}
/// Tension spring, Arora 1989; optimum of Coello 2000 and many after: (0.051690, 0.356737, 11.28885).
inline Values spring(const std::vector<double>& x) {
  const double d = x[0], D = x[1], turns = x[2];
  return {(turns + 2) * D * d * d, 1.5 - D - d, std::pow(D, 3) * turns / (71785 * std::pow(d, 4)) - 1,
          1 - (4 * D * D - d * D) / (12566 * (D * std::pow(d, 3) - std::pow(d, 4))) - 1 / (5108 * d * d),
          140.45 * d / (D * D * turns) - 1};
}
/// Welded beam, Rao 1996; optimum 1.724852 of Coello 2000 and after: (0.205730, 3.470489, 9.036624, 0.205729).
inline Values welded_beam(const std::vector<double>& x) {
  const double h = x[0], l = x[1], t = x[2], b = x[3], load = 6000, reach = 14;
  const double arm = std::sqrt(l * l / 4 + square((h + t) / 2));
  const double direct = load / (std::sqrt(2.0) * h * l);
  const double twist = load * (reach + l / 2) * arm / (2 * std::sqrt(2.0) * h * l * (l * l / 12 + square((h + t) / 2)));
  const double shear = std::sqrt(direct * direct + direct * twist * l / arm + twist * twist);
  const double bending = 6 * load * reach / (b * t * t),
               deflection = 4 * load * std::pow(reach, 3) / (30e6 * b * t * t * t);
  const double buckling = 4.013 * 30e6 * std::sqrt(t * t * std::pow(b, 6) / 36) / (reach * reach) *
                          (1 - t / (2 * reach) * std::sqrt(30e6 / (4 * 12e6)));
  return {1.10471 * h * h * l + 0.04811 * t * b * (14 + l),
          b - h,
          5 - 0.10471 * h * h - 0.04811 * t * b * (14 + l),
          1 - shear / 13600,
          1 - bending / 30000,
          1 - deflection / 0.25,
          1 - load / buckling,
          buckling / load - 1};
}
/// Pressure vessel, Sandgren 1990, with continuous thicknesses and length up to 200: 5885.3328 (Yang 2014 and others).
inline Values vessel(const std::vector<double>& x) {
  const double pi = std::numbers::pi, r = x[2], length = x[3];
  return {0.6224 * x[0] * r * length + 1.7781 * x[1] * r * r + 3.1661 * x[0] * x[0] * length + 19.84 * x[0] * x[0] * r,
          x[0] - 0.0193 * r, x[1] - 0.00954 * r, (pi * r * r * length + 4.0 / 3.0 * pi * r * r * r) / 1296000 - 1};
}
/// Himmelblau 1972; G04 of Koziel & Michalewicz 1999.
inline Values g04(const std::vector<double>& x) {
  const double a = 85.334407 + 0.0056858 * x[1] * x[4] + 0.0006262 * x[0] * x[3] - 0.0022053 * x[2] * x[4];
  const double b = 80.51249 + 0.0071317 * x[1] * x[4] + 0.0029955 * x[0] * x[1] + 0.0021813 * x[2] * x[2];
  const double c = 9.300961 + 0.0047026 * x[2] * x[4] + 0.0012547 * x[0] * x[2] + 0.0019085 * x[2] * x[3];
  return {5.3578547 * x[2] * x[2] + 0.8356891 * x[0] * x[4] + 37.293239 * x[0] - 40792.141,
          (c - 20) / 10,
          (25 - c) / 10,
          a / 10,
          (92 - a) / 10,
          (b - 90) / 10,
          (110 - b) / 10};
}
/// Hartmann's function of six variables (Dixon & Szego 1978) within the unit ball (Letham et al. 2019).
inline Values hartmann6(const std::vector<double>& x) {
  constexpr double alpha[4] = {1.0, 1.2, 3.0, 3.2};
  constexpr double a[4][6] = {
      {10, 3, 17, 3.5, 1.7, 8}, {0.05, 10, 17, 0.1, 8, 14}, {3, 3.5, 1.7, 10, 17, 8}, {17, 8, 0.05, 10, 0.1, 14}};
  constexpr double p[4][6] = {{0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                              {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                              {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                              {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}};
  double sum = 0, norm = 0;
  for (int i = 0; i < 4; ++i) {
    double e = 0;
    for (int j = 0; j < 6; ++j) e += a[i][j] * square(x[j] - p[i][j]);
    sum -= alpha[i] * std::exp(-e);
  }
  for (const double v : x) norm += v * v;
  return {sum, 1 - norm};
}

/// Twelve variables, [0, 1]: a bowl of uneven axes cut by a plane. Lagrange: x_i = c_i - q/(2 w_i), q from the plane.
inline constexpr std::size_t many = 12;
inline double bowl_weight(std::size_t i) { return 1.0 + static_cast<double>(i); }
inline double bowl_centre(std::size_t i) { return 0.35 + 0.03 * static_cast<double>(i); }
inline constexpr double bowl_plane = 0.05;  ///< how far the plane keeps the mean below the centres' mean
inline Values bowl(const std::vector<double>& x) {
  double f = 0, excess = 0;
  for (std::size_t i = 0; i < many; ++i) {
    f += bowl_weight(i) * square(x[i] - bowl_centre(i));
    excess += (x[i] - bowl_centre(i)) / many;
  }
  return {f, 0.4 - square(x[0] - 0.5) - square(x[1] - 0.5), -bowl_plane - excess};
}
inline double bowl_optimum() {
  double inverse = 0;
  for (std::size_t i = 0; i < many; ++i) inverse += 1 / bowl_weight(i);
  // sum (q / 2w) = 12 * plane, f = sum q^2 / 4w.
  return square(many * bowl_plane) / inverse;
}
/// Twelve variables, shifted Ackley (1987), 0 at the shift, on the edge of a half-space through it.
inline Values ackley12(const std::vector<double>& x) {
  double squares = 0, waves = 0, side = 0;
  for (std::size_t i = 0; i < many; ++i) {
    const double z = x[i] - 0.07 * static_cast<double>(i);
    squares += z * z / many;
    waves += std::cos(2 * std::numbers::pi * z) / many;
    side += z / many;
  }
  return {-20 * std::exp(-0.2 * std::sqrt(squares)) - std::exp(waves) + 20 + std::numbers::e,
          (16 - square(x[0]) - square(x[1])) / 16, side};
}
/// Twelve variables, a mild Rastrigin: three minima an axis, the outer ones shallow, so 3^12 before the constraints.
inline Values ripples12(const std::vector<double>& x) {
  double f = 0, side = 0;
  for (std::size_t i = 0; i < many; ++i) {
    const double z = x[i] - 0.07 * static_cast<double>(i);
    f += z * z + 1.0 - std::cos(std::numbers::pi * z);
    side += z / many;
  }
  return {f, (16 - square(x[0]) - square(x[1])) / 16, side};
}

inline std::vector<KnownProblem> small_problems() {
  return {{"g06", {13, 0}, {100, 100}, 1, -6961.81388, g06},
          {"g08", {1e-6, 1e-6}, {10, 10}, 1, -0.095825041, g08},
          {"bird in a disk", {-10, -6.5}, {0, 0}, 1, -106.7645367, bird},
          {"Gomez-Levy", {-1, -1}, {0.75, 1}, 1, -1.031628453, gomez_levy},
          {"Rosenbrock in a disk", {-1.5, -1.5}, {1.5, 1.5}, 0, 0, rosenbrock_disk},
          {"tension spring", {0.05, 0.25, 2}, {2, 1.3, 15}, 1, 0.012665233, spring},
          {"welded beam", {0.1, 0.1, 0.1, 0.1}, {2, 10, 10, 2}, 2, 1.724852309, welded_beam},
          {"pressure vessel", {0.0625, 0.0625, 10, 10}, {6.1875, 6.1875, 200, 200}, 2, 5885.3328, vessel},
          {"g04", {78, 33, 27, 27, 27}, {102, 45, 45, 45, 45}, 2, -30665.5387, g04},
          {"Hartmann 6 in a ball", {0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1}, 1, -3.32236801, hartmann6}};
}

inline std::vector<KnownProblem> large_problems() {
  const std::vector<double> zero(many, 0), one(many, 1), left(many, -3), right(many, 3);
  return {{"bowl", zero, one, 1, bowl_optimum(), bowl},
          {"Ackley", left, right, 1, 0, ackley12},
          {"ripples", left, right, 1, 0, ripples12}};
}

/// A number in [0, 1) that depends on x and `salt` alone.
inline double hashed(const Point& x, std::uint64_t salt) {
  for (const double v : x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    salt = SearchRandom(static_cast<std::int64_t>(salt ^ bits)).bits();
  }
  return SearchRandom(static_cast<std::int64_t>(salt)).uniform();
}

struct Trouble {
  double noise = 0;            ///< standard deviation of the objective, relative to it
  double absolute_noise = 0;   ///< the same, in its unit
  double failures = 0;         ///< share of points that fail, by hash of x
  bool fails_outside = false;  ///< points of infeasible geometry cannot be simulated
};

inline Trial answer(const KnownProblem& known, const Point& x, const Trouble& trouble, std::uint64_t salt) {
  const Values values = known.at(x);
  Trial trial;
  trial.x = x;
  trial.geometry.assign(values.begin() + 1, values.begin() + 1 + static_cast<std::ptrdiff_t>(known.geometry));
  trial.ok = hashed(x, salt + 1) >= trouble.failures;
  if (trouble.fails_outside && shortfall(trial.geometry) > 0) trial.ok = false;
  if (!trial.ok) return trial;
  const double normal = std::sqrt(-2 * std::log(1 - hashed(x, salt + 2))) *
                        std::cos(2 * std::numbers::pi * hashed(x, salt + 3));  // Box & Muller 1958
  trial.objective = values[0] + (trouble.noise * std::abs(values[0]) + trouble.absolute_noise) * normal;
  trial.constraints.assign(values.begin() + 1 + static_cast<std::ptrdiff_t>(known.geometry), values.end());
  return trial;
}

/// `known` must outlive the problem. The start is a random point of the seed, feasible or not.
inline SearchProblem problem_of(const KnownProblem& known, const Trouble& trouble, std::int64_t seed) {
  SearchProblem problem;
  problem.variables = known.variables();
  SearchRandom random(1000 + seed);
  for (std::size_t i = 0; i < known.variables(); ++i) problem.start.push_back(random.uniform());
  problem.geometry_constraints = known.geometry;
  problem.constraints = known.at(problem.start).size() - 1 - known.geometry;
  if (known.geometry > 0)
    problem.geometry = [&known](const Point& x) {
      const Values values = known.at(x);
      return Values(values.begin() + 1, values.begin() + 1 + static_cast<std::ptrdiff_t>(known.geometry));
    };
  problem.evaluate = [&known, trouble, seed](const std::vector<Point>& points) {
    std::vector<Trial> trials;
    for (const Point& x : points) trials.push_back(answer(known, x, trouble, static_cast<std::uint64_t>(seed)));
    return trials;
  };
  return problem;
}

/// Median objective of 200 feasible random points: what one gets without searching.
inline double typical_objective(const KnownProblem& known) {
  SearchRandom random(77);
  std::vector<double> found;
  for (long tries = 0; found.size() < 200 && tries < 20'000'000; ++tries) {
    Point x(known.variables());
    for (double& v : x) v = random.uniform();
    Values values = known.at(x);
    const double f = values[0];
    values.erase(values.begin());
    if (shortfall(values) == 0) found.push_back(f);
  }
  std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2), found.end());
  return found[found.size() / 2];
}

/// What is left of the way from a typical feasible design to the optimum, by the true objective of the incumbent; 1 if
/// there is none. Solved: at most 0.01.
inline double way_left(const KnownProblem& known, const std::vector<Trial>& history, double typical) {
  const Trial* best = best_of(history);
  if (!best) return 1;
  return (known.at(best->x)[0] - known.optimum) / (typical - known.optimum);
}

}  // namespace beltlife::search_test
