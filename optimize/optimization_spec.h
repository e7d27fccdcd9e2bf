// Owns what an optimisation's file says: objective, constraints, choices, settings of the search.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimize/layout/layout_spec.h"
#include "optimize/search/search.h"
#include "sim/eval/problem_spec.h"

namespace beltlife {

struct ObjectiveSpec {
  std::string quantity;
  bool maximize = true;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, required_text,
      "what is to be made large; of lives take the logarithm, log10_life_h: a search loses its way on the life itself");
    v("maximize", maximize, any_text, "false: make it small");
  }
};

struct ConstraintSpec {
  std::string name;
  std::string quantity;
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<double> scale;

  template <class V>
  void visit(V& v) {
    v("name", name, any_text, "how the answer calls it; absent: as the quantity");
    v("quantity", quantity, required_text, "what is held between bounds");
    v("lower", lower, any_text, "smallest value allowed; give this, upper or both");
    v("upper", upper, any_text, "largest value allowed");
    v("scale", scale, above(0, 1e300),
      "how much of it is a lot, in its unit; absent: the size of its bound, or 1 where that is 0");
  }
};

/// The table [layout]: how the layout is stated, and its limits.
struct LayoutSpec {
  bool hold_pretension = true;
  LayoutLimitsSpec limits;

  template <class V>
  void visit(V& v) {
    v("hold_pretension", hold_pretension, any_text,
      "true: every layout has the tension at rest of the scene, the arm at rest as placed, and the belt's length and "
      "the spring's torque that go with it; false: length and torque stay as the scene states them");
    limits.visit(v);
  }
};

struct ChoiceSpec {
  std::string path;
  std::vector<std::string> values;

  template <class V>
  void visit(V& v) {
    v("path", path, required_text,
      "a choice of the scene by its path, such as pulley.NAME.side; of a command: any name");
    v("values", values, required_text, "what it may be; all combinations of all choices are looked at");
  }
};

struct FidelitySpec {
  std::vector<std::string> settings;
  int check = 20;

  template <class V>
  void visit(V& v) {
    v("settings", settings, required_text, "PATH=VALUE, which make the model coarse, such as belt.elements=256");
    v("check", check, within(5, 1000), "layouts simulated coarse and fine before the coarse model is trusted");
  }
};

struct ParetoSpec {
  std::string quantity;
  bool maximize = false;
  int steps = 4;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, required_text, "the second objective");
    v("maximize", maximize, any_text, "true: make it large");
    v("steps", steps, within(1, 100),
      "levels that the second objective is held to between its values at the two ends; the budget is shared by two "
      "searches for the ends and one for each level");
  }
};

struct ScatterSpec {
  std::string path;
  std::optional<double> lower;
  std::optional<double> upper;
  DistributionSpec distribution;

  template <class V>
  void visit(V& v) {
    v("path", path, required_text, "a number of the scene that scatters, and is no parameter");
    v("lower", lower, any_text, "of uniform and triangular: lower end; of the others: where they are cut off");
    v("upper", upper, any_text, "upper end, likewise");
    v("distribution", distribution, any_text, "how it scatters");
  }
};

struct RobustSpec {
  int samples = 8;
  double percentile = 10;

  template <class V>
  void visit(V& v) {
    v("samples", samples, within(2, 1000), "simulations a layout, of the same draws for every layout");
    v("percentile", percentile, within(0, 50),
      "of the samples, counted from the bad end, that is the layout's objective; constraints are held by it likewise");
  }
};

struct OptimizationSettings {
  int budget = 600;
  SearchAlgorithm algorithm = SearchAlgorithm::automatic;
  std::int64_t seed = 1;
  double xtol = 1e-4;
  int batch = 8;
  int finalists = 4;
  int replicates = 4;

  template <class V>
  void visit(V& v) {
    v("budget", budget, within(1, 1e6), "simulations of the search; check and replicates come on top");
    v("algorithm", algorithm, any_text, "automatic: crs2_cobyla up to 6 variables, kriging above");
    v("seed", seed, within(0, 9e15), "of whatever is drawn at random");
    v("xtol", xtol, above(0, 0.5), "step, as a share of the bounds' distance, at which a local search has converged");
    v("batch", batch, within(1, 1024), "layouts simulated at once where the algorithm can");
    v("finalists", finalists, within(1, 100), "the best layouts that differ, which are run again with replicates");
    v("replicates", replicates, within(1, 1000),
      "runs of each finalist, at crank phases spread over a revolution by the golden section");
  }
};

struct OptimizationSpec {
  ProblemSpec problem;
  ObjectiveSpec objective;
  std::vector<ConstraintSpec> constraint;
  std::optional<LayoutSpec> layout;
  std::vector<ChoiceSpec> choice;
  std::optional<FidelitySpec> fidelity;
  std::optional<ParetoSpec> pareto;
  std::optional<RobustSpec> robust;
  std::vector<ScatterSpec> scatter;
  OptimizationSettings optimization;

  /// By parameter: whether the file gives its start. Not a field of the file.
  std::vector<bool> start_given;

  template <class V>
  void visit(V& v) {
    problem.visit(v);
    v("objective", objective, required_text, "what is improved");
    v("constraint", constraint, any_text, "bounds on what a simulation says");
    v("layout", layout, any_text, "limits of the layout, known without a simulation; absent: those of the defaults");
    v("choice", choice, any_text, "what is chosen from a list, such as the side on which the belt passes a pulley");
    v("fidelity", fidelity, any_text, "a coarse model that searches, if it ranks layouts as the fine one does");
    v("pareto", pareto, any_text, "a second objective: what each costs of the other");
    v("robust", robust, any_text, "a bad percentile over the [[scatter]] takes the place of the objective");
    v("scatter", scatter, any_text, "what scatters from drive to drive");
    v("optimization", optimization, any_text, "settings of the search");
  }
};

}  // namespace beltlife
