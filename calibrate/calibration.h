// Owns the driver calibrate: parameters of a model fitted to measurements, with how sure they are.
#pragma once

#include "calibrate/calibration_result.h"
#include "calibrate/calibration_spec.h"
#include "calibrate/fit_model.h"
#include "results/course/study_run.h"

namespace beltlife {

class Calibration {
 public:
  using Spec = CalibrationSpec;
  using Result = CalibrationAnswer;
  static void prepare(Spec& spec, const DriverOptions& options, ReadLog& log);
  static std::vector<std::string> quantities(const Model&) { return {}; }  // what the targets need is added later
  Calibration(const LoadedProblem& problem, const Spec& spec, ReadLog& log);
  StudyHead head() const;
  PointModel model(int threads) const;
  CalibrationAnswer solve(StudyRun& run) const;
  static std::string text(const CalibrationAnswer& answer);

 private:
  void add_observations(const Spec& spec, ReadLog& log);
  void add_spectra(const Spec& spec, ReadLog& log);
  void add(Target target);

  LoadedProblem problem_;
  CalibrationSettings settings_;
  std::vector<Measurement> measurements_;
  std::vector<Target> targets_;
  std::string files_;  ///< comment lines: what the measured files held, for the log's head
};

}  // namespace beltlife
