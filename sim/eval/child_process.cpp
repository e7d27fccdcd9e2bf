// Running another program: see child_process.h.
#include "sim/eval/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

namespace beltlife {
namespace {

constexpr double first_pause_s = 50e-6;  // a program that has closed its output is about to exit
constexpr double longest_pause_s = 0.02;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A file descriptor, closed with its owner.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  bool open() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_ = -1;
};

/// Out of the way of 0, 1 and 2, which are free if somebody closed them and which the program's ends are copied to.
bool above_standard(Descriptor& end) {
  if (end.number() > STDERR_FILENO) return true;
  end = Descriptor(fcntl(end.number(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  return end.open();
}

/// A pipe of which neither end reaches programs that other threads start meanwhile: while any of those held an end,
/// there would be no end of file.
struct Pipe {
  Descriptor read, write;

  bool create() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return false;
    read = Descriptor(ends[0]);
    write = Descriptor(ends[1]);
    return above_standard(read) && above_standard(write);
  }
};

bool do_not_block(const Descriptor& end) { return fcntl(end.number(), F_SETFL, O_NONBLOCK) == 0; }

/// Keeps SIGPIPE of this thread's writes from killing us, whatever the process's disposition, and leaves no trace.
class NoBrokenPipeSignal {
 public:
  NoBrokenPipeSignal() {
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  NoBrokenPipeSignal(const NoBrokenPipeSignal&) = delete;
  ~NoBrokenPipeSignal() {
    const timespec at_once{};
    if (!was_pending_)
      while (sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t pipe_, before_;
  bool was_pending_;
};

/// A started program; killed with its group and reaped, should its owner not come to that.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  ~Child() {
    if (reaped_) return;
    kill_group();
    int status;
    rusage usage;
    reap(status, usage);
  }

  /// Leaves the zombie, so that its number stays ours to kill.
  bool has_exited() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 ? info.si_pid != 0
                                                                                           : errno != EINTR;
  }
  void kill_group() const { kill(-pid_, SIGKILL); }
  bool reap(int& status, rusage& usage) {
    reaped_ = true;
    while (wait4(pid_, &status, 0, &usage) < 0)
      if (errno != EINTR) return false;
    return true;
  }

 private:
  pid_t pid_;
  bool reaped_ = false;
};

/// Starts a program on its ends of the pipes; an errno, or 0.
int start(const std::vector<std::string>& command, const std::filesystem::path& folder, const Descriptor& in,
          const Descriptor& out, const Descriptor& err, pid_t& pid) {
  struct Settings {  // freed on every way out
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    Settings() {
      posix_spawn_file_actions_init(&files);
      posix_spawnattr_init(&attributes);
    }
    ~Settings() {
      posix_spawn_file_actions_destroy(&files);
      posix_spawnattr_destroy(&attributes);
    }
  } settings;

  const std::array<std::pair<int, int>, 3> copies{
      {{in.number(), STDIN_FILENO}, {out.number(), STDOUT_FILENO}, {err.number(), STDERR_FILENO}}};
  for (const auto& [from, to] : copies)
    if (const int error = posix_spawn_file_actions_adddup2(&settings.files, from, to)) return error;
  // Also what was opened without close-on-exec, by libraries.
  if (const int error = posix_spawn_file_actions_addclosefrom_np(&settings.files, STDERR_FILENO + 1)) return error;
  if (!folder.empty())
    if (const int error = posix_spawn_file_actions_addchdir_np(&settings.files, folder.c_str())) return error;

  sigset_t none, broken_pipe;
  sigemptyset(&none);
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  posix_spawnattr_setflags(&settings.attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&settings.attributes, 0);
  posix_spawnattr_setsigdefault(&settings.attributes, &broken_pipe);
  posix_spawnattr_setsigmask(&settings.attributes, &none);

  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));  // C's signature
  arguments.push_back(nullptr);
  return posix_spawnp(&pid, arguments[0], &settings.files, &settings.attributes, arguments.data(), environ);
}

bool later(int error) { return error == EAGAIN || error == EINTR; }

/// Writes what the pipe takes; closes it after the last byte, or when nobody reads any more.
void feed(Descriptor& pipe, std::string_view& input) {
  if (!input.empty()) {
    const ssize_t written = write(pipe.number(), input.data(), input.size());
    if (written < 0 && later(errno)) return;
    input.remove_prefix(written < 0 ? input.size() : static_cast<std::size_t>(written));
  }
  if (input.empty()) pipe.close();
}

/// Appends what the pipe holds, up to a buffer's length; closes it at its end.
void drain(Descriptor& pipe, std::string& text) {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = read(pipe.number(), buffer.data(), buffer.size());
  if (count > 0)
    text.append(buffer.data(), static_cast<std::size_t>(count));
  else if (count == 0 || !later(errno))
    pipe.close();
}

/// A closed pipe has number -1, which poll passes over.
void exchange(Descriptor& in, Descriptor& out, Descriptor& err, std::string_view& input, ProgramOutcome& outcome,
              double wait_s) {
  std::array<pollfd, 3> ends{{{in.number(), POLLOUT, 0}, {out.number(), POLLIN, 0}, {err.number(), POLLIN, 0}}};
  const timespec wait{0, static_cast<long>(std::clamp(wait_s, 0.0, 0.5) * 1e9)};
  if (ppoll(ends.data(), ends.size(), &wait, nullptr) <= 0) return;
  if (ends[0].revents != 0) feed(in, input);
  if (ends[1].revents != 0) drain(out, outcome.output);
  if (ends[2].revents != 0) drain(err, outcome.error_tail);
  if (outcome.error_tail.size() > error_tail_bytes)
    outcome.error_tail.erase(0, outcome.error_tail.size() - error_tail_bytes);
}

}  // namespace

