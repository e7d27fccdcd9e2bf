// Owns the course that every driver takes, from its file to its answer.
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "results/answer/answer_json.h"
#include "results/course/study_run.h"
#include "results/journal/ranks.h"
#include "results/text/print.h"

namespace beltlife {

/// `Driver` has a Spec with visit() and a member `problem`, and
///   static void prepare(Spec&, const DriverOptions&, ReadLog&)    flags applied; adds what is wrong with it alone
///   static std::vector<std::string> quantities(const Model&)      recorded where the file names none
///   Driver(LoadedProblem, Spec, ReadLog&)                         adds what is wrong with file and scene together
///   StudyHead head(); PointModel model(threads)                   columns of its points, and who answers them
///   const LoadedProblem& problem()                                optional: the problem as the driver has changed it
///   using Result = ...                                            its answer: a DriverAnswer that lists its parts
///   Result solve(StudyRun&)                                       what it found
///   static std::string text(const Result&)                        the answer for people
/// `name` is what the log calls the driver.
template <class Driver>
int run_driver(const DriverOptions& o, const std::string& name) {
  auto input = read_study<typename Driver::Spec>(o.file);
  Driver::prepare(input.spec, o, input.log);
  LoadedProblem problem = load_problem(input.spec.problem, input.path, Driver::quantities, o, input.log);
  throw_problems(input.log.problems);
  input.spec.problem = problem.spec;
  Driver driver(problem, input.spec, input.log);
  throw_problems(std::move(input.log.problems));
  if constexpr (requires { driver.problem(); }) {
    problem = driver.problem();
    input.spec.problem = problem.spec;
  }

  PointModel model = driver.model(o.threads);
  if (o.program.ranks && !o.program.ranks->leads()) {
    o.program.ranks->answer(model);
    return 0;
  }
  if (o.program.ranks) model = o.program.ranks->spread(std::move(model), o.threads);
  StudyHead head = driver.head();
  head.driver = name;
  head.study_text = write_spec(input.spec) + head.study_text;
  StudyRun run(o, problem, std::move(head), std::move(model));
  typename Driver::Result answer;
  try {
    answer = driver.solve(run);
  } catch (const Interrupted&) {
    return report_interrupted(std::filesystem::path(run.out()).replace_extension(".jsonl").string());
  }
  answer.evaluations = run.evaluations();
  answer.failed = run.failed();
  const nlohmann::json json = json_of_answer(answer);
  run.finish(json, notes_of<typename Driver::Result>());
  fmt::print("{}", o.json ? json_text(json) + "\n" : Driver::text(answer));
  return answer.error ? 3 : 0;
}

}  // namespace beltlife
