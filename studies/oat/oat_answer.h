// Owns what a study of kind oat answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// What one change did to one quantity.
struct ChangeEffect {
  double before = not_known, after = not_known, change = not_known;
  std::optional<double> db, life_factor;
  double standard_error = not_known;
  bool beyond_noise = false, visible = false;
  std::int64_t responses_before = 1, responses_after = 1;

  template <class V>
  void visit(V& v) {
    v("before", before, unit_of_its_name, "mean over the replicates without the change");
    v("after", after, unit_of_its_name, "mean over the replicates with it");
    v("change", change, "", "relative to before; of a quantity that is 0 before: to after");
    v("db", db, "dB", "ratio of the two, of what is no life; absent where there is none");
    v("life_factor", life_factor, "", "factor on the life, of lives");
    v("standard_error", standard_error, "", "of the change");
    v("beyond_noise", beyond_noise, "", "whether it is more than noise");
    v("visible", visible, "", "whether a reader of plots would see it");
    v("responses_before", responses_before, "",
      "steady responses that coexist among the replicates without the change");
    v("responses_after", responses_after, "", "likewise with it");
  }
};

/// One change: verdicts beside what was said of it, and its effects; or why it could not be judged.
struct ChangeAnswer {
  std::string name;
  std::optional<std::string> magnitude, frequency, peak;
  std::optional<std::string> says_magnitude, says_frequency;
  std::optional<bool> agrees_magnitude, agrees_frequency;
  std::optional<std::string> failure;
  std::map<std::string, ChangeEffect> effects;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "of the change");
    v("magnitude", magnitude, "", "verdict: none, decrease, increase, slight ...");
    v("frequency", frequency, "", "likewise of what is looked at for frequencies; absent where nothing is");
    v("peak", peak, "", "likewise of peaks");
    v("says_magnitude", says_magnitude, "", "what somebody said of the magnitude");
    v("agrees_magnitude", agrees_magnitude, "", "whether the verdict agrees");
    v("says_frequency", says_frequency, "", "what somebody said of the frequency");
    v("agrees_frequency", agrees_frequency, "", "whether the verdict agrees");
    v("failure", failure, "", "why it could not be judged");
    v("effects", effects, "", "effects by quantity");
  }
};

struct VariantAnswer {
  std::string name;
  std::int64_t said = 0, agreed = 0;
  std::vector<ChangeAnswer> changes;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "of the variant of the scene");
    v("said", said, "", "verdicts of which something was said");
    v("agreed", agreed, "", "of them that agree");
    v("changes", changes, "", "the changes");
  }
};

struct OatAnswer : DriverAnswer {
  double visible = not_known;
  std::int64_t replicates = 0;
  std::vector<VariantAnswer> variants;

  template <class V>
  void visit(V& v) {
    v("visible", visible, "", "relative change that a reader of plots would see");
    v("replicates", replicates, "", "crank phases of every side of every comparison");
    v("variants", variants, "", "the table of changes for every variant of the scene");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife
