// Owns the tests of the page that compares result files, and of the comparison of scenes in it.
#include "results/pages/run/report_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

#include "results/pages/run/report_compare_parts.h"
#include "results/pages/run/scene_differences.h"
#include "sim/eval/run_ranges.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using Settings = std::vector<std::string>;

SceneSpec scene_of(const std::string& name, const Settings& more = {}) {
  Settings settings{"profile.settle_s=0.01", "profile.ramp_s=0.05", "profile.hold_s=0.2", "profile.evaluate_s=0.15",
                    "belt.elements=64"};
  settings.insert(settings.end(), more.begin(), more.end());
  return read_scene(std::string(BELTLIFE_SCENES "/") + name + ".toml", settings).scene;
}

/// A result file of short runs of the scene's ranges, or of those named, without the file.
ResultFile file_of(const SceneSpec& scene, Settings ranges = {}) {
  ResultFile file;
  file.provenance.scene_text = write_scene(scene);
  if (ranges.empty())
    for (const RangeSpec& range : scene.range) ranges.push_back(range.name);
  for (RunOutcome& outcome : run_plans(compile(scene), plans_of(scene, ranges, nullptr), 1, {}, false, 0))
    file.runs.push_back(std::move(outcome.record));
  return file;
}

bool has(const std::string& page, const std::string& words) { return page.find(words) != std::string::npos; }

/// What stands between the first `from` and the next `to`.
std::string between(const std::string& page, const std::string& from, const std::string& to) {
  const auto begin = page.find(from);
  return begin == page.npos ? "" : page.substr(begin, page.find(to, begin) - begin);
}

TEST(SceneDifferences, NamesTheFieldsThatDifferWithTheValueOfEach) {
  const SceneSpec a = scene_of("two_pulley"), b = scene_of("two_pulley", {"belt.friction_front=0.45"});
  const auto differences = scene_differences({&a, &b, &a});
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0].path, "belt.friction_front");
  ASSERT_EQ(differences[0].values.size(), 3u);
  EXPECT_EQ(differences[0].values[1], "0.45");
  EXPECT_EQ(differences[0].values[0], differences[0].values[2]);
  EXPECT_TRUE(scene_differences({&a, &a}).empty());
}

TEST(SceneDifferences, TellsElementsApartByNameAndShowsADashWhereOneIsMissing) {
  const SceneSpec a = scene_of("two_pulley");
  SceneSpec turned = a, fewer = a;
  std::swap(turned.range[0], turned.range[1]);
  EXPECT_TRUE(scene_differences({&a, &turned}).empty()) << "the order of ranges is no field";
  const std::string name = fewer.range.back().name;
  fewer.range.pop_back();
  const auto differences = scene_differences({&fewer, &a});
  ASSERT_FALSE(differences.empty());
  for (const SceneDifference& d : differences) {
    EXPECT_TRUE(d.path.starts_with("range." + name + ".")) << d.path;
    EXPECT_EQ(d.values[0], "-") << d.path;
    EXPECT_NE(d.values[1], "-") << d.path;
  }
}

