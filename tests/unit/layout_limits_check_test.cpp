// Owns the tests of the table [layout] as it is read and checked against a scene.
#include "optimize/layout/layout_limits.h"
#include "tests/unit/scene_fixture.h"

namespace beltlife {
namespace {

LayoutLimitsSpec read_limits(const std::string& text, const SceneSpec& scene, ReadLog& log) {
  log.file = "layout.toml";
  auto spec = read_spec<LayoutLimitsSpec>(parse_toml(text, log.file), log);
  check_layout_limits(spec, scene, log, {});
  return spec;
}

TEST(LayoutLimitsSpec, IsReadAndCheckedAgainstTheScene) {
  const std::string good =
      "min_wrap_deg = 12\ntravel_deg = 4\nbox = { x_min_mm = 0, x_max_mm = 1, y_min_mm = 0, y_max_mm = 1 }\n"
      "[take_up]\nlonger_mm = 10\n[[wrap]]\npulley = \"crank\"\nmin_deg = 120\n"
      "[[keep_out]]\nname = \"pump\"\npolygon = { x_mm = [0, 1, 0], y_mm = [0, 0, 1] }\nmargin_mm = 3\n";
  const SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml").scene;
  ReadLog log;
  const auto spec = read_limits(good, scene, log);
  EXPECT_TRUE(log.problems.empty()) << log.problems[0].what;
  EXPECT_EQ(spec.keep_out.at(0).polygon->x_mm.size(), 3u);
  EXPECT_EQ(spec.wrap.at(0).min_deg, 120);
  EXPECT_EQ(spec.min_span_mm, 20);
  struct Mistake {
    const char *from, *to, *key, *what;
  };
  for (const Mistake& m : {
           Mistake{"\"crank\"", "\"krank\"", "wrap.0.pulley", "did you mean 'crank'?"},
           Mistake{"min_deg = 120\n", "min_deg = 120\n[[wrap]]\npulley = \"crank\"\nmin_deg = 1\n", "wrap.1.pulley",
                   "a limit already"},
           Mistake{"[0, 0, 1]", "[0, 0]", "keep_out.pump.polygon.y_mm", "has 2 entries, x_mm has 3"},
           Mistake{"x_mm = [0, 1, 0], y_mm = [0, 0, 1]", "x_mm = [0, 1], y_mm = [0, 0]", "keep_out.pump.polygon.x_mm",
                   "2 corners enclose nothing"},
           Mistake{"margin_mm = 3\n", "margin_mm = 3\ncircle = { x_mm = 0, y_mm = 0, radius_mm = 3 }\n",
                   "keep_out.pump.circle", "polygon is given too"},
           Mistake{"x_max_mm = 1,", "x_max_mm = 0,", "box.x_max_mm", "does not exceed"},
           Mistake{"travel_deg = 4", "min_unstretched_length_mm = 9\nmax_unstretched_length_mm = 8",
                   "max_unstretched_length_mm", "is less"},
       }) {
    ReadLog wrong;
    read_limits(scene_fixture::replaced(good, m.from, m.to), scene, wrong);
    ASSERT_EQ(wrong.problems.size(), 1u) << m.key;
    EXPECT_EQ(wrong.problems[0].key, m.key);
    EXPECT_NE(wrong.problems[0].what.find(m.what), std::string::npos) << wrong.problems[0].what;
    EXPECT_GT(wrong.problems[0].line, 0);
  }
  ReadLog without;
  read_limits("travel_deg = 4\n", read_scene(BELTLIFE_SCENES "/two_pulley.toml", {}).scene, without);
  ASSERT_EQ(without.problems.size(), 1u);
  EXPECT_EQ(without.problems[0].what, "needs a tensioner, and there is none");
}

}  // namespace
}  // namespace beltlife
