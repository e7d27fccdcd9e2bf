// Owns the claims about the pages of studies: their sections and numbers, and that odd records do not break them.
#include "results/pages/study/study_page.h"

#include "tests/unit/study_page_fixture.h"

namespace beltlife::study_test {
namespace {

using nlohmann::json;

/// Two ramp times, each with a response of its own; a quantity that is zero throughout.
StudyRecord noise() {
  StudyRecord r = record_of("study noise", {"belt.friction_front", "driver.phase_rad", "profile.ramp_s"},
                            {odd_name, "B1.log10_life_h"});
  for (const double ramp : {1.0, 1.25})
    for (const double phase : {0.0, 1.5, 3.0}) add_point(r, {0.6, phase, ramp}, {ramp > 1 ? 2 + phase / 99 : 1.0, 0});
  add_point(r, {0.6000001, 0.0, 1.0}, {1.0001, 0});
  add_failure(r, {0.7, 0.0, 1.0}, "range B1: diverged after 0.0123 s at idler_3, element 12");
  add_failure(r, {0.8, 0.0, 1.0}, "range B1: diverged after 1.5e-05 s at idler_3, element 7");
  r.answer = {
      {"evaluations", 9},
      {"failed", 2},
      {"parameters", {"belt.friction_front"}},
      {"quantities",
       {{odd_name,
         {{"value", 1.0},
          {"replicates",
           {{"points", 6},
            {"mean", 1.5},
            {"standard_deviation", 0.55},
            {"relative", 0.5512},
            {"min", 1},
            {"max", 2.03}}},
          {"responses",
           {{{"name", "response 1"}, {"mean", 1.0}, {"replicates", 3}},
            {{"name", "response 2"}, {"mean", 2.0152}, {"replicates", 3}}}},
          {"perturbation", {{"relative", 1.3e-7}}},
          {"differences", {{"noise", 1e-5}, {"relative", 1e-5}, {"order", 0}, {"levels", json::array()}}},
          {"step_forward", 0.00721},
          {"step_central", 0.0215}}},
        {"B1.log10_life_h",
         {{"value", 0.0}, {"replicates", {{"relative", 0.0}, {"min", 0}, {"max", 0}}}, {"step_forward", nullptr}}}}}};
  return r;
}

StudyRecord convergence() {
  StudyRecord r =
      record_of("study convergence", {"solver.scheme", "belt.elements", "solver.step_s"}, {"B1.a_n", "B1.b_n"});
  r.head.study_text = "[study]\nexplicit_factors = [1, 0.5]\n";
  const auto setting = [](const char* scheme, int elements, double step, double processor, json errors) {
    return json{{"name", std::string(scheme) + std::to_string(elements)},
                {"scheme", scheme},
                {"elements", elements},
                {"step_s", step},
                {"steps", 1000},
                {"evaluations", 2000},
                {"processor_s", processor},
                {"simulated_s_per_s", 3.0},
                {"errors", std::move(errors)}};
  };
  const json errors{{"tensions", {{"error", 0.0123}, {"quantity", "B1.a_n"}}}};
  json failed = setting("linearly_implicit", 128, 5e-5, 0.3, nullptr);
  failed.erase("errors");
  failed["failure"] = "diverged: <here>";
  r.answer = {
      {"processor", "Abacus 7"},
      {"groups", {"tensions"}},
      {"simulated_s", 5.4},
      {"reference", "thesis256"},
      {"reference_band", {{"tensions", {{"error", 0.003}}}}},
      {"noise_floor", {{"tensions", {{"error", 0.0}}}}},
      {"not_judged", {"B1.b_n"}},
      {"quantities",
       {{"B1.a_n", {{"group", "tensions"}, {"reference", 612.5}, {"band", 1.5}, {"noise", 0.25}}},
        {"B1.b_n", {{"group", "tensions"}, {"reference", 0.5}, {"band", 1.5}, {"noise", 0.25}}}}},
      {"settings",
       {setting("thesis", 256, 4e-7, 20, {{"tensions", {{"error", 0.0}}}}), setting("thesis", 128, 1e-6, 2, errors),
        setting("linearly_implicit", 128, 2e-5, 0.75, errors), failed}},
      {"orders", {{"tensions", {{"linearly_implicit", {{"step", 0.981}, {"mesh", 1.93}}}}}}},
      {"cheapest",
       {{"tensions", {{"1 %", nullptr}, {"5 %", {{"setting", "linearly_implicit128"}, {"processor_s", 0.75}}}}},
        {"all", {{"1 %", nullptr}, {"5 %", {{"setting", "linearly_implicit128"}, {"processor_s", 0.75}}}}}}}};
  return r;
}

StudyRecord stability() {
  StudyRecord r = record_of("study stability", {"settings", "solver.scheme", "solver.step_s"}, {"B1.energy_residual"});
  add_failure(r, {"belt.ribs=6\nprofile.ramp_s=1", "thesis", "1e-6"}, "diverged");
  const auto row = [](const char* name, const char* value, double predicted, double observed, double residual) {
    return json{{"case", name},
                {"value", value},
                {"scheme", "thesis"},
                {"predicted_s", predicted},
                {"limited_by", "bending"},
                {"observed_s", observed},
                {"beyond_s", 2e-6},
                {"observed_over_predicted", predicted > 0 ? observed / predicted : 0},
                {"residual", residual},
                {"why", "diverged: step too long"}};
  };
  r.answer = {{"range", "B1"},
              {"steps",
               {row("as the scene", "", 1e-6, 1.25e-6, 0.001), row("belt.friction_front", "0", 1e-6, 1.1e-6, 0),
                row("belt.friction_front", "2", 1e-6, 1.5e-6, -0.031), row("belt.friction_front", "3", 1e-6, 0, 0)}},
              {"extremes",
               {{{"case", "slack <belt>"},
                 {"settings", "a=1\nb=2"},
                 {"step_s", 2e-5},
                 {"state", "diverged"},
                 {"reason", "at idler_3"},
                 {"residual", 0},
                 {"drift", 0},
                 {"processor_s", 0.8}},
                {{"case", "no friction"},
                 {"settings", ""},
                 {"step_s", 2e-5},
                 {"state", "ok"},
                 {"reason", ""},
                 {"residual", 0.001},
                 {"drift", 0.25},
                 {"processor_s", 0.8}}}}};
  return r;
}

TEST(StudyPage, OfNoiseHasScatterResponsesAndFailuresByReason) {
  const std::string page = page_of_study(noise(), "n.jsonl");
  expect_sound(page);
  expect_ids(page, {"summary", "key-numbers", "noise", "noise-bars", "study-noise-table", "responses", "replicates-0",
                    "failures", "failures-by-reason-words", "failures-words", "points", "points-0-0", "provenance",
                    "provenance-table", "study", "scene"});
  expect_words(page,
               {"<strong>55 %</strong>", ">0.0072<", ">N m<", "response 2</strong> near 2.0152 N m (3 replicates)",
                ">1.3e-05<", "&lt;b&gt;'x' &amp; &quot;y&quot; 50 %", "4.5 s of processor time", "n.jsonl",
                "diverged after ... s at idler_3, element ...", "friction_front = 0.6"});
  EXPECT_EQ(page.find("<b>"), page.npos);
  EXPECT_EQ(page.find("has not ended"), page.npos);
}

TEST(StudyPage, OfConvergenceHasChartsCheapestAndEverySetting) {
  const std::string page = page_of_study(convergence(), "c.h5");
  expect_sound(page);
  expect_ids(page, {"errors", "errors-tensions", "cheapest", "study-cheapest", "settings", "study-settings-words",
                    "quantities", "not-judged", "study-quantities", "provenance"});
  expect_words(page,
               {"within 1 % is <span class=\"alarm\">none of these</span>", "Abacus 7", "g++, revision abc",
                "within 5 % is <strong>linearly_implicit128</strong> (0.75 s", "0.98 in the step and 1.9 in the mesh",
                "diverged: &lt;here&gt;", ">612.5<", "Rings:", "the reference"});
  EXPECT_FALSE(has_id(page, "points"));
}

TEST(StudyPage, OfStabilityHasEveryRowAndColoursWhatAlarms) {
  const std::string page = page_of_study(stability(), "s.h5");
  expect_sound(page);
  expect_ids(page, {"steps", "steps-belt.friction-front", "study-steps-words", "extremes", "study-extremes-words",
                    "failures"});
  expect_words(page,
               {"4 cases with 1 scheme", "thesis <strong>1.1 to 1.5</strong>", "1 of 2 extreme cases did not end ok",
                "class=\"alarm\">-3.1<", "class=\"alarm\">diverged<", "slack &lt;belt&gt;", "a=1; b=2",
                "A value of 0 has no place on the axis", "1 of 4 rows no stable step"});
}

TEST(StudyPage, OfAStudyThatHasNotEndedSaysSoAndHasItsPoints) {
  StudyRecord r = noise();
  r.answer = nullptr;
  const std::string page = page_of_study(r, "n.jsonl");
  expect_sound(page);
  expect_words(page, {"This study has not ended.", "9 points"});
  expect_ids(page, {"summary", "failures", "points", "provenance"});
  EXPECT_FALSE(has_id(page, "noise"));
  r.points.clear();
  expect_sound(page_of_study(r, "n.jsonl"));
}

TEST(StudyPage, OfAnUnknownKindHasTheAnswerAsItIs) {
  StudyRecord r = noise();
  r.head.driver = "study of <something>";
  const std::string page = page_of_study(r, "n.jsonl");
  expect_sound(page);
  expect_ids(page, {"answer", "points", "failures"});
  expect_words(page, {"study of &lt;something&gt;"});
}

TEST(StudyPage, OfAnAnswerThatIsAnErrorSaysWhy) {
  for (const char* driver : {"study noise", "study convergence", "study stability"}) {
    StudyRecord r = record_of(driver, {"a"}, {"b"});
    add_failure(r, {1.0}, "no <luck>");
    r.answer = {{"error", "the nominal point diverged: no <luck>"}, {"evaluations", 1}};
    const std::string page = page_of_study(r, "x");
    expect_sound(page);
    expect_words(page, {"no &lt;luck&gt;"});
  }
}

TEST(StudyPage, SurvivesOneSettingZerosAndAnswersOfAnotherShape) {
  StudyRecord one = convergence();
  one.answer["settings"].erase(1);
  one.answer["settings"][0]["errors"]["tensions"]["error"] = 0.0;
  one.answer["settings"].erase(1);
  one.answer["reference_band"]["tensions"]["error"] = nullptr;
  const std::string page = page_of_study(one, "c");
  expect_sound(page);
  expect_words(page, {"No error above zero"});
  StudyRecord zero = noise();
  zero.answer["quantities"].erase(odd_name);
  zero.head.quantities.erase(zero.head.quantities.begin());
  expect_words(page_of_study(zero, "n"), {"No scatter is above zero"});
  for (StudyRecord r : {noise(), convergence(), stability()}) {
    for (auto& [key, value] : r.answer.items()) value = nullptr;
    expect_sound(page_of_study(r, "x"));
    for (const json& odd : {json(7), json("text"), json(json::array({1, "a", nullptr}))}) {
      r.answer = odd;
      expect_sound(page_of_study(r, "x"));
    }
    for (const char* key : {"quantities", "settings", "groups", "steps", "extremes", "cheapest", "orders"})
      r.answer = {{key, {1, "a", nullptr, json::object()}}, {"groups", {"g"}}};
    expect_sound(page_of_study(r, "x"));
  }
}

TEST(StudyPage, ThinsThousandsOfPointsAndListsTheFirstFailures) {
  StudyRecord r = record_of("study sobol", {"p", "constant"}, {"q"});
  for (int i = 0; i < 4000; ++i) add_point(r, {i * 0.25, 1.0}, {1.0 / (1 + i)}, 0);
  for (int i = 0; i < 60; ++i) add_failure(r, {0.5, 1.0}, "reason " + std::to_string(i));
  const std::string page = page_of_study(r, "x");
  expect_sound(page);
  expect_ids(page, {"points-0-0"});
  EXPECT_FALSE(has_id(page, "points-0-1")) << "a constant parameter has no chart";
  expect_words(page, {"one in 4 of the points", "The first 50", "60 of 4060", ">reason ...<"});
  EXPECT_LT(page.size(), 300000u);
}

}  // namespace
}  // namespace beltlife::study_test
