// The UM-Bridge protocol: see um_bridge.h.
#include "results/server/um_bridge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/scene/spec_value.h"

namespace beltlife {
namespace {

using Json = nlohmann::json;

constexpr const char *invalid_input = "InvalidInput", *unsupported = "UnsupportedFeature",
                     *evaluation_error = "EvaluationError";

constexpr std::array<std::string_view, 7> post_paths{"/InputSizes",    "/OutputSizes", "/ModelInfo",   "/Evaluate",
                                                     "/ApplyJacobian", "/Gradient",    "/ApplyHessian"};
constexpr std::array<std::string_view, 3> derivatives{"/Gradient", "/ApplyJacobian", "/ApplyHessian"};

/// A request that cannot be answered as it is.
struct Refused {
  HttpAnswer answer;
};

[[noreturn]] void refuse_input(const std::string& message) { throw Refused{error_answer(400, invalid_input, message)}; }

template <class List>
bool among(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// A client's text inside a message: no longer than a line can hold.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 80;
  return text.size() <= longest ? std::string(text) : std::string(text.substr(0, longest)) + "...";
}

/// Deepest nesting of brackets outside texts. The library builds any depth, and what is copied is copied recursively.
int depth_of(std::string_view json) {
  int depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

Json parsed(std::string_view body) {
  if (depth_of(body) > deepest_request)
    refuse_input(fmt::format("the request is nested deeper than {} levels", deepest_request));
  try {
    return Json::parse(body);
  } catch (const Json::exception& e) {
    std::string why = e.what();  // [json.exception.parse_error.101] parse error at ...
    if (const auto end = why.find("] "); end != why.npos) why.erase(0, end + 2);
    refuse_input("the request is no JSON (NaN and infinity are not either): " + why);
  }
}

void refuse_unknown_keys(const Json& object, std::string_view where, const std::vector<std::string>& allowed) {
  for (const auto& [key, value] : object.items())
    if (!among(allowed, key))
      refuse_input(fmt::format("unknown key '{}' in {}{} (allowed: {})", shown(key), where, did_you_mean(key, allowed),
                               allowed.empty() ? "none" : fmt::format("{}", fmt::join(allowed, ", "))));
}

void refuse_other_model(const Json& request, const ServedModel& model) {
  const auto name = request.find("name");
  if (name == request.end()) refuse_input("'name' is missing: the model's name, as GET /Info lists it");
  if (!name->is_string()) refuse_input(fmt::format("'name' is a {}, not a text", name->type_name()));
  if (const auto& asked = name->get_ref<const std::string&>(); asked != model.name)
    throw Refused{error_answer(400, "ModelNotFound",
                               fmt::format("there is no model '{}'; this server has '{}'", shown(asked), model.name))};
}

/// Settings of the request's config, one a line. A config that is null is none: so some clients send an empty one.
std::string settings_of(const Json& request, const ServedModel& model) {
  const auto config = request.find("config");
  if (config == request.end() || config->is_null()) return {};
  if (!config->is_object()) refuse_input(fmt::format("'config' is a {}, not an object", config->type_name()));
  refuse_unknown_keys(*config, "config", {"settings"});
  if (config->empty()) return {};
  const Json& list = config->front();
  const char* wanted = R"(config.settings is not a list of texts, as in ["belt.elements=256"])";
  if (!list.is_array()) refuse_input(wanted);
  std::vector<std::string> settings;
  std::string lines;
  for (const Json& entry : list) {
    if (!entry.is_string()) refuse_input(wanted);
    const auto& setting = entry.get_ref<const std::string&>();
    const std::string path = setting.substr(0, setting.find('='));
    if (path.size() == setting.size()) refuse_input(fmt::format("setting '{}' has no '='", shown(setting)));
    if (!among(model.settings, path))
      refuse_input(fmt::format("'{}' is not to be set by requests{} (allowed: {})", shown(path),
                               did_you_mean(path, model.settings),
                               model.settings.empty() ? "nothing; see server.settings of the study file"
                                                      : fmt::format("{}", fmt::join(model.settings, ", "))));
    if (std::any_of(setting.begin(), setting.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }))
      refuse_input(fmt::format("setting of '{}' holds a control character", path));
    settings.push_back(setting);
    lines += (lines.empty() ? "" : "\n") + setting;
  }
  if (!settings.empty())
    if (const std::string why = model.refusal(settings); !why.empty()) refuse_input("config.settings: " + why);
  return lines;
}

double number_at(const Json& input, std::size_t i, const ParameterSpec& p) {
  const Json& entry = input[i];
  if (!entry.is_number())
    refuse_input(fmt::format("input[0][{}], parameter '{}', is a {}, not a number", i, p.path, entry.type_name()));
  const double x = entry.get<double>();
  if (!std::isfinite(x)) refuse_input(fmt::format("input[0][{}], parameter '{}', is not finite", i, p.path));
  const double lower = p.lower.value_or(-INFINITY), upper = p.upper.value_or(INFINITY);
  if (x < lower || x > upper)
    refuse_input(
        fmt::format("parameter '{}' is {}, outside its bounds (allowed: from {} to {})", p.path, x, lower, upper));
  return x;
}

Point point_of(const Json& request, const ServedModel& model) {
  const auto input = request.find("input");
  const std::size_t n = model.parameters.size();
  if (input == request.end()) refuse_input("'input' is missing: a list of one list of numbers");
  if (!input->is_array() || input->size() != 1)
    refuse_input("'input' is not a list of one list: this model has one input vector");
  const Json& vector = input->front();
  if (!vector.is_array() || vector.size() != n)
    refuse_input(fmt::format(
        "input[0] {} (expected: a list of {} numbers)",
        vector.is_array() ? fmt::format("has {} entries", vector.size()) : fmt::format("is a {}", vector.type_name()),
        n));
  Point point;
  const std::string settings = settings_of(request, model);
  if (!model.settings.empty()) point.emplace_back(settings);
  for (std::size_t i = 0; i < n; ++i) point.emplace_back(number_at(vector, i, model.parameters[i]));
  return point;
}

HttpAnswer evaluated(const Point& point, const ServedModel& model) {
  const Answer a = model.evaluate(point);
  if (!a.ok()) {
    const std::string words = fmt::format("{}: {}", to_string(a.state), a.reason);
    if (a.state == PointState::infeasible) refuse_input(words);
    return error_answer(500, evaluation_error, words);
  }
  if (a.values.size() != model.quantities.size())
    return error_answer(
        500, "InvalidOutput",
        fmt::format("the model gave {} numbers instead of {}", a.values.size(), model.quantities.size()));
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (!std::isfinite(a.values[i]))
      return error_answer(500, "InvalidOutput", model.quantities[i] + " has no finite value");
  return {200, Json{{"output", Json::array({a.values})}}.dump()};
}

HttpAnswer posted(std::string_view path, std::string_view body, const ServedModel& model) {
  const Json request = parsed(body);
  if (!request.is_object()) refuse_input(fmt::format("the request is a {}, not an object", request.type_name()));
  refuse_other_model(request, model);
  if (among(derivatives, path))
    throw Refused{error_answer(400, unsupported,
                               fmt::format("{} is not supported: this model gives no derivatives", path.substr(1)))};
  refuse_unknown_keys(request, "the request", {"name", "input", "config"});
  if (path == "/Evaluate") return evaluated(point_of(request, model), model);
  if (path == "/ModelInfo")
    return {200, R"({"support":{"ApplyHessian":false,"ApplyJacobian":false,"Evaluate":true,"Gradient":false}})"};
  settings_of(request, model);
  if (path == "/InputSizes") return {200, fmt::format(R"({{"inputSizes":[{}]}})", model.parameters.size())};
  return {200, fmt::format(R"({{"outputSizes":[{}]}})", model.quantities.size())};
}

}  // namespace

HttpAnswer error_answer(int status, std::string_view type, const std::string& message) {
  const Json error{{"error", {{"type", type}, {"message", message}}}};
  return {status, error.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

std::optional<HttpAnswer> UmBridge::refuse(std::string_view method, std::string_view path) const {
  const bool info = path == "/Info", known = info || among(post_paths, path);
  if (!known)
    return error_answer(
        404, unsupported,
        fmt::format("there is no {} (allowed: GET /Info, POST {})", shown(path), fmt::join(post_paths, ", ")));
  if (method == (info ? "GET" : "POST")) return {};
  return error_answer(
      405, unsupported,
      fmt::format("{} {} is not part of the protocol (allowed: {})", shown(method), path, info ? "GET" : "POST"));
}

HttpAnswer UmBridge::answer(std::string_view method, std::string_view path, std::string_view body) const {
  if (auto refused = refuse(method, path)) return *refused;
  if (path == "/Info") return {200, Json{{"protocolVersion", 1.0}, {"models", {model_.name}}}.dump()};
  try {
    return posted(path, body, model_);
  } catch (const Refused& refused) {
    return refused.answer;
  } catch (const Interrupted&) {
    return error_answer(503, evaluation_error, "the server is stopping");
  } catch (const std::exception& e) {
    return error_answer(500, evaluation_error, std::string("the evaluation broke off: ") + e.what());
  }
}

}  // namespace beltlife
