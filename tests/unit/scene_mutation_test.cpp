// Owns the claim that a damaged scene file is read or refused at its place and in words, and never anything else. The
// same test is built a second time under the address and undefined behaviour sanitizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/scene_claims.h"
#include "tests/fuzz/scene_damage.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;
using scene_claims::judge;
using scene_claims::Verdict;

const std::vector<std::string>& originals() {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(BELTLIFE_SCENES)) {
      if (entry.path().extension() != ".toml") continue;
      std::ifstream in(entry.path());
      found.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    std::sort(found.begin(), found.end());  // folders list files in any order
    return found;
  }();
  return texts;
}

TEST(DamagedScene, IsReadOrRefusedAtAPlaceAndInWords) {
  ASSERT_GE(originals().size(), 9u);
  scene_damage::Random random(2630);
  int refused = 0, read = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const std::string text = scene_damage::damaged(originals()[i % originals().size()], random);
    const Verdict verdict = judge(text);
    for (const std::string& words : verdict.broken) ADD_FAILURE() << "number " << i << " " << words;
    ++(verdict.problems.empty() ? read : refused);
  }
  // Four damages seldom all land in comments; both outcomes must have been seen.
  EXPECT_GT(refused, 50);
  EXPECT_GT(read, 10);
}

/// One line "key = value" of a text.
struct Entry {
  std::string key;
  int line;  // from 1
};

/// Whether a line is an entry as a whole, and no comment, header or piece of a list.
bool is_entry(const std::string& line) {
  const bool opens = line.find('[') != line.npos && line.find(']') == line.npos;
  return !line.empty() && line[0] != '#' && line[0] != ' ' && line.find(" = ") != line.npos && !opens;
}

/// A text whose entry at a random line has a value that no field takes: a date.
std::string with_a_date(const std::string& text, Entry& entry, scene_damage::Random& random) {
  auto lines = scene_damage::lines_of(text);
  std::size_t at = 0;
  do at = scene_damage::below(lines.size(), random);
  while (!is_entry(lines[at]));
  entry = {lines[at].substr(0, lines[at].find(" = ")), static_cast<int>(at) + 1};
  lines[at] = entry.key + " = 1979-05-27";
  return scene_damage::joined(lines);
}

TEST(DamagedScene, NamesTheLineAndKeyOfEachWrongValue) {
  scene_damage::Random random(1979);
  for (std::size_t i = 0; i < 200; ++i) {
    Entry entry;
    const Verdict verdict = judge(with_a_date(originals()[i % originals().size()], entry, random));
    for (const std::string& words : verdict.broken) ADD_FAILURE() << "number " << i << " " << words;
    const bool named = std::any_of(verdict.problems.begin(), verdict.problems.end(), [&](const Problem& p) {
      return p.line == entry.line && ("." + p.key).ends_with("." + entry.key) && p.what.find("a date") != p.what.npos;
    });
    EXPECT_TRUE(named) << "number " << i << ", " << entry.key << " at line " << entry.line;
  }
}

}  // namespace
}  // namespace beltlife
