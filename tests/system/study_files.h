// Owns what tests of studies share: a small drive, other programs as models, a command that can be stopped on its way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>

#include "tests/system/command.h"

namespace beltlife::system_test {

/// The smallest drive that is still one: 64 elements, 0.18 s a range, with the scheme that has vector lanes.
inline std::string small_drive() {
  std::string text = text_of(scene("two_pulley"));
  for (const auto& [right, wrong] : {std::pair{"elements = 264", "elements = 64"},
                                     {"settle_s = 0.2 ", "settle_s = 0.01 "},
                                     {"ramp_s = 0.5 ", "ramp_s = 0.05 "},
                                     {"hold_s = 2 ", "hold_s = 0.12 "},
                                     {"evaluate_s = 1 ", "evaluate_s = 0.06 "}})
    text = replaced(text, right, wrong);
  return text + "\n[solver]\nscheme = \"linearly_implicit\"\nstep_s = 2e-5\n";
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

/// A folder with `drive.toml`, and logs of studies read back.
class InStudyFolder : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("drive.toml", small_drive());
  }

  /// The study `name`.toml of the folder on two threads, without progress.
  Answer study(const std::string& kind, const std::string& name, const Arguments& more = {}) const {
    return run(Arguments{"study", kind, name + ".toml", "--quiet", "--json"} + more);
  }

  /// An executable file that reads x from its input, as the awk program may use it, and prints what that prints.
  void write_model(const std::string& name, const std::string& awk) const {
    const std::string reads = "{ split($0, part, /[:}]/); x = part[2] + 0; " + awk + " }";
    write(name, "#!/bin/sh\nexec awk '" + reads + "'\n");
    fs::permissions(folder / name, fs::perms::owner_all);
  }

  /// Points of the log by number.
  std::vector<nlohmann::json> points(const std::string& name) const {
    std::vector<nlohmann::json> all;
    for (const std::string& line : lines_of(text_of(folder / (name + ".jsonl"))))
      if (auto j = nlohmann::json::parse(line, nullptr, false); j.contains("point")) all.push_back(std::move(j));
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a["point"] < b["point"]; });
    return all;
  }
  /// The same without the processor time, the only part that differs from run to run.
  std::vector<nlohmann::json> timeless_points(const std::string& name) const {
    auto all = points(name);
    for (auto& p : all) p.erase("processor_s");
    return all;
  }

  /// Starts the command with both streams in files and sends it `signal` once its log has more than `points` points.
  /// Returns its exit code, 128 + signal if that ended it; what it said on standard error is in the file "said".
  int stopped_after(std::size_t points, int signal, const std::string& log, const Arguments& arguments) const {
    std::vector<char*> argv{const_cast<char*>("beltlife")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const int in = open("/dev/null", O_RDONLY);
      if (chdir(folder.c_str()) != 0) _exit(127);
      const int said = open("said", O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (dup2(in, 0) == 0 && dup2(said, 1) == 1 && dup2(said, 2) == 2) execv(BELTLIFE_COMMAND, argv.data());
      _exit(127);
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(40);
    int status = 0;
    bool sent = false;
    while (waitpid(child, &status, WNOHANG) == 0) {
      const auto lines = lines_of(text_of(folder / log));
      const bool late = std::chrono::steady_clock::now() > deadline;
      if (late || (!sent && lines.size() > points + 1)) kill(child, late ? SIGKILL : signal);
      sent = sent || lines.size() > points + 1;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

}  // namespace beltlife::system_test
