// Owns the study of kind surrogate: a fitted function in place of the simulator, and whether it may stand there.
#pragma once

#include "results/course/study_run.h"
#include "studies/openturns/openturns_surrogate.h"
#include "studies/surrogate/surrogate_answer.h"

namespace beltlife {

struct SurrogateSettings {
  int samples = 128;
  SurrogateMethod method = SurrogateMethod::chaos;
  int degree = 3;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v("samples", samples, within(8, 20000), "points to fit to");
    v("method", method, any_text, "polynomial chaos, or Kriging, which has no degree");
    v("degree", degree, within(1, 20), "of chaos: largest total degree; terms that do not pay are dropped");
    v("seed", seed, within(0, 9e15), "of the points");
  }
  void check(ReadLog&) const {}
};

/// Points by a Sobol' sequence, and the nominal one, which it is not fitted to.
class SurrogateStudy {
 public:
  using Settings = SurrogateSettings;
  using Result = SurrogateAnswer;
  static std::vector<std::string> quantities(const Model& model);
  SurrogateStudy(const LoadedProblem& problem, const SurrogateSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  SurrogateAnswer solve(StudyRun& run) const;
  static std::string text(const SurrogateAnswer& answer);

 private:
  LoadedProblem problem_;
  SurrogateSettings settings_;
};

}  // namespace beltlife
