// Owns the claims about an installed beltlife: the program runs, the library embeds, wherever the folder is moved to.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/guard/source_tree.h"

namespace beltlife::install_test {
namespace {

namespace fs = guard_test::fs;
using guard_test::Output;
using guard_test::quoted;
using guard_test::shell;

const fs::path build = BELTLIFE_BUILD;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// An installation of this build, moved away from where it was installed to, and the embedding example built on it.
/// Made once for all tests here: they run as one process.
class Installed : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string pattern = (fs::temp_directory_path() / "beltlife_install_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    const fs::path first = folder / "first";
    // By component, which leaves the list of files of an installation that somebody made from this build alone.
    for (const std::string component : {"program", "dev", "licence", "Unspecified"}) {
      const Output output = shell(quoted(BELTLIFE_CMAKE) + " --install " + quoted(build) + " --prefix " +
                                  quoted(first) + " --component " + component);
      ASSERT_EQ(output.code, 0) << output.text;
      const fs::path manifest = build / ("install_manifest_" + component + ".txt");
      for (const std::string& line : lines(content(manifest))) {
        EXPECT_NE(component, "Unspecified") << line << " is in no package";
        EXPECT_TRUE(line.starts_with(first.string() + "/")) << line << " is outside the prefix";
      }
      fs::remove(manifest);
    }
    prefix = folder / "moved to here";
    fs::rename(first, prefix);

    const fs::path consumer = folder / "consumer";
    configured = shell(quoted(BELTLIFE_CMAKE) + " -S " + quoted(prefix / "share/beltlife/examples/embed") + " -B " +
                       quoted(consumer) + " -G " + quoted(BELTLIFE_GENERATOR) + " -DCMAKE_CXX_COMPILER=" +
                       quoted(BELTLIFE_COMPILER) + " -DCMAKE_PREFIX_PATH=" + quoted(prefix) + " -DCMAKE_CXX_FLAGS=-O1");
    if (configured.code == 0) built = shell(quoted(BELTLIFE_CMAKE) + " --build " + quoted(consumer) + " --verbose");
    embed = consumer / "embed";
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }

  static Output program(const std::string& arguments) {
    return shell("cd " + quoted(folder) + " && " + quoted(prefix / "bin/beltlife") + " " + arguments);
  }
  static std::string scene(const std::string& name) {
    return quoted(prefix / "share/beltlife/scenes" / (name + ".toml"));
  }
  static std::string example(const std::string& name) { return quoted(prefix / "share/beltlife/examples" / name); }

  static inline fs::path folder, prefix, embed;
  static inline Output configured, built;
};

TEST_F(Installed, ProgramRuns) {
  const Output version = program("--version");
  EXPECT_EQ(version.code, 0) << version.text;
  EXPECT_TRUE(version.text.starts_with(BELTLIFE_VERSION)) << version.text;
  for (const std::string name : {"two_pulley", "baseline"}) {
    const Output check = program("check " + scene(name));
    EXPECT_EQ(check.code, 0) << check.text;
  }
}

TEST_F(Installed, ExamplesFindTheirScenes) {
  EXPECT_EQ(program("twin " + example("calibrate/examples/small_twin.toml") + " --out twin").code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(prefix / "share/beltlife/examples"))
    if (entry.path().extension() == ".toml")
      for (const std::string& line : lines(content(entry.path())))
        if (line.starts_with("scene = \"")) {
          const std::string path = line.substr(9, line.find('"', 9) - 9);
          EXPECT_TRUE(fs::exists(entry.path().parent_path() / path)) << entry.path() << ": " << line;
        }
}

TEST_F(Installed, HoldsNoPathOfThisMachine) {
  if (!BELTLIFE_RELEASE) GTEST_SKIP() << "debug information names the sources";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
    if (!entry.is_regular_file()) continue;
    const std::string text = content(entry.path());
    for (const fs::path& path : {guard_test::source, build, folder / "first"})
      EXPECT_EQ(text.find(path.string() + "/"), text.npos) << entry.path() << " holds " << path;
    ++files;
  }
  EXPECT_GT(files, 50u) << "the search itself is broken";
}

