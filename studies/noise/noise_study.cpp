// The study of kind noise: see noise_study.h.
#include "studies/noise/noise_study.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "results/text/table.h"
#include "sim/eval/difference_noise.h"
#include "studies/noise/noise.h"

namespace beltlife {
namespace {

constexpr const char* phase_path = "driver.phase_rad";
constexpr const char* ramp_path = "profile.ramp_s";

std::vector<double> values_of(const std::vector<Answer>& answers, std::size_t quantity) {
  std::vector<double> v;
  for (const Answer& a : answers)
    if (a.ok()) v.push_back(a.values[quantity]);
  return v;
}

double relative(double deviation, double value) { return value == 0 ? 0 : deviation / std::abs(value); }

Scatter scatter_of(const std::vector<double>& values, double value) {
  const Spread s = spread_of(values);
  return {std::ssize(values), s.mean, s.standard_deviation, relative(s.standard_deviation, value), s.low, s.high};
}

std::vector<SteadyResponse> named_responses(const std::vector<double>& values) {
  std::vector<SteadyResponse> named;
  for (const Response& r : responses_of(values))
    named.push_back({fmt::format("response {}", named.size() + 1), r.mean, std::ssize(r.members)});
  return named;
}

QuantityNoise noise_of(double value, const std::vector<double>& replicates, const std::vector<double>& hairs,
                       const std::optional<std::vector<double>>& line) {
  QuantityNoise q;
  q.value = value;
  q.noise = 0;
  if (replicates.size() > 1) {
    q.replicates = scatter_of(replicates, value);
    q.responses = named_responses(replicates);
  }
  if (hairs.size() > 1) {
    q.perturbation = scatter_of(hairs, value);
    q.noise = q.perturbation->standard_deviation;
  }
  if (line) {
    const DifferenceNoise d = difference_noise(*line);
    q.differences = {d.noise, relative(d.noise, value), d.order, d.levels};
    // Without a reliable order the estimate holds the function's slope: it is no more than a bound.
    if (d.order > 0 || !q.perturbation) q.noise = std::max(q.noise, d.noise);
  }
  q.noise_relative = relative(q.noise, value);
  q.step_forward = 2 * std::sqrt(q.noise_relative);
  q.step_central = std::cbrt(q.noise_relative);
  return q;
}

}  // namespace

void NoiseSettings::check(ReadLog& log) const {
  if (ramp_factors.empty())
    log.add(SpecPath{}.child("study").child("ramp_factors"), log.line("study.ramp_factors"), "is empty", "factors");
}

std::vector<std::string> NoiseStudy::quantities(const Model& m) {
  std::vector<std::string> names;
  for (const RangeSpec& range : m.scene.range) {
    if (m.scene.output)
      for (const char* channel : {"speed_rpm", "torque_n_m"})
        for (const char* order : {"order_3", "order_6"})
          names.push_back(fmt::format("{}.{}.{}.{}", range.name, m.scene.output->body, channel, order));
    names.push_back(range.name + ".log10_life_h");
  }
  names.push_back("log10_life_h");
  return names;
}

NoiseStudy::NoiseStudy(const LoadedProblem& problem, const NoiseSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings), paths_(problem.spec.paths()), start_(problem.start()) {
  const SceneSpec* scene = problem.scene ? &problem.scene->file.scene : nullptr;
  if (paths_.empty() && scene) {
    paths_ = {"belt.axial_stiffness_n", "belt.friction_front"};
    for (const std::string& path : paths_) start_.push_back(get_number(*scene, path));
  }
  if (paths_.empty())
    log.add(SpecPath{}.child("parameter"), log.line("parameter"), "missing: there is nothing to perturb",
            "at least one [[parameter]]");
  for (std::size_t i = 0; i < problem.spec.parameter.size(); ++i) {
    const SpecPath at = SpecPath{}.child("parameter").element(i);
    if (scene && scene->driver && (paths_[i] == phase_path || paths_[i] == ramp_path))
      log.add(at.child("path"), log.line(at.child("path").place), paths_[i] + " is varied by this study itself",
              "study.phases, study.ramp_factors");
    if (!problem.spec.parameter[i].start)
      log.add(at.child("start"), log.line(at.place), "missing: there is no nominal value",
              "start, both bounds or the mean of a distribution");
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    scale_.push_back(std::abs(start_[i]));
    if (scale_[i] > 0) continue;
    const ParameterSpec* p = i < problem.spec.parameter.size() ? &problem.spec.parameter[i] : nullptr;
    scale_[i] = p && p->lower && p->upper ? *p->upper - *p->lower : 1;
  }
  varied_ = paths_.size();
  if (scene && scene->driver) {
    paths_.insert(paths_.end(), {phase_path, ramp_path});
    start_.insert(start_.end(), {scene->driver->phase_rad, scene->profile.ramp_s});
  }
}

StudyHead NoiseStudy::head() const {
  StudyHead head;
  head.lanes = "drives";
  head.parameters = paths_;
  head.quantities = problem_.spec.quantities;
  return head;
}

PointModel NoiseStudy::model(int threads) const {
  return model_of(problem_, paths_, problem_.spec.quantities, {.threads = threads});
}

Point NoiseStudy::nominal() const { return point_of(start_); }

Point NoiseStudy::moved(const std::vector<double>& relative) const {
  std::vector<double> x = start_;
  for (std::size_t i = 0; i < varied_; ++i) {
    // Inwards at a bound: no point outside.
    const ParameterSpec* p = i < problem_.spec.parameter.size() ? &problem_.spec.parameter[i] : nullptr;
    double step = relative[i] * scale_[i];
    if (p && ((p->lower && x[i] + step < *p->lower) || (p->upper && x[i] + step > *p->upper))) step = -step;
    x[i] += step;
  }
  return point_of(x);
}

std::vector<double> NoiseStudy::signs(std::uint64_t which) const {
  std::mt19937_64 random(static_cast<std::uint64_t>(settings_.seed) * 1000003 + which);
  std::vector<double> s;
  for (std::size_t i = 0; i < varied_; ++i) s.push_back((random() & 1) != 0 ? 1 : -1);
  return s;
}

std::vector<Point> NoiseStudy::replicates() const {
  std::vector<Point> points;
  if (varied_ == paths_.size()) return points;
  for (const double factor : settings_.ramp_factors)
    for (int k = 0; k < settings_.phases; ++k) {
      std::vector<double> x = start_;
      x[varied_] += 2 * std::numbers::pi * k / settings_.phases;
      x[varied_ + 1] *= factor;
      points.push_back(point_of(x));
    }
  return points;
}

std::vector<Point> NoiseStudy::perturbed() const {
  std::vector<Point> points;
  for (int k = 0; k < settings_.perturbations; ++k) {
    std::vector<double> change = signs(static_cast<std::uint64_t>(k));
    // Up or down by one to two hairs, so that two parameters leave more than four different points.
    for (double& c : change) c *= settings_.perturbation * (1 + static_cast<double>(k) / settings_.perturbations);
    points.push_back(moved(change));
  }
  return points;
}

std::vector<Point> NoiseStudy::line() const {
  const std::vector<double> direction = signs(1u << 20);
  std::vector<Point> points;
  for (int k = 0; k < settings_.line_points; ++k) {
    std::vector<double> x = start_;  // straight on, or differences would mean nothing: not folded back at a bound
    for (std::size_t i = 0; i < varied_; ++i) {
      double from = -0.5 * (settings_.line_points - 1);
      const ParameterSpec* p = i < problem_.spec.parameter.size() ? &problem_.spec.parameter[i] : nullptr;
      const double reach = settings_.line_points * settings_.line_step * scale_[i];
      double sign = direction[i];
      if (p && p->lower && x[i] - reach < *p->lower) from = 0, sign = 1;
      if (p && p->upper && x[i] + reach > *p->upper) from = 0, sign = -1;
      x[i] += sign * (from + k) * settings_.line_step * scale_[i];
    }
    points.push_back(point_of(x));
  }
  return points;
}

NoiseAnswer NoiseStudy::solve(StudyRun& run) const {
  std::vector<Point> points{nominal()};
  const auto add = [&](const std::vector<Point>& more) {
    points.insert(points.end(), more.begin(), more.end());
    return more.size();
  };
  const std::size_t replicated = add(replicates()), hairs = add(perturbed());
  add(line());
  const std::vector<Answer> all = run.evaluate(points, "noise");
  const auto part = [&](std::size_t from, std::size_t count) {
    return std::vector<Answer>(all.begin() + static_cast<std::ptrdiff_t>(from),
                               all.begin() + static_cast<std::ptrdiff_t>(from + count));
  };
  const auto copies = part(1, replicated), close = part(1 + replicated, hairs),
             on_line = part(1 + replicated + hairs, points.size() - 1 - replicated - hairs);

  NoiseAnswer answer;
  answer.parameters.assign(paths_.begin(), paths_.begin() + static_cast<std::ptrdiff_t>(varied_));
  if (!all[0].ok()) {
    answer.error = fmt::format("the nominal point {}: {}", to_string(all[0].state), all[0].reason);
    return answer;
  }
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    std::optional<std::vector<double>> whole_line = values_of(on_line, q);
    if (whole_line->size() != on_line.size()) whole_line.reset();
    answer.quantities[problem_.spec.quantities[q]] =
        noise_of(all[0].values[q], values_of(copies, q), values_of(close, q), whole_line);
  }
  return answer;
}

