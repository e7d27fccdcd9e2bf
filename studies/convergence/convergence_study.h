// Owns the study of kind convergence: error against run time, by scheme, step and mesh.
#pragma once

#include "results/course/study_run.h"
#include "studies/convergence/convergence.h"
#include "studies/convergence/convergence_answer.h"

namespace beltlife {

struct ConvergenceSettings {
  std::vector<std::string> ranges;
  std::vector<Scheme> schemes = {Scheme::thesis, Scheme::symplectic_euler, Scheme::linearly_implicit};
  std::vector<int> elements = {128, 256, 512, 1024};
  std::vector<double> implicit_steps_s = {5e-6, 1e-5, 2e-5, 3.3333333333333335e-5, 5e-5};
  std::vector<double> explicit_factors = {1, 0.5};
  int phases = 8;
  int repeats = 3;
  double repeat_below_s = 20;

  template <class V>
  void visit(V& v) {
    v("ranges", ranges, any_text, "operating ranges; none: all");
    v("schemes", schemes, any_text, "time integrators");
    v("elements", elements, within(8, 100000), "belt elements");
    v("implicit_steps_s", implicit_steps_s, above(0, 1e-2), "steps of linearly_implicit");
    v("explicit_factors", explicit_factors, above(0, 1),
      "steps of the explicit schemes, as parts of the stable step predicted for the mesh");
    v("phases", phases, within(2, 1000), "crank phases, run at the scene's own setting, for the noise floor");
    v("repeats", repeats, within(1, 100), "runs of a setting, for the median of their time");
    v("repeat_below_s", repeat_below_s, within(0, 1e9), "a setting that takes longer is run once, s of processor time");
  }
  void check(ReadLog& log) const;
};

/// Every run has all eight lanes and one thread, and nothing else shares its lanes, so that its time is its own.
class ConvergenceStudy {
 public:
  using Settings = ConvergenceSettings;
  using Result = ConvergenceAnswer;
  static std::vector<std::string> quantities(const Model& model);
  ConvergenceStudy(const LoadedProblem& problem, const ConvergenceSettings& settings, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  ConvergenceAnswer solve(StudyRun& run) const;
  static std::string text(const ConvergenceAnswer& answer);

 private:
  std::vector<NumericalRun> settings() const;
  std::vector<NumericalRun> run_all(StudyRun& run) const;
  std::vector<double> noise_floor(StudyRun& run) const;
  double simulated_s() const;
  /// Which quantities are not drowned in noise; what is known of the reference goes to the answer.
  std::vector<bool> judge(const std::vector<NumericalRun>& runs, std::size_t reference,
                          const std::vector<double>& floor, ConvergenceAnswer& answer) const;
  SettingAnswer setting_of(const NumericalRun& r, const std::vector<NumericalRun>& runs,
                           std::optional<std::size_t> reference, const std::vector<bool>& judged,
                           double simulated) const;
  std::map<std::string, ObservedOrders> orders_of(const std::string& group, const std::vector<NumericalRun>& runs,
                                                  const std::vector<SettingAnswer>& settings,
                                                  const std::vector<bool>& judged) const;
  Point point_of_run(const NumericalRun& r, double phase, int repeat) const;

  LoadedProblem problem_;
  ConvergenceSettings settings_;
  std::vector<std::string> quantities_;
};

}  // namespace beltlife
