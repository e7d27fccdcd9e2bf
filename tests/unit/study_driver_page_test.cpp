// Owns the claims about the pages of studies that sample or compare: their numbers, and that odd answers do not break.
#include <cmath>

#include "tests/unit/study_page_fixture.h"

namespace beltlife::study_test {
namespace {

using nlohmann::json;

json effect(double change, bool beyond, int responses = 1) {
  return {{"before", 2.0},
          {"after", 2.0 * (1 + change)},
          {"change", change},
          {"standard_error", 0.001},
          {"beyond_noise", beyond},
          {"visible", beyond},
          {"responses_before", 1},
          {"responses_after", responses},
          {"db", change > -1 ? 20 * std::log10(1 + change) : -200}};
}

StudyRecord oat() {
  StudyRecord r = record_of("study oat", {"settings", "driver.phase_rad"}, {odd_name, "B1.log10_life_h"});
  add_point(r, {"", 0.0}, {2, 3});
  add_failure(r, {"a=1", 0.0}, "diverged");
  json life = effect(0, true);
  life.erase("db");
  life["life_factor"] = 0.25;
  const json more{{"name", "more <friction>"},
                  {"effects", {{odd_name, effect(1.0, true, 2)}, {"B1.log10_life_h", life}}},
                  {"magnitude", "increase"},
                  {"frequency", "slight decrease"},
                  {"peak", "none"},
                  {"says_magnitude", "decrease"},
                  {"agrees_magnitude", false}};
  const json less{{"name", "less damping"},  {"effects", {{odd_name, effect(-0.01, false)}}},
                  {"magnitude", "none"},     {"frequency", "none"},
                  {"peak", "none"},          {"says_magnitude", "none"},
                  {"agrees_magnitude", true}};
  const json gone{{"name", "nothing left"}, {"effects", {{odd_name, effect(-1, true)}}}, {"magnitude", "decrease"}};
  const json failed{{"name", "no belt"}, {"failure", "diverged: at <idler>"}};
  r.answer = {{"visible", 0.05},
              {"replicates", 4},
              {"variants",
               {{{"name", "as the scene"}, {"changes", {less, more, gone, failed}}, {"said", 2}, {"agreed", 1}},
                {{"name", "ripple <2>"}, {"changes", {less}}, {"said", 1}, {"agreed", 1}}}}};
  return r;
}

StudyRecord morris() {
  StudyRecord r = record_of("study morris", {"belt.friction_front", "belt.<b>", "belt.still"}, {"B1.a_n_m", "B1.zero"});
  for (int i = 0; i < 4; ++i) add_point(r, {0.1 * i, 1.0 * i, 2.0}, {1.0 + i, 0});
  const auto effects = [](json mu_star, double sigma, bool noise) {
    return json{{"mu", -1.5},           {"mu_star", std::move(mu_star)},
                {"sigma", sigma},       {"mu_star_error", 0.125},
                {"effects", 9},         {"noise_floor", 0.5},
                {"within_noise", noise}};
  };
  r.answer = {{"parameters", r.head.parameters},
              {"trajectories", 10},
              {"levels", 4},
              {"quantities",
               {{"B1.a_n_m",
                 {{"belt.friction_front", effects(0.25, 0.1, true)},
                  {"belt.<b>", effects(3.125, 1.5, false)},
                  {"belt.still", effects(nullptr, 0, false)}}},
                {"B1.zero", {{"belt.friction_front", effects(0, 0, true)}}}}}};
  return r;
}

StudyRecord sobol() {
  StudyRecord r = record_of("study sobol", {"belt.<b>", "belt.friction_front"}, {"B1.a_n_m", "B1.still_n"});
  for (int i = 0; i < 4; ++i) add_point(r, {0.1 * i, 1.0 * i}, {1.0 + i, 0});
  const auto share = [](double v) { return json{{"value", v}, {"low", v - 0.05}, {"high", v + 0.05}}; };
  const json none{{"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
  r.answer = {{"parameters", r.head.parameters},
              {"confidence", 0.95},
              {"convergence_width", 0.05},
              {"rows", 64},
              {"rows_used", 60},
              {"quantities",
               {{"B1.a_n_m",
                 {{"first", {{"belt.<b>", share(-0.01)}, {"belt.friction_front", share(0.625)}}},
                  {"total", {{"belt.<b>", share(0.125)}, {"belt.friction_front", share(0.712)}}},
                  {"sum_first", share(0.615)},
                  {"mean", 2.5},
                  {"variance", 4.0},
                  {"converged", false},
                  {"widest_interval", 0.1},
                  {"widest_parameter", "belt.<b>"},
                  {"samples_needed", 256}}},
                {"B1.still_n",
                 {{"first", {{"belt.<b>", none}}},
                  {"total", {{"belt.<b>", none}}},
                  {"mean", 0},
                  {"variance", 0},
                  {"converged", false},
                  {"widest_interval", nullptr}}}}}};
  return r;
}

StudyRecord surrogate() {
  StudyRecord r = sobol();
  r.head.driver = "study surrogate";
  r.answer = {{"method", "chaos"},
              {"samples", 64},
              {"samples_used", 60},
              {"quantities",
               {{"B1.a_n_m",
                 {{"q2", 0.8125},
                  {"usable", false},
                  {"terms", 21},
                  {"first", {{"belt.<b>", 0.25}, {"belt.friction_front", 0.625}}},
                  {"total", {{"belt.<b>", 0.375}, {"belt.friction_front", 0.75}}},
                  {"nominal", {{"predicted", 2.5}, {"simulated", 2.25}}}}},
                {"B1.still_n", {{"q2", nullptr}, {"terms", 1}}}}}};
  return r;
}

StudyRecord uncertainty() {
  StudyRecord r = record_of("study uncertainty", {"belt.friction_front"}, {"log10_life_h", odd_name, "B1.still_n"});
  for (int i = 0; i < 64; ++i) add_point(r, {0.1 + 0.01 * i}, {2 + i / 64.0, 1.0 * i * i, 0});
  add_failure(r, {0.5}, "diverged at <idler>");
  const json interval{{"low", 2.0}, {"high", 2.5}};
  json life{{"mean", 2.5},
            {"standard_deviation", 0.3},
            {"standard_error", 0.04},
            {"percentiles", {{"10", 2.09375}, {"5", 2.0}, {"50", 2.5}}},
            {"percentile_intervals", {{"10", interval}, {"5", {{"low", nullptr}, {"high", 2.25}}}}},
            {"percentiles_by_failures", {{"10", {{"low", 2.078}, {"high", 2.11}}}}},
            {"b10_life_h", {{"value", 124.1}, {"low", 100}, {"high", 316.2}}},
            {"missing_target",
             {{"value", 0.314}, {"low", 0.21}, {"high", 0.43}, {"if_failed_hold", 0.3077}, {"if_failed_miss", 0.323}}}};
  r.answer = {{"samples", 65},
              {"confidence", 0.95},
              {"target_life_h", 200},
              {"failed_share", 1 / 65.0},
              {"quantities",
               {{"log10_life_h", life},
                {odd_name, {{"mean", 1300}, {"percentiles", {{"5", 9.5}, {"95", 3600}}}}},
                {"B1.still_n", {{"mean", 0}}}}}};
  return r;
}

TEST(StudyDriverPage, OfOneAtATimeHasVerdictsEffectsAndTornados) {
  const std::string page = page_of_study(oat(), "o.jsonl");
  expect_sound(page);
  expect_ids(
      page, {"summary", "variants", "study-variants", "changes-0", "study-verdicts-0", "study-effects-0", "tornado-0-0",
             "tornado-0-1", "changes-1", "study-verdicts-1", "tornado-1-0", "failures", "provenance"});
  expect_words(page, {"<strong>2 of 3</strong> verdicts", "<em>more &lt;friction&gt;</em>: by <strong>+6.0 dB</strong>",
                      "by a factor of <strong>0.25</strong>", "class=\"alarm\">no<", ">yes<", "+6.02 c<", "-0.09 n<",
                      "-100 %", "class=\"alarm\">failed<", "diverged: at &lt;idler&gt;", "ripple &lt;2&gt;",
                      "1 change could not be judged", ">slight decrease<"});
  EXPECT_EQ(page.find("<b>"), page.npos);
  EXPECT_FALSE(has_id(page, "points")) << "crank phases against quantities of many settings say nothing";
}

TEST(StudyDriverPage, OfOneAtATimeWithNothingSaidHasNoColumnForIt) {
  StudyRecord r = oat();
  r.answer["variants"].erase(1);
  for (json& row : r.answer["variants"][0]["changes"])
    for (const char* key : {"says_magnitude", "agrees_magnitude"}) row.erase(key);
  r.answer["variants"][0]["said"] = 0;
  const std::string page = page_of_study(r, "o");
  expect_sound(page);
  EXPECT_EQ(page.find("agree"), page.npos);
  EXPECT_FALSE(has_id(page, "variants"));
}

TEST(StudyDriverPage, OfElementaryEffectsHasTablesAndPlanes) {
  const std::string page = page_of_study(morris(), "m.jsonl");
  expect_sound(page);
  expect_ids(page, {"effects", "plane-0", "study-effects-0", "study-effects-1", "points", "provenance"});
  expect_words(page, {"To B1.a_n_m <strong>belt.&lt;b&gt;</strong> matters most: &mu;* = 3.12 N m", "μ*, N m",
                      "1 of 3 do no more than noise", ">no more than noise<", "class=\"alarm\">9<", ">0.48<"});
  EXPECT_LT(page.find(">3.125<"), page.find("<td>0.25<")) << "largest first";
}

TEST(StudyDriverPage, OfSobolHasSharesWithIntervalsAndSaysWhetherTheyConverged) {
  const std::string page = page_of_study(sobol(), "s.jsonl");
  expect_sound(page);
  expect_ids(page, {"shares", "shares-0", "study-shares-0", "points"});
  expect_words(page, {"<strong>71 %</strong> goes with <strong>belt.friction_front</strong>", "It has not converged",
                      ">0.662 to 0.762<", ">0.615<", "that of belt.&lt;b&gt;, is 0.1 wide; 0.05 is asked for",
                      "About 256 samples (1024 points)", "standard deviation 2 N m", "class=\"alarm\">60<",
                      "too few points are ok"});
  EXPECT_FALSE(has_id(page, "shares-1"));
  StudyRecord r = sobol();
  r.answer["quantities"]["B1.a_n_m"]["converged"] = true;
  expect_words(page_of_study(r, "s"), {"It has converged.", "Converged: the widest"});
}

TEST(StudyDriverPage, OfASurrogateWarnsOfOneThatPredictsBadly) {
  StudyRecord r = surrogate();
  const std::string page = page_of_study(r, "g.jsonl");
  expect_sound(page);
  expect_ids(page, {"surrogate", "study-surrogate", "shares", "shares-0", "study-shares-0"});
  expect_words(page, {"class=\"alarm\">0.8125<", "one quantity predicts less than 90 %", ">0.375<", ">2.25<", "chaos"});
  EXPECT_EQ(page.find(">interval<"), page.npos);
  r.answer["quantities"]["B1.a_n_m"]["q2"] = 0.97;
  expect_words(page_of_study(r, "g"), {"predicts at least 90 %"});
}

TEST(StudyDriverPage, OfUncertaintyHasDistributionsPercentilesAndTheTarget) {
  const std::string page = page_of_study(uncertainty(), "u.jsonl");
  expect_sound(page);
  expect_ids(page, {"scatter", "histogram-0", "exceedance-0", "histogram-1", "exceedance-1", "study-percentiles-0",
                    "study-percentiles-1", "points", "failures"});
  expect_words(
      page, {"longer than <strong>124 h</strong> (95 %: 100 to 316)", "<strong>31.4 %</strong> (95 %: 21 to 43)",
             "between <strong>9.5</strong> and <strong>3600</strong> N m", "1.5 % of the points failed", "target 200 h",
             "of 64 points", ">2.5<", ">100 to 316<", ">- to 2.25<", ">2.078 to 2.11<", "32.3 % if every one misses it",
             "It does not vary"});
  EXPECT_LT(page.find("<td>5<"), page.find("<td>10<")) << "percentiles by size";
  EXPECT_FALSE(has_id(page, "histogram-2"));
  EXPECT_FALSE(has_id(page, "study-percentiles-2"));
}

/// Every fifth of what stands in an object, at any depth, from the `first`, is left out or becomes something else.
void spoil(json& j, std::size_t& count, std::size_t first) {
  const json odd[] = {nullptr, "<odd>", 7, {1, "a", nullptr, json::object()}};
  std::vector<std::string> gone;
  for (auto& [key, value] : j.items()) {
    if (j.is_object() && count++ % 5 == first) {
      if (count % 3 == 0)
        gone.push_back(key);
      else
        value = odd[count % 4];
    }
    if (value.is_structured()) spoil(value, count, first);
  }
  for (const std::string& key : gone) j.erase(key);
}

TEST(StudyDriverPage, SurvivesMissingKeysZerosAndAnswersOfAnotherShape) {
  for (const StudyRecord& whole : {oat(), morris(), sobol(), surrogate(), uncertainty()}) {
    StudyRecord r = whole;
    for (std::size_t first = 0; first < 5; ++first) {
      std::size_t count = 0;
      r.answer = whole.answer;
      spoil(r.answer, count, first);
      expect_sound(page_of_study(r, "x"));
      r.points.clear();
    }
    for (const json& odd : {json::object(), json(7), json("text"), json(json::array({1, "a", nullptr}))}) {
      r.answer = odd;
      expect_sound(page_of_study(r, "x"));
      r.answer = {{"quantities", odd}, {"variants", odd}, {"parameters", odd}};
      expect_sound(page_of_study(r, "x"));
      r.answer = {{"quantities", {{r.head.quantities[0], odd}}}, {"variants", {{{"changes", odd}}, odd}}};
      expect_sound(page_of_study(r, "x"));
    }
    r.answer = {{"error", "only 1 of 9 points are <ok>"}};
    expect_words(page_of_study(r, "x"), {"There is no answer: only 1 of 9 points are &lt;ok&gt;"});
  }
}

TEST(StudyDriverPage, OfZerosAndASinglePointHasNoEmptyCharts) {
  StudyRecord r = morris();
  for (auto& [name, e] : r.answer["quantities"]["B1.a_n_m"].items()) e["mu_star"] = e["sigma"] = 0;
  expect_sound(page_of_study(r, "m"));
  r = sobol();
  for (const char* kind : {"first", "total"})
    for (auto& [name, e] : r.answer["quantities"]["B1.a_n_m"][kind].items())
      e = {{"value", 0}, {"low", 0}, {"high", 0}};
  expect_sound(page_of_study(r, "s"));
  r = uncertainty();
  r.points.resize(2);
  expect_sound(page_of_study(r, "u"));
  r.points.resize(1);
  expect_sound(page_of_study(r, "u"));
}

}  // namespace
}  // namespace beltlife::study_test
