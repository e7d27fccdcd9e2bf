// Owns the claims about derivatives by differences where a model fails, and about parameters that it does not feel.
#include <gtest/gtest.h>

#include "calibrate/fit_many.h"
#include "calibrate/inference.h"

namespace beltlife {
namespace {

ParameterSpec parameter(const char* path, double lower, double upper, double start) {
  ParameterSpec p;
  p.path = path;
  p.lower = lower;
  p.upper = upper;
  p.start = start;
  return p;
}

/// y = x, x^2 and x + z of two parameters, with targets of x = 2, z = 1; fails where `fails` says so.
FitProblem problem(const std::function<bool(double x, double z)>& fails) {
  FitProblem p;
  p.parameters = {parameter("x", 0, 10, 3), parameter("z", 0, 4, 2)};
  for (std::size_t k = 0; k < 3; ++k) {
    Target t;
    t.column = k;
    t.value = k == 0 ? 2 : k == 1 ? 4 : 3;
    t.sigma = 0.1;
    p.targets.push_back(t);
  }
  p.evaluate = [fails](const std::vector<Point>& points, const std::string&) {
    std::vector<Answer> answers;
    for (const Point& point : points) {
      const double x = number_of(point[0]), z = number_of(point[1]);
      Answer a;
      if (fails(x, z)) {
        a.reason = "fails there";
      } else {
        a.state = PointState::ok;
        a.values = {x, x * x, x + z};
      }
      answers.push_back(std::move(a));
    }
    return answers;
  };
  return p;
}

TEST(FitModel, TakesTheOtherSideWhereANeighbourFails) {
  FitModel model(problem([](double x, double) { return x > 3; }));
  const Derivatives d = model.derivatives_at({0.3, 0.5}, false, "");
  ASSERT_TRUE(d.ok);
  EXPECT_TRUE(d.frozen.empty());
  // u = x / 10: d(x)/du / sigma = 100; linear, so that either side gives it to rounding over the step.
  EXPECT_NEAR(d.jacobian(0, 0), 100, 1e-9);
}

TEST(FitModel, HalvesTheStepWhereBothNeighboursFail) {
  FitModel model(problem([](double x, double) { return std::abs(x - 3) > 0.06; }));  // the step is 0.03 of 3: 0.09
  const Derivatives d = model.derivatives_at({0.3, 0.5}, false, "");
  ASSERT_TRUE(d.ok);
  EXPECT_TRUE(d.frozen.empty());
  EXPECT_NEAR(d.jacobian(0, 0), 100, 1e-9);
}

TEST(FitModel, FreezesAParameterWhoseNeighboursAllFail) {
  FitModel model(problem([](double x, double) { return x != 3; }));
  const Derivatives d = model.derivatives_at({0.3, 0.5}, true, "");
  ASSERT_TRUE(d.ok);
  EXPECT_EQ(d.frozen, std::vector<std::size_t>{0});
  EXPECT_EQ(d.jacobian.col(0).norm(), 0);
  EXPECT_GT(d.jacobian.col(1).norm(), 0);
}

TEST(FitMany, FindsItsWayWhereAThirdOfTheBoxFails) {
  FitModel model(problem([](double x, double z) { return x > 7 || z > 3 || (x > 2.4 && x < 2.6); }));
  CalibrationSettings settings;
  const FitCourse course = fit_many(model, settings);
  ASSERT_TRUE(course.end.ok);
  EXPECT_LT(course.screened_ok, course.screened);
  // Exact data: what is left is the tolerance of a model without noise.
  EXPECT_NEAR(model.coordinates()[0].value(course.end.u[0]), 2, 1e-6);
  EXPECT_NEAR(model.coordinates()[1].value(course.end.u[1]), 1, 1e-6);
}

TEST(FitMany, SaysSoWhereTheStartFails) {
  FitModel model(problem([](double, double) { return true; }));
  const FitCourse course = fit_many(model, {});
  EXPECT_FALSE(course.end.ok);
  EXPECT_NE(course.fits[0].ended.find("failed"), std::string::npos) << course.fits[0].ended;
}

TEST(Inference, DoesNotShrinkAModelErrorThatIsStated) {
  FitProblem p = problem([](double, double) { return false; });
  p.targets[0].value += 0.001;  // a hundredth of sigma off
  FitModel model(std::move(p));
  const FitCourse course = fit_many(model, {});
  const Inference scaled = infer(model, course.end, 0.95, 3), held = infer(model, course.end, 0.95, 3, true);
  EXPECT_LT(scaled.residual_variance, 1e-3);
  EXPECT_NEAR(held.scale, 1, 1e-6) << "nothing remains to go";
  EXPECT_NEAR(scaled.standard_error[0] / held.standard_error[0], std::sqrt(scaled.residual_variance), 1e-6);
}

}  // namespace
}  // namespace beltlife
