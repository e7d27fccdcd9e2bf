// Owns the claims about what a run leaves behind: the same answer on any number of threads, one whole result file, and
// an account of a run that failed.
#include <hdf5.h>

#include <cstring>
#include <map>

#include "tests/documented_names.h"
#include "tests/system/command.h"

namespace beltlife::system_test {
namespace {

/// A result file, read with the C API.
class ResultFile {
 public:
  explicit ResultFile(const fs::path& path) : id_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~ResultFile() {
    if (id_ >= 0) H5Fclose(id_);
  }
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;
  bool is_open() const { return id_ >= 0; }

  std::string text(const char* object, const char* attribute) const {
    const hid_t id = H5Aopen_by_name(id_, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
    if (id < 0) return "(none)";
    const hid_t type = H5Aget_type(id);
    char* value = nullptr;
    std::string result = H5Aread(id, type, static_cast<void*>(&value)) < 0 || !value ? "(unreadable)" : value;
    H5free_memory(value);
    H5Tclose(type);
    H5Aclose(id);
    return result;
  }

  /// Every group and dataset by path, with the unit that a dataset has.
  std::map<std::string, std::string> units() const {
    std::map<std::string, std::string> found;
    const auto each = [](hid_t root, const char* name, const H5L_info_t*, void* into) -> herr_t {
      const hid_t id = H5Oopen(root, name, H5P_DEFAULT);
      const std::string path = std::string("/") + name;
      const auto& self = *static_cast<std::pair<const ResultFile*, std::map<std::string, std::string>*>*>(into);
      (*self.second)[path] = H5Iget_type(id) == H5I_DATASET ? self.first->text(path.c_str(), "unit") : "";
      return H5Oclose(id);
    };
    std::pair<const ResultFile*, std::map<std::string, std::string>*> into{this, &found};
    H5Lvisit(id_, H5_INDEX_NAME, H5_ITER_INC, each, &into);
    return found;
  }

  /// Every dataset of numbers by path: that all of them can be read is what "whole" means.
  std::map<std::string, std::vector<double>> datasets() const {
    std::map<std::string, std::vector<double>> found;
    H5Lvisit(id_, H5_INDEX_NAME, H5_ITER_INC, visit, &found);
    return found;
  }

 private:
  static herr_t visit(hid_t root, const char* name, const H5L_info_t*, void* found) {
    const hid_t set = H5Oopen(root, name, H5P_DEFAULT);
    if (H5Iget_type(set) != H5I_DATASET) return H5Oclose(set);
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    herr_t outcome = 0;
    if (H5Tget_class(type) == H5T_FLOAT) {
      std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      if (!values.empty()) outcome = H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      (*static_cast<std::map<std::string, std::vector<double>>*>(found))[name] = std::move(values);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Oclose(set);
    EXPECT_GE(outcome, 0) << name;
    return outcome;
  }

  hid_t id_;
};

std::string without_wall_time(const Answer& answer) {
  auto j = answer.json();
  j.erase("wall_s");
  return j.dump();
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_F(InFolder, TheSameBytesComeFromOneThreadAndFromTwo) {
  for (const Arguments& command :
       {Arguments{"simulate", scene("two_pulley"), "--each-range"}, Arguments{"life", scene("two_pulley")},
        Arguments{"life", scene("accessory_drive"), "--range", "town", "--range", "full_load"}}) {
    const Arguments all =
        command + brief(80) + Arguments{"--json", "--set", "profile.hold_s=0.15", "--set", "profile.ramp_s=0.05"};
    const Answer one = run(all + Arguments{"--threads", "1", "--out", "one.h5"});
    const Answer two = run(all + Arguments{"--threads", "2", "--out", "two.h5"});
    ASSERT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(two.code, 0) << two.err;
    EXPECT_EQ(without_wall_time(one), without_wall_time(two));
    const auto first = ResultFile(folder / "one.h5").datasets(), second = ResultFile(folder / "two.h5").datasets();
    EXPECT_GT(first.size(), 50u);
    ASSERT_EQ(first.size(), second.size());
    for (const auto& [name, values] : first) EXPECT_TRUE(same_bits(values, second.at(name))) << name;
  }
}

TEST_F(InFolder, MoreThreadsThanWorkDoNoHarm) {
  const Answer answer =
      run(Arguments{"simulate", scene("two_pulley"), "--each-range", "--threads", "1000"} + brief(64));
  EXPECT_EQ(answer.code, 0) << answer.err;
}

TEST_F(InFolder, ARunLeavesItsResultFileAndNothingElse) {
  write("result.h5", "an older file that is replaced");
  const Answer answer = run(Arguments{"simulate", scene("two_pulley"), "--out", "result.h5"} + brief(88));
  ASSERT_EQ(answer.code, 0) << answer.err;
  EXPECT_EQ(files(), std::vector<std::string>{"result.h5"});
  const ResultFile file(folder / "result.h5");
  ASSERT_TRUE(file.is_open());
  EXPECT_EQ(file.text("/", "program"), "beltlife");
  EXPECT_NE(file.text("/", "command_line").find("--out result.h5"), std::string::npos);
  EXPECT_EQ(file.text("/runs/0", "state"), "ok");
  const auto datasets = file.datasets();
  EXPECT_EQ(datasets.at("runs/0/trace/time_s").size(), 600u);  // 0.6 s at 1000 Hz
  EXPECT_EQ(datasets.at("ranges/fast/spectra/frequency_hz").size(), 150 / 2 + 1);
  EXPECT_EQ(datasets.at("life/slow/sigma_a_mpa").size(), 2u);
}

// Three files, because what a run of ranges, an event and a sweep leave differs.
TEST_F(InFolder, EveryNameInTheFilesOfRealDrivesIsDocumentedAndEveryDocumentedNameIsThere) {
  const std::map<std::string, Arguments> commands{
      {"life.h5", Arguments{"life", scene("accessory_drive"), "--range", "town"} + brief(80) +
                      Arguments{"--set", "profile.hold_s=0.15"}},
      {"event.h5",
       {"simulate", scene("sudden_stop"), "--quiet", "--elements", "128", "--set", "profile.settle_s=0.05"}},
      {"sweep.h5", {"simulate", scene("two_pulley"), "--quiet", "--elements", "88", "--sweep", "1000:1100:1"}}};
  const auto documented = documented_units();
  std::map<std::string, std::string> written;
  for (const auto& [file, command] : commands) {
    const Answer answer = run(command + Arguments{"--out", file});
    ASSERT_EQ(answer.code, 0) << answer.err;
    for (const auto& [path, unit] : ResultFile(folder / file).units()) {
      const std::string name = documented_spelling(path);
      written[name] = name.ends_with("CHANNEL") ? "its own" : unit;
      EXPECT_TRUE(documented.contains(name)) << path << " is written, but not documented";
    }
  }
  for (const auto& [name, unit] : documented) {
    if (name.find('@') != name.npos) continue;  // attributes: the unit tests
    EXPECT_TRUE(written.contains(name)) << name << " is documented, but not written";
    EXPECT_EQ(written[name], unit) << name;
  }
}

TEST_F(InFolder, TheSceneInAResultFileIsTheSceneThatWasRun) {
  const Arguments drive = Arguments{"--range", "slow", "--json"} + brief(64);
  const Answer first = run(Arguments{"simulate", scene("two_pulley"), "--out", "a.h5"} + drive);
  ASSERT_EQ(first.code, 0) << first.err;
  write("again.toml", ResultFile(folder / "a.h5").text("/", "scene_text"));
  const Answer second = run({"simulate", "again.toml", "--range", "slow", "--json", "--quiet"});
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(without_wall_time(first), without_wall_time(second));
}

TEST_F(InFolder, ARingWithoutPulleysHasAResultFileToo) {
  const Answer answer = run({"simulate", scene("spinning_ring"), "--out", "ring.h5", "--set", "profile.settle_s=0",
                             "--set", "profile.hold_s=0.02", "--set", "profile.evaluate_s=0.01"});
  EXPECT_EQ(answer.code, 0) << answer.err;
  const ResultFile file(folder / "ring.h5");
  EXPECT_EQ(file.text("/runs/0", "state"), "ok");
  for (const auto& [path, unit] : file.units())
    EXPECT_TRUE(!path.starts_with("/statics") && !path.starts_with("/modes")) << path;
}

// ---------------------------------------------------------------- runs that fail

void expect_explained(const Answer& answer) {
  EXPECT_EQ(answer.code, 3) << answer.err;
  for (const char* part : {"diverged at 0.0", "likely cause: step", "is longer than", "try: leave solver.step_s out"})
    EXPECT_NE(answer.err.find(part), answer.err.npos) << part << "\n" << answer.err;
  const bool place = answer.err.find("span ") != answer.err.npos || answer.err.find("pulley ") != answer.err.npos;
  EXPECT_TRUE(place) << answer.err;
}

TEST_F(InFolder, ADivergingRunSaysWhenWhereAndWhyAndKeepsWhatItHas) {
  const Answer answer = run(Arguments{"simulate", scene("two_pulley"), "--scheme", "symplectic_euler", "--step", "1e-4",
                                      "--force", "--json", "--out", "failed.h5"} +
                            brief(88));
  expect_explained(answer);
  const auto j = answer.json();
  ASSERT_FALSE(j.is_discarded()) << answer.out;
  EXPECT_EQ(j["status"], "failed");
  expect_keys(j["runs"][0], {"time_s", "where", "element", "cause", "advice"});
  EXPECT_EQ(files(), std::vector<std::string>{"failed.h5"});
  const ResultFile file(folder / "failed.h5");
  ASSERT_TRUE(file.is_open());
  EXPECT_EQ(file.text("/runs/0", "state"), "diverged");
  EXPECT_EQ(file.text("/runs/0", "cause"), j["runs"][0]["cause"]);
  (void)file.datasets();
}

TEST_F(InFolder, ARunThatFailsInsideAWindowKeepsThePartBefore) {
  // From 0.28 s on, inside the first window, the measured speed brings the driven pulley from 1500 to 1800 r/min; above
  // 1600 its torque table tears it away.
  write("speed.csv", "time_s,speed_rpm\n0,0\n0.15,1000\n0.28,1000\n0.3,1200\n0.6,1200\n");
  std::string text = replaced(text_of(scene("two_pulley")), "[driver]", "[driver]\nspeed_csv = \"speed.csv\"");
  text = replaced(text, "[300, 1500, 4500]", "[1600, 1650]");
  write("leap.toml", replaced(text, "[-4, -10, -14]", "[0, 1e6]"));
  const Answer answer =
      run(Arguments{"simulate", "leap.toml", "--json", "--step", "1.4e-6", "--out", "part.h5"} + brief(88));
  EXPECT_EQ(answer.code, 3) << answer.err;
  EXPECT_NE(answer.err.find("at 0.2"), answer.err.npos) << answer.err;
  const auto j = answer.json();
  ASSERT_FALSE(j.is_discarded()) << answer.out;
  EXPECT_EQ(j["status"], "failed");
  EXPECT_EQ(j["ranges"]["slow"]["complete"], false);
  const ResultFile file(folder / "part.h5");
  ASSERT_TRUE(file.is_open());
  EXPECT_NE(file.text("/runs/0", "state"), "ok");
  const auto time = file.datasets().at("runs/0/trace/time_s");
  EXPECT_GE(time.size(), 279u);  // samples at 1000 Hz up to the leap
}

TEST_F(InFolder, ALifeWithoutARunThatWorkedIsNoNumber) {
  const Answer answer = run(Arguments{"life", scene("two_pulley"), "--scheme", "symplectic_euler", "--step", "1e-4",
                                      "--force", "--json", "--out", "failed.h5"} +
                            brief(88));
  expect_explained(answer);
  const auto j = answer.json();
  ASSERT_FALSE(j.is_discarded()) << answer.out;
  EXPECT_EQ(j["status"], "failed");
  EXPECT_TRUE(j["life_h"].is_null());
  EXPECT_EQ(ResultFile(folder / "failed.h5").text("/runs/1", "state"), "diverged");
}

}  // namespace
}  // namespace beltlife::system_test
