// The study of kind morris: see morris_study.h.
#include "studies/morris/morris_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/answer/answer_json.h"
#include "results/store/study_file.h"
#include "results/text/table.h"
#include "studies/morris/elementary_effects.h"
#include "studies/noise/noise_answer.h"
#include "studies/openturns/openturns_inputs.h"
#include "studies/sampled_study.h"

namespace beltlife {

void MorrisSettings::check(ReadLog& log) const {
  const SpecPath path = SpecPath{}.child("study").child("levels");
  if (levels % 2 != 0 && !log.is_faulty(path.place))
    log.add(path, log.line(path.place), fmt::format("{} is odd: levels would not be equally likely", levels),
            "an even number");
}

std::vector<std::string> MorrisStudy::quantities(const Model& m) { return life_quantity(m); }

MorrisStudy::MorrisStudy(const LoadedProblem& problem, const MorrisSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  check_bounds(problem.spec, log);
  if (settings.noise) read_noise(log);
}

void MorrisStudy::read_noise(ReadLog& log) {
  const SpecPath path = SpecPath{}.child("study").child("noise");
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    log.add(path, log.line(path.place), what, allowed);
  };
  StudyRecord record;
  try {
    record = read_study_record(problem_.folder / *settings_.noise);
  } catch (const BadInput& bad) {
    return refuse(fmt::format("{}: {}", *settings_.noise, bad.problems().front().what), "a result of study noise");
  }
  if (record.head.driver != "study noise" || !record.answer.is_object())
    return refuse(*settings_.noise + " holds no finished study of kind noise", "a result of study noise");
  const auto answer = answer_of_json<NoiseAnswer>(record.answer);
  if (answer.quantities.empty())
    return refuse(*settings_.noise + " holds no finished study of kind noise", "a result of study noise");
  for (const std::string& name : problem_.spec.quantities) {
    const auto found = answer.quantities.find(name);
    if (found == answer.quantities.end()) {
      refuse(fmt::format("{} does not know {}", *settings_.noise, name), "a study of the same quantities");
      continue;
    }
    // Another simulator has no crank phase to replicate with: what is left is its scatter over hairs.
    const QuantityNoise& q = found->second;
    noise_[name] = q.replicates ? q.replicates->standard_deviation : q.noise;
  }
}

StudyHead MorrisStudy::head() const { return sampled_head(problem_); }
PointModel MorrisStudy::model(int threads) const { return sampled_model(problem_, threads); }

MorrisAnswer MorrisStudy::solve(StudyRun& run) const {
  const std::vector<std::string> paths = problem_.spec.paths();
  const Rows cube =
      trajectories(static_cast<std::size_t>(settings_.trajectories), paths.size(), settings_.levels, settings_.seed);
  // From bound to bound, evenly: a parameter without a distribution is just that.
  std::vector<ParameterSpec> even = problem_.spec.parameter;
  for (ParameterSpec& p : even) p.distribution.reset();
  const std::vector<Answer> answers = run.evaluate(points_of(Inputs(even).at(cube)), "morris");

  MorrisAnswer answer;
  answer.parameters = paths;
  answer.trajectories = settings_.trajectories;
  answer.levels = settings_.levels;
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    std::vector<std::optional<double>> values;
    for (const Answer& a : answers) values.push_back(a.ok() ? std::optional(a.values[q]) : std::nullopt);
    const std::vector<Effects> effects = elementary_effects(cube, values);
    const auto noise = noise_.find(problem_.spec.quantities[q]);
    auto& by_parameter = answer.quantities[problem_.spec.quantities[q]];
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const Effects& e = effects[k];
      ParameterEffects& found = by_parameter[paths[k]];
      found = {e.mu, e.mu_star, e.sigma, e.mu_star_error, static_cast<std::int64_t>(e.used), {}, {}};
      if (noise == noise_.end() || e.used == 0) continue;
      found.noise_floor = mu_star_of_noise(noise->second, settings_.levels, e.used);
      found.within_noise = e.mu_star <= *found.noise_floor;
    }
  }
  return answer;
}

std::string MorrisStudy::text(const MorrisAnswer& answer) {
  std::string words = fmt::format(
      "Elementary effects for each parameter's whole range, {} trajectories on {} levels: mu, their mean; mu*, mean "
      "of\n"
      "their magnitudes, with its standard error; sigma, their scatter (curvature and interactions).\n",
      answer.trajectories, answer.levels);
  for (const auto& [name, by_parameter] : answer.quantities) {
    const bool floor = std::any_of(by_parameter.begin(), by_parameter.end(),
                                   [](const auto& entry) { return entry.second.noise_floor.has_value(); });
    std::vector<std::string> header{"parameter", "mu", "mu*", "error", "sigma", "effects"};
    if (floor) header.insert(header.end(), {"of noise", "verdict"});
    Table table(header);
    std::vector<std::string> order = answer.parameters;
    const auto size = [&effects = by_parameter](const std::string& p) {
      const double mu_star = effects.at(p).mu_star;
      return std::isfinite(mu_star) ? mu_star : -1.0;
    };
    std::stable_sort(order.begin(), order.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
    for (const std::string& p : order) {
      const ParameterEffects& e = by_parameter.at(p);
      std::vector<std::string> row{p,
                                   cell(e.mu, 4),
                                   cell(e.mu_star, 4),
                                   cell(e.mu_star_error, 2),
                                   cell(e.sigma, 4),
                                   fmt::format("{}", e.effects)};
      if (e.noise_floor) {
        row.push_back(cell(*e.noise_floor, 2));
        row.push_back(e.within_noise.value_or(false) ? "no more than noise" : "above noise");
      }
      table.row(std::move(row));
    }
    words += fmt::format("\n{}{}\n\n{}", name, in_unit(name), table.text());
  }
  return words;
}

}  // namespace beltlife