std::string NoiseStudy::text(const NoiseAnswer& answer) {
  if (answer.error) return *answer.error + "\n";
  Table table(
      {"quantity", "value", "replicates %", "range %", "hair %", "differences %", "order", "step ln p", "responses"});
  std::string coexisting;
  const auto percent = [](double share) { return fmt::format("{:.2g}", 100 * share); };
  for (const auto& [name, q] : answer.quantities) {
    table.row({name, fmt::format("{:.5g}", q.value), q.replicates ? percent(q.replicates->relative) : "-",
               q.replicates ? percent(relative(q.replicates->max - q.replicates->min, q.value)) : "-",
               q.perturbation ? percent(q.perturbation->relative) : "-",
               q.differences ? percent(q.differences->relative) : "-",
               q.differences ? fmt::format("{}", q.differences->order) : "-", fmt::format("{:.2g}", q.step_forward),
               q.responses ? fmt::format("{}", q.responses->size()) : "-"});
    if (!q.responses || q.responses->size() < 2) continue;
    coexisting += name + ":";
    for (const SteadyResponse& r : *q.responses)
      coexisting += fmt::format(" {} near {:.5g} ({} replicates)", r.name, r.mean, r.replicates);
    coexisting += "\n";
  }
  return "Scatter of each quantity, of its value: replicates differ in crank phase and ramp time, hairs in the last\n"
         "digits of the parameters; differences: noise along a short line, by the order of the difference table (0:\n"
         "none is reliable). Step: for forward differences in ln p.\n\n" +
         table.text() + (coexisting.empty() ? "" : "\nSteady responses that coexist:\n" + coexisting);
}

}  // namespace beltlife
