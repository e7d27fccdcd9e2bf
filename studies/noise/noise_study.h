// Owns the study of kind noise: how far quantities scatter without anything of importance being changed.
#pragma once

#include "results/course/study_run.h"
#include "studies/noise/noise_answer.h"

namespace beltlife {

struct NoiseSettings {
  int phases = 8;
  std::vector<double> ramp_factors = {0.8, 1.0, 1.25};
  int perturbations = 8;
  double perturbation = 1e-9;
  int line_points = 7;
  double line_step = 1e-5;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v("phases", phases, within(1, 1000), "crank phases, evenly over a revolution; each with every ramp time");
    v("ramp_factors", ramp_factors, above(0, 100), "factors on profile.ramp_s");
    v("perturbations", perturbations, within(0, 1000), "points that differ from the nominal one by a hair");
    v("perturbation", perturbation, above(0, 0.1),
      "the hair: relative change of every parameter, up or down by chance");
    v("line_points", line_points, within(4, 100),
      "points on a short line through the nominal one, for a difference table");
    v("line_step", line_step, above(0, 0.1), "their distance: relative change of every parameter from one to the next");
    v("seed", seed, within(0, 9e15), "of the random signs");
  }
  void check(ReadLog& log) const;
};

/// Points are the nominal one, replicates (crank phase x ramp time; of a scene that has them), perturbations, and the
/// line. Without parameters in the file the belt's stiffness and front friction are perturbed.
class NoiseStudy {
 public:
  using Settings = NoiseSettings;
  using Result = NoiseAnswer;
  static std::vector<std::string> quantities(const Model& model);
  NoiseStudy(const LoadedProblem& problem, const NoiseSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  NoiseAnswer solve(StudyRun& run) const;
  static std::string text(const NoiseAnswer& answer);

 private:
  std::vector<Point> replicates() const, perturbed() const, line() const;
  Point nominal() const;
  Point moved(const std::vector<double>& relative) const;
  std::vector<double> signs(std::uint64_t which) const;

  LoadedProblem problem_;
  NoiseSettings settings_;
  std::vector<std::string> paths_;
  std::vector<double> start_, scale_;
  std::size_t varied_ = 0;  ///< of the paths: parameters; behind them phase and ramp time
};

}  // namespace beltlife
