// Owns the course that every driver takes, from its file to its answer.
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "results/print.h"
#include "results/ranks.h"
#include "results/study_run.h"

namespace beltlife {

/// `Driver` has a Spec with visit() and a member `problem`, and
///   static void prepare(Spec&, const CommandOptions&, ReadLog&)   flags applied; adds what is wrong with it alone
///   static std::vector<std::string> quantities(const Model&)      recorded where the file names none
///   Driver(LoadedProblem, Spec, ReadLog&)                         adds what is wrong with file and scene together
///   StudyHead head(); PointModel model(threads)                   columns of its points, and who answers them
///   const LoadedProblem& problem()                                optional: the problem as the driver has changed it
///   nlohmann::json solve(StudyRun&)                               the answer; `error` in it: there is none, and why
///   static std::string text(const nlohmann::json&)                the answer for people
/// `name` is what the log calls the driver.
template <class Driver>
int run_driver(const CommandOptions& o, const std::string& name) {
  auto input = read_study<typename Driver::Spec>(o.scenes.at(0));
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
  if (o.ranks && !o.ranks->leads()) {
    o.ranks->answer(model);
    return 0;
  }
  if (o.ranks) model = o.ranks->spread(std::move(model), o.threads);
  StudyHead head = driver.head();
  head.driver = name;
  head.study_text = write_spec(input.spec) + head.study_text;
  StudyRun run(o, problem, std::move(head), std::move(model));
  nlohmann::json answer;
  try {
    answer = driver.solve(run);
  } catch (const Interrupted&) {
    return report_interrupted(std::filesystem::path(run.out()).replace_extension(".jsonl").string());
  }
  answer = run.finish(std::move(answer));
  if (o.json)
    fmt::print("{}\n", json_text(answer));
  else
    fmt::print("{}", Driver::text(answer));
  return answer.contains("error") ? 3 : 0;
}

}  // namespace beltlife
