// Owns the running of the beltlife command as a process of its own: arguments in, exit code and both streams out.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace beltlife::system_test {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// How a process ended. `code` is -1 if it had to be killed, 128 + signal if it died of a signal.
struct Answer {
  int code = -1;
  std::string out, err;

  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

inline std::string scene(const std::string& name) { return std::string(BELTLIFE_SCENES) + "/" + name + ".toml"; }

/// a followed by b.
inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Runs a program without a shell, so that no character of an argument means anything. `line` begins with what the
/// program is to be called. Standard input is empty.
inline Answer run_program(const std::string& path, const Arguments& line, const fs::path& folder, double time_out_s) {
  Answer answer;
  std::array<int, 2> out{}, err{};
  if (pipe(out.data()) != 0 || pipe(err.data()) != 0) return answer;
  std::vector<char*> argv;
  for (const std::string& argument : line) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const int empty = open("/dev/null", O_RDONLY);
    if (chdir(folder.c_str()) == 0 && dup2(empty, 0) == 0 && dup2(out[1], 1) == 1 && dup2(err[1], 2) == 2) {
      for (const int pipe_end : {out[0], out[1], err[0], err[1]}) close(pipe_end);
      execvp(path.c_str(), argv.data());
    }
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(time_out_s);
  std::array<pollfd, 2> ends{pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
  const std::array<std::string*, 2> texts{&answer.out, &answer.err};
  bool late = child < 0;
  while (!late && (ends[0].fd >= 0 || ends[1].fd >= 0)) {
    late = std::chrono::steady_clock::now() > deadline;
    if (poll(ends.data(), ends.size(), 100) <= 0) continue;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      std::array<char, 65536> buffer;
      const ssize_t got = read(ends[i].fd, buffer.data(), buffer.size());
      if (got > 0)
        texts[i]->append(buffer.data(), static_cast<std::size_t>(got));
      else
        ends[i].fd = -1;  // poll() passes over it; closed below
    }
  }
  if (child > 0 && late) kill(child, SIGKILL);
  close(out[0]);
  close(err[0]);
  int status = 0;
  if (child > 0 && waitpid(child, &status, 0) == child && !late)
    answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return answer;
}

inline Answer beltlife(const Arguments& arguments, const fs::path& folder = fs::temp_directory_path(),
                       double time_out_s = 50) {
  return run_program(BELTLIFE_COMMAND, Arguments{"beltlife"} + arguments, folder, time_out_s);
}

/// A folder of one test's own, which disappears with it.
class InFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "beltlife_system_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  Answer run(const Arguments& arguments) const { return beltlife(arguments, folder); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    return names;
  }

  fs::path folder;
};

inline std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `text` with the first `right` replaced; the test fails if there is none.
inline std::string replaced(std::string text, const std::string& right, const std::string& wrong) {
  const auto at = text.find(right);
  EXPECT_NE(at, text.npos) << right;
  return at == text.npos ? text : text.replace(at, right.size(), wrong);
}

/// Settings that make a run as short as it can be and still hold two revolutions at 1000 r/min in each window, as many
/// as order tracking needs.
inline Arguments brief(int elements) {
  return {"--quiet",
          "--elements",
          std::to_string(elements),
          "--set",
          "profile.settle_s=0.05",
          "--set",
          "profile.ramp_s=0.1",
          "--set",
          "profile.hold_s=0.2",
          "--set",
          "profile.transition_s=0.05",
          "--set",
          "profile.evaluate_s=0.15"};
}

/// Fails the test for every key that `object` has not.
inline void expect_keys(const nlohmann::json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys)
    EXPECT_TRUE(object.contains(key)) << key << " in " << object.dump().substr(0, 300);
}

}  // namespace beltlife::system_test
