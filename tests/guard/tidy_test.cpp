// Owns the claim that clang-tidy, with the checks of .clang-tidy, finds nothing in the simulator's core.
#include <gtest/gtest.h>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

// What most needs a second reader. The rest is left out for time: headers of JSON, TOML and formatting take most of it.
std::vector<std::string> units() {
  std::vector<std::string> files;
  for (const std::string& file : cpp_files({"sim"})) {
    const bool core =
        file.find('/', 4) == file.npos || file.starts_with("sim/kernels/") || file.starts_with("sim/schemes/");
    if (file.ends_with(".cpp") && core) files.push_back(file);
  }
  return files;
}

/// The files are dealt out to several tests, which ctest runs side by side.
constexpr std::size_t shares = 16;
class Tidy : public testing::TestWithParam<std::size_t> {};

TEST_P(Tidy, FindsNothing) {
  if (!installed("clang-tidy")) GTEST_SKIP() << "clang-tidy is not installed";
  const fs::path build = fs::path(BELTLIFE_COMMAND).parent_path();
  ASSERT_TRUE(fs::exists(build / "compile_commands.json")) << build;
  const auto files = units();
  ASSERT_GT(files.size(), 10u);
  // GCC's options in the compile commands mean nothing to clang, which is no finding.
  std::string command = "cd " + quoted(source) + " && clang-tidy --quiet -p " + quoted(build) +
                        " --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument";
  for (std::size_t i = GetParam(); i < files.size(); i += shares) command.append(" ").append(quoted(files[i]));
  const Output output = shell(command);
  EXPECT_EQ(output.code, 0) << output.text.substr(0, 6000);
}

INSTANTIATE_TEST_SUITE_P(Share, Tidy, testing::Range(std::size_t{0}, shares));

}  // namespace
}  // namespace beltlife::guard_test
