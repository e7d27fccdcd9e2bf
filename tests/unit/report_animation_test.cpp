// The running belt on a report page: what the player gets is what was recorded, and a page without frames has none.
#include "results/pages/run/report_animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "results/pages/run/report.h"
#include "sim/eval/run_ranges.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using Settings = std::vector<std::string>;

/// A result file of a short run, without the file.
ResultFile file_of(const std::string& scene_name, const Settings& more, int frames) {
  Settings settings{"profile.settle_s=0.01", "profile.ramp_s=0.05", "profile.hold_s=0.07", "profile.evaluate_s=0.06"};
  settings.insert(settings.end(), more.begin(), more.end());
  const SceneSpec scene = read_scene(std::string(BELTLIFE_SCENES "/") + scene_name + ".toml", settings).scene;
  ResultFile file;
  file.provenance.scene_text = write_scene(scene);
  const Model model = compile(scene);
  const auto first = scene.range.empty() ? Settings{} : Settings{scene.range[0].name};
  for (RunOutcome& outcome : run_plans(model, plans_of(scene, first, nullptr), 1, {}, false, frames))
    file.runs.push_back(std::move(outcome.record));
  return file;
}

std::vector<int> bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<int> bytes;
  for (std::size_t i = 0; i + 4 <= base64.size(); i += 4) {
    unsigned word = 0;
    int have = 3;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto digit = digits.find(base64[i + k]);
      if (digit == std::string::npos) --have;
      word = word << 6 | static_cast<unsigned>(digit == std::string::npos ? 0 : digit);
    }
    for (int k = 0; k < have; ++k) bytes.push_back(static_cast<int>(word >> (16 - 8 * k) & 255));
  }
  return bytes;
}

double decoded(double level, double levels, double low, double high) { return low + (high - low) * level / levels; }

TEST(Animation, GivesThePlayerWhatWasRecordedWithinHalfAStepOfItsCoding) {
  const ResultFile file = file_of("accessory_drive", {"belt.elements=64"}, 12);
  const Subject s = subject_of(file, "r.h5");
  const nlohmann::json data = animation_data(s);
  const Frames& f = file.runs[0].windows[0].frames;
  ASSERT_EQ(f.time_s.size(), 12u);
  ASSERT_EQ(data["ranges"].size(), 1u);
  const nlohmann::json& r = data["ranges"][0];
  ASSERT_EQ(r["nodes"], 64);
  const auto xs = bytes_of(r["x"]), ys = bytes_of(r["y"]), tensions = bytes_of(r["tension"]);
  ASSERT_EQ(xs.size(), 2u * 12 * 64);
  ASSERT_EQ(ys.size(), xs.size());
  ASSERT_EQ(tensions.size(), 12u * 64);
  const auto box = data["box"].get<std::vector<double>>();
  const auto range = r["tension_n"].get<std::vector<double>>();
  const double half = 0.5 + 1e-6;  // a step, and the rounding of doubles
  for (std::size_t i = 0; i < f.x_m.size(); ++i) {
    EXPECT_NEAR(decoded(xs[2 * i] + 256 * xs[2 * i + 1], 65535, box[0], box[1]), f.x_m[i],
                half * (box[1] - box[0]) / 65535);
    EXPECT_NEAR(decoded(ys[2 * i] + 256 * ys[2 * i + 1], 65535, box[2], box[3]), f.y_m[i],
                half * (box[3] - box[2]) / 65535);
    EXPECT_NEAR(decoded(tensions[i], 255, range[0], range[1]), f.tension_n[i], half * (range[1] - range[0]) / 255);
  }
  const std::size_t pulleys = f.pulleys(), arm = data["arm"]["pulley"];
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_NEAR(r["time_ms"][k], 1e3 * (f.time_s[k] - f.time_s[0]), 0.5e-3 + 1e-9);
    EXPECT_NEAR(r["centre"][k][0], f.pulley_x_m[k * pulleys + arm], 0.5e-6 + 1e-12);
    EXPECT_NEAR(r["centre"][k][1], f.pulley_y_m[k * pulleys + arm], 0.5e-6 + 1e-12);
    for (std::size_t p = 0; p < pulleys; ++p) {
      EXPECT_NEAR(
          std::remainder(r["turn"][k][p].get<double>() - f.pulley_angle_rad[k * pulleys + p], 2 * std::numbers::pi), 0,
          0.5e-3 + 1e-9);
    }
  }
  EXPECT_GE(r["turn"][0][0], 0);
  EXPECT_LT(r["turn"][0][0], 2 * std::numbers::pi + 1e-3);
}

