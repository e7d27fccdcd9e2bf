// Owns what tests of sampled studies share: problems without a scene, functions with known answers, runs of a kind.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <span>

#include "results/answer/answer_json.h"
#include "results/course/study_run.h"
#include "studies/openturns/openturns_inputs.h"
#include "tests/unit/study_fixture.h"

namespace beltlife::study_test {

inline ParameterSpec uniform(const std::string& path, double lower, double upper) {
  ParameterSpec p;
  p.path = path;
  p.lower = lower;
  p.upper = upper;
  p.start = 0.5 * (lower + upper);
  return p;
}

inline ParameterSpec scattered(const std::string& path, DistributionKind kind, double mean, double deviation) {
  ParameterSpec p;
  p.path = path;
  p.start = mean;
  p.distribution = DistributionSpec{kind, mean, deviation, {}};
  return p;
}

using Function = std::function<double(const std::vector<double>&)>;

/// Ishigami and Homma (1990) with a = 7, b = 0.1, inputs uniform in -pi to pi. First indices 0.3139, 0.4424, 0; total
/// 0.5576, 0.4424, 0.2437; variance a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2 = 13.845; mean a/2.
inline double ishigami(const std::vector<double>& x) {
  return std::sin(x[0]) + 7 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}
inline std::vector<ParameterSpec> ishigami_inputs() {
  const double pi = std::numbers::pi;
  return {uniform("x1", -pi, pi), uniform("x2", -pi, pi), uniform("x3", -pi, pi)};
}
inline const std::vector<double> ishigami_first{0.3139, 0.4424, 0}, ishigami_total{0.5576, 0.4424, 0.2437};

inline LoadedProblem toy_problem(std::vector<ParameterSpec> parameters, std::vector<std::string> quantities) {
  LoadedProblem problem;
  problem.spec.parameter = std::move(parameters);
  problem.spec.quantities = std::move(quantities);
  return problem;
}

/// Answers each quantity by one function; a point for which `fails` says so has failed.
inline PointModel toy(std::vector<Function> functions, std::function<bool(const std::vector<double>&)> fails = {}) {
  return [=](const std::vector<Point>& points, const OnAnswer& on_answer) {
    std::vector<Answer> answers;
    for (const Point& point : points) {
      std::vector<double> x;
      for (const Setting& s : point) x.push_back(number_of(s));
      Answer a;
      if (fails && fails(x)) {
        a.reason = "chance";
      } else {
        a.state = PointState::ok;
        for (const Function& f : functions) a.values.push_back(f(x));
      }
      if (on_answer) on_answer(answers.size(), a);
      answers.push_back(std::move(a));
    }
    return answers;
  };
}

/// One failure in ten, by a hash of the point: the same point always fails.
inline bool fails_by_chance(const std::vector<double>& x) {
  std::uint64_t bits = 0x9e3779b97f4a7c15;
  for (const double v : x) bits = (bits ^ std::bit_cast<std::uint64_t>(v)) * 0xff51afd7ed558ccd, bits ^= bits >> 33;
  return std::mt19937_64(bits)() % 10 == 0;
}

/// The answer of a kind whose points are answered by `model`, with its log in `folder`.
template <class Kind>
nlohmann::json answer_of(const LoadedProblem& problem, const typename Kind::Settings& settings, const PointModel& model,
                         const fs::path& folder) {
  DriverOptions o;
  o.file = "toy.toml";
  o.out = folder / "toy.h5";
  o.quiet = true;
  fs::remove(folder / "toy.jsonl");
  ReadLog log;
  const Kind kind(problem, settings, log);
  throw_problems(log.problems);
  StudyRun run(o, problem, kind.head(), model);
  auto found = kind.solve(run);
  found.evaluations = run.evaluations();
  found.failed = run.failed();
  const nlohmann::json answer = json_of_answer(found);
  run.finish(answer, notes_of<typename Kind::Result>());
  return answer;
}

/// An answer for people.
template <class Kind>
std::string text_of(const nlohmann::json& answer) {
  return Kind::text(answer_of_json<typename Kind::Result>(answer));
}

/// What a kind refuses of a problem, in words.
template <class Kind>
std::string refusal_of(const LoadedProblem& problem, const typename Kind::Settings& settings) {
  return refusal([&] {
    ReadLog log;
    settings.check(log);
    const Kind kind(problem, settings, log);
    throw_problems(log.problems);
  });
}

}  // namespace beltlife::study_test
