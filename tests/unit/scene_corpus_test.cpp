// Owns the replay of the fuzz corpus: inputs that once broke something, and the seeds, keep the claims about scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/scene_claims.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, IsReadOrRefusedAtAPlaceAndInWords) {
  std::ifstream in(fs::path(BELTLIFE_CORPUS) / GetParam(), std::ios::binary);
  ASSERT_TRUE(in);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::string& words : scene_claims::judge(text).broken) ADD_FAILURE() << words;
}

std::vector<std::string> file_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_CORPUS)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());  // folders list files in any order
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scene, Corpus, testing::ValuesIn(file_names()), [](const auto& info) {
  std::string name = fs::path(info.param).stem();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace beltlife
