// Owns the tests of HDF5 result files: read back with the C API, compared with the documentation, nothing left behind.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include "results/store/results_file.h"
#include "results/store/whole_file.h"
#include "sim/scene/scene_io.h"
#include "tests/documented_names.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

/// A folder of one test's own, which disappears with it.
class ResultsFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "beltlife_results_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    path = folder / "result.h5";
  }
  void TearDown() override { fs::remove_all(folder); }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder), {}); }
  fs::path folder, path;
};

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

Provenance provenance() {
  return {.version = "1.2.3",
          .command_line = "beltlife simulate scene.toml --out result.h5",
          .scene_path = "scene.toml",
          .scene_text = "# \xC2\xB5\n" + std::string(100000, '#'),  // longer than HDF5 keeps in an object header
          .compiler = "g++",
          .revision = "abc",
          .scheme = "thesis",
          .elements = 512};
}

/// One run of two ranges, 2000 samples at 1000 Hz, a drive of two pulleys; the second range is cut short by a failure.
RunRecord example_run() {
  RunRecord run;
  run.status = {
      .state = RunState::diverged, .time_s = 1.5, .element = 7, .where = "pulley crank", .cause = "step", .advice = ""};
  run.steps = std::int64_t{1} << 40;
  run.step_s = 3e-7;
  for (int i = 0; i < 2000; ++i) run.trace.time_s.push_back(i * 1e-3);
  run.trace.channels = {{"crank.speed_rpm", "r/min", "speed of crank", {}},
                        {"pulley.crank.hub_load_x_n", "N", "hub load", {}},
                        {"pulley.a/b.hub_load_x_n", "N", "hub load", {}}};
  for (Channel& channel : run.trace.channels)
    for (int i = 0; i < 2000; ++i) channel.values.push_back(1500 + 20.1 * std::cos(2 * std::numbers::pi * 75e-3 * i));
  WindowRecord window;
  window.range = "B100";
  window.complete = true;
  window.first_sample = 1000;
  window.last_sample = 2000;
  window.passes.resize(2);
  for (int i = 0; i < 300; ++i) window.passes[1].normal_resolved.push_back(std::sqrt(i));
  window.passes[1].unsampled = 3;
  window.energy[Energy::work_torque_tables] = 15300;
  window.energy[Energy::lost_friction] = 0.1;
  window.element = {
      .time_s = {1, 2}, .normal_n = {0, 90}, .tangential_n = {0, 9}, .tension_n = {700, 800}, .pulley = {-1, 1}};
  window.frames = {.time_s = {1.9, 2},
                   .x_m = {0, 1, 1, 0},
                   .y_m = {0, 0, 1, 1},
                   .tension_n = {700, 701, 702, 703},
                   .pulley_angle_rad = {5, 6, 7, 8},
                   .pulley_x_m = {0, 1, 0, 1},
                   .pulley_y_m = {0, 0, 0, 0}};
  run.windows = {window, window};
  run.windows[1].range = "C100";
  run.windows[1].complete = false;
  return run;
}

Life example_life() {
  Life life;
  life.life_h = 1580;
  life.log10_life_h = std::log10(1580);
  RangeLife& range = life.ranges.emplace_back();
  range.name = "B100";
  range.error = "range B100, pulley crank: too much";
  range.life_h = std::nan("");
  PulleyLife& pulley = range.pulleys.emplace_back();
  pulley.name = "crank";
  pulley.sigma_a = 2.5e6;
  pulley.cycles = std::numeric_limits<double>::infinity();
  return life;
}

