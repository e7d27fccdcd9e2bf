// Committed reports: each page comes from its compressed log alone, and the log is whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "results/store/study_file.h"
#include "sim/scene/toml_tree.h"
#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

std::vector<fs::path> logs() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(BELTLIFE_SOURCE "/results/reports"))
    if (entry.is_directory()) found.push_back(entry.path() / "log.jsonl.gz");
  std::sort(found.begin(), found.end());  // folders list files in any order
  return found;
}

TEST(CommittedReports, HaveAWholeLogAndAReadmeWithItsCommand) {
  EXPECT_EQ(logs().size(), 13u) << "a report is missing, or a new one is not counted here";
  for (const fs::path& log : logs()) {
    SCOPED_TRACE(log);
    const StudyRecord record = read_study_record(log);
    EXPECT_FALSE(record.answer.is_null()) << "the study has not ended";
    EXPECT_FALSE(record.points.empty());
    EXPECT_NE(read_text(log.parent_path() / "README.md").find(record.head.command_line), std::string::npos)
        << record.head.command_line;
  }
}

class CommittedReport : public testing::TestWithParam<fs::path> {};

TEST_P(CommittedReport, GivesItsPageFromTheLogAlone) {
  const fs::path page = fs::path(testing::TempDir()) / (GetParam().parent_path().filename().string() + "_report.html");
  fs::remove(page);
  const Answer made = beltlife({"report", GetParam().string(), "--out", page.string(), "--quiet"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_GT(fs::file_size(page), 10000u);
}

INSTANTIATE_TEST_SUITE_P(Each, CommittedReport, testing::ValuesIn(logs()),
                         [](const auto& given) { return given.param.parent_path().filename().string(); });

}  // namespace
}  // namespace beltlife::system_test
