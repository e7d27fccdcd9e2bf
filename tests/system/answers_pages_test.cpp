// Owns the claim that joins both ends: every driver runs, and the page made from its fresh log shows all that it found.
#include <gtest/gtest.h>

#include <regex>

#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

/// A driver's run that takes a second or two.
struct SmallRun {
  const char* name;
  Arguments command;
  std::string file;                   ///< what its study file says, for drive.toml
  std::vector<const char*> sections;  ///< that its page must have
};

const std::string two_parameters =
    "[[parameter]]\npath = \"belt.friction_front\"\nlower = 0.4\nupper = 0.8\n"
    "[[parameter]]\npath = \"belt.axial_stiffness_n\"\nlower = 80000\nupper = 160000\n";
const std::string lives = "scene = \"drive.toml\"\nquantities = [\"log10_life_h\", \"fast.slip_percent.max\"]\n";
const std::string numbers = "scene = \"drive.toml\"\nquantities = [\"log10_life_h\"]\n" + two_parameters;

std::vector<SmallRun> small_runs() {
  return {
      {"noise",
       {"study", "noise"},
       numbers + "[study]\nphases = 2\nperturbations = 2\nline_points = 4\n",
       {"noise", "points", "provenance"}},
      {"convergence",
       {"study", "convergence", "--threads", "1"},
       "scene = \"longer.toml\"\n[study]\nschemes = [\"symplectic_euler\", \"linearly_implicit\"]\nelements = [64]\n"
       "implicit_steps_s = [2e-5, 4e-5]\nexplicit_factors = [1]\nphases = 2\nrepeats = 1\n",
       {"errors", "cheapest", "settings", "quantities"}},
      {"stability",
       {"study", "stability"},
       "scene = \"drive.toml\"\n[study]\nschemes = [\"linearly_implicit\"]\nhold_s = 0.02\n"
       "[[study.variation]]\npath = \"belt.axial_damping_n_s\"\nfactors = [0]\n"
       "[[study.extreme]]\nname = \"no friction\"\nset = [\"belt.friction_front=0\"]\n",
       {"steps", "extremes"}},
      {"oat",
       {"study", "oat"},
       numbers + "[study]\nphases = 2\n[[study.change]]\nname = \"less friction\"\nset = "
                 "[\"belt.friction_front=0.3\"]\nsays_magnitude = \"decrease\"\n",
       {"changes-0"}},
      {"morris", {"study", "morris"}, numbers + "[study]\ntrajectories = 3\n", {"effects"}},
      {"sobol", {"study", "sobol"}, numbers + "[study]\nsamples = 8\nbootstrap = 100\n", {"shares"}},
      {"surrogate", {"study", "surrogate"}, numbers + "[study]\nsamples = 24\ndegree = 2\n", {"surrogate", "shares"}},
      {"uncertainty", {"study", "uncertainty"}, numbers + "[study]\nsamples = 24\ntarget_life_h = 1000\n", {"scatter"}},
      {"optimize",
       {"optimize"},
       "scene = \"drive.toml\"\n[objective]\nquantity = \"log10_life_h\"\n[layout]\nmin_span_mm = 100\n"
       "[[parameter]]\npath = \"pulley.driven.x_mm\"\nlower = 300\nupper = 520\n"
       "[[constraint]]\nquantity = \"slip_percent.max\"\nupper = 5\n"
       "[optimization]\nbudget = 10\nfinalists = 2\nreplicates = 2\n",
       {"layouts", "parameters", "history", "finalists", "lives", "active"}},
  };
}

/// Cells of a page's tables that say nothing: a dash gives no reason.
std::vector<std::string> dashes_in(const std::string& page) {
  std::vector<std::string> found;
  const std::regex row(R"(<tr>(?:(?!</tr>)[\s\S])*?<td[^>]*>-</td>(?:(?!</tr>)[\s\S])*?</tr>)");
  for (std::sregex_iterator i(page.begin(), page.end(), row), end; i != end; ++i) found.push_back(i->str());
  return found;
}

class Driver : public InStudyFolder {
 protected:
  void expect_page(const SmallRun& r) const {
    const std::string log = std::string(r.name) + ".jsonl", page = std::string(r.name) + ".html";
    const Answer made = run({"report", log, "--out", page, "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string html = text_of(folder / page);
    for (const char* id : r.sections)
      EXPECT_NE(html.find("id=\"" + std::string(id) + "\""), html.npos) << r.name << " has no section " << id;
    for (const std::string& row : dashes_in(html)) ADD_FAILURE() << r.name << ": a dash without a reason in " << row;
  }
};

class DriverOfAKind : public Driver, public testing::WithParamInterface<SmallRun> {};

TEST_P(DriverOfAKind, ShowsAllThatItFoundOnItsPage) {
  const std::string held = replaced(small_drive(), "hold_s = 0.12 ", "hold_s = 0.3 ");
  write("longer.toml", replaced(held, "evaluate_s = 0.06 ", "evaluate_s = 0.25 "));  // a window that resolves orders
  const SmallRun& r = GetParam();
  write(std::string(r.name) + ".toml", r.file);
  const Answer a = run(
      r.command + Arguments{std::string(r.name) + ".toml", "--quiet", "--json", "--out", std::string(r.name) + ".h5"});
  ASSERT_EQ(a.code, 0) << a.err;
  expect_page(r);
}

INSTANTIATE_TEST_SUITE_P(Each, DriverOfAKind, testing::ValuesIn(small_runs()),
                         [](const auto& given) { return std::string(given.param.name); });

TEST_F(Driver, CalibrateShowsAllThatItFoundOnItsPage) {
  write("twin.toml", "scene = \"drive.toml\"\nset = [\"belt.axial_stiffness_n=120000\"]\nseconds = 0.5\n");
  ASSERT_EQ(
      run({"twin", "twin.toml", "--quiet", "--set", "profile.hold_s=0.5", "--set", "profile.evaluate_s=0.24"}).code, 0);
  const SmallRun r{"calibration",
                   {"calibrate"},
                   "scene = \"drive.toml\"\n[[parameter]]\npath = \"belt.axial_stiffness_n\"\nlower = 60000\nupper = "
                   "240000\nlog = true\n[[spectrum]]\nfile = \"twin_fast.csv\"\nrange = \"fast\"\nchannel = "
                   "\"driven.speed_rpm\"\norders = [2, 4]\nsigma = 0.01\n[calibration]\nstarts = 1\nscreen = 8\n",
                   {"parameters", "main", "pictures", "residuals", "correlation", "profiles", "fits"}};
  write("calibration.toml", r.file);
  const Answer a = run({"calibrate", "calibration.toml", "--quiet", "--json", "--set", "profile.hold_s=0.5", "--set",
                        "profile.evaluate_s=0.24", "--out", "calibration.h5"});
  ASSERT_EQ(a.code, 0) << a.err;
  expect_page(r);
}

// Each driver's answer in its file carries units from its one list of parts.
TEST_F(Driver, PrintsTheReferenceOfItsAnswer) {
  for (const Arguments& command : {Arguments{"study", "noise"}, {"study", "sobol"}, {"calibrate"}, {"optimize"}}) {
    const Answer a = run(command + Arguments{"--answer"});
    EXPECT_EQ(a.code, 0) << a.err;
    EXPECT_NE(a.out.find("| part | type | unit | meaning |"), a.out.npos) << a.out;
    EXPECT_NE(a.out.find("| `evaluations` | integer |"), a.out.npos) << a.out;
  }
}

}  // namespace
}  // namespace beltlife::system_test
