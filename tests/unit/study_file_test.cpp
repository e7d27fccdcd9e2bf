// Owns the claims about the HDF5 file of a study: the same study comes back, under the names that are documented.
#include "results/store/study_file.h"

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <map>

#include "results/store/file_paths.h"
#include "results/store/hdf5_source.h"
#include "results/store/whole_file.h"
#include "tests/documented_names.h"
#include "tests/unit/study_fixture.h"

namespace beltlife::study_test {
namespace {

StudyRecord example_record() {
  StudyRecord record{example_head(), {}, {}};
  for (const std::size_t number : {0, 1, 2, 4, 5, 9}) record.points.push_back(example_point(number));
  record.answer = {{"mean", {{"life_h", 1580.0}, {"count", 6}}},
                   {"table", {{{"parameter", "belt.friction_front"}, {"slope_n", 0.5}}}},
                   {"converged", true},
                   {"undefined", nullptr},
                   {"levels", {1, 2.5}},
                   {"a/b", std::uint64_t{1} << 63}};
  return record;
}

class StudyFile : public InFolder {
 protected:
  fs::path path() const { return folder / "study.h5"; }
};

TEST_F(StudyFile, GivesBackTheStudyToTheLastBit) {
  for (const bool ended : {true, false}) {
    StudyRecord record = example_record();
    if (!ended) record.answer = nullptr;
    write_study(path(), record);
    EXPECT_EQ(files(), 1) << "the temporary is gone";
    for (const StudyRecord& back : {read_study_file(path()), read_study_record(path())}) {
      expect_same(back.head, record.head);
      expect_same_history(back, record);
      for (std::size_t i = 0; i < record.points.size(); ++i)
        EXPECT_EQ(back.points[i].answer.processor_s, record.points[i].answer.processor_s);
    }
  }
}

TEST_F(StudyFile, HoldsAStudyWithoutPointsAndNamesOfAnyKind) {
  StudyRecord record{example_head(), {}, {}};
  write_study(path(), record);
  expect_same(read_study_file(path()).head, record.head);
  record.head.parameters = {"z/a", "z_a", "a"};
  record.head.quantities = {"", ".", "force/n"};
  record.points = {{3, {1.0, 5e-324, std::string("a")}, {PointState::ok, "", {1, 2, 3}, 0}},
                   {4, {std::string("mixed"), -0.0, std::string("")}, {PointState::failed, "why", {}, 0}}};
  write_study(path(), record);
  expect_same(read_study_file(path()).head, record.head);
  expect_same_history(read_study_file(path()), record);
}

TEST_F(StudyFile, IsTheSameFromALogAsFromMemory) {
  Journal journal(log, example_head());
  for (const StudyPoint& p : example_record().points) journal.append(p);
  journal.finish(example_record().answer);
  write_study(path(), journal.record());
  const std::string from_memory = text_of(path());
  write_study(path(), read_study_record(log));
  EXPECT_TRUE(text_of(path()) == from_memory);
}

/// A path as the documentation spells it.
std::string spelling(const std::string& path) {
  for (const auto& [parent, name] :
       {std::pair{"/points/parameters/", "PARAMETER"}, {"/points/quantities/", "QUANTITY"}, {"/answer/", "KEY"}})
    if (path.starts_with(parent)) return parent + std::string(name);
  return path;
}

void collect(const Hdf5Source& file, const std::string& path, std::map<std::string, std::string>& units) {
  const Hdf5Kind kind = file.kind(path);
  const bool dataset = kind != Hdf5Kind::group;
  const std::string name = spelling(path);
  EXPECT_TRUE(file.has(path, "description")) << path;
  EXPECT_EQ(file.has(path, "unit"), dataset) << path;
  if (path != "/") units[name] = name == path ? (dataset ? file.text(path, "unit") : "") : "its own";
  for (const std::string& attribute : file.attributes(path))
    if (attribute != "unit" && attribute != "description") units[name + "@" + attribute] = "";
  if (dataset) return;
  for (const std::string& child : file.children(path))
    collect(file, path == "/" ? "/" + child : join(path, child), units);
}

TEST_F(StudyFile, HasTheNamesAndUnitsOfTheReadme) {
  StudyRecord record = example_record();
  record.head.parameters[0] = "a/b";
  write_study(path(), record);
  std::map<std::string, std::string> written;
  collect(Hdf5Source(path().string()), "/", written);
  for (const char* elsewhere : {"/points/quantities/QUANTITY@name", "/answer/KEY@name"}) written.erase(elsewhere);
  EXPECT_EQ(documented_units("study_files.md"), written);
}

TEST_F(StudyFile, GivesQuantitiesTheirUnitsAndNanWhereAPointIsNotOk) {
  write_study(path(), example_record());
  const Hdf5Source file(path().string());
  const std::string torque = "/points/quantities/B100.drive_shaft.torque_n_m.order_3";
  EXPECT_EQ(file.text(torque, "unit"), "N m");
  EXPECT_EQ(file.text("/points/quantities/log10_life_h", "unit"), "log10 h");
  const auto values = file.numbers(torque);
  ASSERT_EQ(values.size(), 6u);
  EXPECT_EQ(values[1], 0.5);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_EQ(file.texts("/points/parameters/solver.scheme")[0], "thesis");
}

TEST_F(StudyFile, IsToldFromOtherFiles) {
  write_study(path(), example_record());
  EXPECT_TRUE(is_study(path()));
  Journal(log, example_head()).append(example_point(0));
  EXPECT_TRUE(is_study(log));
  for (const std::string text : {"", "{}", "format = 1\n", "{\"beltlife_journal"}) {
    write_text(folder / "other", text);
    EXPECT_FALSE(is_study(folder / "other"));
  }
  Hdf5Image result;  // as simulate writes it, of no kind
  result.attribute("/", "format", std::int64_t{1});
  write_whole_file(folder / "result.h5", result.bytes());
  EXPECT_FALSE(is_study(folder / "result.h5"));
  expect_words(refusal([&] { read_study_record(folder / "result.h5"); }), {"holds no study"});
  expect_words(refusal([&] { is_study(folder / "missing"); }), {"missing", "No such file"});
  expect_words(refusal([&] { is_study(folder); }), {"is a directory"});
  write_text(folder / "torn.h5", text_of(path()).substr(0, 2000));
  expect_words(refusal([&] { is_study(folder / "torn.h5"); }), {"torn.h5", "not a whole HDF5 file"});
}

TEST_F(StudyFile, ThatCannotBeWrittenLeavesTheOlderOneAndNothingElse) {
  write_text(path(), "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 4096, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string words = refusal([&] { write_study(path(), example_record()); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expect_words(words, {"bytes failed", "free space"});
  EXPECT_EQ(text_of(path()), "old");
  EXPECT_EQ(files(), 1);
  expect_words(refusal([&] { write_study(folder / "missing/study.h5", example_record()); }), {"create it first"});
}

}  // namespace
}  // namespace beltlife::study_test
