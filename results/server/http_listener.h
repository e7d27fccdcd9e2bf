// Owns the HTTP side of the server: sockets, threads and limits, around a function from request to answer.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "results/server/um_bridge.h"

namespace beltlife {

struct HttpLimits {
  std::size_t head_bytes = 16 << 10;  ///< request line and header fields
  std::size_t body_bytes = 1 << 20;   ///< also of a body sent in chunks
  double request_s = 10;              ///< within which a request must have come in whole, and an answer be taken
  int connections = 64;               ///< served at once, a thread each; each waits while its request is answered
  int waiting = 128;                  ///< further ones that are kept waiting; who comes then is turned away
};

/// An HTTP server, one request a connection, so that an idle client holds nothing. Whatever a client sends or does not
/// send, it gets an answer or is cut off, and others go on.
class HttpListener {
 public:
  /// `refuse` is asked before a body is read, `answer` with it; both from any thread.
  HttpListener(const HttpLimits& limits,
               std::function<std::optional<HttpAnswer>(std::string_view method, std::string_view path)> refuse,
               std::function<HttpAnswer(std::string_view method, std::string_view path, std::string_view body)> answer);
  ~HttpListener();

  /// Opens the port (0: the system chooses one) and returns it; 0 if it cannot be opened.
  int open(const std::string& address, int port);

  /// Serves until stop(); returns once all answers under way are sent.
  void run();

  /// From any thread: no connection is taken any more, and requests that have not come in whole are cut off.
  void stop();

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace beltlife
