// Owns the shape of the source tree: what stands at the top, first lines, sizes, and that everything is text.
#include <gtest/gtest.h>

#include <set>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

TEST(Layout, TopLevelHoldsOnlyWhatItIsMeantTo) {
  const std::set<std::string> folders{"sim", "calibrate", "optimize", "studies", "tests", "results"};
  const std::set<std::string> names{"CMakeLists.txt", "CMakePresets.json", "main.cpp",        "demo.sh", "test.sh",
                                    "README.md",      "CHANGELOG.md",      "CONTRIBUTING.md", "LICENSE"};
  for (const std::string& file : all_files()) {
    const auto slash = file.find('/');
    const std::string top = file.substr(0, slash);
    const bool allowed = top[0] == '.' || (slash == file.npos ? names : folders).contains(top);
    EXPECT_TRUE(allowed) << file << ": " << top << " has no place at the top level";
  }
}

TEST(Layout, FirstLineOfEverySourceFileSaysWhatItOwns) {
  constexpr std::size_t words = 20;  // characters after the slashes: fewer say nothing
  for (const std::string& file : cpp_files()) {
    const auto lines = lines_of(file);
    ASSERT_FALSE(lines.empty()) << file;
    EXPECT_TRUE(lines[0].starts_with("// ") && lines[0].size() > 3 + words) << file << ": " << lines[0];
  }
}

TEST(Layout, NoSourceFileHasMoreThan600Lines) {
  for (const std::string& file : cpp_files()) EXPECT_LE(lines_of(file).size(), 600u) << file;
}

TEST(Layout, EveryHeaderIsGuardedByPragmaOnce) {
  for (const std::string& file : cpp_files())
    if (file.ends_with(".h")) {
      EXPECT_NE(text_of(file).find("\n#pragma once\n"), std::string::npos) << file;
    }
}

TEST(Layout, EveryFolderOfSourcesThatHoldsSeveralIsNamedInItsOwnOrItsParentsReadme) {
  std::set<std::string> folders;
  for (const std::string& file : cpp_files({"sim", "results", "calibrate", "studies", "optimize"}))
    folders.insert(fs::path(file).parent_path().string());
  for (const std::string& folder : folders) {
    const fs::path path = source / folder;
    const bool own = fs::exists(path / "README.md");
    const std::string parent = text_of(fs::path(folder).parent_path() / "README.md");
    EXPECT_TRUE(own || parent.find(fs::path(folder).filename().string()) != parent.npos) << folder;
  }
}

TEST(Layout, HoldsNoBinaryFiles) {
  for (const std::string& file : all_files()) {
    EXPECT_FALSE(file.ends_with(".h5") || file.ends_with(".hdf5")) << file;
    const std::string extension = fs::path(file).extension();
    if (extension == ".png" || extension == ".gz" || extension == ".xz") continue;  // pictures and logs of reports
    EXPECT_EQ(text_of(file).find('\0'), std::string::npos) << file << " is not text";
  }
}

TEST(Layout, ScriptsCanBeRun) {
  for (const char* script : {"demo.sh", "test.sh", ".ci/run"}) {
    if (!fs::exists(source / script)) continue;
    EXPECT_NE(fs::status(source / script).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
    EXPECT_TRUE(text_of(script).starts_with("#!")) << script;
  }
}

}  // namespace
}  // namespace beltlife::guard_test
