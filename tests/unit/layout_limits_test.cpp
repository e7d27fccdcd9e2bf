// Owns the tests of a layout's limits: known distances, one fixed list for all layouts, agreement with solve_statics().
#include "optimize/layout/layout_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "optimize/layout/layout_base.h"
#include "sim/modes/modes.h"
#include "sim/scene/scene_io.h"
#include "sim/statics/quasi_static.h"

namespace beltlife {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double exact = 1e-9;  // mm or degrees: rounding of some dozen operations on numbers of 1000

SceneSpec shipped(const std::string& name) {
  return read_scene(std::string(BELTLIFE_SCENES "/") + name + ".toml").scene;
}

LayoutLimitsSpec no_minima() {
  LayoutLimitsSpec spec;
  spec.min_pulley_clearance_mm = spec.min_belt_clearance_mm = spec.min_wrap_deg = spec.min_span_mm = 0;
  spec.min_arm_leverage_mm = 0;
  return spec;
}

std::map<std::string, double> values(const SceneSpec& scene, const LayoutLimitsSpec& spec) {
  std::map<std::string, double> all;
  for (const LayoutLimit& c : layout_limits(scene, spec)) all[c.name] = c.value;
  return all;
}

PulleySpec pulley(const char* name, double x, double y, double diameter, Side side = Side::front) {
  PulleySpec p;
  p.name = name;
  p.x_mm = x;
  p.y_mm = y;
  p.pitch_diameter_mm = diameter;
  p.side = side;
  p.inertia_kg_m2 = 0.01;
  return p;
}

// Pulleys of 60 mm radius at (0, 0) and (500, 0); taken in this order, counterclockwise, the span
// crank-rider runs at y = -60, the span rider-crank at y = 60.
SceneSpec two_pulleys() {
  SceneSpec scene;
  scene.belt.axial_stiffness_n = 1e5;
  scene.belt.mass_kg_per_m = 0.1;
  scene.belt.ribs = 6;
  scene.belt.pretension_n = 700;
  scene.pulley = {pulley("crank", 0, 0, 120), pulley("rider", 500, 0, 120)};
  return scene;
}

// The same with the right pulley upright on an arm of 200 mm.
SceneSpec on_arm() {
  SceneSpec scene = two_pulleys();
  scene.belt.balanced_as_placed = true;
  TensionerSpec t;
  t.pulley = "rider";
  t.pivot_x_mm = 500;
  t.pivot_y_mm = -200;
  t.inertia_kg_m2 = 1e-3;
  t.spring_rate_n_m_per_rad = 30;
  scene.tensioner = t;
  return scene;
}

TEST(LayoutLimits, OfTwoPulleysAreTheDistancesOnPaper) {
  SceneSpec scene = two_pulleys();
  LayoutLimitsSpec spec;
  spec.wrap = {{"rider", 150}};
  spec.box = LayoutBoxSpec{-100, 570, -200, 80};
  spec.max_unstretched_length_mm = 1400;
  spec.min_unstretched_length_mm = 1300;
  auto v = values(scene, spec);
  EXPECT_NEAR(v.at("pulleys crank and rider"), 380 - 10, exact);
  EXPECT_NEAR(v.at("wrap on crank"), 180 - 10, exact);
  EXPECT_NEAR(v.at("wrap on rider"), 180 - 150, exact);
  EXPECT_NEAR(v.at("span crank-rider"), 500 - 20, exact);
  EXPECT_NEAR(v.at("belt crank-rider and belt rider-crank"), 120, exact);
  EXPECT_NEAR(v.at("box and pulley crank"), 20, exact);
  EXPECT_NEAR(v.at("box and pulley rider"), 10, exact);
  const double length = (1000 + 120 * pi) / 1.007;
  EXPECT_NEAR(v.at("shortest belt"), length - 1300, exact);
  EXPECT_NEAR(v.at("longest belt"), 1400 - length, exact);
  for (double d : {119.0, 60.0, 3.0, 0.0}) {  // of unequal circles, down to one inside the other
    scene.pulley[1] = pulley("rider", d, 0, 60);
    v = values(scene, no_minima());
    EXPECT_NEAR(v.at("pulleys crank and rider"), d - 90, exact) << d;
    EXPECT_NEAR(v.at("span crank-rider"), d > 30 ? std::sqrt(d * d - 900) : d - 30, exact) << d;
  }
}

TEST(LayoutLimits, KeepOutsAreSignedDistances) {
  const SceneSpec scene = two_pulleys();
  LayoutLimitsSpec spec;
  KeepOutSpec above{"above", 0, {}, KeepOutPolygonSpec{{200, 300, 300, 200}, {70, 70, 90, 90}}};
  KeepOutSpec across{"across", 2, {}, KeepOutPolygonSpec{{200, 200, 300, 300}, {50, 70, 70, 50}}};  // the other way
  KeepOutSpec corner{"corner", 0, {}, KeepOutPolygonSpec{{250, 249, 251}, {59, 69, 69}}};  // its tip 1 mm in the belt
  KeepOutSpec around{"around", 0, {}, KeepOutPolygonSpec{{-400, 900, 900, -400}, {-400, -400, 400, 400}}};
  KeepOutSpec post{"post", 1, KeepOutCircleSpec{250, 60, 5}, {}};
  spec.keep_out = {above, across, corner, around, post};
  const auto v = values(scene, spec);
  EXPECT_NEAR(v.at("keep-out above and belt rider-crank"), 10, exact);
  EXPECT_NEAR(v.at("keep-out above and belt crank-rider"), 130, exact);
  EXPECT_NEAR(v.at("keep-out above and pulley crank"), std::hypot(200, 70) - 60, exact);
  EXPECT_NEAR(v.at("keep-out across and belt rider-crank"), -10 - 2, 1e-6);  // searched by thirds, 40 times
  EXPECT_NEAR(v.at("keep-out across and belt crank-rider"), 110 - 2, exact);
  // Inside the triangle the belt is at most as far from its sides as half its width there, 0.1 mm, less a little.
  EXPECT_LT(v.at("keep-out corner and belt rider-crank"), -0.09);
  EXPECT_GT(v.at("keep-out corner and belt rider-crank"), -0.1);
  EXPECT_NEAR(v.at("keep-out around and pulley crank"), -400 - 60, exact);
  EXPECT_NEAR(v.at("keep-out around and belt rider-crank"), -340, 1e-6);
  EXPECT_NEAR(v.at("keep-out post and belt rider-crank"), -6, exact);
  EXPECT_NEAR(v.at("keep-out post and pulley rider"), std::hypot(250, 60) - 60 - 5 - 1, exact);
}

TEST(LayoutLimits, AWrapThatVanishesIsMissingByTheAngleByWhichTheBeltPassesOnTheOtherSide) {
  SceneSpec scene = two_pulleys();
  double before = 1e9;
  for (double lift : {-20.0, -1e-6, 1e-6, 1.0, 20.0, 35.0}) {  // of a back-side idler above the upper span
    scene.pulley = {pulley("crank", 0, 0, 120), pulley("idler", 250, 60 + 30 + lift, 60, Side::back),
                    pulley("rider", 500, 0, 120)};
    const double wrap = values(scene, no_minima()).at("wrap on idler");
    EXPECT_LT(wrap, before);
    before = wrap;
    EXPECT_EQ(wrap<0, lift> 0);
    // Both tangents lean by the same angle: asin of the radii over the distance of the centres, less the line of
    // centres.
    const double y = 90 + lift, lean = std::asin(90 / std::hypot(250, y)) - std::atan2(y, 250);
    EXPECT_NEAR(wrap, 2 * lean * 180 / pi, 1e-9) << lift;
  }
  const auto limits = layout_limits(scene, no_minima());
  const auto idler = std::find_if(limits.begin(), limits.end(), [](auto& c) { return c.name == "wrap on idler"; });
  EXPECT_NE(idler->words.find("the belt would pass it on its front side by"), std::string::npos) << idler->words;
  EXPECT_EQ(idler->key, "pulley.idler.x_mm");
}

TEST(LayoutLimits, OfAnArmAreItsLeverageAndTheLengthsItHolds) {
  SceneSpec scene = on_arm();
  scene.tensioner->stop_lengthening_deg = 10;
  scene.tensioner->stop_shortening_deg = 5;
  LayoutLimitsSpec spec;
  spec.take_up = TakeUpLimitSpec{30, 2};
  const auto v = values(scene, spec);
  EXPECT_NEAR(v.at("arm leverage"), 400 - 10, exact);
  EXPECT_EQ(v.count("arm at rest"), 0u);
  const auto unstretched = [](double a) {  // clockwise lengthens
    const double d = std::hypot(0.5 - 0.2 * std::sin(a), 0.2 * std::cos(a) - 0.2);
    const double leverage = 2 * (0.5 * 0.2 * std::cos(a) - 0.04 * std::sin(a)) / d;
    return 1e3 * (2 * d + 0.12 * pi) / (1 + (700 * 0.4 + 30 * a) / leverage / 1e5);
  };
  const double degree = pi / 180;
  EXPECT_NEAR(v.at("take-up longer"), unstretched(-10 * degree) - unstretched(0) - 30, 1e-6);  // ends to 1e-7 rad
  EXPECT_NEAR(v.at("take-up shorter"), unstretched(0) - unstretched(5 * degree) - 2, 1e-6);
  scene.belt.balanced_as_placed.reset();
  scene.belt.unstretched_length_mm = 1500;  // the stop ends at less
  const double needed = 1500 * 1.007,
               longest =
                   2 * std::hypot(500 + 200 * std::sin(10 * degree), 200 * std::cos(10 * degree) - 200) + 120 * pi;
  ASSERT_GT(needed, longest);
  EXPECT_NEAR(values(scene, spec).at("arm at rest"), longest - needed, 1e-4);
  scene.belt.unstretched_length_mm = unstretched(0) + 5;
  EXPECT_EQ(values(scene, spec).at("arm at rest"), 0);
  EXPECT_LT(values(scene, spec).at("arm leverage"), 400 - 10);  // where it rests, which is not as placed
}

TEST(LayoutLimits, OfRunningAreTheQuasiStaticSolutions) {
  SceneSpec scene = on_arm();
  scene.tensioner->friction_torque_n_m = 5;
  scene.tensioner->stop_lengthening_deg = 15;
  scene.tensioner->stop_shortening_deg = 12;
  scene.belt.friction_front = 0.6;
  scene.driver = DriverSpec{};
  scene.driver->body = "crank";
  scene.torque = {{"load", "rider", {500, 3000}, {-12, -10}, {}}};
  scene.range = {{"slow", 800, 0.5}, {"fast", 2500, 0.3}, {"fast_again", 2500, 0.2}};
  validate(scene);
  LayoutLimitsSpec spec;
  spec.travel_deg = 3;
  spec.min_slip_safety = 1.5;
  spec.max_hub_load_n = 1600;
  const auto v = values(scene, spec);
  const Model model = compile(scene);
  double low = pi, high = -pi;
  for (const RangeSpec& range : scene.range) {
    const QuasiStaticRange q = solve_quasi_static(model, range);
    ASSERT_FALSE(q.error);
    low = std::min(low, *q.arm_angle_low);
    high = std::max(high, *q.arm_angle_high);
    double safety = 1e9, load = 0;
    for (const auto& p : q.pulleys) {
      safety = std::min(safety, p.slip_safety.value_or(1e9));
      load = std::max(load, p.hub_load_high);
    }
    EXPECT_NEAR(v.at("slip safety in " + range.name), safety - 1.5, exact);
    EXPECT_NEAR(v.at("hub load in " + range.name), 1600 - load, exact);
  }
  EXPECT_NEAR(v.at("travel lengthening"), 15 + low * 180 / pi - 3, 1e-4);  // clockwise lengthens; ends to 1e-7 rad
  EXPECT_NEAR(v.at("travel shortening"), 12 - high * 180 / pi - 3, 1e-4);
  LayoutLimitsSpec slip_only;
  slip_only.min_slip_safety = 1.5;
  EXPECT_NEAR(values(scene, slip_only).at("slip safety in slow"), v.at("slip safety in slow"), 1e-6);  // without band

  scene.pulley[1].x_mm = 60;  // cannot be built
  scene.tensioner->pivot_x_mm = 60;
  const auto broken = values(scene, spec);
  EXPECT_EQ(broken.size(), v.size());
  EXPECT_EQ(broken.at("slip safety in slow"), -1.5);
  EXPECT_EQ(broken.at("hub load in slow"), -1600);
  EXPECT_EQ(broken.at("travel shortening"), -3);
}

TEST(LayoutLimits, OfModesAreTheNearestRotationalFrequencyToAnOrder) {
  const SceneSpec scene = shipped("two_pulley");
  LayoutLimitsSpec spec = no_minima();
  spec.modes = ModesLimitSpec{{2, 3}, 25};
  const auto v = values(scene, spec);
  const Model model = compile(scene);
  for (const RangeSpec& range : scene.range) {
    double least = 100;
    for (const ArmModes& arm : solve_modes(model, range).arms)
      for (const Mode& mode : arm.modes)
        for (const double hz : {2 * range.crank_rpm / 60, 3 * range.crank_rpm / 60})
          least = std::min(least, 100 * std::abs(mode.frequency_hz / hz - 1));
    ASSERT_LT(least, 100) << "the drive has a frequency near an order";
    EXPECT_NEAR(v.at("modes in " + range.name), least - 25, exact);
  }
  SceneSpec overlapping = scene;
  overlapping.pulley[1].x_mm = 20;
  EXPECT_EQ(values(overlapping, spec).at("modes in " + scene.range[0].name), -25);
}

TEST(LayoutLimits, OfADriveTunedOntoAnOrderSayWhichFrequencyMeetsIt) {
  SceneSpec scene = shipped("two_pulley");
  const double hz = solve_modes(compile(scene), scene.range[0]).arms[0].modes.back().frequency_hz;
  LayoutLimitsSpec spec = no_minima();
  spec.modes = ModesLimitSpec{{hz * 60 / scene.range[0].crank_rpm}, 5};
  for (const LayoutLimit& c : layout_limits(scene, spec))
    if (c.name == "modes in " + scene.range[0].name) {
      EXPECT_NEAR(c.value, -5, 1e-6);  // percent: exactly on it, but for rounding
      EXPECT_NE(c.words.find(" Hz is 0.0 % away from order "), c.words.npos) << c.words;
      return;
    }
  FAIL() << "no such limit";
}

// The baseline with idlers, tensioner pulley and pivot moved inside boxes of this size.
SceneSpec moved(const SceneSpec& base, double box_mm, std::mt19937_64& random) {
  SceneSpec scene = base;
  const auto shift = [&] { return box_mm * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
  for (PulleySpec& p : scene.pulley)
    if (p.name.starts_with("idler") || p.name == "tensioner") {
      p.x_mm += shift();
      p.y_mm += shift();
    }
  scene.tensioner->pivot_x_mm += shift();
  scene.tensioner->pivot_y_mm += shift();
  return scene;
}

TEST(LayoutLimits, AreOneListForAllLayoutsAndNegativeExactlyWhereStaticsRefuses) {
  const SceneSpec base = layout_base(shipped("baseline"));
  LayoutLimitsSpec spec = no_minima();
  spec.take_up = TakeUpLimitSpec{5, 5};
  spec.keep_out = {{"post", 5, KeepOutCircleSpec{-100, 300, 20}, {}}};
  const auto first = layout_limits(base, spec);
  std::mt19937_64 random(1);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const SceneSpec scene = moved(base, i % 2 ? 60 : 180, random);
    std::vector<LayoutLimit> limits;
    ASSERT_NO_THROW(limits = layout_limits(scene, spec));
    ASSERT_EQ(limits.size(), first.size());
    bool clear = true;
    for (std::size_t k = 0; k < limits.size(); ++k) {
      ASSERT_EQ(limits[k].name, first[k].name);
      ASSERT_TRUE(std::isfinite(limits[k].value)) << limits[k].name;
      ASSERT_EQ(limits[k].words.empty(), limits[k].value >= 0) << limits[k].name;
      const bool basic = !limits[k].name.starts_with("take-up") && !limits[k].name.starts_with("keep-out");
      clear = clear && (!basic || limits[k].value >= 0);
    }
    std::string words;
    try {
      solve_statics(scene);
    } catch (const BadInput& bad) {
      words = bad.what();
    }
    ASSERT_EQ(clear, words.empty()) << i << ": " << words;
    ++(clear ? accepted : refused);
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

TEST(LayoutLimits, ChangeLittleWithSmallMovesAlsoAcrossTheBorderOfWhatCanBeBuilt) {
  const SceneSpec base = layout_base(shipped("baseline"));
  const LayoutLimitsSpec spec = no_minima();
  const auto clear = [&](const SceneSpec& scene) {
    const auto limits = layout_limits(scene, spec);
    return std::all_of(limits.begin(), limits.end(), [](const LayoutLimit& c) { return c.value >= 0; });
  };
  std::mt19937_64 random(2);
  int borders = 0;
  for (int i = 0; i < 200; ++i) {
    const SceneSpec far = moved(base, 240, random);
    const auto between = [&](double t) {
      SceneSpec scene = base;
      for (std::size_t p = 0; p < scene.pulley.size(); ++p) {
        scene.pulley[p].x_mm += t * (far.pulley[p].x_mm - base.pulley[p].x_mm);
        scene.pulley[p].y_mm += t * (far.pulley[p].y_mm - base.pulley[p].y_mm);
      }
      scene.tensioner->pivot_x_mm += t * (far.tensioner->pivot_x_mm - base.tensioner->pivot_x_mm);
      scene.tensioner->pivot_y_mm += t * (far.tensioner->pivot_y_mm - base.tensioner->pivot_y_mm);
      return scene;
    };
    double good = 0, bad = 1;
    if (clear(between(bad))) continue;
    for (int k = 0; k < 45; ++k) (clear(between(0.5 * (good + bad))) ? good : bad) = 0.5 * (good + bad);
    const auto inside = layout_limits(between(good), spec), outside = layout_limits(between(bad), spec);
    // 1e-11 of a move of 170 mm; a tangent that begins to exist grows as a root, by 1e-4 mm here.
    for (std::size_t k = 0; k < inside.size(); ++k)
      ASSERT_NEAR(inside[k].value, outside[k].value, 1e-3) << i << " " << inside[k].name;
    const double step = 1e-7;
    const auto a = layout_limits(between(0.5 * good), spec), b = layout_limits(between(0.5 * good + step), spec);
    // Up to 170 mm a unit of t; angles turn by at most a radian per 10 mm while the spans are that long.
    for (std::size_t k = 0; k < a.size(); ++k)
      ASSERT_NEAR(a[k].value, b[k].value, step * 170 * 10) << i << " " << a[k].name;
    ++borders;
  }
  EXPECT_GT(borders, 50);
}

TEST(LayoutLimits, AreFiniteWhereNothingCouldEverBeBuilt) {
  LayoutLimitsSpec spec;
  spec.take_up = TakeUpLimitSpec{5, 5};
  spec.travel_deg = spec.min_slip_safety = 1;
  spec.max_hub_load_n = 100;
  spec.keep_out = {{"plate", 0, {}, KeepOutPolygonSpec{{0, 10, 10, 0}, {0, 0, 10, 10}}}};
  const SceneSpec base = layout_base(shipped("baseline")), original = shipped("baseline");
  const auto points = [](SceneSpec& s) {
    for (PulleySpec& p : s.pulley) p.x_mm = p.y_mm = 5;
  };
  const auto row = [](SceneSpec& s) {
    for (PulleySpec& p : s.pulley) p.y_mm = 0;
  };
  const auto pivot = [](SceneSpec& s) {
    s.tensioner->pivot_x_mm = s.pulley[5].x_mm, s.tensioner->pivot_y_mm = s.pulley[5].y_mm;
  };
  const auto reversed = [](SceneSpec& s) { std::reverse(s.pulley.begin(), s.pulley.end() - 2); };
  const auto sides = [](SceneSpec& s) {
    for (PulleySpec& p : s.pulley) p.side = p.side == Side::front ? Side::back : Side::front;
  };
  const auto count = [&](const SceneSpec& drive) {
    return layout_limits(drive, spec, RunningDetail::without_bending_loss).size();
  };
  for (const SceneSpec& drive : {base, original})
    for (const std::function<void(SceneSpec&)>& spoil :
         std::vector<std::function<void(SceneSpec&)>>{points, row, pivot, reversed, sides}) {
      SceneSpec scene = drive;
      spoil(scene);
      std::vector<LayoutLimit> limits;
      ASSERT_NO_THROW(limits = layout_limits(scene, spec, RunningDetail::without_bending_loss));
      EXPECT_EQ(limits.size(), count(drive));
      for (const LayoutLimit& c : limits) EXPECT_TRUE(std::isfinite(c.value)) << c.name;
    }
}

TEST(LayoutLimits, GrowAsALayoutGoesFurtherFromWhatCanBeBuilt) {
  SceneSpec scene = layout_base(shipped("baseline"));
  double before = 0;
  for (double x = -130; x <= -50; x += 10) {  // idler_3 into idler_5's side of the crank's upper strands
    scene.pulley[2].x_mm = x;
    scene.pulley[2].y_mm = 400;
    double sum = 0;
    for (const LayoutLimit& c : layout_limits(scene, no_minima())) sum += std::max(-c.value, 0.0);
    EXPECT_GE(sum, before) << x;
    before = sum;
  }
}

TEST(LayoutLimits, AreKeptByTheShippedDrivesButForTwoPulleysOfAlternative2) {
  for (const char* name : {"baseline", "alternative_1", "alternative_2", "alternative_3", "accessory_drive"}) {
    std::vector<LayoutLimit> broken;
    for (const LayoutLimit& c : layout_limits(layout_base(shipped(name)), {}))
      if (c.value < 0) broken.push_back(c);
    if (std::string(name) != "alternative_2") {
      EXPECT_TRUE(broken.empty()) << name << ": " << broken[0].words;
    } else {
      ASSERT_EQ(broken.size(), 1u);
      EXPECT_EQ(broken[0].words, "pulleys idler_4 and tensioner are 9.6 mm apart, less than 10 mm");
      EXPECT_NEAR(broken[0].value, std::hypot(107.4 - 40, 456.3 - 400) - 41.25 - 37 - 10, exact);
    }
  }
}

TEST(LayoutLimits, OfTheOriginalStatementAreThoseOfTheBase) {
  for (const char* name : {"baseline", "alternative_3", "overrunning_alternator"}) {
    const SceneSpec scene = shipped(name);
    const auto original = values(scene, {}), base = values(layout_base(scene), {});
    for (const auto& [limit, value] : base) EXPECT_NEAR(value, original.at(limit), 1e-6) << name << " " << limit;
  }
}

}  // namespace
}  // namespace beltlife