/// Reads back through the plain C API, knowing nothing of how the file was written.
class Reader {
 public:
  explicit Reader(const fs::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Reader() { H5Fclose(file_); }

  std::vector<double> numbers(const std::string& path) const {
    const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!values.empty()) H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }
  double number(const std::string& path, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    double value = 0;
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
  std::vector<std::string> texts(const std::string& path, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Aget_space(attribute), type = H5Aget_type(attribute);
    std::vector<char*> pointers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Aread(attribute, type, pointers.data());
    std::vector<std::string> values(pointers.begin(), pointers.end());
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    H5Tclose(type);
    H5Sclose(space);
    H5Aclose(attribute);
    return values;
  }
  std::string text(const std::string& path, const char* name) const { return texts(path, name).at(0); }
  bool has_attribute(const std::string& path, const char* name) const {
    return H5Aexists_by_name(file_, path.c_str(), name, H5P_DEFAULT) > 0;
  }
  /// Attributes by name below every object by path; true for a dataset.
  std::map<std::string, std::pair<bool, std::vector<std::string>>> objects() const {
    std::map<std::string, std::pair<bool, std::vector<std::string>>> found;
    const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* into) -> herr_t {
      const std::string path = std::string("/") + (std::string(name) == "." ? "" : name);
      auto& [is_dataset, attributes] = (*static_cast<decltype(found)*>(into))[path];
      is_dataset = info->type == H5O_TYPE_DATASET;
      const auto each = [](hid_t, const char* attribute, const H5A_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->push_back(attribute);
        return 0;
      };
      hsize_t from = 0;
      return H5Aiterate_by_name(root, name, H5_INDEX_NAME, H5_ITER_NATIVE, &from, each, &attributes, H5P_DEFAULT);
    };
    H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &found, H5O_INFO_BASIC);
    return found;
  }

 private:
  hid_t file_;
};

TEST_F(ResultsFile, ReadsBackToTheSameBits) {
  const RunRecord run = example_run();
  const Life life = example_life();
  write_results(path, provenance(), {run, run}, &life);
  EXPECT_EQ(files(), 1) << "the temporary is gone";

  const Reader file(path);
  EXPECT_EQ(file.number("/", "format"), 1);
  EXPECT_EQ(file.text("/", "scene_text"), provenance().scene_text);
  EXPECT_EQ(file.text("/runs/1", "state"), "diverged");
  EXPECT_EQ(file.text("/runs/0", "advice"), "");
  EXPECT_EQ(file.number("/runs/0", "steps"), std::pow(2, 40));
  EXPECT_EQ(file.numbers("/runs/0/trace/time_s"), run.trace.time_s);
  EXPECT_EQ(file.numbers("/runs/0/trace/crank.speed_rpm"), run.trace.channels[0].values);
  EXPECT_EQ(file.numbers("/ranges/B100/passes/a_b/normal_resolved_n"), run.windows[0].passes[1].normal_resolved);
  EXPECT_TRUE(file.numbers("/ranges/B100/passes/crank/normal_resolved_n").empty());
  EXPECT_EQ(file.number("/ranges/B100/passes/a_b", "unsampled"), 3);
  EXPECT_EQ(file.texts("/ranges/B100", "pulleys"), (std::vector<std::string>{"crank", "a/b"}));
  EXPECT_EQ(file.numbers("/ranges/B100/energy/lost_friction"), std::vector{0.1});
  EXPECT_EQ(file.numbers("/ranges/B100/energy/residual"), std::vector{15300 - 0.1});
  EXPECT_EQ(file.numbers("/ranges/B100/element/pulley"), (std::vector<double>{-1, 1}));
  EXPECT_EQ(file.number("/ranges/B100_2", "run"), 1) << "a range of the second run is not lost";
  EXPECT_EQ(file.number("/life", "life_h"), 1580);
  EXPECT_EQ(file.text("/life/B100", "error"), *life.ranges[0].error);
  EXPECT_TRUE(std::isnan(file.number("/life/B100", "life_h")));
  EXPECT_EQ(file.numbers("/life/B100/sigma_a_mpa"), std::vector{2.5});
  EXPECT_EQ(file.numbers("/life/B100/cycles"), std::vector{life.ranges[0].pulleys[0].cycles});
}

TEST_F(ResultsFile, HoldsSpectraOfCompleteWindowsOnly) {
  write_results(path, provenance(), {example_run()}, nullptr);
  const Reader file(path);
  const auto frequency = file.numbers("/ranges/B100/spectra/frequency_hz");
  ASSERT_EQ(frequency.size(), 501u);
  EXPECT_NEAR(frequency[75], 75, 1e-9);  // rounding of the sample times
  EXPECT_NEAR(file.numbers("/ranges/B100/spectra/crank.speed_rpm")[75], 20.1, 1e-9);
  const auto objects = file.objects();
  EXPECT_FALSE(objects.contains("/ranges/C100/spectra"));
  EXPECT_FALSE(objects.contains("/life"));
}

