// Owns the fuzz target for requests to the server: any path and body get one JSON object with an output or an error,
// without an error in memory.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "results/server/um_bridge.h"

using namespace beltlife;

namespace {

ServedModel model() {
  ServedModel m;
  m.name = "m";
  m.parameters.resize(2);
  m.parameters[0].path = "a";
  m.parameters[0].lower = 0;
  m.parameters[1].path = "b";
  m.quantities = {"sum"};
  m.settings = {"belt.elements"};
  m.refusal = [](const std::vector<std::string>& s) { return s.front().ends_with("=1") ? "is out of limits" : ""; };
  m.evaluate = [](const Point& p) {
    const double sum = number_of(p.at(1)) + number_of(p.at(2));
    if (sum < 1) return Answer{PointState::diverged, "it broke off", {}, 0};
    return Answer{PointState::ok, "", {sum}, 0};  // infinite for two huge numbers: no output then
  };
  return m;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const UmBridge bridge(model());
  static const std::vector<std::string> paths{"/Evaluate", "/Evaluate", "/InputSizes", "/ModelInfo", "/Gradient"};
  if (size == 0) return 0;
  const std::string body(reinterpret_cast<const char*>(data) + 1, size - 1);
  const HttpAnswer answer = bridge.answer("POST", paths[data[0] % paths.size()], body);
  const auto json = nlohmann::json::parse(answer.body, nullptr, false);
  const bool error = json.is_object() && json.contains("error") && json["error"]["message"].is_string();
  if (json.is_object() && json.size() == 1 && error == (answer.status != 200)) return 0;
  std::fprintf(stderr, "broken claim: %d %s\n", answer.status, answer.body.c_str());
  std::abort();
}
