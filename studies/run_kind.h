// Owns the course that every kind of study takes, from its file to its answer.
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "results/print.h"
#include "results/study_run.h"

namespace beltlife {

/// `Kind` has a Settings with visit() and check(log), and
///   static std::vector<std::string> quantities(const Model&)   recorded where the file names none
///   Kind(LoadedProblem, Settings, ReadLog&)                    adds what is wrong with both together
///   StudyHead head(); PointModel model(threads)                columns of its points, and who answers them
///   nlohmann::json solve(StudyRun&)                            the answer
///   static std::string text(const nlohmann::json&)             the answer for people
template <class Kind>
int run_kind(const CommandOptions& o) {
  auto input = read_study<StudySpec<typename Kind::Settings>>(o.scenes.at(0));
  auto& settings = input.spec.study;
  if constexpr (requires { settings.seed; })
    if (o.seed) settings.seed = static_cast<std::int64_t>(*o.seed);
  settings.check(input.log);
  LoadedProblem problem = load_problem(input.spec.problem, input.path, Kind::quantities, o, input.log);
  throw_problems(input.log.problems);
  Kind kind(problem, settings, input.log);
  throw_problems(std::move(input.log.problems));

  StudyHead head = kind.head();
  head.driver = "study " + o.kind;
  head.study_text = write_spec(StudySpec<typename Kind::Settings>{problem.spec, settings});
  StudyRun run(o, problem, std::move(head), kind.model(o.threads));
  nlohmann::json answer;
  try {
    answer = kind.solve(run);
  } catch (const Interrupted&) {
    return report_interrupted(std::filesystem::path(run.out()).replace_extension(".jsonl").string());
  }
  answer = run.finish(std::move(answer));
  if (o.json)
    fmt::print("{}\n", json_text(answer));
  else
    fmt::print("{}", Kind::text(answer));
  return answer.contains("error") ? 3 : 0;
}

}  // namespace beltlife