TEST(Animation, LeavesOutNodesAndThenFramesSoThatThePageStaysSmall) {
  const Subject whole = subject_of(file_of("two_pulley", {"belt.elements=512"}, 160), "r.h5");
  EXPECT_EQ(animation_data(whole)["ranges"][0]["nodes"], 512);
  const auto many = [](std::size_t ranges) {
    ResultFile file = file_of("two_pulley", {"belt.elements=512"}, 160);
    file.runs[0].windows.resize(ranges, file.runs[0].windows[0]);
    return animation_section(subject_of(file, "r.h5"));
  };
  for (std::size_t ranges : {4, 30}) {
    const std::string html = many(ranges);
    EXPECT_GT(html.size(), 0.5e6) << ranges;
    EXPECT_LT(html.size(), 1.5e6) << ranges;
  }
}

TEST(Animation, EndsWithTheLastFrameEvenIfFramesAreLeftOut) {
  ResultFile file = file_of("two_pulley", {"belt.elements=512"}, 160);
  const Frames f = file.runs[0].windows[0].frames;
  file.runs[0].windows.resize(30, file.runs[0].windows[0]);
  const nlohmann::json data = animation_data(subject_of(file, "r.h5")), &r = data["ranges"][29];
  const std::size_t frames = r["time_ms"].size(), nodes = r["nodes"];
  EXPECT_LT(frames, 160u);
  EXPECT_LT(nodes, 512u);
  const auto xs = bytes_of(r["x"]);
  ASSERT_EQ(xs.size(), 2 * frames * nodes);
  const std::size_t at = 2 * (frames - 1) * nodes;
  const auto box = data["box"].get<std::vector<double>>();
  EXPECT_NEAR(decoded(xs[at] + 256 * xs[at + 1], 65535, box[0], box[1]), f.x_m[159 * 512],
              0.51 * (box[1] - box[0]) / 65535);
}

TEST(Animation, OfARingOrOfNoFrames) {
  EXPECT_NE(animation_section(subject_of(file_of("spinning_ring", {"belt.elements=64"}, 5), "r.h5")), "");
  EXPECT_EQ(animation_section(subject_of(file_of("two_pulley", {"belt.elements=64"}, 1), "r.h5")), "");
  const std::string page = report_html(file_of("two_pulley", {"belt.elements=64"}, 0), "r.h5");
  EXPECT_EQ(page.find("id=\"animation"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST(Animation, OfAWindowThatTheRunDidNotFinishIsLeftOut) {
  ResultFile file = file_of("two_pulley", {"belt.elements=64"}, 4);
  file.runs[0].windows.resize(2, file.runs[0].windows[0]);
  file.runs[0].windows[0].complete = false;
  file.runs[0].windows[0].frames.x_m[5] = std::nan("");  // as after a divergence
  const nlohmann::json data = animation_data(subject_of(file, "r.h5"));
  ASSERT_EQ(data["ranges"].size(), 1u);
  EXPECT_EQ(data["first"], 0);
  EXPECT_TRUE(std::isfinite(data["box"][0].get<double>()));
}

TEST(Animation, LetsNoNameOutOfItsScriptOrItsList) {
  ResultFile file = file_of("two_pulley", {"belt.elements=64"}, 3);
  file.runs[0].windows[0].range = "</script><b>&\"";
  const std::string html = animation_section(subject_of(file, "r.h5"));
  EXPECT_EQ(html.find("</script><b>"), std::string::npos);
  EXPECT_NE(html.find("&lt;/script&gt;&lt;b&gt;&amp;"), std::string::npos);
  EXPECT_NE(html.find("\\u003c/script>\\u003cb>&\\\""), std::string::npos);
}

}  // namespace
}  // namespace beltlife