// Nothing but these headers: Eigen's, for one, are in no default folder.
TEST_F(Installed, HeadersNeedNoOthers) {
  const fs::path include = prefix / "include/beltlife";
  std::ofstream every(folder / "every_header.cpp");
  for (const auto& entry : fs::recursive_directory_iterator(include))
    if (entry.is_regular_file()) every << "#include \"" << entry.path().lexically_relative(include).string() << "\"\n";
  every.close();
  const Output output = shell(quoted(BELTLIFE_COMPILER) + " -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I" +
                              quoted(include) + " " + quoted(folder / "every_header.cpp"));
  EXPECT_EQ(output.code, 0) << "add what is missing to sim/install.cmake\n" << output.text.substr(0, 3000);
}

TEST_F(Installed, LibraryGivesEmbeddersTheNumbersOfTheProgram) {
  ASSERT_EQ(configured.code, 0) << configured.text;
  ASSERT_EQ(built.code, 0) << built.text;
  const Output mine = shell(quoted(embed) + " " + scene("two_pulley") + " fast profile.hold_s=1");
  ASSERT_EQ(mine.code, 0) << mine.text;
  const Output theirs =
      program("simulate " + scene("two_pulley") + " --range fast --set profile.hold_s=1 --json --quiet");
  ASSERT_EQ(theirs.code, 0) << theirs.text;
  const auto fast = nlohmann::json::parse(theirs.text)["ranges"]["fast"];

  std::string wanted;  // digit by digit: 17 of them name a double to the bit
  const auto digits = [](const nlohmann::json& number) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", number.get<double>());
    return std::string(text.data());
  };
  for (const auto& span : fast["spans"])
    wanted += span["name"].get<std::string>() + ": tension " + digits(span["tension_n_mean"]) + " N, " +
              digits(span["tension_n_min"]) + " to " + digits(span["tension_n_max"]) + "\n";
  for (const auto& line : fast["drive_shaft"]["orders"])
    if (line["order"] == 3) wanted += "order 3: speed " + digits(line["speed_rpm"]) + " r/min\n";
  EXPECT_EQ(mine.text, wanted);
  EXPECT_NE(wanted.find("order 3"), wanted.npos);
}

TEST_F(Installed, LibraryRefusesInWords) {
  ASSERT_EQ(built.code, 0) << built.text;
  const Output field = shell(quoted(embed) + " " + scene("two_pulley") + " fast belt.elemnts=88");
  EXPECT_EQ(field.code, 2);
  EXPECT_NE(field.text.find("did you mean 'belt.elements'"), field.text.npos) << field.text;
  const Output range = shell(quoted(embed) + " " + scene("two_pulley") + " faster");
  EXPECT_EQ(range.code, 2);
  EXPECT_NE(range.text.find("(allowed: "), range.text.npos) << range.text;
}

TEST_F(Installed, LibraryLinksNothingOfTheDrivers) {
  ASSERT_EQ(built.code, 0) << built.text;
  const std::set<std::string> expected{"linux-vdso", "libfmt", "libgomp",    "libomp",  "libstdc++",
                                       "libm",       "libc",   "libpthread", "libgcc_s"};
  const Output libraries = shell("ldd " + quoted(embed));
  ASSERT_EQ(libraries.code, 0) << libraries.text;
  EXPECT_NE(libraries.text.find("libfmt"), libraries.text.npos) << "the search itself is broken";
  for (const std::string& line : lines(libraries.text)) {
    const std::string name = line.substr(1, line.find(".so") - 1);
    EXPECT_TRUE(expected.contains(name) || name.find("/ld-linux") != name.npos) << line;
  }
}

TEST_F(Installed, LibraryKeepsItsOwnFlagsToItself) {
  ASSERT_EQ(built.code, 0) << built.text;
  for (const char* flag : {"-Wall", "-Wextra", "-fopenmp ", "-mprefer-vector-width", "FMT_SHARED"})
    EXPECT_EQ(built.text.find(flag), built.text.npos) << built.text;
  for (const char* flag : {"-ffp-contract=off", "EIGEN_DONT_PARALLELIZE", "++20"})
    EXPECT_NE(built.text.find(flag), built.text.npos) << built.text;
}

}  // namespace
}  // namespace beltlife::install_test