ProgramOutcome run_program(const std::vector<std::string>& command, const std::filesystem::path& folder,
                           std::string_view input, double timeout_s) {
  ProgramOutcome outcome;
  const auto not_started = [&](int error) {
    outcome.end = ProgramEnd::not_started;
    outcome.code = error;
    return outcome;
  };
  if (command.empty()) return not_started(EINVAL);
  Pipe in, out, err;
  if (!in.create() || !out.create() || !err.create() || !do_not_block(in.write) || !do_not_block(out.read) ||
      !do_not_block(err.read))
    return not_started(errno);

  const double deadline = now_s() + timeout_s;
  pid_t pid = 0;
  if (const int error = start(command, folder, in.read, out.write, err.write, pid)) return not_started(error);
  Child child(pid);
  in.read.close();
  out.write.close();
  err.write.close();
  const NoBrokenPipeSignal guard;

  // The exit is asked for rather than waited for: no pipe tells of it while a grandchild holds the other end.
  bool exited = false;
  double until = deadline, pause = first_pause_s;
  ProgramEnd stopped = ProgramEnd::exited;
  for (;;) {
    if (!exited && child.has_exited()) {
      exited = true;
      until = now_s() + output_grace_s;
      in.write.close();
    }
    const bool silent = !out.read.open() && !err.read.open();
    if (exited && silent) break;
    const double left = until - now_s();
    if (left <= 0) {
      if (!exited) stopped = ProgramEnd::timed_out;
      break;
    }
    pause = silent ? std::min(2 * pause, longest_pause_s) : first_pause_s;
    exchange(in.write, out.read, err.read, input, outcome, std::min(left, silent ? pause : longest_pause_s));
    if (outcome.output.size() > output_limit_bytes) {
      stopped = ProgramEnd::too_much_output;
      break;
    }
  }
  if (stopped != ProgramEnd::exited) child.kill_group();

  int status = 0;
  rusage usage{};
  if (!child.reap(status, usage)) return not_started(errno);  // somebody has us ignore our children's ends
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  outcome.processor_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.end = stopped;
  if (stopped == ProgramEnd::exited) {
    outcome.end = WIFSIGNALED(status) ? ProgramEnd::killed : ProgramEnd::exited;
    outcome.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return outcome;
}

}  // namespace beltlife
