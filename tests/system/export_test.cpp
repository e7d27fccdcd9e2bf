// Owns the claims about the commands `export` and `report` of several files: lists, CSV, comparison, refusals.
#include <cmath>
#include <sstream>

#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

class Export : public InFolder {
 protected:
  void simulate(const std::string& name, const Arguments& more = {}) {
    const Answer run =
        this->run(Arguments{"simulate", scene("two_pulley"), "--each-range", "--out", name} + brief(64) + more);
    ASSERT_EQ(run.code, 0) << run.err;
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(Export, ListsDatasetsAsATableAndAsJson) {
  simulate("r.h5");
  const Answer table = run({"export", "r.h5"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("runs/0/trace/driven.speed_rpm"), std::string::npos);
  const auto list = run({"export", "r.h5", "--json"}).json();
  ASSERT_TRUE(list.contains("datasets"));
  EXPECT_EQ(lines_of(table.out).size(), list["datasets"].size() + 1) << "a header and a line each";
  for (const auto& entry : list["datasets"]) expect_keys(entry, {"dataset", "shape", "type", "unit", "description"});
}

TEST_F(Export, WritesATraceOfWhichEveryLineHasEveryColumn) {
  simulate("r.h5");
  const Answer answer = run({"export", "r.h5", "runs/0/trace", "--out", "trace.csv"});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_EQ(answer.out, "wrote trace.csv\n");
  const std::string text = text_of(folder / "trace.csv");
  EXPECT_EQ(run({"export", "r.h5", "runs/0/trace"}).out, text) << "standard output holds the same";
  const auto lines = lines_of(text);
  ASSERT_GT(lines.size(), 100u);
  EXPECT_TRUE(lines[0].starts_with("time_s [s],driver.speed_rpm [r/min],")) << lines[0];
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  for (const std::string& line : lines) EXPECT_EQ(commas(line), commas(lines[0])) << line;
}

TEST_F(Export, RefusesInWordsAndLeavesNothing) {
  simulate("r.h5");
  const Answer unknown = run({"export", "r.h5", "runs/0/trac", "--out", "x.csv"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'runs/0/trace'"), std::string::npos) << unknown.err;
  for (const Arguments& wrong :
       {Arguments{"export", "r.h5", "--out", "x.csv"}, Arguments{"export", "r.h5", "runs/0/trace", "--json"},
        Arguments{"export", "r.h5", "runs/0/trace", "--out", "r.h5"}, Arguments{"export", "nothing.h5"}})
    EXPECT_EQ(run(wrong).code, 2) << wrong[2];
  EXPECT_EQ(files(), std::vector<std::string>{"r.h5"});
}

TEST_F(Export, SeveralFilesAreComparedOnAPageNamedAfterThem) {
  simulate("a.h5");
  simulate("b.h5", {"--set", "belt.friction_front=0.45"});
  const Answer answer = run({"report", "a.h5", "b.h5"});
  EXPECT_EQ(answer.code, 0) << answer.err;
  const std::string page = text_of(folder / "a_vs_b.html");
  EXPECT_NE(page.find("belt.friction_front"), std::string::npos);
  EXPECT_NE(page.find("id=\"range-fast-trace-speed_rpm\""), std::string::npos);
  for (std::size_t at = page.find("href="); at != std::string::npos; at = page.find("href=", at + 1))
    EXPECT_EQ(page[at + 6], '#') << page.substr(at, 60);

  const std::string study = BELTLIFE_SOURCE "/results/reports/sobol_life/log.jsonl.gz";
  const Answer refused = run({"report", "a.h5", study, "missing.h5"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("log.jsonl.gz: is of a study"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("missing.h5: "), std::string::npos) << "all that is wrong: " << refused.err;
}

}  // namespace
}  // namespace beltlife::system_test
