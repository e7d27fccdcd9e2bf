// One change at a time: what is noise, what is slight, what can be seen.
#include "studies/oat/oat.h"

#include <gtest/gtest.h>

namespace beltlife {
namespace {

constexpr double visible = 0.05, errors = 3;

TEST(Oat, TellsAVisibleChangeFromASlightOneAndFromNoise) {
  const std::vector<double> before{10.0, 10.1, 9.9, 10.0};  // standard error of a mean: 0.041
  const Effect large = compare(before, {8.0, 8.1, 7.9, 8.0}, visible, errors);
  EXPECT_NEAR(large.change, -0.2, 1e-12);
  EXPECT_NEAR(large.standard_error, 0.0057735, 1e-6) << "sqrt(2) 0.0816 / sqrt(4) / 10";
  EXPECT_TRUE(large.beyond_noise && large.visible);
  const Effect slight = compare(before, {10.3, 10.4, 10.2, 10.3}, visible, errors);
  EXPECT_TRUE(slight.beyond_noise && !slight.visible);
  const Effect none = compare(before, {10.05, 10.15, 9.95, 10.05}, visible, errors);
  EXPECT_FALSE(none.beyond_noise || none.visible);
  EXPECT_EQ(verdict_of({none, slight, large}), "decrease") << "the largest change speaks";
  EXPECT_EQ(verdict_of({none, slight}), "slight increase");
  EXPECT_EQ(verdict_of({none}), "none");
}

TEST(Oat, StatesAChangeFromZeroRelativeToWhatItBecomes) {
  const Effect e = compare({0, 0}, {2, 2}, visible, errors);
  EXPECT_EQ(e.change, 1);
  EXPECT_TRUE(e.visible);
  EXPECT_FALSE(compare({0, 0}, {0, 0}, visible, errors).beyond_noise);
}

TEST(Oat, CountsResponsesThatCoexistOnEitherSide) {
  const Effect e = compare({10, 10.01, 20, 20.01, 10.02, 20.02}, {10, 10.01, 10.02, 10.01}, visible, errors);
  EXPECT_EQ(e.responses_before, 2u);
  EXPECT_EQ(e.responses_after, 1u);
}

}  // namespace
}  // namespace beltlife
