// Owns one client's connection: reading and writing within a time and a number of bytes.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string_view>

#include "results/server/http_listener.h"

namespace beltlife {

/// Why a request has not come in whole.
enum class ClientTrouble { none, slow, long_head, gone, stopping };

/// Reading takes no longer than a whole request may take, however small the pieces in which it comes, and no more of a
/// head than its limit. `limits` and `stopping` must outlive it.
class ClientConnection {
 public:
  ClientConnection(int socket, const HttpLimits& limits, const std::atomic<bool>& stopping);
  ~ClientConnection();  ///< closes, so that a client which still sends gets to read its answer
  ClientConnection(const ClientConnection&) = delete;
  ClientConnection& operator=(const ClientConnection&) = delete;

  /// At most `size` bytes; -1 once there is trouble().
  long read(char* to, std::size_t size);
  /// No more time for this client: closing does not wait for what it still sends.
  void hurry() { hurried_ = true; }
  /// All of `text`, or false: the client is gone or does not take it.
  bool write(std::string_view text);

  int socket() const { return socket_; }
  ClientTrouble trouble() const { return trouble_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool wait(short events, Clock::time_point until) const;
  bool fill();

  int socket_;
  const HttpLimits& limits_;
  const std::atomic<bool>& stopping_;
  Clock::time_point deadline_;
  ClientTrouble trouble_ = ClientTrouble::none;
  std::array<char, 4096> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what of the buffer is not read yet
  std::size_t head_bytes_ = 0;
  bool in_head_ = true, line_is_empty_ = true;
  bool hurried_ = false;
};

}  // namespace beltlife
