// Owns what tests of the server share: the command as a server under way, and clients on plain sockets.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <thread>

#include "tests/system/study_files.h"

namespace beltlife::system_test {

/// What came back over HTTP; `status` is 0 if nothing did.
struct HttpReply {
  int status = 0;
  std::string head, body;

  nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
};

/// One connection to a port of this machine.
class Socket {
 public:
  explicit Socket(int port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    open_ = connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~Socket() { close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  bool is_open() const { return open_; }
  void send(const std::string& text) const {
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t n = ::send(fd_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return;  // turned away already
      sent += static_cast<std::size_t>(n);
    }
  }
  /// Says that nothing more is sent.
  void end() const { shutdown(fd_, SHUT_WR); }
  /// All that comes until the server closes, or until `seconds` are over.
  std::string all(double seconds = 20) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    std::string text;
    std::array<char, 65536> buffer;
    while (std::chrono::steady_clock::now() < deadline) {
      pollfd one{fd_, POLLIN, 0};
      if (poll(&one, 1, 50) <= 0) continue;
      const ssize_t got = recv(fd_, buffer.data(), buffer.size(), 0);
      if (got <= 0) break;
      text.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int fd_;
  bool open_ = false;
};

inline HttpReply reply_of(const std::string& text) {
  HttpReply reply;
  const auto end = text.find("\r\n\r\n");
  if (!text.starts_with("HTTP/1.1 ") || end == text.npos) return reply;
  reply.status = std::stoi(text.substr(9, 3));
  reply.head = text.substr(0, end);
  reply.body = text.substr(end + 4);
  return reply;
}

inline std::string request_text(const std::string& method, const std::string& path, const std::string& body) {
  return method + " " + path + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\n\r\n" + body;
}

/// A folder with the small drive and a server of it. Its file is `served()`; `server_table` goes below [server].
class InServedFolder : public InStudyFolder {
 protected:
  void TearDown() override {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
    InStudyFolder::TearDown();
  }

  static std::string served(const std::string& server_table) {
    return "scene = \"drive.toml\"\n"
           "quantities = [\"fast.pulley.driven.hub_load_n.mean\", \"slow.pulley.driven.hub_load_n.max\"]\n"
           "[[parameter]]\npath = \"belt.friction_front\"\nlower = 0.2\nupper = 1\n"
           "[[parameter]]\npath = \"pulley.driven.x_mm\"\nlower = 50\nupper = 600\n"
           "[server]\nsettings = [\"belt.elements\"]\n" +
           server_table;
  }

  /// Starts the server on a port that the system chooses. Its standard error goes to the file "said".
  void start(const std::string& file, const Arguments& more = {}) {
    write("served.toml", file);
    std::array<int, 2> out{};
    ASSERT_EQ(pipe2(out.data(), O_CLOEXEC), 0);
    const Arguments arguments = Arguments{"serve", "served.toml", "--port", "0"} + more;
    std::vector<char*> argv{const_cast<char*>("beltlife")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      const int in = open("/dev/null", O_RDONLY);
      if (chdir(folder.c_str()) != 0) _exit(127);
      const int said = open("said", O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (dup2(in, 0) == 0 && dup2(out[1], 1) == 1 && dup2(said, 2) == 2) execv(BELTLIFE_COMMAND, argv.data());
      _exit(127);
    }
    close(out[1]);
    printed.clear();
    for (char c = 0; read(out[0], &c, 1) == 1 && c != '\n';) printed += c;
    close(out[0]);
    const auto at = printed.find("http://");
    ASSERT_NE(at, printed.npos) << printed << text_of(folder / "said");
    port_ = std::stoi(printed.substr(printed.find(':', at + 7) + 1));
  }

  /// Sends a signal and waits. Returns the exit code, 128 + signal if that ended it, -1 if it did not end.
  int stop(int signal = SIGTERM, double seconds = 20) {
    kill(child_, signal);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// A request as a client would send it.
  HttpReply http(const std::string& method, const std::string& path, const std::string& body = "") const {
    const Socket socket(port_);
    socket.send(request_text(method, path, body));
    return reply_of(socket.all());
  }
  static std::string evaluation(double friction, double x_mm, const nlohmann::json& config = nullptr) {
    return nlohmann::json{{"name", "beltlife"}, {"input", {{friction, x_mm}}}, {"config", config}}.dump();
  }
  HttpReply evaluate(double friction, double x_mm, const nlohmann::json& config = nullptr) const {
    return http("POST", "/Evaluate", evaluation(friction, x_mm, config));
  }

  int port() const { return port_; }

  std::string printed;  ///< the line that the server printed when it was ready

 private:
  pid_t child_ = -1;
  int port_ = 0;
};

}  // namespace beltlife::system_test
