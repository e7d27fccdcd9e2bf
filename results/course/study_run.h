// Owns what every driver's command goes through: its problem loaded and checked, its points evaluated with journal and
// progress, its answer on disk.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_note.h"
#include "results/course/loaded_scene.h"
#include "results/course/options.h"
#include "results/journal/journal.h"
#include "sim/eval/drive_model.h"
#include "sim/eval/study_input.h"

namespace beltlife {

/// A problem with its scene, if it has one.
struct LoadedProblem {
  ProblemSpec spec;  ///< starts and quantities completed
  std::filesystem::path folder;
  std::optional<LoadedScene> scene;

  std::vector<double> start() const;
};

/// Reads the scene (relative to the study file, settings of the command line applied) and checks the problem against
/// it. Where the file names no quantities, those that `wanted` names for the drive are recorded. All problems, the
/// scene's among them, go to `log`; look there before using the result.
LoadedProblem load_problem(const ProblemSpec& spec, const std::filesystem::path& study,
                           const std::function<std::vector<std::string>(const Model&)>& wanted,
                           const CommonOptions& options, ReadLog& log);

/// The model of a problem; with other paths or quantities than the file's where a driver brings its own.
PointModel model_of(const LoadedProblem& problem, const std::vector<std::string>& paths,
                    const std::vector<std::string>& quantities, const DriveModelOptions& options);

/// A study under way. Ctrl-C lets it finish what is running, then evaluate() throws Interrupted.
class StudyRun {
 public:
  /// `head` needs driver, study_text, lanes, parameters and quantities; the rest is filled in. The log stands beside
  /// the result file: NAME.h5 has NAME.jsonl. Without --out both are named after the study file, in the working folder.
  StudyRun(const DriverOptions& options, const LoadedProblem& problem, StudyHead head, PointModel model);
  ~StudyRun();

  /// Answers in the points' order, from the log as far as it goes. `what` names the batch in the progress.
  std::vector<Answer> evaluate(const std::vector<Point>& points, const std::string& what);
  std::int64_t evaluations() const;  ///< points in the log
  std::int64_t failed() const;       ///< of them not ok

  /// Ends the log with the answer and folds both into the result file; `notes` say what the answer's parts mean.
  void finish(const nlohmann::json& answer, const std::vector<AnswerNote>& notes);
  const StudyRecord& record() const { return journal_.record(); }
  const std::string& out() const { return out_; }
  int threads() const { return options_.threads; }

 private:
  DriverOptions options_;
  std::string out_;
  Journal journal_;
  JournaledModel model_;
};

/// What to say of a study that was stopped or could not go on; returns the exit code.
int report_interrupted(const std::string& log);

}  // namespace beltlife
