// Owns the claim that clang-tidy, with the checks of .clang-tidy, finds nothing in the simulator's core and results.
#include <gtest/gtest.h>

#include <thread>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

// What most needs a second reader. Scene reading is left out for time: toml++ alone takes a quarter of a minute.
std::vector<std::string> units() {
  std::vector<std::string> files;
  for (const std::string& file : cpp_files({"sim", "results"})) {
    const bool core = file.find('/', 4) == file.npos || file.starts_with("sim/kernels/") || file.starts_with("sim/schemes/");
    if (file.ends_with(".cpp") && core) files.push_back(file);
  }
  return files;
}

TEST(Tidy, FindsNothing) {
  if (!installed("clang-tidy")) GTEST_SKIP() << "clang-tidy is not installed";
  const fs::path build = fs::path(BELTLIFE_COMMAND).parent_path();
  ASSERT_TRUE(fs::exists(build / "compile_commands.json")) << build;
  const auto files = units();
  ASSERT_GT(files.size(), 10u);
  // GCC's options in the compile commands mean nothing to clang, which is no finding.
  const std::string command = "cd " + quoted(source) + " && clang-tidy --quiet -p " + quoted(build) +
                              " --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument "
                              "--extra-arg=-Qunused-arguments";
  constexpr std::size_t processes = 2;
  std::vector<Output> outputs(processes);
  std::vector<std::thread> threads;
  for (std::size_t p = 0; p < processes; ++p)
    threads.emplace_back([&, p] {
      std::string share = command;
      for (std::size_t i = p; i < files.size(); i += processes) share += " " + quoted(files[i]);
      outputs[p] = shell(share);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Output& output : outputs) EXPECT_EQ(output.code, 0) << output.text.substr(0, 6000);
}

}  // namespace
}  // namespace beltlife::guard_test
