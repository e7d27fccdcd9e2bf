// Owns the UM-Bridge protocol, version 1.0: from the text of a request to the text of its answer. No sockets.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/eval/point.h"
#include "sim/eval/problem_spec.h"

namespace beltlife {

/// What an HTTP request is answered with; `body` is one JSON object.
struct HttpAnswer {
  int status = 200;
  std::string body;
};

/// An error in the protocol's form, {"error": {"type": ..., "message": ...}}; bytes that are no UTF-8 are replaced.
HttpAnswer error_answer(int status, std::string_view type, const std::string& message);

/// What is served: one model whose single input vector are the parameters and whose single output vector the
/// quantities, both in this order.
struct ServedModel {
  std::string name;
  std::vector<ParameterSpec> parameters;
  std::vector<std::string> quantities;
  std::vector<std::string> settings;  ///< paths that a request's config may set; empty: none
  /// Why settings PATH=VALUE (of allowed paths) cannot be applied; empty if they can. Unused without `settings`.
  std::function<std::string(const std::vector<std::string>&)> refusal;
  /// Answers a point: first, if there are `settings`, those of the request, one a line, then the parameters. Called
  /// from any thread, may block. Throws Interrupted where the server is about to stop.
  std::function<Answer(const Point&)> evaluate;
};

/// Nesting of a request's JSON beyond which it is refused unread; the protocol itself needs three levels.
inline constexpr int deepest_request = 16;

/// Answers requests. Whatever the request, the answer is a JSON object and nothing is thrown.
class UmBridge {
 public:
  explicit UmBridge(ServedModel model) : model_(std::move(model)) {}

  /// Why no request of this method and path can be answered, before its body is read; nothing if one can.
  std::optional<HttpAnswer> refuse(std::string_view method, std::string_view path) const;

  HttpAnswer answer(std::string_view method, std::string_view path, std::string_view body) const;

 private:
  ServedModel model_;
};

}  // namespace beltlife
