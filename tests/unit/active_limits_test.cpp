// Owns the claim that a limit of any kind has its value, its bound and its unit, in the layout's list and in the
// answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "optimize/layout/layout_base.h"
#include "optimize/layout/layout_limits.h"
#include "optimize/layout_answer.h"
#include "results/answer/answer_json.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/spec_path.h"

namespace beltlife {
namespace {

SceneSpec baseline() {
  SceneSpec scene = read_scene(std::string(BELTLIFE_SCENES) + "/baseline.toml").scene;
  scene.range.resize(1);  // each takes the time of a bending solution
  return scene;
}

/// Bounds that no layout keeps, so that every limit is active; each kind has one of its own.
LayoutLimitsSpec beyond_reach() {
  LayoutLimitsSpec spec;
  spec.min_pulley_clearance_mm = 9001;
  spec.min_belt_clearance_mm = 9002;
  spec.min_wrap_deg = 359;
  spec.wrap = {{"crank", 358}};
  spec.min_span_mm = 9003;
  spec.min_arm_leverage_mm = 9004;
  spec.min_unstretched_length_mm = 90000;
  spec.max_unstretched_length_mm = 2;
  spec.box = LayoutBoxSpec{5000, 5001, 5000, 5001};
  spec.keep_out = {{"post", 9005, KeepOutCircleSpec{0, 0, 1}, {}}};
  spec.take_up = TakeUpLimitSpec{9006, 9007};
  spec.travel_deg = 180;
  spec.min_slip_safety = 100;
  spec.max_hub_load_n = 3;
  spec.modes = ModesLimitSpec{{3}, 100};
  return spec;
}

/// A kind of limit by what its name begins with and holds.
struct Kind {
  const char *begins, *holds;
  double bound;
  const char* unit;
  bool at_most = false;
  int found = 0;

  bool is_of(const std::string& name) const { return name.starts_with(begins) && name.find(holds) != name.npos; }
};

std::vector<Kind> layout_kinds() {
  return {{"pulleys ", " and ", 9001, "mm"},
          {"wrap on crank", "", 358, "deg"},
          {"wrap on ", "", 359, "deg"},
          {"span ", "", 9003, "mm"},
          {"belt ", " and pulley ", 9002, "mm"},
          {"belt ", " and belt ", 9002, "mm"},
          {"arm leverage", "", 9004, "mm"},
          {"shortest belt", "", 90000, "mm"},
          {"longest belt", "", 2, "mm", true},
          {"box and pulley ", "", 0, "mm"},
          {"keep-out post and pulley ", "", 9005, "mm"},
          {"keep-out post and belt ", "", 9005, "mm"},
          {"take-up longer", "", 9006, "mm"},
          {"take-up shorter", "", 9007, "mm"},
          {"travel lengthening", "", 180, "deg"},
          {"travel shortening", "", 180, "deg"},
          {"slip safety in ", "", 100, ""},
          {"hub load in ", "", 3, "N", true},
          {"modes in ", "", 100, "%"}};
}

/// Spans that share a pulley may touch: their bound is 0.
bool of_touching_spans(const auto& limit) { return limit.name.starts_with("belt ") && limit.bound == 0; }

void expect_kind(std::vector<Kind>& kinds, const ActiveLimit& limit) {
  SCOPED_TRACE(limit.name);
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.is_of(limit.name); });
  ASSERT_NE(kind, kinds.end()) << "a kind that this test does not know";
  ++kind->found;
  EXPECT_EQ(limit.bound, kind->bound);
  EXPECT_EQ(limit.unit, kind->unit);
  EXPECT_EQ(limit.at_most, kind->at_most);
  EXPECT_TRUE(std::isfinite(limit.value));
  const double left = kind->at_most ? limit.bound - limit.value : limit.value - limit.bound;
  EXPECT_NEAR(limit.left, left, 1e-9) << "rounding of numbers of 10000";
}

void expect_all_found(const std::vector<Kind>& kinds) {
  for (const Kind& k : kinds) EXPECT_GT(k.found, 0) << k.begins << "..." << k.holds;
}

