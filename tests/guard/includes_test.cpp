// Owns the arrows between rooms: which may include which, no way up and no circle, read off the #include lines.
#include <gtest/gtest.h>

#include "tests/guard/source_tree.h"

namespace beltlife::guard_test {
namespace {

struct Include {
  std::string file;    ///< that includes
  std::string header;  ///< between the quotes or brackets
};

std::vector<Include> includes_of(const std::vector<std::string>& files) {
  std::vector<Include> found;
  for (const std::string& file : files) {
    for (const std::string& line : lines_of(file)) {
      const auto hash = line.find_first_not_of(" \t");
      if (hash == line.npos || line[hash] != '#') continue;
      const auto word = line.find_first_not_of(" \t", hash + 1);
      if (word == line.npos || line.compare(word, 7, "include") != 0) continue;
      const auto open = line.find_first_of("<\"", word);
      const auto close = open == line.npos ? open : line.find_first_of(">\"", open + 1);
      if (close != line.npos) found.push_back({file, line.substr(open + 1, close - open - 1)});
    }
  }
  return found;
}

bool in(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

bool in_any(const std::string& path, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(), [&](const std::string& folder) { return in(path, folder); });
}

// The simulator's core takes a Spec and gives numbers: no file format, no command line.
bool is_core(const std::string& file) {
  return in(file, "sim") && (file.find('/', 4) == file.npos ||
                             in_any(file, {"sim/kernels", "sim/schemes", "sim/route", "sim/signal", "sim/observe"}));
}

const std::vector<std::string> drivers{"calibrate", "studies", "optimize"};

/// All includes outside tests.
const std::vector<Include>& includes() {
  static const std::vector<Include> found = [] {
    std::vector<std::string> files;
    for (const std::string& file : cpp_files())
      if (!in(file, "tests")) files.push_back(file);
    return includes_of(files);
  }();
  return found;
}

/// The files outside tests that include `header`.
std::vector<std::string> includers(const std::string& header) {
  std::vector<std::string> files;
  for (const Include& i : includes())
    if (i.header == header) files.push_back(i.file);
  return files;
}

TEST(Includes, AreSeen) {
  EXPECT_GT(includes().size(), 200u) << "the search itself is broken";
  EXPECT_FALSE(includers("sim/model.h").empty());
}

TEST(Includes, OfTheSimulatorNeverReachResultsOrDrivers) {
  for (const Include& i : includes())
    if (in(i.file, "sim")) {
      EXPECT_FALSE(in_any(i.header, {"results", "calibrate", "studies", "optimize", "tests"}))
          << i.file << " includes " << i.header;
    }
}

TEST(Includes, OfTheCoreNameNoFileFormatAndNoCommandLine) {
  for (const Include& i : includes())
    if (is_core(i.file)) {
      EXPECT_FALSE(in_any(i.header, {"nlohmann", "CLI", "toml++"}) || i.header == "hdf5.h")
          << i.file << " includes " << i.header;
    }
}

TEST(Includes, OfTheCoreNeverReachEvaluation) {
  for (const Include& i : includes())
    if (is_core(i.file)) {
      EXPECT_FALSE(in_any(i.header, {"sim/eval", "sim/life"})) << i.file << " includes " << i.header;
    }
}

// Rooms from the bottom up: a file includes files of its own room and of rooms on floors below. Rooms that share a
// floor know nothing of each other. A room of its own floor is the longest of these names that begins a path.
const std::vector<std::vector<std::string>> floors{
    {"sim"},
    {"results/text", "results/answer"},
    {"results/journal"},
    {"results/store"},
    {"results/pages"},
    {"results/pages/run", "results/pages/study"},
    {"results/course"},
    {"optimize/search"},
    {"optimize/layout"},
    {"calibrate", "studies", "optimize"},
    {"results/commands", "results/server"},
    {"main.cpp"},
};

struct Place {
  std::string room;
  std::size_t floor = 0;
};

Place place_of(const std::string& file) {
  Place found;
  for (std::size_t floor = 0; floor < floors.size(); ++floor)
    for (const std::string& room : floors[floor])
      if ((file == room || in(file, room)) && room.size() > found.room.size()) found = {room, floor};
  return found;
}

TEST(Includes, LeadDownwardsFromRoomToRoom) {
  for (const Include& i : includes()) {
    const Place from = place_of(i.file), to = place_of(i.header);
    EXPECT_FALSE(from.room.empty()) << i.file << " stands in no room";
    if (to.room.empty() || from.room == to.room) continue;  // a header of the system, or of the same room
    EXPECT_GT(from.floor, to.floor) << i.file << " includes " << i.header;
  }
}

TEST(Includes, OfASearchKnowNothingOfBelts) {
  for (const Include& i : includes())
    if (in(i.file, "optimize/search")) {
      EXPECT_TRUE(!in(i.header, "sim") || i.header == "sim/scene/field.h") << i.file << " includes " << i.header;
    }
}

TEST(Includes, OfDriversNeverReachEachOther) {
  for (const Include& i : includes())
    for (const std::string& own : drivers)
      for (const std::string& other : drivers)
        if (own != other && in(i.file, own)) {
          EXPECT_FALSE(in(i.header, other)) << i.file << " includes " << i.header;
        }
}

TEST(Includes, OfTomlStandInOneFile) {
  EXPECT_EQ(includers("toml++/toml.h"), std::vector<std::string>{"sim/scene/toml_tree.cpp"});
}

TEST(Includes, OfHdf5StandWhereFilesAreWrittenAndRead) {
  EXPECT_EQ(includers("hdf5.h"),
            (std::vector<std::string>{"results/store/hdf5_image.cpp", "results/store/hdf5_source.cpp"}));
}

TEST(Includes, OfCli11StandInOneFile) {
  EXPECT_EQ(includers("CLI/CLI.hpp"), std::vector<std::string>{"results/course/command_line.cpp"});
}

TEST(Includes, OfCeresAndNloptStandInOneFileEach) {
  EXPECT_EQ(includers("ceres/ceres.h"), std::vector<std::string>{"calibrate/fit.cpp"});
  EXPECT_EQ(includers("nlopt.h"), std::vector<std::string>{"optimize/search/nlopt_search.cpp"});
  EXPECT_EQ(includers("mpi.h"), std::vector<std::string>{"results/journal/ranks_mpi.cpp"});
}

TEST(Includes, OfHttplibStandInOneFile) {
  EXPECT_EQ(includers("httplib.h"), std::vector<std::string>{"results/server/http_listener.cpp"});
}

// The program does not link it: its module alone does, which is opened on first use.
TEST(Includes, OfOpenTurnsStandInItsModule) {
  for (const Include& i : includes())
    if (in(i.header, "openturns") || in(i.header, "studies/openturns/module")) {
      EXPECT_TRUE(in(i.file, "studies/openturns/module")) << i.file << " includes " << i.header;
    }
  EXPECT_FALSE(includers("openturns/Distribution.hxx").empty());
}

TEST(Includes, OfOpenMpStandInOneFile) {
  EXPECT_EQ(includers("omp.h"), std::vector<std::string>{"sim/eval/parallel_for.cpp"});
}

// Parallelism is over evaluations: a pragma elsewhere would be a second place to look for races.
TEST(Includes, OpenMpPragmasStandBesideThem) {
  for (const std::string& file : cpp_files({"sim", "results", "calibrate", "studies", "optimize"}))
    for (const std::string& line : lines_of(file)) {
      const bool threads = line.starts_with("#pragma omp") && line.find("simd") == line.npos;
      EXPECT_FALSE(threads && file != "sim/eval/parallel_for.cpp") << file << ": " << line;
    }
}

TEST(Includes, OfProductCodeNeverReachTests) {
  for (const Include& i : includes()) EXPECT_FALSE(in(i.header, "tests")) << i.file << " includes " << i.header;
}

}  // namespace
}  // namespace beltlife::guard_test
