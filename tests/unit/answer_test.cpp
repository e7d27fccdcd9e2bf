// Owns the claims about answers: JSON both ways over one list of parts, leniency, units in files, the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "calibrate/calibration_result.h"
#include "optimize/search_answer.h"
#include "results/answer/answer_json.h"
#include "results/answer/answer_note.h"
#include "results/store/hdf5_source.h"
#include "results/store/json_group.h"
#include "studies/convergence/convergence_answer.h"
#include "studies/morris/morris_answer.h"
#include "studies/noise/noise_answer.h"
#include "studies/oat/oat_answer.h"
#include "studies/sobol/sobol_answer.h"
#include "studies/stability/stability_answer.h"
#include "studies/surrogate/surrogate_answer.h"
#include "studies/uncertainty/uncertainty_answer.h"

namespace beltlife {
namespace {

using nlohmann::json;

NoiseAnswer example() {
  NoiseAnswer a;
  a.evaluations = 7;
  a.parameters = {"belt.friction_front"};
  QuantityNoise& q = a.quantities["B100.hub_load_n.max"];
  q.value = 1200;
  q.noise = 0.5;
  q.responses = {{"response 1", 1100, 3}, {"response 2", 1300, 4}};
  return a;
}

TEST(Answers, SayWhatIsNotKnownByNullAndLeaveOutWhatIsAbsent) {
  const json j = json_of_answer(example());
  const json& q = j["quantities"]["B100.hub_load_n.max"];
  EXPECT_EQ(q["value"], 1200.0);
  EXPECT_TRUE(q["step_forward"].is_null());
  EXPECT_FALSE(q.contains("replicates"));
  EXPECT_EQ(q["responses"].size(), 2u);
  EXPECT_TRUE(q["responses"][0]["replicates"].is_number_integer());
  EXPECT_EQ(j["evaluations"], 7);
  EXPECT_FALSE(j.contains("error"));
}

TEST(Answers, ComeBackFromTheirJson) {
  const json j = json_of_answer(example());
  EXPECT_EQ(json_of_answer(answer_of_json<NoiseAnswer>(j)), j);
}

TEST(Answers, WithAnErrorHoldNoEmptyParts) {
  NoiseAnswer a;
  a.error = "no point is ok";
  const json j = json_of_answer(a);
  EXPECT_FALSE(j.contains("quantities"));
  EXPECT_EQ(j["error"], "no point is ok");
  EXPECT_EQ(j["failed"], 0);
}

// Logs of other versions, and damaged ones.
TEST(Answers, LeaveAsItIsWhatIsNotThereOrOfAnotherType) {
  const auto a = answer_of_json<NoiseAnswer>(json::parse(
      R"({"parameters": "text", "evaluations": "many", "quantities": {"x": {"value": "one", "noise": 2, "responses": 5},
          "y": null}, "more": [1, 2]})"));
  EXPECT_TRUE(a.parameters.empty());
  EXPECT_EQ(a.evaluations, 0);
  EXPECT_TRUE(std::isnan(a.quantities.at("x").value));
  EXPECT_EQ(a.quantities.at("x").noise, 2);
  EXPECT_TRUE(std::isnan(a.quantities.at("y").noise));
}

TEST(Answers, KeepNullInMapsThatHaveIt) {
  ConvergenceAnswer a;
  a.cheapest["all"]["1 %"] = {};
  a.cheapest["all"]["5 %"] = {CheapestSetting{"thesis, 64 elements, 1e-06 s", 2.5}};
  const json j = json_of_answer(a);
  EXPECT_TRUE(j["cheapest"]["all"].contains("1 %"));
  EXPECT_TRUE(j["cheapest"]["all"]["1 %"].is_null());
  EXPECT_EQ(json_of_answer(answer_of_json<ConvergenceAnswer>(j)), j);
}

TEST(Answers, GiveTheirUnitsAndMeaningsToFiles) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "answer_units.h5";
  Hdf5Image file;
  put_answer(file, "/answer", json_of_answer(example()), notes_of<NoiseAnswer>(), "what was found");
  const auto bytes = file.bytes();
  std::FILE* out = std::fopen(path.c_str(), "wb");
  ASSERT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), out), bytes.size());
  std::fclose(out);
  const Hdf5Source source(path.string());
  const std::string q = "/answer/quantities/B100.hub_load_n.max";
  EXPECT_EQ(source.text(q + "/value", "unit"), "N") << "of the quantity by whose name it is found";
  EXPECT_EQ(source.text(q + "/value", "description"), "at the nominal point");
  EXPECT_EQ(source.text(q + "/step_forward", "unit"), "");
  EXPECT_EQ(source.text(q + "/responses/mean", "unit"), "N");
  EXPECT_EQ(get_json(source, "/answer")["quantities"]["B100.hub_load_n.max"]["noise"], 0.5);
}

/// Every part has a meaning; its unit is none where it is no number.
void expect_described(const std::vector<AnswerNote>& notes, const std::string& above) {
  for (const AnswerNote& note : notes) {
    const std::string path = above + "." + note.name;
    EXPECT_FALSE(note.meaning.empty()) << path;
    EXPECT_FALSE(note.type.empty()) << path;
    const bool number = note.type.find("number") != note.type.npos || note.type.find("integer") != note.type.npos ||
                        note.type.find("object") != note.type.npos || note.name == "value";
    EXPECT_TRUE(number || note.unit.empty()) << path << " is no number, but has the unit " << note.unit;
    expect_described(note.parts, path);
  }
}

template <class... All>
void expect_all_described() {
  (expect_described(notes_of<All>(), "answer"), ...);
}

TEST(Answers, OfEveryDriverDescribeAllTheirParts) {
  expect_all_described<NoiseAnswer, ConvergenceAnswer, StabilityAnswer, OatAnswer, MorrisAnswer, SobolAnswer,
                       SurrogateAnswer, UncertaintyAnswer, CalibrationAnswer, SearchAnswer>();
}

TEST(Answers, HaveAReferenceWithARowAPart) {
  const std::string reference = reference_of_answer<MorrisAnswer>();
  EXPECT_NE(reference.find("| `quantities.NAME.NAME.mu_star` | number | its own | mean of their magnitudes"),
            reference.npos)
      << reference;
  EXPECT_NE(reference.find("| `error` | text, or absent |"), reference.npos);
}

}  // namespace
}  // namespace beltlife