TEST(ActiveLimits, OfTheLayoutsListHaveValueBoundAndUnitWhateverTheirKind) {
  auto kinds = layout_kinds();
  kinds.push_back({"arm at rest", "", 0, "mm"});
  // As shipped, the scene states the belt's length, so that the arm's rest has to be found.
  for (const LayoutLimit& limit : layout_limits(baseline(), beyond_reach()))
    if (!of_touching_spans(limit))
      expect_kind(kinds, {"limit", limit.name, limit.measured(), limit.bound, limit.at_most, limit.value, limit.unit});
  expect_all_found(kinds);
}

class ActiveLimitsOfADesign : public testing::Test {
 protected:
  ActiveLimitsOfADesign() {
    LoadedProblem problem;
    problem.spec.scene = std::string(BELTLIFE_SCENES) + "/baseline.toml";
    problem.scene = load_scene(*problem.spec.scene, {});
    problem.scene->file.scene = layout_base(baseline());
    for (const char* path : {"pulley.idler_5.x_mm", "pulley.idler_5.y_mm", "tensioner.pivot_y_mm"}) {
      ParameterSpec& p = problem.spec.parameter.emplace_back();
      p.path = path;
      p.start = get_number(problem.scene->file.scene, path);
      p.lower = *p.start - 10;
      p.upper = *p.start + 10;
    }
    OptimizationSpec spec;
    spec.layout.emplace();
    spec.layout->limits = beyond_reach();
    const DesignProblem design(problem, spec);
    Outcome outcome;
    outcome.state = PointState::ok;
    outcome.constraints = {0.25, -2};
    active = active_limits(design,
                           {{"torque", "B100.drive_shaft.torque_n_m.order_3", 20, false, 20},
                            {"load", "hub_load_n.max", 4000, true, 4000}},
                           {0, {0, 1, 0.5}}, outcome);
    at_lower = problem.spec.parameter[0];
    at_upper = problem.spec.parameter[1];
  }

  const ActiveLimit& named(const std::string& kind, const std::string& name) const {
    const auto at = std::find_if(active.begin(), active.end(),
                                 [&](const ActiveLimit& a) { return a.kind == kind && a.name == name; });
    EXPECT_NE(at, active.end()) << name;
    return at == active.end() ? active.front() : *at;
  }

  std::vector<ActiveLimit> active;
  ParameterSpec at_lower, at_upper;
};

TEST_F(ActiveLimitsOfADesign, HaveValueBoundAndUnitWhateverTheirKind) {
  auto kinds = layout_kinds();
  for (const ActiveLimit& a : active)
    if (a.kind == "limit" && !of_touching_spans(a)) expect_kind(kinds, a);
  expect_all_found(kinds);

  const ActiveLimit& torque = named("constraint", "torque");
  EXPECT_EQ(torque.value, 20.25);
  EXPECT_EQ(torque.bound, 20);
  EXPECT_EQ(torque.unit, "N m");
  EXPECT_EQ(torque.at_most, false);
  const ActiveLimit& load = named("constraint", "load");
  EXPECT_EQ(load.value, 4002);
  EXPECT_EQ(load.bound, 4000);
  EXPECT_EQ(load.unit, "N");
  EXPECT_EQ(load.at_most, true);

  const ActiveLimit& lower = named("lower bound", at_lower.path);
  EXPECT_EQ(lower.value, *at_lower.lower);
  EXPECT_EQ(lower.bound, *at_lower.lower);
  EXPECT_EQ(lower.unit, "mm");
  EXPECT_EQ(lower.at_most, false);
  const ActiveLimit& upper = named("upper bound", at_upper.path);
  EXPECT_EQ(upper.value, *at_upper.upper);
  EXPECT_EQ(upper.bound, *at_upper.upper);
  EXPECT_EQ(upper.unit, "mm");
  EXPECT_EQ(upper.at_most, true);
}

TEST_F(ActiveLimitsOfADesign, SayAllOfItInJson) {
  for (const ActiveLimit& a : active) {
    const nlohmann::json j = json_of_answer(a);
    SCOPED_TRACE(j.dump());
    for (const char* number : {"value", "bound", "left"}) EXPECT_TRUE(j[number].is_number()) << number;
    for (const char* text : {"kind", "name", "unit"}) EXPECT_TRUE(j[text].is_string()) << text;
    const auto back = answer_of_json<ActiveLimit>(j);
    EXPECT_EQ(json_of_answer(back), j);
  }
}

}  // namespace
}  // namespace beltlife
