// Owns that scripts of pages can be parsed, where there is a program that can say so.
#include <gtest/gtest.h>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

TEST(Assets, ScriptsParse) {
  if (!installed("node")) GTEST_SKIP() << "node is not installed";
  std::size_t scripts = 0;
  for (const std::string& file : all_files())
    if (file.ends_with(".js")) {
      const Output checked = shell("node --check " + quoted((source / file).string()));
      EXPECT_EQ(checked.code, 0) << file << ": " << checked.text;
      ++scripts;
    }
  EXPECT_GT(scripts, 0u);
}

// The build turns them into literals that end at this.
TEST(Assets, DoNotHoldTheEndOfTheirOwnLiteral) {
  for (const std::string& file : all_files())
    if (file.starts_with("results/pages/assets/")) {
      EXPECT_EQ(text_of(file).find(")asset\""), std::string::npos) << file;
    }
}

}  // namespace
}  // namespace beltlife::guard_test
