// Owns the claims about the UM-Bridge protocol as text: what requests are answered with, and that no request breaks it.
#include "results/server/um_bridge.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace beltlife {
namespace {

using Json = nlohmann::json;

ParameterSpec parameter(const std::string& path, double lower, double upper) {
  ParameterSpec p;
  p.path = path;
  p.lower = lower;
  p.upper = upper;
  return p;
}

/// Two parameters, two quantities: their sum and product; below 1 the first makes no drive, above 9 none that runs.
ServedModel calculator() {
  ServedModel m;
  m.name = "toy";
  m.parameters = {parameter("belt.a", 0, 10), parameter("belt.b", -1e6, 1e6)};
  m.quantities = {"sum", "product"};
  m.evaluate = [](const Point& p) {
    const double a = number_of(p.at(0)), b = number_of(p.at(1));
    if (a < 1) return Answer{PointState::infeasible, "pulleys overlap", {}, 0};
    if (a > 9) return Answer{PointState::diverged, "range slow: diverged", {}, 0};
    return Answer{PointState::ok, "", {a + b, a * b}, 0};
  };
  return m;
}

/// The same with a setting that multiplies nothing but is passed on.
ServedModel with_settings() {
  ServedModel m = calculator();
  m.settings = {"belt.elements", "solver.step_s"};
  m.refusal = [](const std::vector<std::string>& settings) {
    return settings.back() == "belt.elements=1" ? "belt.elements: 1 is out of limits" : "";
  };
  m.evaluate = [](const Point& p) {
    const auto& lines = std::get<std::string>(p.at(0));
    return Answer{PointState::ok, "", {static_cast<double>(lines.size()), number_of(p.at(1))}, 0};
  };
  return m;
}

HttpAnswer post(const ServedModel& model, const std::string& path, const std::string& body) {
  return UmBridge(model).answer("POST", path, body);
}

HttpAnswer evaluate(const std::string& body) { return post(calculator(), "/Evaluate", body); }

/// Fails unless the answer is an error of this status and type whose message holds all of `words`.
void expect_error(const HttpAnswer& a, int status, const std::string& type, const std::vector<std::string>& words) {
  EXPECT_EQ(a.status, status) << a.body;
  const Json j = Json::parse(a.body, nullptr, false);
  ASSERT_TRUE(j.contains("error")) << a.body;
  EXPECT_EQ(j.size(), 1u) << "the protocol's schema allows no other key";
  EXPECT_EQ(j["error"].size(), 2u);
  EXPECT_EQ(j["error"]["type"], type) << a.body;
  const auto message = j["error"]["message"].get<std::string>();
  for (const std::string& word : words) EXPECT_NE(message.find(word), message.npos) << word << " in " << message;
}

TEST(UmBridgeInfo, ListsTheModelAndTheVersionAsANumber) {
  const HttpAnswer a = UmBridge(calculator()).answer("GET", "/Info", "");
  EXPECT_EQ(a.status, 200);
  EXPECT_EQ(a.body, R"({"models":["toy"],"protocolVersion":1.0})");
}

TEST(UmBridgeSizes, AreOneVectorOfParametersAndOneOfQuantities) {
  for (const char* body :
       {R"({"name": "toy"})", R"({"name": "toy", "config": {}})", R"({"name":"toy","config":null})"}) {
    EXPECT_EQ(post(calculator(), "/InputSizes", body).body, R"({"inputSizes":[2]})");
    EXPECT_EQ(post(calculator(), "/OutputSizes", body).body, R"({"outputSizes":[2]})");
  }
}

TEST(UmBridgeModelInfo, SaysThatThereAreEvaluationsAndNoDerivatives) {
  const Json j = Json::parse(post(calculator(), "/ModelInfo", R"({"name": "toy"})").body);
  const Json wanted{{"Evaluate", true}, {"Gradient", false}, {"ApplyJacobian", false}, {"ApplyHessian", false}};
  EXPECT_EQ(j, (Json{{"support", wanted}}));
}

TEST(UmBridgeEvaluate, GivesOutputsToTheBit) {
  const HttpAnswer a = evaluate(R"({"name": "toy", "input": [[1.1, 0.30000000000000004]], "config": {}})");
  EXPECT_EQ(a.status, 200);
  const Json wanted{{"output", Json::array({{1.1 + 0.30000000000000004, 1.1 * 0.30000000000000004}})}};
  EXPECT_EQ(Json::parse(a.body), wanted) << a.body;
}

TEST(UmBridgeEvaluate, TakesWholeNumbersAndBounds) {
  EXPECT_EQ(evaluate(R"({"name": "toy", "input": [[2, -1000000]]})").body, R"({"output":[[-999998.0,-2000000.0]]})");
}

TEST(UmBridgeEvaluate, PassesAllowedSettingsOn) {
  const auto answer = [](const std::string& config) {
    return post(with_settings(), "/Evaluate", R"({"name": "toy", "input": [[2, 3]], "config": )" + config + "}").body;
  };
  EXPECT_EQ(answer(R"({"settings": ["belt.elements=64", "solver.step_s=1e-5"]})"), R"({"output":[[35.0,2.0]]})")
      << "both settings and the break between them";
  EXPECT_EQ(answer(R"({"settings": []})"), R"({"output":[[0.0,2.0]]})");
  EXPECT_EQ(answer("{}"), R"({"output":[[0.0,2.0]]})");
}

TEST(UmBridgeError, NamesWhatIsWrongWithAConfig) {
  const auto refused = [](const ServedModel& model, const std::string& config, const std::vector<std::string>& words) {
    for (const char* path : {"/Evaluate", "/InputSizes", "/OutputSizes"})
      expect_error(post(model, path, R"({"name": "toy", "input": [[2, 3]], "config": )" + config + "}"), 400,
                   "InvalidInput", words);
  };
  refused(with_settings(), "7", {"config", "number"});
  refused(with_settings(), R"({"setings": []})", {"setings", "did you mean 'settings'"});
  refused(with_settings(), R"({"settings": "belt.elements=64"})", {"list of texts"});
  refused(with_settings(), R"({"settings": [64]})", {"list of texts"});
  refused(with_settings(), R"({"settings": ["belt.elements"]})", {"belt.elements", "no '='"});
  refused(with_settings(), R"({"settings": ["belt.elemnts=64"]})", {"belt.elemnts", "did you mean 'belt.elements'"});
  refused(with_settings(), R"({"settings": ["belt.elements=64\nbelt.ribs=3"]})", {"control character"});
  refused(with_settings(), R"({"settings": ["belt.elements=1"]})", {"belt.elements: 1 is out of limits"});
  refused(calculator(), R"({"settings": ["belt.elements=64"]})", {"allowed: nothing", "server.settings"});
}

TEST(UmBridgeError, NamesWhatIsWrongWithAnInput) {
  const auto refused = [](const std::string& input, const std::vector<std::string>& words) {
    expect_error(evaluate(R"({"name": "toy", "input": )" + input + "}"), 400, "InvalidInput", words);
  };
  refused("[[2]]", {"1 entries", "2 numbers"});
  refused("[[2, 3, 4]]", {"3 entries", "2 numbers"});
  refused("[2, 3]", {"one list"});
  refused("[[2], [3]]", {"one list"});
  refused("[]", {"one list"});
  refused("{}", {"one list"});
  refused("null", {"one list"});
  refused("[7]", {"is a number"});
  refused("[[2, \"3\"]]", {"belt.b", "string"});
  refused("[[2, null]]", {"belt.b", "null"});
  refused("[[true, 2]]", {"belt.a", "boolean"});
  refused("[[2, NaN]]", {"NaN"});
  refused("[[2, -Infinity]]", {"infinity"});
  refused("[[2, 1e999]]", {"1e999"});
  refused("[[10.5, 3]]", {"belt.a", "10.5", "from 0 to 10"});
  refused("[[2, 123456789012345678901234567890]]", {"belt.b", "from -1000000 to 1000000"});
  expect_error(evaluate(R"({"name": "toy"})"), 400, "InvalidInput", {"'input' is missing"});
  expect_error(evaluate(R"({"name": "toy", "inputs": [[2, 3]]})"), 400, "InvalidInput", {"did you mean 'input'"});
}

TEST(UmBridgeError, NamesWhatIsWrongWithARequest) {
  const auto refused = [](const std::string& body, const std::vector<std::string>& words) {
    expect_error(evaluate(body), 400, "InvalidInput", words);
  };
  refused("", {"no JSON"});
  refused("{", {"no JSON"});
  refused("[]", {"not an object"});
  refused("{}", {"'name' is missing"});
  refused(R"({"name": 7})", {"'name' is a number"});
  refused(std::string("{\"name\": \"\xff\"}"), {"no JSON"});
  expect_error(evaluate(R"({"name": "toi", "input": [[2, 3]]})"), 400, "ModelNotFound", {"toi", "toy"});
  expect_error(evaluate(R"({"name": "wrong_model_name"})"), 400, "ModelNotFound", {"wrong_model_name"});
}

TEST(UmBridgeError, OfDerivativesComesBeforeAllButTheModelsName) {
  for (const char* path : {"/Gradient", "/ApplyJacobian", "/ApplyHessian"}) {
    expect_error(post(calculator(), path, R"({"name": "toy"})"), 400, "UnsupportedFeature", {path + 1});
    expect_error(post(calculator(), path, R"({"name": "toy", "inWrt": 0, "outWrt": 0, "input": [[2, 3]]})"), 400,
                 "UnsupportedFeature", {"no derivatives"});
    expect_error(post(calculator(), path, R"({"name": "no"})"), 400, "ModelNotFound", {"toy"});
  }
}

TEST(UmBridgeError, OfPathsAndMethodsComesWithoutABody) {
  const UmBridge bridge(calculator());
  expect_error(bridge.answer("GET", "/", ""), 404, "UnsupportedFeature", {"there is no /", "/Evaluate"});
  expect_error(bridge.answer("POST", "/evaluate", "{}"), 404, "UnsupportedFeature", {"/evaluate"});
  expect_error(bridge.answer("GET", "/Evaluate", ""), 405, "UnsupportedFeature", {"allowed: POST"});
  expect_error(bridge.answer("POST", "/Info", "{}"), 405, "UnsupportedFeature", {"allowed: GET"});
  EXPECT_FALSE(bridge.refuse("GET", "/Info"));
  EXPECT_FALSE(bridge.refuse("POST", "/Evaluate"));
  EXPECT_TRUE(bridge.refuse("PUT", "/Evaluate"));
}

TEST(UmBridgeError, SaysWhyAPointHasNoAnswer) {
  expect_error(evaluate(R"({"name": "toy", "input": [[0.5, 3]]})"), 400, "InvalidInput",
               {"infeasible", "pulleys overlap"});
  expect_error(evaluate(R"({"name": "toy", "input": [[9.5, 3]]})"), 500, "EvaluationError", {"diverged", "range slow"});
  ServedModel m = calculator();
  const std::string good = R"({"name": "toy", "input": [[2, 3]]})";
  m.evaluate = [](const Point&) -> Answer { throw std::runtime_error("out of memory"); };
  expect_error(post(m, "/Evaluate", good), 500, "EvaluationError", {"out of memory"});
  m.evaluate = [](const Point&) -> Answer { throw Interrupted(); };
  expect_error(post(m, "/Evaluate", good), 503, "EvaluationError", {"stopping"});
  m.evaluate = [](const Point&) { return Answer{PointState::ok, "", {1}, 0}; };
  expect_error(post(m, "/Evaluate", good), 500, "InvalidOutput", {"1 numbers instead of 2"});
  m.evaluate = [](const Point&) {
    return Answer{PointState::ok, "", {1, std::numeric_limits<double>::quiet_NaN()}, 0};
  };
  expect_error(post(m, "/Evaluate", good), 500, "InvalidOutput", {"product has no finite value"});
}

TEST(UmBridgeError, OfDeepNestingComesWithoutDeepRecursion) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string deep;
    for (int i = 0; i < 200000; ++i) deep += bracket;
    expect_error(evaluate(deep), 400, "InvalidInput", {"nested deeper than 16"});
  }
  expect_error(evaluate("\"" + std::string(100, '[') + "\""), 400, "InvalidInput", {"not an object"});
}

