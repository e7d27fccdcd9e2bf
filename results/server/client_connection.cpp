// One client's connection: see client_connection.h.
#include "results/server/client_connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace beltlife {
namespace {

constexpr std::chrono::milliseconds glance{50};  // how long a request to stop may go unseen
constexpr std::chrono::seconds farewell{1};      // for what a client still sends after its answer

std::chrono::steady_clock::duration seconds(double s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(s));
}

}  // namespace

ClientConnection::ClientConnection(int socket, const HttpLimits& limits, const std::atomic<bool>& stopping)
    : socket_(socket), limits_(limits), stopping_(stopping), deadline_(Clock::now() + seconds(limits.request_s)) {
  const int yes = 1;  // head and body are written apart, and the second must not wait for the first to be acknowledged
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

ClientConnection::~ClientConnection() {
  // Closing with bytes unread would reset the connection, and the answer be lost on its way.
  shutdown(socket_, SHUT_WR);
  const bool patient = !hurried_ && trouble_ != ClientTrouble::slow && trouble_ != ClientTrouble::gone;
  const auto until = Clock::now() + farewell;
  do {
    const long got = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EAGAIN)) break;
  } while (patient && wait(POLLIN, until));
  close(socket_);
}

bool ClientConnection::wait(short events, Clock::time_point until) const {
  while (true) {
    if (stopping_ && events == POLLIN) return false;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) return false;
    pollfd one{socket_, events, 0};
    const int ready = poll(&one, 1, static_cast<int>(std::min(left, glance).count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool ClientConnection::fill() {
  if (trouble_ != ClientTrouble::none) return false;
  if (!wait(POLLIN, deadline_)) {
    trouble_ = stopping_ ? ClientTrouble::stopping : ClientTrouble::slow;
    return false;
  }
  const long got = recv(socket_, buffer_.data(), buffer_.size(), 0);
  if (got <= 0) {
    trouble_ = ClientTrouble::gone;
    return false;
  }
  begin_ = 0;
  end_ = static_cast<std::size_t>(got);
  for (std::size_t i = 0; in_head_ && i < end_; ++i) {  // an empty line ends the head
    ++head_bytes_;
    if (buffer_[i] == '\n') {
      in_head_ = !line_is_empty_;
      line_is_empty_ = true;
    } else if (buffer_[i] != '\r') {
      line_is_empty_ = false;
    }
  }
  if (head_bytes_ <= limits_.head_bytes) return true;
  trouble_ = ClientTrouble::long_head;
  return false;
}

long ClientConnection::read(char* to, std::size_t size) {
  if (begin_ == end_ && !fill()) return -1;
  const std::size_t count = std::min(size, end_ - begin_);
  std::memcpy(to, buffer_.data() + begin_, count);
  begin_ += count;
  return static_cast<long>(count);
}

bool ClientConnection::write(std::string_view text) {
  const auto until = Clock::now() + seconds(limits_.request_s);
  while (!text.empty()) {
    if (!wait(POLLOUT, until)) return false;
    const long sent = send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return false;
    text.remove_prefix(static_cast<std::size_t>(std::max(sent, 0L)));
  }
  return true;
}

}  // namespace beltlife
