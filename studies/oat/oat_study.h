// Owns the study of kind oat: one change at a time, beside what somebody said of it.
#pragma once

#include "results/course/study_run.h"
#include "studies/oat/oat.h"
#include "studies/oat/oat_answer.h"

namespace beltlife {

enum class Verdict { none, decrease, increase, spikes };
template <>
struct EnumNames<Verdict> {
  static constexpr std::array<std::string_view, 4> names{"none", "decrease", "increase", "spikes"};
};

struct ChangeSpec {
  std::string name;
  std::vector<std::string> base;
  std::vector<std::string> set;
  std::optional<Verdict> says_magnitude;
  std::optional<Verdict> says_frequency;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "for tables");
    v("base", base, any_text, "settings PATH=VALUE on both sides of the comparison");
    v("set", set, required_text, "settings on the changed side");
    v("says_magnitude", says_magnitude, any_text,
      "what the comparison should find of the magnitude; spikes: a higher peak");
    v("says_frequency", says_frequency, any_text, "likewise of the frequency");
  }
};

struct VariantSpec {
  std::string name;
  std::vector<std::string> set;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "for tables");
    v("set", set, any_text, "settings under which the whole table is made");
  }
};

struct OatSettings {
  int phases = 4;
  double visible = 0.05;
  double standard_errors = 3;
  std::vector<std::string> magnitude;
  std::vector<std::string> frequency;
  std::vector<std::string> peak;
  std::vector<ChangeSpec> change;
  std::vector<VariantSpec> variant;

  template <class V>
  void visit(V& v) {
    v("phases", phases, within(1, 1000),
      "crank phases that every side of every comparison is run at, evenly over a revolution");
    v("visible", visible, within(0, 10),
      "relative change that a reader of plots would see; smaller ones, and those within the noise, count as none");
    v("standard_errors", standard_errors, within(0, 100),
      "a difference of means below this many of its standard errors is noise");
    v("magnitude", magnitude, any_text,
      "quantities that the verdict on the magnitude looks at; none: all but lives and those of the two lists below");
    v("frequency", frequency, any_text, "quantities that the verdict on the frequency looks at");
    v("peak", peak, any_text, "quantities in which spikes show");
    v("change", change, any_text, "what is changed; beside every parameter, which goes to its lower and upper bound");
    v("variant", variant, any_text, "scenes for which the table is made; none: the scene as it is");
  }
  void check(ReadLog& log) const;
};

class OatStudy {
 public:
  using Settings = OatSettings;
  using Result = OatAnswer;
  static std::vector<std::string> quantities(const Model& model);
  OatStudy(const LoadedProblem& problem, const OatSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  OatAnswer solve(StudyRun& run) const;
  static std::string text(const OatAnswer& answer);

 private:
  struct Side {
    std::vector<std::string> settings;
    std::vector<double> x;
  };
  struct Comparison {
    ChangeSpec change;
    Side base, changed;
  };
  std::vector<Point> points_of(const Side& side, const VariantSpec& variant) const;
  ChangeAnswer row_of(const Comparison& c, const std::vector<Answer>& base, const std::vector<Answer>& changed) const;
  void judge(const ChangeSpec& change, const std::vector<Effect>& effects, ChangeAnswer& row) const;

  LoadedProblem problem_;
  OatSettings settings_;
  std::vector<Comparison> comparisons_;
  std::vector<std::string> columns_;
  bool phased_ = false;
};

}  // namespace beltlife
