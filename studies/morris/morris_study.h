// Owns the study of kind morris: which parameters matter at all, from few points.
#pragma once

#include <map>

#include "results/course/study_run.h"
#include "studies/morris/morris_answer.h"

namespace beltlife {

struct MorrisSettings {
  int trajectories = 20;
  int levels = 4;
  std::int64_t seed = 1;
  std::optional<std::string> noise;

  template <class V>
  void visit(V& v) {
    v("trajectories", trajectories, within(2, 100000), "trajectories r; r (parameters + 1) points are run");
    v("levels", levels, within(2, 1000), "values of each parameter, evenly from bound to bound; an even number");
    v("seed", seed, within(0, 9e15), "of the trajectories");
    v("noise", noise, any_text,
      "result or log of a study of kind noise of the same quantities, relative to this file: marks what is no more "
      "than noise");
  }
  void check(ReadLog& log) const;
};

/// Elementary effects (Morris, Technometrics 33, 1991; mu_star: Campolongo et al., Environ. Model. Softw. 22, 2007) for
/// each parameter's whole range from bound to bound, with `log` in ln p; its distribution plays no part.
class MorrisStudy {
 public:
  using Settings = MorrisSettings;
  using Result = MorrisAnswer;
  static std::vector<std::string> quantities(const Model& model);
  MorrisStudy(const LoadedProblem& problem, const MorrisSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  MorrisAnswer solve(StudyRun& run) const;
  static std::string text(const MorrisAnswer& answer);

 private:
  void read_noise(ReadLog& log);

  LoadedProblem problem_;
  MorrisSettings settings_;
  std::map<std::string, double> noise_;  ///< standard deviation by quantity, in its unit
};

}  // namespace beltlife
