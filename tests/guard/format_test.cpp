// Owns the claim that every source file is as clang-format would write it, by the .clang-format of this tree.
#include <gtest/gtest.h>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

TEST(Format, IsThatOfClangFormat) {
  if (!installed("clang-format")) GTEST_SKIP() << "clang-format is not installed";
  std::string command = "cd " + quoted(source) + " && clang-format --dry-run -Werror --style=file";
  for (const std::string& file : cpp_files()) command.append(" ").append(quoted(file));
  const Output output = shell(command);
  EXPECT_EQ(output.code, 0) << output.text.substr(0, 4000) << "\nput right by: clang-format -i";
}

}  // namespace
}  // namespace beltlife::guard_test
