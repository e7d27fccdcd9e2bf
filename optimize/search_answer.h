// Owns what a layout search answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "optimize/layout_drawing.h"

namespace beltlife {

/// A mean over replicates; of one run there is no scatter and no interval.
struct ReplicateMean {
  double mean = not_known, standard_deviation = not_known, low = not_known, high = not_known;

  template <class V>
  void visit(V& v) {
    v("mean", mean, "", "over the replicates");
    v("standard_deviation", standard_deviation, "", "of one of them; null of one run alone");
    v("low", low, "", "lower end of the mean's interval of 95 %");
    v("high", high, "", "upper end of it");
  }
};
using RangeLives = std::map<std::string, ReplicateMean>;

/// One design. Where it is infeasible `violated` says what it breaks, where it failed `state` and `reason` say why.
struct DesignOutline {
  std::map<std::string, double> parameters;
  std::optional<std::map<std::string, std::string>> choices;
  bool feasible = false;
  std::int64_t point = 0;
  std::optional<std::vector<std::string>> violated;
  double objective = not_known;
  std::optional<std::string> state, reason;

  template <class V>
  void visit(V& v) {
    v("parameters", parameters, unit_of_its_name, "values by path");
    v("choices", choices, "", "choices by path; absent where there are none");
    v("feasible", feasible, "", "whether all limits are kept");
    v("point", point, "", "number of its point in the log");
    v("violated", violated, "", "what it breaks, in words");
    v("objective", objective, "", "value of the objective; null if it failed");
    v("state", state, "", "how it failed; absent of one that ran");
    v("reason", reason, "", "why it failed");
  }
};

struct DesignAnswer : DesignOutline {
  OrNull<std::map<std::string, double>> quantities;

  template <class V>
  void visit(V& v) {
    DesignOutline::visit(v);
    v("quantities", quantities, unit_of_its_name, "values by quantity; null if it failed");
  }
};

/// The start, with its mean where it is among the finalists.
struct StartDesign : DesignAnswer {
  std::optional<double> mean;
  std::optional<OrNull<double>> standard_deviation, low, high;

  template <class V>
  void visit(V& v) {
    DesignAnswer::visit(v);
    v("mean", mean, "", "objective, mean over the replicates; absent unless it is a finalist");
    v("standard_deviation", standard_deviation, "", "of one replicate");
    v("low", low, "", "lower end of the mean's interval of 95 %");
    v("high", high, "", "upper end of it");
  }
};

struct BestDesign : DesignAnswer {
  ReplicateMean replicates;

  template <class V>
  void visit(V& v) {
    DesignAnswer::visit(v);
    replicates.visit(v);
  }
};

struct FinalistAnswer : DesignOutline {
  ReplicateMean mean;
  std::int64_t replicates = 0, constraints_hold_in = 0;
  bool start = false;
  OrNull<RangeLives> lives;

  template <class V>
  void visit(V& v) {
    DesignOutline::visit(v);
    mean.visit(v);
    v("replicates", replicates, "", "replicates that ran");
    v("constraints_hold_in", constraints_hold_in, "", "of them in so many the constraints hold");
    v("start", start, "", "whether it is the start");
    v("lives", lives, "log10 h", "log10 of the life by range");
  }
};

struct FrontDesign : DesignAnswer {
  double second = not_known;

  template <class V>
  void visit(V& v) {
    DesignAnswer::visit(v);
    v("second", second, "", "value of the second objective");
  }
};

struct ComparisonAnswer : ReplicateMean {
  std::int64_t of = 0, against = 0;
  bool against_start = false;
  double probability_better = not_known;
  std::string words;

  template <class V>
  void visit(V& v) {
    ReplicateMean::visit(v);
    v("of", of, "", "point of the best");
    v("against", against, "", "point that it is compared with");
    v("against_start", against_start, "", "whether that is the start");
    v("probability_better", probability_better, "", "that the best is better; null of one run each");
    v("words", words, "", "the verdict");
  }
};

/// A limit, constraint or bound that the best comes near to.
struct ActiveLimit {
  std::string kind, name;
  double value = not_known, bound = not_known;
  bool at_most = false;
  double left = not_known;
  std::string unit;

  template <class V>
  void visit(V& v) {
    v("kind", kind, "", "limit (of the layout), constraint, lower bound or upper bound (of a parameter)");
    v("name", name, "", "of what");
    v("value", value, "in unit", "what the best has; not in logs of before 2026-12");
    v("bound", bound, "in unit", "what is asked for");
    v("at_most", at_most, "", "whether the bound is an upper one");
    v("left", left, "in unit", "distance to the bound, negative beyond it");
    v("unit", unit, "", "of the three");
  }
};

struct GoverningPart {
  std::string range, pulley;
  double range_share = not_known, pulley_share = not_known;

  template <class V>
  void visit(V& v) {
    v("range", range, "", "range that does most of the damage");
    v("range_share", range_share, "", "its share");
    v("pulley", pulley, "", "pulley that does most of the damage over all ranges");
    v("pulley_share", pulley_share, "", "its share");
  }
};

/// Something of the start and of the best; null where it cannot be stated, and of the best absent without one.
template <class T>
struct StartAndBest {
  OrNull<T> start;
  std::optional<OrNull<T>> best;

