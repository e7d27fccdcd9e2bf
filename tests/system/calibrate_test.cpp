// Owns the claims about calibrate and twin as commands: truth found again, resumed runs, refusals in words.
#include <cmath>

#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

/// y_k = a exp(-b k), k = 1 .. 5, of another program; data of a = 3, b = 0.4 and deviations of +-1 %.
class Calibrate : public InStudyFolder {
 protected:
  void SetUp() override {
    InStudyFolder::SetUp();
    write("model.sh",
          "#!/bin/sh\nexec awk '{ split($0, p, /[:,}]/); a = p[2]; b = p[4]; printf \"{\"; for (k = 1; k <= 5; ++k) "
          "printf \"%s\\\"y%d\\\": %.17g\", (k > 1 ? \", \" : \"\"), k, a * exp(-b * k); print \"}\" }'\n");
    fs::permissions(folder / "model.sh", fs::perms::owner_all);
    write("decay.toml", decay());
  }

  static std::string decay(const std::string& settings = "") {
    std::string text =
        "[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"a\"\nlower = 0.1\nupper = 20\nstart = 10\nlog = "
        "true\n"
        "[[parameter]]\npath = \"b\"\nlower = 0\nupper = 5\nstart = 0\n";
    for (int k = 1; k <= 5; ++k)
      text += "[[observation]]\nquantity = \"y" + std::to_string(k) +
              "\"\nvalue = " + std::to_string(3 * std::exp(-0.4 * k) * (1 + (k % 2 ? 0.01 : -0.01))) +
              "\nsigma = 0.02\n";
    return text + "[calibration]\n" + settings;
  }

  Answer calibrate(const std::string& name, const Arguments& more = {}) const {
    return run(Arguments{"calibrate", name + ".toml", "--quiet", "--json"} + more);
  }
};

TEST_F(Calibrate, FindsTheLeastSquaresOfAnotherProgramFromAStartOnABound) {
  const Answer a = calibrate("decay");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_TRUE(j["converged"]);
  EXPECT_EQ(j["failed"], 0);
  // Gauss-Newton by hand from the truth: sensitivities exp(-bk) and -a k exp(-bk), residuals of 1 %.
  double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
  for (int k = 1; k <= 5; ++k) {
    const double e = std::exp(-0.4 * k), da = e, db = -3 * k * e, r = 3 * e * (k % 2 ? 0.01 : -0.01);
    aa += da * da, ab += da * db, bb += db * db, ra += da * r, rb += db * r;
  }
  const double det = aa * bb - ab * ab;
  const auto& found = j["parameters"];
  // The model is not linear: second order in 1 %.
  EXPECT_NEAR(found["a"]["value"].get<double>(), 3 + (bb * ra - ab * rb) / det, 1e-3);
  EXPECT_NEAR(found["b"]["value"].get<double>(), 0.4 + (aa * rb - ab * ra) / det, 1e-3);
  // Scaled by the residual variance, whatever sigma says: t of 3 degrees of freedom is 3.182.
  const double s = std::sqrt(2 * j["cost"].get<double>() / 3) * 0.02;
  EXPECT_NEAR(found["b"]["standard_error"].get<double>() / (s * std::sqrt(aa / det)), 1, 0.02)
      << "curvature at the end";
  EXPECT_NEAR((found["b"]["high"].get<double>() - found["b"]["low"].get<double>()) / 2 /
                  found["b"]["standard_error"].get<double>(),
              3.182, 0.001);
  EXPECT_EQ(found["a"]["identified"], "yes");
  EXPECT_GT(found["a"]["profile"]["value"].size(), 3u);
  EXPECT_GE(j["evaluations"].get<std::size_t>(), 20u);
  for (const auto& p : points("decay")) {
    EXPECT_GE(p["settings"][0].get<double>(), 0.1);
    EXPECT_GE(p["settings"][1].get<double>(), 0.0);
  }
}

