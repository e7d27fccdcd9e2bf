// Owns the claims about the command optimize: known optima found, limits kept, the same course after a kill.
#include <cmath>
#include <map>
#include <set>

#include "tests/system/study_files.h"

namespace beltlife::system_test {
namespace {

class Optimize : public InStudyFolder {
 protected:
  Answer optimize(const std::string& name, const Arguments& more = {}) const {
    return run(Arguments{"optimize", name + ".toml", "--quiet", "--json"} + more);
  }

  /// A program that knows x and y (awk), and the file of a search over both between 0 and 4 from (0.5, 0.5).
  std::string program(const std::string& name, const std::string& print) const {
    write(name + ".sh",
          "#!/bin/sh\nexec awk '{ gsub(/[{}\" ]/, \"\"); n = split($0, part, \",\"); for (i = 1; i <= n; i++) { "
          "split(part[i], pair, \":\"); v[pair[1]] = pair[2] + 0 } x = v[\"x\"]; y = v[\"y\"]; " +
              print + " }'\n");
    fs::permissions(folder / (name + ".sh"), fs::perms::owner_all);
    return "[command]\nrun = [\"./" + name +
           ".sh\"]\n[[parameter]]\npath = \"x\"\nlower = 0\nupper = 4\nstart = 0.5\n"
           "[[parameter]]\npath = \"y\"\nlower = 0\nupper = 4\nstart = 0.5\n";
  }
};

/// (x-2)^2 + (y-1)^2 with x + y <= 2: by Lagrange at (1.5, 0.5), where it is 0.5.
const char* const bowl = "printf \"{\\\"f\\\": %.17g, \\\"g\\\": %.17g}\", (x-2)^2 + (y-1)^2, x + y";
const std::string smallest_f = "[objective]\nquantity = \"f\"\nmaximize = false\n";
const std::string sum_below_2 = "[[constraint]]\nname = \"sum\"\nquantity = \"g\"\nupper = 2\n";

/// Both pulleys alike, no load, and an idler that presses on the upper strand from outside.
std::string symmetric_drive() {
  std::string text = small_drive();
  for (const auto& [right, wrong] : {std::pair{"elements = 64", "elements = 128"},
                                     {"pitch_diameter_mm = 120", "pitch_diameter_mm = 80"},
                                     {"torques_n_m = [-4, -10, -14]", "torques_n_m = [0, 0, 0]"},
                                     {"[[torque]]",
                                      "[[pulley]]\nname = \"idler\"\nx_mm = 160\ny_mm = IDLER\npitch_diameter_mm = "
                                      "60\nside = \"back\"\ninertia_kg_m2 = 0.0005\n\n[[torque]]"}})
    text = replaced(text, right, wrong);
  return text;
}

TEST_F(Optimize, FindsTheConstrainedOptimumOfAnotherProgram) {
  write("bowl.toml", program("bowl", bowl) + smallest_f + sum_below_2 + "[optimization]\nbudget = 80\n");
  const Answer a = optimize("bowl");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  const auto& best = j["best"];
  EXPECT_EQ(best["feasible"], true);
  EXPECT_LE(best["quantities"]["g"].get<double>(), 2);
  // The search ends within a step of xtol (4e-4 of x) and its margin: f changes by less than its slope, 1.4, times
  // that.
  EXPECT_NEAR(best["objective"].get<double>(), 0.5, 5e-3);
  // Along the constraint f is flat: 5e-3 more of it is the square of a way of 0.07.
  EXPECT_NEAR(best["parameters"]["x"].get<double>(), 1.5, 0.07);
  EXPECT_EQ(j["evaluations"], 80);
  EXPECT_EQ(j["failed"], 0);
  EXPECT_EQ(j["replicate_simulations"], 0) << "a program gives the same to the same question";
  ASSERT_EQ(j["active"].size(), 1u);
  EXPECT_EQ(j["active"][0]["name"], "sum");
  const auto point = points("bowl")[best["point"].get<std::size_t>()];
  EXPECT_EQ(point["values"][0], best["objective"]);
  EXPECT_EQ(j["start"]["objective"], 2.5);
  ASSERT_EQ(j["history"]["objective"].size(), 80u);
  double last = 2.5;
  for (const auto& v : j["history"]["objective"]) {
    EXPECT_LE(v.get<double>(), last);
    last = v;
  }
  EXPECT_EQ(last, best["objective"]);
}

TEST_F(Optimize, IsNeverWorseThanAFeasibleStart) {
  for (const int budget : {1, 2, 9}) {
    const std::string name = "s" + std::to_string(budget);
    write(name + ".toml", replaced(program("bowl", bowl), "start = 0.5", "start = 1.5") + smallest_f + sum_below_2 +
                              "[optimization]\nbudget = " + std::to_string(budget) + "\n");
    const Answer a = optimize(name);
    ASSERT_EQ(a.code, 0) << a.err;
    EXPECT_LE(a.json()["best"]["objective"].get<double>(), 0.5);
    EXPECT_EQ(a.json()["evaluations"], budget);
  }
}

TEST_F(Optimize, SaysInWordsThatNothingIsFeasible) {
  write("none.toml", program("bowl", bowl) + smallest_f +
                         "[[constraint]]\nquantity = \"g\"\nlower = 9\n[optimization]\nbudget = 30\n");
  const Answer a = optimize("none");
  EXPECT_EQ(a.code, 3) << a.err;
  const auto j = a.json();
  EXPECT_FALSE(j.contains("best"));
  const std::string words = j["error"];
  EXPECT_NE(words.find("no layout keeps all limits"), words.npos) << words;
  EXPECT_NE(words.find("below 9"), words.npos) << words;
  EXPECT_GT(j["least_violating"]["quantities"]["g"].get<double>(), 4) << "the corner (4, 4) has 8";
}

TEST_F(Optimize, CountsFailuresAndGoesOn) {
  write("fails.toml", program("fails", std::string("if (x > 1.2 && x < 1.4) exit 3; ") + bowl) + smallest_f +
                          sum_below_2 + "[optimization]\nbudget = 60\n");
  const auto j = optimize("fails").json();
  EXPECT_GT(j["failed"], 0);
  EXPECT_EQ(j["failures"]["failed"], j["failed"]);
  EXPECT_LT(j["best"]["objective"].get<double>(), 0.6);
}

TEST_F(Optimize, FrontHoldsTheTradeBetweenTwoObjectives) {
  write("front.toml", program("front", "printf \"{\\\"f\\\": %.17g, \\\"h\\\": %.17g}\", x*x + y*y, (x-3)^2 + y*y") +
                          smallest_f + "[pareto]\nquantity = \"h\"\nsteps = 3\n[optimization]\nbudget = 150\n");
  const Answer a = optimize("front");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_LE(j["evaluations"].get<int>(), 150);
  const auto front = j["pareto"]["front"];
  ASSERT_GE(front.size(), 5u) << "two ends and three levels";
  for (std::size_t i = 0; i < front.size(); ++i) {
    const double f = front[i]["objective"], h = front[i]["second"];
    // On the front y = 0 and sqrt f + sqrt h = 3; no design lies below.
    EXPECT_GE(std::sqrt(f) + std::sqrt(h), 3 - 1e-9);
    if (i > 0) {
      EXPECT_GE(f, front[i - 1]["objective"].get<double>());
      EXPECT_LT(h, front[i - 1]["second"].get<double>());
    }
  }
  EXPECT_LT(front.back()["second"].get<double>(), 0.05) << "the other end was searched too";
  EXPECT_LT(front.front()["objective"].get<double>(), 0.05);
}

TEST_F(Optimize, PutsAnIdlerWhereItsHubLoadIsLeastBySymmetry) {
  write("drive.toml", replaced(symmetric_drive(), "IDLER", "35"));
  write("idler.toml",
        "scene = \"drive.toml\"\n[objective]\nquantity = \"slow.pulley.idler.hub_load_n.mean\"\nmaximize = false\n"
        "[[parameter]]\npath = \"pulley.idler.x_mm\"\nlower = 120\nupper = 400\n[layout]\nmin_wrap_deg = 0\n"
        "[optimization]\nbudget = 20\nfinalists = 1\nreplicates = 3\n");
  const Answer a = optimize("idler");
  ASSERT_EQ(a.code, 0) << a.err << a.out.substr(0, 500);
  const auto j = a.json();
  // Tension times wrap, least in the middle: 25 mm off it adds 1 %, more than the mesh's noise.
  EXPECT_NEAR(j["best"]["parameters"]["pulley.idler.x_mm"].get<double>(), 250, 25);
  EXPECT_EQ(j["start"]["parameters"]["pulley.idler.x_mm"], 160);
  EXPECT_LT(j["best"]["objective"], j["start"]["objective"]);
  EXPECT_NEAR(j["layouts"]["best"]["tension_n"].get<double>(), 600, 1e-6) << "the pretension is held";
  EXPECT_EQ(j["layouts"]["best"]["pulleys"].size(), 3u);
  // The log holds the drive as it was varied, so that a point can be run again from it.
  const std::string best = j["best"]["point"].dump();
  const auto again = run({"replay", "idler.h5", "--point", best, "--quiet", "--json"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("idler"), again.out.npos);
  // Replicates are other runs, at other phases, and are told apart from the search.
  std::set<std::string> settings;
  for (const auto& p : points("idler")) settings.insert(p["settings"][0].get<std::string>());
  EXPECT_EQ(settings.size(), 3u);
  EXPECT_EQ(j["replicate_simulations"], 4) << "two more of the best and of the start";
  EXPECT_EQ(j["finalists"][0]["replicates"], 3);
  EXPECT_GT(j["finalists"][0]["standard_deviation"].get<double>(), 0);
}

const std::string tight =
    "scene = \"drive.toml\"\n[objective]\nquantity = \"log10_life_h\"\n[[parameter]]\npath = "
    "\"pulley.driven.x_mm\"\nlower = 300\nupper = 520\n[[parameter]]\npath = \"belt.pretension_n\"\nlower = 300\nupper "
    "= "
    "800\n";

TEST_F(Optimize, AfterKillsTakesTheCourseOfAnUndisturbedSearch) {
  for (const std::string algorithm : {"crs2_cobyla", "kriging"}) {
    const std::string settings =
        "[optimization]\nbudget = 24\nbatch = 4\nfinalists = 2\nreplicates = 2\nalgorithm = \"" + algorithm + "\"\n";
    const std::string killed = "killed_" + algorithm, calm = "calm_" + algorithm;
    write(calm + ".toml", tight + settings);
    write(killed + ".toml", tight + settings);
    const Answer undisturbed = optimize(calm, {"--threads", "1"});
    ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
    int kills = 0;
    for (const std::size_t have : {3u, 12u}) {
      const int code = stopped_after(have, SIGKILL, killed + ".jsonl",
                                     {"optimize", killed + ".toml", "--quiet", "--json", "--threads", "1"});
      kills += code == 128 + SIGKILL;
    }
    EXPECT_GE(kills, 1) << "the search was over before it could be killed";
    EXPECT_LT(points(killed).size(), points(calm).size());
    const Answer again = optimize(killed, {"--threads", "2"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.json(), undisturbed.json());
    EXPECT_EQ(timeless_points(killed), timeless_points(calm));
    EXPECT_EQ(optimize(killed).out, again.out) << "nothing is left to run";
  }
}

TEST_F(Optimize, ARequestToStopFinishesWhatRunsAndTheSameCommandGoesOn) {
  write("stop.toml", program("slow", std::string("system(\"sleep 0.03\"); ") + bowl) + smallest_f + sum_below_2 +
                         "[optimization]\nbudget = 30\n");
  EXPECT_EQ(stopped_after(4, SIGINT, "stop.jsonl", {"optimize", "stop.toml", "--quiet", "--threads", "2"}), 3);
  EXPECT_NE(text_of(folder / "said").find("stopped; what was finished is in stop.jsonl"), std::string::npos);
  EXPECT_LT(points("stop").size(), 30u);
  const Answer rest = optimize("stop");
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rest.json()["evaluations"], 30);
}

TEST_F(Optimize, ReportsLivesOfTheFineModelWhateverSearched) {
  write("drive.toml", replaced(small_drive(), "elements = 64", "elements = 96"));
  write("fine.toml", tight +
                         "[fidelity]\nsettings = [\"belt.elements=64\"]\ncheck = 6\n"
                         "[optimization]\nbudget = 12\nfinalists = 2\nreplicates = 1\n");
  const Answer a = optimize("fine");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  const double correlation = j["fidelity"]["rank_correlation"];
  EXPECT_EQ(j["fidelity"]["search"], correlation >= 0.8 ? "coarse" : "fine");
  EXPECT_EQ(j["check_simulations"], 12);
  EXPECT_EQ(points("fine")[j["best"]["point"].get<std::size_t>()]["settings"][0], "") << "no coarse setting";
  EXPECT_GE(j["best"]["objective"].get<double>(), j["start"]["objective"].get<double>());
}

TEST_F(Optimize, LooksAtEveryChoiceAndSpendsNothingOnTheImpossible) {
  write("choice.toml", tight + "[[choice]]\npath = \"pulley.driven.side\"\nvalues = [\"back\", \"front\"]\n" +
                           "[optimization]\nbudget = 6\nfinalists = 1\nreplicates = 1\n");
  const Answer a = optimize("choice");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_EQ(j["best"]["choices"]["pulley.driven.side"], "front");
  ASSERT_EQ(j["combinations"].size(), 2u);
  EXPECT_EQ(j["combinations"][0]["budget"], 6);
  EXPECT_EQ(j["combinations"][1]["budget"], 0) << "two pulleys hold no belt that runs on one's back";
}

TEST_F(Optimize, RobustObjectiveIsABadPercentileOfTheSameDraws) {
  write("robust.toml", tight +
                           "[robust]\nsamples = 3\npercentile = 0\n[[scatter]]\npath = \"belt.friction_front\"\n"
                           "lower = 0.5\nupper = 0.7\n[optimization]\nbudget = 9\nfinalists = 1\nreplicates = 1\n");
  const Answer a = optimize("robust");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_EQ(j["search_simulations"], 9);
  std::map<std::string, std::set<std::string>> draws;  // by design
  double worst = 1e9;
  for (const auto& p : points("robust")) {
    draws[p["settings"][1].dump() + p["settings"][2].dump()].insert(p["settings"][0]);
    if (p["point"] < 3) worst = std::min(worst, p["values"][0].get<double>());
  }
  ASSERT_EQ(draws.size(), 3u);
  for (const auto& [design, settings] : draws) {
    EXPECT_EQ(settings, draws.begin()->second) << "common draws";
    EXPECT_EQ(settings.size(), 3u);
  }
  EXPECT_EQ(j["start"]["objective"], worst) << "percentile 0 from the bad end";
}

TEST_F(Optimize, NamesWhatTheStartBreaks) {
  write("start.toml", tight +
                          "[layout]\nmax_unstretched_length_mm = 1200\n[optimization]\nbudget = 8\nfinalists = "
                          "1\nreplicates = 1\n");
  const Answer a = optimize("start");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_EQ(j["start"]["feasible"], false);
  EXPECT_NE(j["start"]["violated"][0].get<std::string>().find("more than 1200 mm"), std::string::npos) << j["start"];
  EXPECT_LT(j["layouts"]["best"]["unstretched_length_mm"].get<double>(), 1200);
  const Answer text = run({"optimize", "start.toml", "--quiet"});
  EXPECT_NE(text.out.find("which breaks limits: the belt is"), text.out.npos) << text.out;
}

TEST_F(Optimize, BeginsAtAStartThatCannotEvenBeBuilt) {
  write("built.toml", replaced(replaced(tight, "lower = 300", "lower = 40"), "upper = 520", "upper = 520\nstart = 60") +
                          "[optimization]\nbudget = 8\nfinalists = 1\nreplicates = 1\n");
  const Answer a = optimize("built");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = a.json();
  EXPECT_EQ(j["start"]["state"], "infeasible");
  EXPECT_EQ(j["start"]["objective"], nullptr);
  EXPECT_NE(j["start"]["violated"][0].get<std::string>().find("overlap"), std::string::npos) << j["start"];
  EXPECT_EQ(j["history"]["objective"][0], nullptr);
  const Answer text = run({"optimize", "built.toml", "--quiet"});
  EXPECT_NE(text.out.find("The start is no design to compare with (infeasible)"), text.out.npos) << text.out;
}

}  // namespace
}  // namespace beltlife::system_test
