// Owns the claim that a damaged scene file is refused in words or read, and never anything else. Under the asan preset
// the same test looks for memory errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "sim/model.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// One to four damages: a byte changed, a stretch cut out, doubled or swapped for one of the pieces that mistakes are
// made of.
std::string damaged(std::string text, std::mt19937& random) {
  static const std::vector<std::string> pieces{
      "-",    "nan",          "inf",      "1e308", "1e-308",   "\"",     "]",  "[[pulley]]\n", "=", "\n",      "0",
      "true", "name = \"x\"", "99999999", "\0",    "[belt]\n", "1e5000", "# ", "'''\n",        ".", "\xff\xfe"};
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
    const std::size_t at = below(text.size()), length = std::min(text.size() - at, 1 + below(60));
    switch (below(4)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, std::min<std::size_t>(length, 6), pieces[below(pieces.size())]);
    }
  }
  return text;
}

TEST(DamagedScene, IsReadOrRefusedWithTheFileNamed) {
  std::vector<std::string> originals;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_SCENES)) originals.push_back(text_of(entry.path()));
  std::sort(originals.begin(), originals.end());  // folders list files in any order
  ASSERT_GE(originals.size(), 9u);

  std::mt19937 random(2630);
  int refused = 0, read = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string text = damaged(originals[static_cast<std::size_t>(i) % originals.size()], random);
    try {
      const SceneSpec scene = parse_scene(text, "damaged.toml");
      compile(scene, "damaged.toml");
      ++read;
    } catch (const BadInput& bad) {
      ++refused;
      ASSERT_FALSE(bad.problems().empty()) << "number " << i;
      for (const Problem& problem : bad.problems()) {
        EXPECT_EQ(problem.file, "damaged.toml") << "number " << i;
        EXPECT_FALSE(problem.what.empty()) << "number " << i;
      }
    }  // anything else fails the test
  }
  // Four damages seldom all land in comments; both outcomes must have been seen.
  EXPECT_GT(refused, 100);
  EXPECT_GT(read, 20);
}

}  // namespace
}  // namespace beltlife