TEST_F(Calibrate, AfterKillsGivesWhatAnUndisturbedRunGives) {
  write("killed.toml", decay());
  const Answer calm = calibrate("decay", {"--threads", "1"});
  ASSERT_EQ(calm.code, 0) << calm.err;
  const std::size_t all = points("decay").size();
  int kills = 0;
  for (std::size_t have = 5; have + 5 < all; have = points("killed").size() + all / 3, ++kills)
    stopped_after(have, SIGKILL, "killed.jsonl", {"calibrate", "killed.toml", "--quiet", "--json", "--threads", "1"});
  EXPECT_GE(kills, 2);
  const Answer again = calibrate("killed", {"--threads", "2"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.json(), calm.json());
  EXPECT_EQ(timeless_points("killed"), timeless_points("decay"));
}

TEST_F(Calibrate, NamesWhatTheDataSayNothingAboutAndWhatIsOnABound) {
  std::string text = decay();
  text = replaced(text, "[[observation]]",
                  "[[parameter]]\npath = \"unused\"\nlower = 1\nupper = 2\nstart = 1.5\n[[observation]]");
  write("idle.toml", replaced(text, "lower = 0\nupper = 5\nstart = 0", "lower = 0.6\nupper = 5\nstart = 1"));
  const Answer a = calibrate("idle");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_EQ(j["parameters"]["unused"]["identified"], "no");
  EXPECT_EQ(j["parameters"]["b"]["at_bound"], "lower");
  EXPECT_EQ(j["parameters"]["b"]["value"], 0.6);
  EXPECT_LT(j["probability_of_residuals"].get<double>(), 1e-3) << "b = 0.4 is out of reach";
  std::string words;
  for (const auto& remark : j["remarks"]) words += remark.get<std::string>() + "\n";
  for (const char* said : {"say nothing about unused", "b ended on its lower bound", "does not reach the data"})
    EXPECT_NE(words.find(said), words.npos) << said << "\n" << words;
}

/// A record of the small drive with known friction and damping, and the file that looks for them.
class Twin : public InStudyFolder {
 protected:
  void SetUp() override {
    InStudyFolder::SetUp();
    write("twin.toml",
          "scene = \"drive.toml\"\nset = [\"belt.axial_stiffness_n=90000\", \"belt.axial_damping_n_s=12\"]\n"
          "seconds = 0.3\nspeed_noise_rpm = 0.02\n");
    write("fit.toml", fit());
  }
  static std::string fit() {
    return "scene = \"drive.toml\"\n"
           "[[parameter]]\npath = \"belt.axial_stiffness_n\"\nlower = 50000\nupper = 200000\nlog = true\n"
           "[[parameter]]\npath = \"belt.axial_damping_n_s\"\nlower = 2\nupper = 40\nlog = true\n"
           "[[spectrum]]\nfile = \"twin_fast.csv\"\nrange = \"fast\"\nchannel = \"driven.speed_rpm\"\nsigma = 0.005\n"
           "orders = [2, 4, 6]\n";
  }
};

TEST_F(Twin, IsFoundAgainWithinItsIntervals) {
  // Settled, so that the window simulated is like those recorded.
  const Arguments settled{"--set", "profile.hold_s=0.4"};
  const Answer made = run(Arguments{"twin", "twin.toml", "--quiet"} + settled);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(text_of(folder / "twin_fast.csv").find("A twin, not a measurement"), std::string::npos);
  const Answer a = run(Arguments{"calibrate", "fit.toml", "--quiet", "--json"} + settled);
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  const auto inside = [&](const char* name, double truth) {
    const auto& p = j["parameters"][name];
    EXPECT_LE(p["low"].get<double>(), truth) << j["parameters"].dump(1);
    EXPECT_GE(p["high"].get<double>(), truth) << j["parameters"].dump(1);
  };
  inside("belt.axial_stiffness_n", 90000);
  ASSERT_EQ(j["main_frequencies"].size(), 1u);
  EXPECT_EQ(j["main_frequencies"][0]["order"], 2);
  EXPECT_LT(std::abs(j["main_frequencies"][0]["calibrated_error"].get<double>()), 0.01);
  ASSERT_EQ(j["pictures"].size(), 1u);
  EXPECT_EQ(j["pictures"][0]["calibrated"]["trace"].size(), j["pictures"][0]["measured"]["trace"].size());
}

TEST_F(Twin, OfTheSameSeedIsTheSameFileAndOfAnotherIsNot) {
  for (const std::string out : {"a", "b"}) ASSERT_EQ(run({"twin", "twin.toml", "--quiet", "--out", out}).code, 0);
  ASSERT_EQ(run({"twin", "twin.toml", "--quiet", "--out", "c", "--seed", "2"}).code, 0);
  EXPECT_EQ(text_of(folder / "a_fast.csv"), text_of(folder / "b_fast.csv"));
  EXPECT_NE(text_of(folder / "a_fast.csv"), text_of(folder / "c_fast.csv"));
}

TEST_F(Twin, OfAnotherContentIsAnotherCalibration) {
  ASSERT_EQ(run({"twin", "twin.toml", "--quiet"}).code, 0);
  ASSERT_EQ(run({"calibrate", "fit.toml", "--quiet"}).code, 0);
  ASSERT_EQ(run({"twin", "twin.toml", "--quiet", "--seed", "2"}).code, 0);
  const Answer a = run({"calibrate", "fit.toml", "--quiet"});
  EXPECT_EQ(a.code, 2) << "the log is of the other record";
  EXPECT_NE(a.err.find("crc32"), std::string::npos) << a.err;
}

TEST_F(Twin, WithoutParametersTheSetThatTheThesisTunedIsFitted) {
  ASSERT_EQ(run({"twin", "twin.toml", "--quiet"}).code, 0);
  const std::string all = fit();
  write("tuned.toml", "scene = \"drive.toml\"\n" + all.substr(all.find("[[spectrum]]")) +
                          "mean = true\n[calibration]\nstarts = 1\niterations = 1\nprofiles = false\n");
  const Answer a = run({"calibrate", "tuned.toml", "--quiet", "--json"});
  ASSERT_TRUE(a.code == 0 || a.code == 3) << a.err;
  const auto j = a.json();
  std::vector<std::string> names;
  for (const auto& [name, value] : j["parameters"].items()) names.push_back(name);
  // A drive without a tensioner has none of its two.
  EXPECT_EQ(names,
            (std::vector<std::string>{"belt.axial_damping_n_s", "belt.bending_damping_n_m2_s", "belt.friction_front"}));
}

TEST_F(Twin, WhatCannotBeFittedIsRefusedInWords) {
  ASSERT_EQ(run({"twin", "twin.toml", "--quiet"}).code, 0);
  const struct {
    std::string from, to;
    const char* says;
  } faults[] = {
      {"range = \"fast\"", "range = \"slow\"", "1000 r/min"},
      {"channel = \"driven.speed_rpm\"", "channel = \"driver.speed_rpm\"", "channel"},
      {"file = \"twin_fast.csv\"", "file = \"none.csv\"", "none.csv"},
      {"orders = [2, 4, 6]", "orders = [2]", "at least 3"},
      {"orders = [2, 4, 6]", "orders = [2.3]", "2.3"},
      {"path = \"belt.axial_damping_n_s\"", "path = \"belt.axial_dumping_n_s\"", "did you mean"},
      {"sigma = 0.005", "sigma = -1", "sigma"},
      {"log = true\n[[spectrum]]", "logarithm = true\n[[spectrum]]", "logarithm"},
  };
  for (const auto& fault : faults) {
    write("bad.toml", replaced(fit(), fault.from, fault.to));
    const Answer a = run({"calibrate", "bad.toml", "--quiet"});
    EXPECT_EQ(a.code, 2) << fault.to << a.err;
    EXPECT_NE(a.err.find(fault.says), std::string::npos) << fault.to << "\n" << a.err;
    EXPECT_FALSE(fs::exists(folder / "bad.jsonl")) << fault.to;
  }
}

}  // namespace
}  // namespace beltlife::system_test