  const T* of_start() const { return start.value ? &*start.value : nullptr; }
  const T* of_best() const { return best && best->value ? &*best->value : nullptr; }

  template <class V>
  void visit(V& v) {
    v("start", start, "", "of the start");
    v("best", best, "", "of the best");
  }
};

struct LivesAnswer {
  std::optional<OrNull<RangeLives>> start;
  OrNull<RangeLives> best;

  template <class V>
  void visit(V& v) {
    v("start", start, "log10 h", "log10 of the life by range, at the start if it is a finalist");
    v("best", best, "log10 h", "log10 of the life by range, of the best");
  }
};

struct ObjectiveAnswer {
  std::string quantity;
  bool maximize = false;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, "", "what is sought");
    v("maximize", maximize, "", "whether large is good");
  }
};

struct FidelityAnswer {
  double rank_correlation = not_known;
  std::int64_t compared = 0, asked = 0;
  double enough = not_known;
  std::string search;

  template <class V>
  void visit(V& v) {
    v("rank_correlation", rank_correlation, "", "Spearman's, of the coarse and the fine objective");
    v("compared", compared, "", "layouts that both models ran to their end");
    v("asked", asked, "", "layouts that were asked for");
    v("enough", enough, "", "correlation from which the coarse model is trusted");
    v("search", search, "", "which model the search ran: coarse or fine");
  }
};

struct SearchHistory {
  std::vector<std::int64_t> simulations;
  std::vector<double> objective;

  template <class V>
  void visit(V& v) {
    v("simulations", simulations, "", "simulations of the search so far");
    v("objective", objective, "", "best feasible objective by then; null before there is one");
  }
};

struct RobustAnswer {
  int samples = 0;
  double percentile = not_known;

  template <class V>
  void visit(V& v) {
    v("samples", samples, "", "draws of the scatter a layout");
    v("percentile", percentile, "", "by which a layout counts, from the bad end");
  }
};

struct CombinationAnswer {
  std::string choices;
  std::int64_t budget = 0;
  std::optional<std::string> why;

  template <class V>
  void visit(V& v) {
    v("choices", choices, "", "a combination of the choices");
    v("budget", budget, "simulations", "share of the budget");
    v("why", why, "", "why it got none");
  }
};

struct ParetoAnswer {
  std::string quantity;
  bool maximize = false;
  std::string model;
  std::vector<FrontDesign> front;

  template <class V>
  void visit(V& v) {
    v("quantity", quantity, "", "the second objective");
    v("maximize", maximize, "", "whether large is good");
    v("model", model, "", "coarse or fine");
    v("front", front, "", "designs that no other beats in one objective without losing in the other");
  }
};

struct SearchAnswer : DriverAnswer {
  std::string algorithm;
  ObjectiveAnswer objective;
  std::int64_t seed = 0;
  std::optional<FidelityAnswer> fidelity;
  std::string ended;
  std::optional<std::vector<CombinationAnswer>> combinations;
  SearchHistory history;
  std::int64_t search_simulations = 0, check_simulations = 0, replicate_simulations = 0;
  std::optional<RobustAnswer> robust;
  StartDesign start;
  std::optional<BestDesign> best;
  std::optional<DesignAnswer> least_violating;
  StartAndBest<DrawnLayout> layouts;
  StartAndBest<GoverningPart> governing;
  std::vector<FinalistAnswer> finalists;
  std::vector<ComparisonAnswer> comparison;
  std::optional<LivesAnswer> lives;
  std::vector<ActiveLimit> active;
  std::optional<ParetoAnswer> pareto;
  std::map<std::string, std::int64_t> failures;

  template <class V>
  void visit(V& v) {
    v("algorithm", algorithm, "", "how it was searched");
    v("objective", objective, "", "what was sought");
    v("seed", seed, "", "of what is drawn at random");
    v("fidelity", fidelity, "", "check of the coarse model; absent without one");
    v("ended", ended, "", "why the search ended");
    v("combinations", combinations, "", "combinations of choices; absent without choices");
    v("history", history, "", "course of the search");
    v("search_simulations", search_simulations, "", "simulations of the search");
    v("check_simulations", check_simulations, "", "of the check of a coarse model");
    v("replicate_simulations", replicate_simulations, "", "of the replicates");
    v("robust", robust, "", "scatter that a layout has to bear; absent without");
    v("start", start, "", "the start");
    v("best", best, "", "the best; absent where no design keeps all limits");
    v("least_violating", least_violating, "", "the nearest to feasible, where none is");
    v("layouts", layouts, "", "the loops, for drawings");
    v("governing", governing, "", "what does most of the damage");
    v("finalists", finalists, "", "the best designs that differ, with replicates");
    v("comparison", comparison, "", "the best against each of the others, in pairs");
    v("lives", lives, "", "lives by range");
    v("active", active, "", "what the best comes near to");
    v("pareto", pareto, "", "the trade between two objectives; absent without a second");
    v("failures", failures, "", "points that are not ok, by state");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