TEST(Comparison, ShowsLivesWithFactorsSpansByNameAndWhatDiffers) {
  const ResultFile a = file_of(scene_of("two_pulley")),
                   b = file_of(scene_of("two_pulley", {"pulley.driven.x_mm=260", "belt.elements=72"}));
  const std::string page = comparison_html({{"x/first.h5", a}, {"y/second.h5", b}});
  for (const char* id : {"summary",
                         "key-numbers",
                         "layout",
                         "layout-1",
                         "layout-2",
                         "life",
                         "life-ranges",
                         "scenes",
                         "scenes-table",
                         "ranges",
                         "range-slow",
                         "range-slow-trace-speed_rpm",
                         "range-slow-spectrum-torque_n_m",
                         "range-fast-orders",
                         "range-slow-tensions",
                         "range-slow-hub-loads",
                         "range-slow-slip",
                         "range-slow-losses",
                         "warnings",
                         "provenance"})
    EXPECT_TRUE(has(page, "id=\"" + std::string(id) + "\"")) << id;
  EXPECT_TRUE(has(between(page, "id=\"scenes-table\"", "</table>"), "pulley.driven.x_mm"));
  EXPECT_TRUE(has(page, "They also differ in how they were computed (belt.elements)"));

  // Lives and factor are those of the files by themselves.
  const double life_a = subject_of(a, "a").life->life_h, life_b = subject_of(b, "b").life->life_h;
  EXPECT_TRUE(has(between(page, "class=\"lead\"", "</p>"), html_rounded(life_b / life_a, 3) + " times"));
  const std::string lives = between(page, "id=\"life-ranges\"", "</table>");
  EXPECT_TRUE(has(lives, html_number(life_a)) && has(lives, html_number(life_b))) << lives;

  std::map<std::string, int> count;
  const std::regex pattern(R"(\bid=['"]([^'"]+)['"])");
  for (std::sregex_iterator i(page.begin(), page.end(), pattern), end; i != end; ++i) ++count[(*i)[1]];
  for (const auto& [id, times] : count) EXPECT_EQ(times, 1) << id;
}

TEST(Comparison, DrawsBothLayoutsToOneScaleWithTheFirstDashedBeneathTheSecond) {
  const ResultFile a = file_of(scene_of("two_pulley"), {"slow"}),
                   b = file_of(scene_of("two_pulley", {"pulley.driven.x_mm=400"}), {"slow"});
  const std::string page = comparison_html({{"a.h5", a}, {"b.h5", b}});
  const std::string first = between(page, "id=\"layout-1\"", "</svg>"),
                    second = between(page, "id=\"layout-2\"", "</svg>");
  const std::regex box(R"re(viewBox="([^"]*)")re");
  std::smatch of_first, of_second;
  ASSERT_TRUE(std::regex_search(first, of_first, box) && std::regex_search(second, of_second, box));
  EXPECT_EQ(of_first[1], of_second[1]);
  EXPECT_FALSE(has(first, "stroke-dasharray"));
  EXPECT_TRUE(has(second, "stroke-dasharray"));
}

TEST(Comparison, LeavesOutWhatNoFileHasAndMarksWhatSomeLack) {
  const SceneSpec scene = scene_of("two_pulley");
  const ResultFile all = file_of(scene), slow = file_of(scene, {"slow"}), ring = file_of(scene_of("spinning_ring"));
  const std::string page = comparison_html({{"all.h5", all}, {"slow.h5", slow}, {"ring.h5", ring}});
  EXPECT_TRUE(has(page, "fast; not in slow, ring"));
  EXPECT_TRUE(has(page, "their lives cannot be compared")) << "they are over other ranges";
  const std::string both_rings = comparison_html({{"r.h5", ring}, {"r.h5", ring}});
  EXPECT_FALSE(has(both_rings, "id=\"layout\""));
  EXPECT_FALSE(has(both_rings, "id=\"life\""));
  EXPECT_TRUE(has(both_rings, "r.h5 (2)")) << "labels of the same file differ";
}

TEST(Comparison, StatesChangesInPerCentOfTheFirst) {
  using compare_page::change_text;
  EXPECT_EQ(change_text(103.1, 100), "+3.1");
  EXPECT_EQ(change_text(96, 100), "-4.0");
  EXPECT_EQ(change_text(100.001, 100), "0.0");
  EXPECT_EQ(change_text(1, 0), "-");
  EXPECT_EQ(change_text(std::nan(""), 1), "-");
}

TEST(Comparison, IsNamedAfterItsFilesBesideTheFirst) {
  EXPECT_EQ(comparison_page_beside({"x/a.h5", "y/b.h5"}), "x/a_vs_b.html");
  EXPECT_EQ(comparison_page_beside({"a.h5", "b.h5", "c.h5", "d.h5"}), "a_vs_b_and_2_more.html");
}

}  // namespace
}  // namespace beltlife
