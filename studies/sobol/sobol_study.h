// Owns the study of kind sobol: which share of a quantity's variance comes from which parameter.
#pragma once

#include "results/course/study_run.h"
#include "studies/sample.h"
#include "studies/sobol/sobol_answer.h"

namespace beltlife {

struct SobolSettings {
  int samples = 256;
  SamplingMethod method = SamplingMethod::sobol_sequence;
  std::int64_t seed = 1;
  double confidence = 0.95;
  int bootstrap = 1000;
  double convergence_width = 0.1;

  template <class V>
  void visit(V& v) {
    v("samples", samples, within(8, 1000000), "base rows N; N (parameters + 2) points are run; best a power of two");
    v("method", method, any_text, "how the base rows fill the parameters' range");
    v("seed", seed, within(0, 9e15), "of the rows and of the resampling");
    v("confidence", confidence, within(0.5, 0.999), "of the intervals");
    v("bootstrap", bootstrap, within(100, 100000), "resamples of the base rows from which the intervals come");
    v("convergence_width", convergence_width, above(0, 10), "converged: no interval of a total index is wider");
  }
  void check(ReadLog&) const {}
};

/// First and total indices (Sobol', Math. Model. Comput. Exp. 1, 1993; Homma and Saltelli, Reliab. Eng. Syst. Saf. 52,
/// 1996) of parameters that scatter independently. A base row with a failed point is left out whole.
class SobolStudy {
 public:
  using Settings = SobolSettings;
  using Result = SobolAnswer;
  static std::vector<std::string> quantities(const Model& model);
  SobolStudy(const LoadedProblem& problem, const SobolSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  SobolAnswer solve(StudyRun& run) const;
  static std::string text(const SobolAnswer& answer);

 private:
  LoadedProblem problem_;
  SobolSettings settings_;
};

}  // namespace beltlife
