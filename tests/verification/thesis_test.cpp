// Owns the facts that the thesis found by computing and that this drive must show again: slip and its threshold.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "sim/run.h"
#include "sim/scene/scene_io.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

/// The baseline at B100 with 256 elements, whose order 3 is within 1 % of that of 512. It has settled 0.2 s after the
/// ramp, in which the belt slips: from then on means over 0.2 s differ by no more than 2 %.
RunRecord b100(std::vector<std::string> settings) {
  for (const char* s : {"belt.elements=256", "profile.settle_s=0.1", "profile.ramp_s=0.4", "profile.hold_s=0.7",
                        "profile.evaluate_s=0.4"})
    settings.push_back(s);
  const SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml", settings).scene;
  RunRecord record = run(compile(scene), plan_range(scene, scene.range[2])).record;
  EXPECT_TRUE(record.status.ok()) << record.status.cause;
  return record;
}

std::span<const double> window(const RunRecord& record, const char* name) {
  const WindowRecord& w = record.windows.at(0);
  return std::span(record.trace.find(name)->values).subspan(w.first_sample, w.last_sample - w.first_sample);
}

double mean(const RunRecord& record, const char* name) {
  double sum = 0;
  for (const double v : window(record, name)) sum += v;
  return sum / static_cast<double>(window(record, name).size());
}

double order_3(const RunRecord& record, const char* name) {
  const auto orders = default_orders();
  for (const auto& o : track_orders(window(record, name), window(record, "driver.angle_rad"), orders))
    if (o.order == 3) return o.amplitude;
  return 0;
}

TEST(ThesisDrive, DoesNotSlipAtItsFriction) {
  const RunRecord record = b100({});
  // Creep of a belt of EA 140563 N between 820 and 1370 N is 0.4 %; bending loss at the crank adds a little.
  for (const char* pulley : {"drive", "idler_2", "idler_3", "idler_5", "tensioner", "idler_7"})
    EXPECT_LT(std::abs(mean(record, ("pulley." + std::string(pulley) + ".slip_percent").c_str())), 1.0) << pulley;
}

TEST(ThesisDrive, SlipsGrosslyIfItsTorqueActedAtTheTurbine) {
  const RunRecord record = b100({"torque.turbine_torque.referred_to=turbine"});
  // The crank drags the belt over the drive pulley, which turns 23 % too slowly: 23.2 % with 512 elements. Means over
  // 0.2 s differ by 2 % of it, and the coarser mesh shifts it by less.
  EXPECT_NEAR(mean(record, "pulley.drive.slip_percent"), -23.2, 1);
}

TEST(ThesisDrive, AnswersTheEngineLessOnceItsFrictionFallsBelowTheThreshold) {
  const RunRecord full = b100({}), more = b100({"belt.friction_front=1"}), less = b100({"belt.friction_front=0.4"});
  for (const char* output : {"drive_shaft.speed_rpm", "drive_shaft.torque_n_m"}) {
    const double at_full = order_3(full, output);
    // Table 4.1: none from 0.6 to 1, a decrease at 0.4. In this reading of the pretension it is of order 10 %.
    EXPECT_NEAR(order_3(more, output) / at_full, 1, 0.03) << output;
    EXPECT_LT(order_3(less, output) / at_full, 0.95) << output;
    EXPECT_GT(order_3(less, output) / at_full, 0.80) << output;
  }
}

}  // namespace
}  // namespace beltlife
