// Owns the running of another program: text in, text out, within a time, with nothing of it left behind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace beltlife {

enum class ProgramEnd { exited, killed, timed_out, too_much_output, not_started };

/// What came of running a program.
struct ProgramOutcome {
  ProgramEnd end = ProgramEnd::not_started;
  int code = 0;            ///< exited: exit status; killed: signal; not_started: errno; else 0
  std::string output;      ///< standard output, whole if exited or killed by others
  std::string error_tail;  ///< the last bytes of standard error
  double processor_s = 0;  ///< of the program and the children it waited for
};

inline constexpr std::size_t output_limit_bytes = 4 << 20;
inline constexpr std::size_t error_tail_bytes = 2000;
/// How long output is waited for after a program's exit, where a process that it left behind holds it open.
inline constexpr double output_grace_s = 1;

/// Runs `command` (program and arguments) in `folder` (empty: the current one) with `input` on its standard input and
/// waits for its end. A program without a slash is looked up in PATH, others relative to `folder`. It gets no other
/// files of this process and a process group of its own, so that a Ctrl-C for us does not reach it; the whole group is
/// killed after `timeout_s` or when it prints more than output_limit_bytes. A program need not read its input. May be
/// called from several threads at once.
ProgramOutcome run_program(const std::vector<std::string>& command, const std::filesystem::path& folder,
                           std::string_view input, double timeout_s);

}  // namespace beltlife
