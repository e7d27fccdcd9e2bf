// Owns the study of kind uncertainty: how quantities scatter when the parameters do, and how sure a life is.
#pragma once

#include "results/course/study_run.h"
#include "studies/sample.h"
#include "studies/uncertainty/correlation.h"
#include "studies/uncertainty/uncertainty_answer.h"

namespace beltlife {

struct UncertaintySettings {
  int samples = 256;
  SamplingMethod method = SamplingMethod::lhs;
  std::int64_t seed = 1;
  double confidence = 0.95;
  std::vector<double> percentiles = {5, 50, 95};
  std::optional<double> target_life_h;
  std::vector<CorrelationSpec> correlation;

  template <class V>
  void visit(V& v) {
    v("samples", samples, within(2, 1000000), "points");
    v("method", method, any_text, "how the points fill the parameters' distributions");
    v("seed", seed, within(0, 9e15), "of the points");
    v("confidence", confidence, within(0.5, 0.999), "of the intervals");
    v("percentiles", percentiles, above(0, 100), "of each quantity, below 100");
    v("target_life_h", target_life_h, above(0, 1e300), "life whose probability of being missed is asked for");
    v("correlation", correlation, any_text, "parameters that do not scatter independently; all others do");
  }
  void check(ReadLog& log) const;
};

class UncertaintyStudy {
 public:
  using Settings = UncertaintySettings;
  using Result = UncertaintyAnswer;
  static std::vector<std::string> quantities(const Model& model);
  UncertaintyStudy(const LoadedProblem& problem, const UncertaintySettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  UncertaintyAnswer solve(StudyRun& run) const;
  static std::string text(const UncertaintyAnswer& answer);

 private:
  QuantityScatter scatter(const std::string& quantity, std::vector<double> values, std::size_t failed) const;

  LoadedProblem problem_;
  UncertaintySettings settings_;
  Rows correlation_;  ///< empty: independent
};

}  // namespace beltlife
