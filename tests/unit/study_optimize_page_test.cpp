// Owns the claims about the page of a layout search: its gain, its limits, and that odd or failed answers do not break
// it.
#include "tests/unit/study_page_fixture.h"

namespace beltlife::study_test {
namespace {

using nlohmann::json;

constexpr const char* x = "pulley.idler_2.x_mm";
constexpr const char* side = "pulley.idler_2.side";

json design(int point, double objective, double x_mm) {
  return {{"point", point},
          {"objective", objective},
          {"mean", objective},
          {"low", objective - 0.0625},
          {"high", objective + 0.0625},
          {"feasible", true},
          {"parameters", {{x, x_mm}}},
          {"choices", {{side, x_mm < -200 ? "back" : "front"}}},
          {"quantities", {{"log10_life_h", objective}, {"B100.pulley.<b>.hub_load_n.mean", 1500 + x_mm}}}};
}

json finalist(const json& design, int hold) {
  json f = design;
  f["replicates"] = 4;
  f["constraints_hold_in"] = hold;
  f["standard_deviation"] = 0.01;
  return f;
}

json comparison(int against, bool start, double mean, double probability, const char* words) {
  return {{"of", 2},
          {"against", against},
          {"against_start", start},
          {"mean", mean},
          {"low", mean - 0.25},
          {"high", mean + 0.25},
          {"words", words},
          {"probability_better", probability}};
}

json layout(double x_mm) {
  return {{"path_length_mm", 1100.5},
          {"unstretched_length_mm", 1097.25},
          {"tension_n", 685},
          {"pulleys",
           {{{"name", "crank"}, {"diameter_mm", 200}, {"side", "front"}, {"x_mm", 0}, {"y_mm", 0}},
            {{"name", "a & b"}, {"diameter_mm", 80}, {"side", "back"}, {"x_mm", x_mm}, {"y_mm", 10}}}},
          {"spans",
           {{{"name", "crank-a & b"}, {"from_mm", {0, -100}}, {"to_mm", {x_mm, -30}}},
            {{"name", "a & b-crank"}, {"from_mm", {x_mm, 50}}, {"to_mm", {0, 100}}}}}};
}

json active(const char* kind, const std::string& name, double value, double bound, bool at_most, const char* unit) {
  return {{"kind", kind},   {"name", name},       {"value", value},
          {"bound", bound}, {"at_most", at_most}, {"left", at_most ? bound - value : value - bound},
          {"unit", unit}};
}

StudyRecord search() {
  StudyRecord r = record_of("optimize", {x, side}, {"log10_life_h", "B100.pulley.<b>.hub_load_n.mean"});
  r.head.study_text =
      "[[parameter]]\npath = \"pulley.idler_2.x_mm\"\nlower = -240\nupper = -180\n[objective]\nquantity = "
      "\"log10_life_h\"\n[[constraint]]\nname = \"the <bearing>\"\nquantity = \"B100.pulley.<b>.hub_load_n.mean\"\n"
      "upper = 1280\n[layout]\nmin_wrap_deg = 15\nmin_pulley_clearance_mm = 9\n[[layout.wrap]]\npulley = \"crank\"\n"
      "min_deg = 120\n";
  for (const double at : {-200.0, -210.0, -239.75}) add_point(r, {at, "back"}, {3 - at / 200, 1500 + at});
  add_failure(r, {-190.0, "front"}, "off <the> pulley");
  r.answer = {
      {"objective", {{"quantity", "log10_life_h"}, {"maximize", true}}},
      {"algorithm", "kriging <automatic>"},
      {"ended", "budget spent"},
      {"seed", 3},
      {"search_simulations", 4},
      {"check_simulations", 0},
      {"replicate_simulations", 9},
      {"start", design(0, 3.25, -200)},
      {"best", design(2, 4.25, -239.75)},
      {"finalists", {finalist(design(2, 4.25, -239.75), 4), finalist(design(1, 4.1875, -210), 4)}},
      {"comparison",
       {comparison(1, false, 0.0625, 0.75, "not told apart"), comparison(0, true, 1, 0.9999, "better beyond <doubt>")}},
      {"active",
       {active("limit", "wrap on crank", 120.5, 120, false, "deg"),
        active("limit", "keep-out frame and belt crank-a & b", 0.25, 0, false, "mm"),
        active("constraint", "the <bearing>", 1260.25, 1280, true, "N"),
        active("lower bound", x, -239.75, -240, false, "mm")}},
      {"governing",
       {{"start", {{"range", "idle"}, {"range_share", 0.5}, {"pulley", "crank"}, {"pulley_share", 0.75}}},
        {"best", {{"range", "B<100>"}, {"range_share", 0.875}, {"pulley", "a & b"}, {"pulley_share", 0.625}}}}},
      {"lives",
       {{"start", {{"B<100>", {{"mean", 3.0}, {"low", 2.9}, {"high", 3.1}}}}},
        {"best", {{"B<100>", {{"mean", 4.0}, {"low", 3.9}, {"high", 4.1}}}}}}},
      {"history", {{"simulations", {1, 2, 3, 4}}, {"objective", {nullptr, 3.25, 4.1, 4.25}}}},
      {"layouts", {{"start", layout(-300)}, {"best", layout(-340)}}}};
  return r;
}

TEST(StudyOptimizePage, HasGainLayoutsCourseFinalistsLivesAndLimits) {
  const std::string page = page_of_study(search(), "o.jsonl");
  expect_sound(page);
  expect_ids(page, {"layouts", "layout-start", "layout-best", "parameters", "study-parameters", "history",
                    "history-chart", "finalists", "lives", "lives-chart", "study-lives", "study-governing", "active",
                    "study-active", "study-constraints", "failures", "provenance"});
  expect_words(page, {"<strong>4.25</strong>", "and 3.25 at the start", "better by <strong>1</strong>",
                      "a factor of <strong>10.0</strong>", "better beyond &lt;doubt&gt;",
                      "Range <strong>B&lt;100&gt;</strong> does 87.5 % of the damage", "1 cannot be told apart from it",
                      "kriging &lt;automatic&gt;", "off &lt;the&gt; pulley"});
  for (const char* unescaped : {"<b>", "<bearing>", "<doubt>", "B<100>"}) EXPECT_EQ(page.find(unescaped), page.npos);
  EXPECT_FALSE(has_id(page, "pareto"));
  EXPECT_FALSE(has_id(page, "fidelity"));
  EXPECT_FALSE(has_id(page, "combinations"));
}

TEST(StudyOptimizePage, StatesEveryLimitWithItsOwnBound) {
  const std::string page = page_of_study(search(), "o");
  expect_words(page, {"wrap on crank", ">120.5<", ">at least 120<", "keep-out frame and belt crank-a &amp; b", ">0.25<",
                      ">at least 0<", ">1260.2<", ">at most 1280<", ">-239.75<", ">at least -240<"});
  expect_words(page, {"4 <a href=\"#active\">limits and bounds hold it back</a>"});
}

TEST(StudyOptimizePage, SaysWhereAnOldLogLacksTheBound) {
  StudyRecord r = search();
  r.answer["active"] = {{{"kind", "limit"}, {"name", "wrap on crank"}, {"left", 0.5}, {"unit", "deg"}}};
  const std::string page = page_of_study(r, "o");
  expect_sound(page);
  expect_words(page, {"wrap on crank", ">not in this log<", ">0.5<"});
}

TEST(StudyOptimizePage, MarksTheParameterThatRestsOnItsBoundAndTheChangedChoice) {
  const std::string page = page_of_study(search(), "o");
  expect_words(page, {"class=\"alarm\">lower<", ">-240 to -180<", ">-39.75<", ">changed<"});
}

TEST(StudyOptimizePage, OfASearchThatFoundNothingShowsWhatBreaksLeast) {
  StudyRecord r = search();
  json least = r.answer["best"];
  least["violated"] = {"the <bearing> by 12 N"};
  least["quantities"]["B100.pulley.<b>.hub_load_n.mean"] = 1292;
  for (const char* key : {"best", "finalists", "comparison", "active", "lives", "governing"}) r.answer.erase(key);
  r.answer["least_violating"] = least;
  r.answer["layouts"].erase("best");
  r.answer["error"] = "no layout keeps all limits";
  const std::string page = page_of_study(r, "o");
  expect_sound(page);
  expect_words(page, {"no layout keeps all limits", "breaks least", "Breaks least: the &lt;bearing&gt; by 12 N",
                      "class=\"alarm\">1292<"});
  EXPECT_FALSE(has_id(page, "lives"));
}

TEST(StudyOptimizePage, SaysWhereNothingBetterThanTheStartWasFoundAndLimitsHoldInSomeReplicatesOnly) {
  StudyRecord r = search();
  r.answer["best"] = r.answer["start"];
  r.answer["finalists"] = {finalist(r.answer["start"], 3)};
  r.answer["comparison"] = json::array();
  const std::string page = page_of_study(r, "o");
  expect_sound(page);
  expect_words(page, {"<strong>nothing better than the start</strong>", "Its limits hold in 3 of 4 replicates only."});
}

TEST(StudyOptimizePage, ShowsTheDistrustedCoarseModelTheFrontAndTheChoices) {
  StudyRecord r = search();
  r.answer["fidelity"] = {
      {"asked", 8}, {"compared", 7}, {"rank_correlation", 0.5}, {"enough", 0.8}, {"search", "fine"}};
  json a = design(1, 4.0, -210), b = design(2, 4.25, -239.75);
  a["second"] = 1290;
  b["second"] = 1260.25;
  r.answer["pareto"] = {
      {"quantity", "B100.pulley.<b>.hub_load_n.mean"}, {"maximize", false}, {"model", "fine"}, {"front", {a, b}}};
  r.answer["combinations"] = {{{"choices", "side back"}, {"budget", 2}, {"why", ""}},
                              {{"choices", "side front"}, {"budget", 0}, {"why", "no layout <fits>"}}};
  const std::string page = page_of_study(r, "o");
  expect_sound(page);
  expect_ids(page, {"fidelity", "pareto", "study-front", "combinations", "study-combinations"});
  expect_words(page, {"The coarse model was not trusted</strong> (rank correlation 0.5)", ">1290<",
                      "class=\"alarm\">no layout &lt;fits&gt;<"});
}

TEST(StudyOptimizePage, AnswersOfAnyKindGiveASoundPage) {
  for (const char* key :
       {"objective", "start", "best", "finalists", "comparison", "active", "governing", "lives", "history", "layouts"})
    for (const json& odd : {json(), json(3), json("text"), json::array({1, "a"}), json::object({{"b", nullptr}})}) {
      StudyRecord r = search();
      r.answer[key] = odd;
      SCOPED_TRACE(std::string(key) + " " + odd.dump());
      expect_sound(page_of_study(r, "o"));
    }
  StudyRecord r = search();
  r.head.study_text = "[[parameter";
  expect_sound(page_of_study(r, "o"));
}

}  // namespace
}  // namespace beltlife::study_test
