// Owns the claims about the page of a calibration: its numbers and warnings, and that odd answers do not break it.
#include <cmath>

#include "calibrate/pages/calibrate_charts.h"
#include "results/answer/answer_json.h"
#include "tests/unit/study_page_fixture.h"

namespace beltlife::study_test {
namespace {

using nlohmann::json;

constexpr const char* odd_parameter = "belt.<b>'x'";

json parameter(double value, double half, const char* identified, const char* at_bound) {
  return {{"value", value},
          {"standard_error", half / 2},
          {"low", value - half},
          {"high", value + half},
          {"start", 0.7},
          {"lower", 0.2},
          {"upper", 1.2},
          {"identified", identified},
          {"at_bound", at_bound},
          {"profile",
           {{"low", value - half},
            {"high", nullptr},
            {"value", {value - 1.6 * half, value, value + 1.6 * half}},
            {"cost", {9.0, 4.0, 8.0}}}}};
}

json residual(const char* quantity, double measured, double calibrated, double r) {
  return {{"quantity", quantity},   {"measured", measured},
          {"start", nullptr},       {"calibrated", calibrated},
          {"start_error", nullptr}, {"calibrated_error", calibrated / measured - 1},
          {"sigma", 0.02},          {"model_noise", 0.01},
          {"logarithm", true},      {"residual", r}};
}

json curves(double size) {
  json j{{"frequency_hz", json::array()},
         {"amplitude", json::array()},
         {"angle_deg", json::array()},
         {"trace", json::array()}};
  for (int i = 0; i < 144; ++i) {
    j["frequency_hz"].push_back(i);
    j["amplitude"].push_back(size * (1.01 + std::cos(0.2 * i)));
    j["angle_deg"].push_back(5 * i);
    j["trace"].push_back(size * std::sin(0.1 * i));
  }
  return j;
}

json main_frequency(const char* range, double error, double thesis) {
  return {{"range", range},
          {"channel", "drive_shaft.speed_rpm"},
          {"order", 3},
          {"hz", 35},
          {"measured", 14.0},
          {"start", 18.5},
          {"calibrated", 14.0 * (1 + error)},
          {"start_error", 0.321},
          {"calibrated_error", error},
          {"thesis_error", thesis}};
}

StudyRecord calibration() {
  StudyRecord r = record_of("calibrate", {"belt.friction_front", odd_parameter, "a.free_n_m"},
                            {"idle.drive_shaft.speed_rpm.order_3", "idle.drive_shaft.speed_rpm.order_6"});
  add_point(r, {0.7, 0.7, 3.0}, {18, 2});
  add_failure(r, {0.5, 0.5, 3.0}, "diverged");
  json free = parameter(3, 1, "no", "no");
  for (const char* key : {"lower", "upper", "profile"}) free.erase(key);
  free["low"] = free["high"] = free["standard_error"] = nullptr;
  const json correlation{{"belt.friction_front", {{odd_parameter, -0.953}, {"a.free_n_m", nullptr}}},
                         {odd_parameter, {{"belt.friction_front", -0.953}}}};
  const json fit{{"ok", true},
                 {"ended", "the cost <changes> no more"},
                 {"start_cost", 900.0},
                 {"cost", 4.0},
                 {"points", {10, 20, 30}},
                 {"costs", {900, 30, 4}},
                 {"parameters", {{"belt.friction_front", 0.4375}}}};
  json failed = fit;
  failed["ok"] = false;
  failed["cost"] = nullptr;
  r.answer = {
      {"parameters",
       {{"belt.friction_front", parameter(0.4375, 0.0625, "yes", "no")},
        {odd_parameter, parameter(1.0625, 0.25, "confounded", "upper")},
        {"a.free_n_m", free}}},
      {"cost", 4.0},
      {"start_cost", 901.5},
      {"converged", true},
      {"confidence", 0.95},
      {"degrees_of_freedom", 10},
      {"residual_variance", 0.8125},
      {"error_scale", 0.9013878188659973},
      {"probability_of_residuals", 0.25},
      {"noise", 1e-3},
      {"correlation", correlation},
      {"eigenvalues", {0.0625, 0.9, 2.0}},
      {"weakest", {{"eigenvalue", 0.0625}, {"words", "a & b trade off."}, {"direction", {{odd_parameter, 0.71}}}}},
      {"fits", {fit, failed, fit}},
      {"best_fit", 0},
      {"residuals",
       {residual("idle.drive_shaft.speed_rpm.order_3", 14, 14.5, 1.755),
        residual("idle.drive_shaft.speed_rpm.order_6", 2, 1.8, -4.714), residual("idle.<odd>.mean", 700, 701, 0.1)}},
      {"main_frequencies", {main_frequency("idle", 0.125, 0.10), main_frequency("B100", -0.125, 0.15)}},
      {"remarks", {"The data say nothing about a.free_n_m.", "x < y ended."}},
      {"pictures",
       {{{"range", "idle"},
         {"channel", "drive_shaft.speed_rpm"},
         {"file", "twin <1>.csv"},
         {"crank_rpm", 700},
         {"noise", 0.008},
         {"windows", 5},
         {"left_out", {"order 7: below the <noise>"}},
         {"measured", curves(10)},
         {"start", curves(12)},
         {"calibrated", curves(10.5)}}}}};
  return r;
}

TEST(StudyCalibratePage, HasValuesIntervalsPicturesResidualsAndFits) {
  const std::string page = page_of_study(calibration(), "c.jsonl");
  expect_sound(page);
  expect_ids(page, {"parameters",
                    "study-parameters",
                    "study-intervals",
                    "intervals",
                    "main",
                    "study-main",
                    "pictures",
                    "spectrum-0",
                    "trace-0",
                    "residuals",
                    "study-residuals",
                    "residuals-by-order",
                    "correlation",
                    "study-correlation",
                    "profiles",
                    "profile-0",
                    "profile-1",
                    "fits",
                    "cost",
                    "study-fits",
                    "failures",
                    "provenance"});
  EXPECT_FALSE(has_id(page, "profile-2")) << "nothing was profiled of it";
  EXPECT_FALSE(has_id(page, "points")) << "the path of a fit is no sample";
  expect_words(page, {"<strong>converged</strong>",
                      "<strong>1 of 3</strong> parameters",
                      ">0.4375<",
                      "0.375 to 0.5",
                      "0.375 to not reached",
                      ">0.2 to 1.2<",
                      ">N m<",
                      "x &lt; y ended.",
                      "The data say nothing about a.free_n_m.",
                      ">+12.5<",
                      ">-12.5<",
                      "crank at 700 r/min, 5 windows",
                      "order 7: below the &lt;noise&gt;",
                      "twin &lt;1&gt;.csv",
                      "1 of 3 exceed 3",
                      "0.0625, 0.9, 2",
                      "a &amp; b trade off.",
                      ">+0.71<",
                      ">1, the best<",
                      ">final<",
                      "the cost &lt;changes&gt; no more",
                      ">901.5<"});
  EXPECT_EQ(page.find("<b>"), page.npos);
  EXPECT_LT(page.find("<td class=\"w\">belt.friction_front"), page.find("<td class=\"w\">a.free_n_m"))
      << "in the study's order, not by name";
}

TEST(StudyCalibratePage, SetsOffWhatIsNotToBeTrusted) {
  const std::string page = page_of_study(calibration(), "c.jsonl");
  expect_words(
      page, {"class=\"alarm\">confounded<", "class=\"alarm\">upper<", "class=\"alarm\">-4.71<", ">+1.75<",
             "class=\"alarm\" style=\"background:rgba(230,159,0,0.48)\">-0.95<", "<strong>1 of 2</strong> amplitudes",
             "class=\"alarm\">+12.5<", "class=\"alarm\">the cost &lt;changes&gt; no more<"});
  EXPECT_EQ(page.find("class=\"alarm\">-12.5<"), page.npos) << "within the 15 % of the thesis";
}

TEST(StudyCalibratePage, BeginsWithTheRemarkThatItHasNotConverged) {
  StudyRecord r = calibration();
  r.answer["converged"] = false;
  std::string page = page_of_study(r, "c");
  expect_words(page, {"<strong class=\"alarm\">The fit has not converged.</strong>"});
  r.answer["remarks"].push_back("Not converged: the minimum is far.");
  page = page_of_study(r, "c");
  expect_sound(page);
  expect_words(page, {"<p class=\"lead\"><strong class=\"alarm\">Not converged: the minimum is far.</strong>"});
  EXPECT_EQ(page.find("The fit has"), page.npos) << "said once";
}

TEST(StudyCalibratePage, OfSingleNumbersHasNoPicturesNorMainFrequencies) {
  StudyRecord r = calibration();
  r.answer["main_frequencies"] = json::array();
  r.answer.erase("pictures");
  r.answer["residuals"] = {residual("y1", 2, 2.1, 0.5)};
  r.answer["residuals"][0]["logarithm"] = false;
  const std::string page = page_of_study(r, "c");
  expect_sound(page);
  for (const char* id : {"main", "pictures", "spectrum-0", "residuals-by-order"}) EXPECT_FALSE(has_id(page, id)) << id;
  expect_words(page, {">y1<", ">0.02<"});
}

TEST(StudyCalibratePage, OfAStudyThatHasNotEndedOrHasNoFitSaysSo) {
  StudyRecord r = calibration();
  r.answer = nullptr;
  std::string page = page_of_study(r, "c");
  expect_sound(page);
  expect_words(page, {"This study has not ended."});
  EXPECT_FALSE(has_id(page, "parameters"));
  r.answer = {{"error", "no fit: every <step> failed"}, {"converged", false}};
  page = page_of_study(r, "c");
  expect_sound(page);
  expect_words(page, {"There is no answer: no fit: every &lt;step&gt; failed"});
  EXPECT_EQ(page.find("converged"), page.npos);
}

/// Every seventh of what stands in an object or a list of objects, from the `first`, is gone or becomes something else.
void spoil(json& j, std::size_t& count, std::size_t first) {
  const json odd[] = {nullptr, "<odd>", 7, {1, "a", nullptr, json::object()}, -1e300};
  std::vector<std::string> gone;
  for (auto& [key, value] : j.items()) {
    if (j.is_object() && count++ % 7 == first) {
      if (count % 3 == 0)
        gone.push_back(key);
      else
        value = odd[count % 5];
    }
    if (value.is_structured()) spoil(value, count, first);
  }
  for (const std::string& key : gone) j.erase(key);
}

TEST(StudyCalibratePage, SurvivesMissingPartsAndAnswersOfAnotherShape) {
  const StudyRecord whole = calibration();
  StudyRecord r = whole;
  for (int part = 0; part < 3; ++part) {
    r.answer = whole.answer;
    int k = 0;
    for (const auto& [key, value] : whole.answer.items())
      if (k++ % 3 == part) r.answer.erase(key);
    expect_sound(page_of_study(r, "x"));
  }
  for (std::size_t first = 0; first < 7; ++first) {
    std::size_t count = 0;
    r.answer = whole.answer;
    spoil(r.answer, count, first);
    expect_sound(page_of_study(r, "x"));
  }
  for (const json& odd : {json::object(), json(7), json("<text>"), json(json::array({1, "a", nullptr}))}) {
    r.answer = odd;
    expect_sound(page_of_study(r, "x"));
    r.answer = json::object();
    for (const auto& [key, value] : whole.answer.items()) r.answer[key] = odd;
    expect_sound(page_of_study(r, "x"));
  }
}

TEST(StudyCalibrateCharts, ShowWideBoundsByTheirLogarithmAndLeaveOutWhatHasNone) {
  FittedParameter p;
  p.name = "belt.bending_damping_n_m2_s";
  p.value = 1e-4;
  EXPECT_EQ(interval_chart("i", {p}), "") << "no bounds, no share of them";
  p.lower = 1e-6;
  p.upper = 1e-3;
  EXPECT_NE(interval_chart("i", {p}).find("n_m2_s (log)"), std::string::npos);
  p.upper = 5e-6;
  p.value = 2e-6;
  EXPECT_EQ(interval_chart("i", {p}).find("(log)"), std::string::npos);
  EXPECT_EQ(profile_chart("p", p, 3), "") << "no profile";
  p.profile_value = {1e-6, 2e-6, 3e-6};
  p.profile_cost = {5, 1, 5};
  EXPECT_NE(profile_chart("p", p, 3).find("value, 1e-6 N m2 s"), std::string::npos) << "tics by a power of a thousand";
}

TEST(StudyCalibrateCharts, CutSpectraBelowTheNoiseAndAtOrderNineAndAHalf) {
  // A line of 10 over nothing, up to 1000 Hz at 600 r/min: order 9.5 is at 95 Hz.
  json picture{{"channel", "drive_shaft.torque_n_m"}, {"crank_rpm", 600}, {"noise", 0.5}};
  for (int f = 0; f <= 1000; ++f) {
    picture["measured"]["frequency_hz"].push_back(f);
    picture["measured"]["amplitude"].push_back(f == 50 ? 10 : 1e-12);
  }
  const std::string svg = spectrum_chart("s", answer_of_json<RecordPicture>(picture));
  EXPECT_NE(svg.find("order 1: 10 Hz"), std::string::npos);
  EXPECT_NE(svg.find("amplitude, N m"), std::string::npos);
  EXPECT_EQ(svg.find("1e-"), std::string::npos) << "no decades of rounding on the axis";
  EXPECT_EQ(svg.find(">1000<"), std::string::npos);
  picture["measured"]["amplitude"] = {0, 0, 0};
  EXPECT_EQ(spectrum_chart("s", answer_of_json<RecordPicture>(picture)), "") << "nothing above zero";
}

}  // namespace
}  // namespace beltlife::study_test