// Mutations of good requests: bytes, pieces cut, doubled or exchanged for what JSON has of its own.
std::string damaged(std::string text, std::mt19937& random) {
  static const std::vector<std::string> pieces{"{",
                                               "}",
                                               "[",
                                               "]",
                                               ",",
                                               ":",
                                               "\"",
                                               "\\",
                                               "null",
                                               "true",
                                               "-",
                                               "1e999",
                                               "NaN",
                                               "\"input\"",
                                               "\"config\"",
                                               "\xff",
                                               "\"settings\"",
                                               "[[2,3]]",
                                               "0.5",
                                               "\\u0000",
                                               "\\ud800",
                                               std::string(1, '\0'),
                                               "\n",
                                               "99999999999999999999",
                                               "=",
                                               "belt.elements=64"};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t k = 1 + below(2); k > 0; --k) {
    const std::size_t at = below(text.size() + 1), length = std::min(below(12), text.size() - at);
    switch (below(4)) {
      case 0:
        text.replace(at, length, "");
        break;
      case 1:
        text.insert(at, pieces[below(pieces.size())]);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(random());
    }
  }
  return text;
}

TEST(UmBridgeFuzz, AnswersDamagedRequestsWithOutputOrErrorAndNothingElse) {
  const std::vector<std::string> originals{
      R"({"name": "toy", "input": [[2.5, 300]], "config": {}})",
      R"({"name": "toy", "input": [[2.5, 300]], "config": {"settings": ["belt.elements=64"]}})", R"({"name": "toy"})",
      R"({"name": "toy", "config": null})"};
  const std::vector<std::string> paths{"/Evaluate",    "/Evaluate",  "/Evaluate", "/InputSizes",
                                       "/OutputSizes", "/ModelInfo", "/Gradient", "/Info"};
  const UmBridge plain(calculator()), settable(with_settings());
  std::mt19937 random(20261122);
  int good = 0, bad = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string body = damaged(originals[random() % originals.size()], random);
    const HttpAnswer a = (i % 2 ? plain : settable).answer("POST", paths[random() % paths.size()], body);
    const Json j = Json::parse(a.body, nullptr, false);
    ASSERT_TRUE(j.is_object() && j.size() == 1) << body << "\n" << a.body;
    ASSERT_EQ(a.status == 200, !j.contains("error")) << body << "\n" << a.body;
    if (a.status != 200) {
      ASSERT_TRUE(j["error"]["type"].is_string() && j["error"]["message"].is_string()) << a.body;
    }
    ++(a.status == 200 ? good : bad);
  }
  EXPECT_GT(good, 500) << "hardly a request got past the door: the damage is too heavy to show anything";
  EXPECT_GT(bad, 5000);
}

}  // namespace
}  // namespace beltlife
