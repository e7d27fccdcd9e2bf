// Error against run time: measures by group, the reference and its band, observed orders, on made-up runs with known
// ones.
#include "studies/convergence/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace beltlife {
namespace {

NumericalRun run_of(const std::string& scheme, int elements, double step_s, std::vector<double> values) {
  return {scheme, elements, step_s, 1, "", std::move(values)};
}

TEST(Convergence, PutsQuantitiesIntoTheirGroups) {
  EXPECT_EQ(quantity_group("B100.shaft.speed_rpm.order_3"), "order 3");
  EXPECT_EQ(quantity_group("B100.shaft.speed_rpm.order_3.5"), "other");
  EXPECT_EQ(quantity_group("idle.pulley.crank.normal_n.sampled"), "normal force, 1 kHz");
  EXPECT_EQ(quantity_group("log10_life_h"), "log10 life");
  EXPECT_TRUE(of_one_element("idle.pulley.crank.tangential_n.resolved"));
  EXPECT_FALSE(of_one_element("idle.pulley.crank.sigma_a_mpa"));
}

TEST(Convergence, StatesErrorsByTheMeasureOfTheGroup) {
  const std::vector<std::string> q{"a.x.order_3", "a.pulley.p.slip_percent", "a.pulley.q.slip_percent",
                                   "a.log10_life_h"};
  const auto e = errors_of(q, {10, 0.5, 0.01, 3}, {11, 0.5, 0.02, 3.2});
  EXPECT_NEAR(e[0], 0.1, 1e-12);
  EXPECT_NEAR(e[2], 0.02, 1e-12) << "0.01 of the range's largest slip, 0.5";
  EXPECT_NEAR(e[3], 0.2, 1e-12) << "a difference of log10";
}

TEST(Convergence, TakesTheFinestExplicitRunAsReference) {
  std::vector<NumericalRun> runs{run_of("linearly_implicit", 1024, 1e-9, {1}), run_of("thesis", 512, 1e-8, {1}),
                                 run_of("symplectic_euler", 1024, 2e-7, {1}), run_of("thesis", 1024, 4e-7, {1})};
  EXPECT_EQ(reference_run(runs), 2u);
  runs[2].failure = "diverged";
  EXPECT_EQ(reference_run(runs), 3u);
  EXPECT_FALSE(reference_run({runs[0]}));
}

// f = 5 + 64/N^2 exactly: Richardson's extrapolation from evenly spaced meshes finds what the finest still lacks.
TEST(Convergence, BandOfTheReferenceHoldsWhatTheFinestMeshLacks) {
  std::vector<NumericalRun> runs;
  for (const int n : {8, 16, 32}) runs.push_back(run_of("thesis", n, 1e-7, {5 + 64.0 / (n * n)}));
  EXPECT_NEAR(reference_band(runs, 2)[0], 64.0 / (32 * 32), 1e-12);
  runs.push_back(run_of("thesis", 32, 2e-7, {runs[2].values[0] + 0.25}));
  EXPECT_NEAR(reference_band(runs, 2)[0], 64.0 / (32 * 32) + 0.25, 1e-12) << "and what the next longer step changes";
  // Unevenly spaced meshes tell no order by this formula: first order, a third of the last change, is taken.
  const std::vector<NumericalRun> uneven{run_of("thesis", 4, 1e-7, {9}), run_of("thesis", 8, 1e-7, {6}),
                                         run_of("thesis", 32, 1e-7, {5.0625})};
  EXPECT_NEAR(reference_band(uneven, 2)[0], (6 - 5.0625) / 3, 1e-12);
}

TEST(Convergence, ObservesTheOrderOfAPowerLaw) {
  const std::vector<double> h{1e-5, 2e-5, 4e-5};
  EXPECT_NEAR(*observed_order(h, {3e-4, 12e-4, 48e-4}), 2, 1e-9);
  EXPECT_NEAR(*observed_order(h, {0, 1e-3, 2e-3}), 1, 1e-9) << "an error of zero has no logarithm and is left out";
  EXPECT_FALSE(observed_order(h, {0, 0, 1e-3}));
}

}  // namespace
}  // namespace beltlife
