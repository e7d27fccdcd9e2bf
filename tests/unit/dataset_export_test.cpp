// Owns the tests of the way from HDF5 datasets to a list and to CSV.
#include "results/store/dataset_export.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "results/store/hdf5_image.h"
#include "results/store/whole_file.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

/// A small file with every shape and type: columns, a table of frames, texts, single values, groups in groups.
std::vector<char> example() {
  Hdf5Image image;
  image.group("/ranges", "windows");
  image.group("/ranges/B100", "one");
  image.group("/ranges/B100/spectra", "amplitudes");
  image.dataset("/ranges/B100/spectra/frequency_hz", std::vector<double>{0, 1, 2}, "Hz", "of each bin");
  image.dataset("/ranges/B100/spectra/speed", std::vector<double>{0.1, std::nan(""), INFINITY}, "r/min", "amplitude");
  image.group("/ranges/C100", "two");
  image.group("/ranges/C100/spectra", "amplitudes");
  image.dataset("/ranges/C100/spectra/speed", std::vector<double>{3, 4, 5}, "r/min", "amplitude");
  image.group("/table", "words and numbers");
  image.dataset("/table/pulley", std::vector<std::string>{"crank", "say \"a,b\""}, "names");
  image.dataset("/table/index", std::vector<int>{-1, 7}, "", "places");
  image.group("/frames", "moving");
  image.dataset("/frames/time_s", std::vector<double>{0, 1}, "s", "of each row");
  image.matrix("/frames/x_m", std::vector<double>{1, 2, 3, 4, 5, 6}, 3, "m", "a row a frame");
  image.scalar("/alone", 9.5, "N", "a single value");
  image.truth("/moves", true, "yes or no");
  return image.bytes();
}

class DatasetExport : public testing::Test {
 protected:
  void SetUp() override {
    path = fs::temp_directory_path() / ("beltlife_export_" + std::to_string(getpid()) + ".h5");
    write_whole_file(path, example());
    file = std::make_unique<Hdf5Source>(path.string());
  }
  void TearDown() override { fs::remove(path); }

  std::string refusal(const std::vector<std::string>& wanted) {
    try {
      datasets_csv(*file, wanted);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "";
  }

  fs::path path;
  std::unique_ptr<Hdf5Source> file;
};

TEST_F(DatasetExport, ListsEveryDatasetWithShapeTypeUnitAndMeaning) {
  const auto list = datasets_of(*file);
  ASSERT_EQ(list.size(), 9u);
  EXPECT_EQ(list[1].path, "ranges/B100/spectra/speed");
  EXPECT_EQ(list[1].type, "number");
  EXPECT_EQ(list[1].shape, std::vector<std::size_t>{3});
  EXPECT_EQ(list[1].unit, "r/min");
  EXPECT_EQ(list[1].description, "amplitude");
  EXPECT_EQ(list[3].type, "text");
  EXPECT_EQ(list[4].type, "integer");
  EXPECT_EQ(list[4].unit, "");
  EXPECT_EQ(list[6].shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_TRUE(list[7].shape.empty());
  EXPECT_EQ(list[8].type, "yes or no");
}

TEST_F(DatasetExport, OfAGroupHasAColumnForEachDatasetWithItsUnit) {
  const std::string wanted = "frequency_hz [Hz],speed [r/min]\n0,0.1\n1,nan\n2,inf\n";
  EXPECT_EQ(datasets_csv(*file, {"ranges/B100/spectra"}), wanted);
  EXPECT_EQ(datasets_csv(*file, {"/ranges/B100/spectra/"}), wanted) << "slashes at the ends mean nothing";
}

TEST_F(DatasetExport, WritesTextsInQuotesAndIntegersWhole) {
  EXPECT_EQ(datasets_csv(*file, {"table"}), "pulley,index\ncrank,-1\n\"say \"\"a,b\"\"\",7\n");
}

TEST_F(DatasetExport, OfATableHasARowForEachFirstIndex) {
  EXPECT_EQ(datasets_csv(*file, {"frames"}), "time_s [s],x_m[0] [m],x_m[1] [m],x_m[2] [m]\n0,1,2,3\n1,4,5,6\n");
}

TEST_F(DatasetExport, OfSingleValuesIsOneRow) {
  EXPECT_EQ(datasets_csv(*file, {"alone", "moves"}), "alone [N],moves\n9.5,1\n");
}

TEST_F(DatasetExport, PutsWholePathsInTheHeaderWhereNamesRepeat) {
  EXPECT_EQ(datasets_csv(*file, {"ranges/C100/spectra/speed", "ranges/B100/spectra/speed"}),
            "ranges/C100/spectra/speed [r/min],ranges/B100/spectra/speed [r/min]\n3,0.1\n4,nan\n5,inf\n");
}

TEST_F(DatasetExport, RefusesAnUnknownNameWithWhatIsNearAndWhatThereIs) {
  const std::string words = refusal({"ranges/B10/spectra"});
  EXPECT_NE(words.find("ranges/B10/spectra: no such dataset or group; did you mean 'ranges/B100/spectra'"), words.npos)
      << words;
  EXPECT_NE(words.find("in ranges: B100, C100"), words.npos) << words;
  const std::string elsewhere = refusal({"speed"});
  EXPECT_NE(elsewhere.find("'ranges/B100/spectra/speed' or 'ranges/C100/spectra/speed'"), elsewhere.npos) << elsewhere;
}

TEST_F(DatasetExport, RefusesGroupsOfGroupsAndUnequalLengths) {
  EXPECT_NE(refusal({"ranges"}).find("is a group without datasets of its own (allowed: one of its groups: B100, C100)"),
            std::string::npos)
      << refusal({"ranges"});
  EXPECT_NE(refusal({"table", "ranges/B100/spectra"}).find("table/pulley has 2 rows, "), std::string::npos)
      << refusal({"table", "ranges/B100/spectra"});
}

}  // namespace
}  // namespace beltlife