TEST_F(ResultsFile, NamesAndUnitsAreThoseOfTheReadme) {
  const auto documented = documented_units();
  std::map<std::string, std::string> written;  // unit by name
  const Life life = example_life();
  const SolvedDrive solved = solve_drive(compile(read_scene(fs::path(BELTLIFE_SCENES) / "accessory_drive.toml").scene));
  Sweep sweep;
  sweep.time_s = sweep.crank_rpm = sweep.orders = {1, 2};
  sweep.channels = {{"shaft.speed_rpm", "r/min", {{1, 2}, {3, 4}}}};
  sweep.modes = solved.modes.map;
  sweep.crossings = solved.modes.crossings;
  const WindowRecord event;
  write_results(path, provenance(), {example_run()}, &life, &solved, {&sweep, &event});
  const Reader file(path);
  for (const auto& [object, description] : file.objects()) {
    const auto& [is_dataset, attributes] = description;
    const std::string name = documented_spelling(object);
    EXPECT_TRUE(file.has_attribute(object, "description")) << object;
    if (name != "/") written[name] = "";
    if (is_dataset) {
      EXPECT_TRUE(file.has_attribute(object, "unit")) << object;
      written[name] = name.ends_with("CHANNEL") ? "its own" : file.text(object, "unit");
    }
    for (const std::string& attribute : attributes)
      if (attribute != "unit" && attribute != "description") written[name + "@" + attribute];
  }
  for (const auto& [name, unit] : documented) {
    EXPECT_TRUE(written.contains(name)) << name << " is documented, but not written";
    if (name.find('@') != std::string::npos) continue;  // an attribute's unit is in its name
    EXPECT_EQ(unit, written[name]) << name;
  }
  for (const auto& [name, unit] : written)
    EXPECT_TRUE(documented.contains(name)) << name << " is written, but not documented";
}

TEST_F(ResultsFile, SameInputGivesTheSameBytesAndReplacesAnOlderFile) {
  std::string first;
  for (int i = 0; i < 2; ++i) {
    write_results(path, provenance(), {example_run()}, nullptr);
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (i == 0) first = bytes;
    EXPECT_TRUE(bytes == first);  // not EXPECT_EQ, which would print them
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(ResultsFile, CheckWritableLeavesNothingBehindAndKeepsAnOlderFile) {
  check_writable(path);
  EXPECT_EQ(files(), 0);
  std::ofstream(path) << "old";
  check_writable(path);
  EXPECT_EQ(fs::file_size(path), 3u);
  EXPECT_EQ(files(), 1);
}

TEST_F(ResultsFile, UnwritablePathsAreRefusedInWordsAndLeaveNothingBehind) {
  std::ofstream(folder / "file") << "x";
  const std::pair<fs::path, std::string> cases[] = {
      {folder, "is a directory"},
      {folder / "", "names no file"},
      {folder / "missing/result.h5", "create it first"},
      {folder / "file/result.h5", "not a folder"},
      {"/dev/null", "not a regular file"},
      {"/proc/result.h5", "no file can be created"},  // refuses root as well
  };
  for (const auto& [where, words] : cases) {
    const std::string checked = refusal([&] { check_writable(where); });
    EXPECT_NE(checked.find(words), std::string::npos) << where << ": " << checked;
    EXPECT_NE(checked.find(where.string()), std::string::npos) << checked;
    EXPECT_EQ(checked, refusal([&] { write_results(where, provenance(), {}, nullptr); }));
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(ResultsFile, ADiskThatFillsUpIsRefusedInWordsAndKeepsTheOlderFile) {
  std::ofstream(path) << "old";
  // A limit on file size stands for the full disk; its signal has to be ignored for the write to fail instead.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 4096, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string words = refusal([&] { write_results(path, provenance(), {example_run()}, nullptr); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(words.find("bytes failed"), std::string::npos) << words;
  EXPECT_NE(words.find("free space"), std::string::npos) << words;
  EXPECT_EQ(fs::file_size(path), 3u);
  EXPECT_EQ(files(), 1);
}

TEST_F(ResultsFile, ARunThatRecordedNothingIsWritten) {
  write_results(path, provenance(), {RunRecord{}}, nullptr);
  EXPECT_TRUE(Reader(path).numbers("/runs/0/trace/time_s").empty());
}

}  // namespace
}  // namespace beltlife
