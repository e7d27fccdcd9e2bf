// The course of a study: see study_run.h.
#include "results/course/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <map>

#include "results/store/study_file.h"
#include "results/store/whole_file.h"
#include "results/text/progress.h"
#include "sim/eval/command_model.h"

namespace beltlife {
namespace {

// The second Ctrl-C ends the program as usual.
extern "C" void on_stop_signal(int number) {
  request_stop();
  std::signal(number, SIG_DFL);
}

std::string out_of(const DriverOptions& o) {
  if (!o.out.empty()) return o.out;
  return std::filesystem::path(o.file).stem().string() + ".h5";
}

std::filesystem::path log_of(const std::string& out) { return std::filesystem::path(out).replace_extension(".jsonl"); }

StudyHead completed(StudyHead head, const DriverOptions& o, const LoadedProblem& problem) {
  head.version = o.program.version;
  head.revision = o.program.revision;
  head.compiler = o.program.compiler;
  head.command_line = o.program.command_line;
  head.study_path = o.file;
  if (problem.scene) {
    head.scene_path = problem.scene->file.path.string();
    head.scene_text = write_scene(problem.scene->file.scene);
  }
  return head;
}

std::filesystem::path checked_log(const std::string& out) {
  check_writable(out);
  if (std::filesystem::path(out).extension() == ".jsonl")
    throw BadInput({Problem{out, 0, "--out", "is the name of the log, which stands beside the result", "NAME.h5"}});
  return log_of(out);
}

}  // namespace

std::vector<double> LoadedProblem::start() const {
  std::vector<double> x;
  for (const ParameterSpec& p : spec.parameter) x.push_back(p.start.value_or(0));
  return x;
}

LoadedProblem load_problem(const ProblemSpec& spec, const std::filesystem::path& study,
                           const std::function<std::vector<std::string>(const Model&)>& wanted, const CommonOptions& o,
                           ReadLog& log) {
  LoadedProblem problem{spec, std::filesystem::absolute(study).parent_path(), {}};
  check_problem(problem.spec, log);
  if (problem.spec.scene && !log.is_faulty("scene")) {
    const auto path = study.parent_path() / *problem.spec.scene;
    if (!std::filesystem::exists(path)) {
      log.add(SpecPath{}.child("scene"), log.line("scene"), fmt::format("there is no file {}", path.string()),
              "a scene file, relative to the study file");
      return problem;
    }
    try {
      problem.scene = load_scene(path.string(), o.settings);
    } catch (const BadInput& bad) {
      for (const Problem& p : bad.problems()) log.problems.push_back(p);
      log.faulty.insert("scene");
      return problem;
    }
    if (problem.spec.quantities.empty()) problem.spec.quantities = wanted(problem.scene->model);
    check_against_scene(problem.spec, problem.scene->file.scene, quantity_names(problem.scene->model), log);
  } else if (problem.spec.command && problem.spec.quantities.empty() && !log.is_faulty("quantities")) {
    log.add(SpecPath{}.child("quantities"), log.line("quantities"), "missing: what the command answers is not known",
            "names of the command's answer");
  }
  if (problem.spec.command && !o.settings.empty())
    log.problems.push_back({"--set", 0, o.settings.front(), "the study has no scene", ""});
  if (log.problems.empty()) complete_starts(problem.spec, problem.scene ? &problem.scene->file.scene : nullptr);
  return problem;
}

PointModel model_of(const LoadedProblem& problem, const std::vector<std::string>& paths,
                    const std::vector<std::string>& quantities, const DriveModelOptions& options) {
  if (!problem.scene) return command_model(*problem.spec.command, problem.folder, paths, quantities, options.threads);
  DriveModelOptions o = options;
  o.step_budget = problem.spec.step_budget;
  o.measured = problem.scene->speed();
  return drive_model(problem.scene->file.scene, paths, quantities, o);
}

StudyRun::StudyRun(const DriverOptions& options, const LoadedProblem& problem, StudyHead head, PointModel model)
    : options_(options),
      out_(out_of(options)),
      journal_(checked_log(out_), completed(std::move(head), options, problem)),
      model_(std::move(model), journal_) {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  if (!options.quiet && !journal_.record().points.empty())
    fmt::print(stderr, "{}: {} points are there already and are not run again\n", log_of(out_).string(),
               journal_.record().points.size());
}

StudyRun::~StudyRun() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

std::vector<Answer> StudyRun::evaluate(const std::vector<Point>& points, const std::string& what) {
  Progress progress(what, static_cast<double>(points.size()), "points", options_.quiet, 0);
  std::size_t done = 0;
  return model_.evaluate(points, [&](std::size_t, const Answer&) { progress(static_cast<double>(++done)); });
}

std::int64_t StudyRun::evaluations() const { return std::ssize(journal_.record().points); }

std::int64_t StudyRun::failed() const {
  const auto& points = journal_.record().points;
  return std::count_if(points.begin(), points.end(), [](const StudyPoint& p) { return !p.answer.ok(); });
}

void StudyRun::finish(const nlohmann::json& answer, const std::vector<AnswerNote>& notes) {
  journal_.finish(answer);
  write_study(out_, journal_.record(), notes);
  if (!options_.quiet) {
    std::map<PointState, std::vector<const StudyPoint*>> lost;
    for (const StudyPoint& p : journal_.record().points)
      if (!p.answer.ok()) lost[p.answer.state].push_back(&p);
    for (const auto& [state, points] : lost)
      fmt::print(stderr, "{} of {} points {}, the first point {}: {}\n", points.size(), evaluations(), to_string(state),
                 points.front()->number, points.front()->answer.reason);
    fmt::print(stderr, "wrote {}\n", out_);
  }
}

int report_interrupted(const std::string& log) {
  fmt::print(stderr, "stopped; what was finished is in {}: the same command goes on from there\n", log);
  return 3;
}

}  // namespace beltlife
