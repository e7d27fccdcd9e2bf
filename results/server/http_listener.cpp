// The HTTP side of the server: see http_listener.h.
#include "results/server/http_listener.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "results/server/client_connection.h"

namespace beltlife {
namespace {

constexpr const char* json_type = "application/json";

/// Set while a connection is closed again because too many wait.
thread_local bool turned_away = false;

/// The library's view of a connection. Once a request is in trouble, what the library would answer is not sent.
class LibraryStream : public httplib::Stream {
 public:
  explicit LibraryStream(ClientConnection& client) : client_(client) {}
  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override { return client_.read(to, size); }
  ssize_t write(const char* from, std::size_t size) override {
    const bool sent = client_.trouble() != ClientTrouble::none || client_.write({from, size});
    return sent ? static_cast<ssize_t>(size) : -1;
  }
  // It wants addresses for logs that nobody keeps here.
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  socket_t socket() const override { return client_.socket(); }

 private:
  ClientConnection& client_;
};

/// Threads for connections, with a waiting line that ends somewhere.
class Workers : public httplib::TaskQueue {
 public:
  explicit Workers(const HttpLimits& limits) : waiting_(static_cast<std::size_t>(limits.waiting)) {
    for (int i = 0; i < limits.connections; ++i) threads_.emplace_back([this] { work(); });
  }

  void enqueue(std::function<void()> serve) override {
    {
      const std::lock_guard lock(mutex_);
      if (tasks_.size() < waiting_) {
        tasks_.push_back(std::move(serve));
        changed_.notify_one();
        return;
      }
    }
    turned_away = true;
    serve();
    turned_away = false;
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    for (std::thread& t : threads_) t.join();
  }

 private:
  void work() {
    while (true) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ended_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      const auto serve = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      serve();
    }
  }

  std::size_t waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

void send(ClientConnection& client, const HttpAnswer& answer) {
  client.write(fmt::format("HTTP/1.1 {} Error\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{}",
                           answer.status, json_type, answer.body.size(), answer.body));
}

HttpAnswer too_long(std::size_t bytes) {
  return error_answer(413, "InvalidInput",
                      fmt::format("the body is too long (allowed: {} bytes; server.max_body_bytes)", bytes));
}

}  // namespace

class HttpListener::Server : public httplib::Server {
 public:
  Server(const HttpLimits& limits, std::function<std::optional<HttpAnswer>(std::string_view, std::string_view)> refuse,
         std::function<HttpAnswer(std::string_view, std::string_view, std::string_view)> answer)
      : limits_(limits), refuse_(std::move(refuse)), answer_(std::move(answer)) {
    new_task_queue = [this] { return new Workers(limits_); };
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      const auto refused = refused_unread(request);
      if (!refused) return HandlerResponse::Unhandled;
      if (refused->status == 405) response.set_header("Allow", request.path == "/Info" ? "GET" : "POST");
      set(response, *refused);
      return HandlerResponse::Handled;
    });
    // Without the library's SO_REUSEPORT: two servers on one port would take turns.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_error_handler([](const httplib::Request&, httplib::Response& response) {  // what the library refuses itself
      if (response.body.empty())
        set(response, error_answer(response.status, "InvalidInput", "this is no HTTP request as it should be"));
    });
    Get("/[A-Za-z]+", [this](const httplib::Request& request, httplib::Response& response) {
      set(response, answer_(request.method, request.path, {}));
    });
    Post("/[A-Za-z]+",
         [this](const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& content) {
           std::string body;
           bool fits = true;
           const bool whole = content([&](const char* data, std::size_t size) {
             fits = body.size() + size <= limits_.body_bytes;
             if (fits) body.append(data, size);
             return fits;
           });
           if (!fits)
             set(response, too_long(limits_.body_bytes));
           else if (whole)
             set(response, answer_(request.method, request.path, body));
           else
             set(response, error_answer(400, "InvalidInput", "the body did not come in whole"));
         });
  }

  void run() {
    listen_after_bind();
    ended_ = true;
  }

  void end() {
    stopping_ = true;
    while (!is_running() && !ended_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!ended_) stop();  // the library forgets a stop that comes before it runs
  }

 private:
  static void set(httplib::Response& response, const HttpAnswer& answer) {
    response.status = answer.status;
    response.set_content(answer.body, json_type);
  }

  std::optional<HttpAnswer> refused_unread(const httplib::Request& request) const {
    if (auto refused = refuse_(request.method, request.path)) return refused;
    if (request.method != "POST") return {};
    const auto refusal = [](int status, const std::string& words) {
      return error_answer(status, "InvalidInput", words);
    };
    if (request.has_header("Content-Encoding"))  // a small body could unfold to a huge one
      return refusal(415, "compressed bodies are not read");
    if (request.get_header_value("Content-Type").starts_with("multipart/"))
      return refusal(415, "the body must be JSON by itself, not a multipart form");
    if (request.has_header("Transfer-Encoding")) return {};
    if (!request.has_header("Content-Length")) return refusal(411, "the request does not say how long its body is");
    const std::string length = request.get_header_value("Content-Length");
    if (length.empty() || length.find_first_not_of("0123456789") != length.npos)
      return refusal(400, "Content-Length is no number");
    if (length.size() > 18 || std::stoull(length) > limits_.body_bytes) return too_long(limits_.body_bytes);
    return {};
  }

  bool process_and_close_socket(socket_t socket) override {
    ClientConnection client(socket, limits_, stopping_);
    if (turned_away || stopping_) {
      client.hurry();
      send(client, error_answer(503, "EvaluationError",
                                stopping_ ? "the server is stopping" : "too many connections; try again"));
      return false;
    }
    LibraryStream stream(client);
    bool closed = false;
    process_request(stream, true, closed, nullptr);
    switch (client.trouble()) {
      case ClientTrouble::none:
      case ClientTrouble::gone:
        return true;
      case ClientTrouble::slow:
        send(client, error_answer(408, "InvalidInput",
                                  fmt::format("the request did not come in whole within {} s", limits_.request_s)));
        break;
      case ClientTrouble::long_head:
        send(client,
             error_answer(431, "InvalidInput",
                          fmt::format("the request's head is too long (allowed: {} bytes)", limits_.head_bytes)));
        break;
      case ClientTrouble::stopping:
        send(client, error_answer(503, "EvaluationError", "the server is stopping"));
        break;
    }
    return false;
  }

  HttpLimits limits_;
  std::function<std::optional<HttpAnswer>(std::string_view, std::string_view)> refuse_;
  std::function<HttpAnswer(std::string_view, std::string_view, std::string_view)> answer_;
  std::atomic<bool> stopping_ = false, ended_ = false;
};

HttpListener::HttpListener(const HttpLimits& limits,
                           std::function<std::optional<HttpAnswer>(std::string_view, std::string_view)> refuse,
                           std::function<HttpAnswer(std::string_view, std::string_view, std::string_view)> answer)
    : server_(std::make_unique<Server>(limits, std::move(refuse), std::move(answer))) {}

HttpListener::~HttpListener() = default;

int HttpListener::open(const std::string& address, int port) {
  if (port != 0) return server_->bind_to_port(address, port) ? port : 0;
  const int chosen = server_->bind_to_any_port(address);
  return chosen > 0 ? chosen : 0;
}

void HttpListener::run() { server_->run(); }

void HttpListener::stop() { server_->end(); }

}  // namespace beltlife
