// The answer, with what it means in words: see calibration_answer.h.
#include "calibrate/calibration_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace beltlife {
namespace {

/// Whether an interval of this half-width says anything: less than half of what was allowed anyway; without bounds,
/// less than the value itself (a factor of e).
bool says_something(const Coordinate& c, double u, double half) {
  if (c.bounded()) return half < 0.5 * c.width();
  return half < (c.log() ? 1 : std::abs(u));
}

enum class Known { settled, confounded, silent };
Known known(const FitModel& model, const FitResult& end, const Inference& in, std::size_t i) {
  const Coordinate& c = model.coordinates()[i];
  if (says_something(c, end.u[i], in.quantile * in.standard_error[i])) return Known::settled;
  return says_something(c, end.u[i], in.quantile * in.standard_error_alone[i]) ? Known::confounded : Known::silent;
}

const char* word_of(Known known) {
  switch (known) {
    case Known::settled:
      return "yes";
    case Known::confounded:
      return "confounded";
    case Known::silent:
      break;
  }
  return "no";
}

FittedValue fitted_value(const FitModel& model, const FitResult& end, const Inference& in, std::size_t i) {
  const ParameterSpec& spec = model.problem().parameters[i];
  const Coordinate& c = model.coordinates()[i];
  const double u = end.u[i], half = in.quantile * in.standard_error[i];
  FittedValue p;
  p.value = c.value(u);
  p.standard_error = c.slope(u) * in.standard_error[i];
  p.low = c.value(std::max(u - half, c.lower()));
  p.high = c.value(std::min(u + half, c.upper()));
  p.start = *spec.start;
  p.at_bound = in.at_bound[i] < 0 ? "lower" : in.at_bound[i] > 0 ? "upper" : "no";
  p.lower = spec.lower;
  p.upper = spec.upper;
  p.identified = word_of(known(model, end, in, i));
  return p;
}

ProfileAnswer profile_answer(const Coordinate& c, const Profile& profile) {
  const auto value = [&](double u) { return std::isnan(u) ? not_known : c.value(u); };
  ProfileAnswer p{value(profile.low), value(profile.high), {}, profile.cost};
  for (const double u : profile.u) p.value.push_back(c.value(u));
  return p;
}

/// "raising a by 0.3 and lowering b by 0.01"
std::string moves_of(const FitModel& model, const FitResult& end, const Inference& in, double threshold) {
  std::vector<std::string> moves;
  for (std::size_t i = 0; i < end.u.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (std::abs(in.share(k)) < threshold) continue;
    const Coordinate& c = model.coordinates()[i];
    const double by = in.weakest(k);
    moves.push_back(fmt::format("{} {} by {}", by > 0 ? "raising" : "lowering", model.problem().parameters[i].path,
                                c.log() ? fmt::format("{:.2g} %", 100 * std::abs(std::expm1(by)))
                                        : fmt::format("{:.2g}", std::abs(by * c.slope(end.u[i])))));
  }
  std::string words;
  for (std::size_t k = 0; k < moves.size(); ++k)
    words += (k == 0 ? "" : k + 1 == moves.size() ? " and " : ", ") + moves[k];
  return words;
}

OrNull<WeakestDirection> weakest_direction(const FitModel& model, const FitResult& end, const Inference& in) {
  if (in.eigenvalues.empty()) return {};
  WeakestDirection weakest;
  weakest.eigenvalue = in.eigenvalues.front();
  std::string names;
  int count = 0;
  for (std::size_t i = 0; i < end.u.size(); ++i) {
    const double share = in.share(static_cast<Eigen::Index>(i));
    weakest.direction[model.problem().parameters[i].path] = share;
    if (std::abs(share) < 0.3) continue;
    names += (count++ > 0 ? ", " : "") + model.problem().parameters[i].path;
  }
  if (count < 2 || in.eigenvalues.front() > 0.5)
    weakest.words = "No two parameters stand in for each other in these data.";
  else
    weakest.words = fmt::format(
        "{} trade off: {} together costs no more than one residual's variance. Data in which they act differently "
        "would separate them: another range, amplitude or channel.",
        names, moves_of(model, end, in, 0.3));
  return {std::move(weakest)};
}

FitAnswer fit_answer(const FitModel& model, const FitResult& f) {
  FitAnswer row;
  row.ok = f.ok;
  row.ended = f.ended;
  row.start_cost = f.start_cost;
  if (f.ok) row.cost = f.cost;
  const auto& parameters = model.problem().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    row.parameters[parameters[i].path] = model.coordinates()[i].value(f.u[i]);
  if (f.steps.empty()) return row;
  row.points.emplace();
  row.costs.emplace();
  for (const CostStep& s : f.steps) {
    row.points->push_back(static_cast<std::int64_t>(s.points));
    row.costs->push_back(s.cost);
  }
  return row;
}

}  // namespace

std::vector<ResidualAnswer> residuals_of(const std::vector<Target>& targets, const Answer& start, const Answer& end) {
  std::vector<ResidualAnswer> rows;
  for (const Target& t : targets) {
    const double before = start.ok() ? start.values[t.column] : not_known, after = end.values[t.column];
    rows.push_back({t.quantity, t.value, before, after, before / t.value - 1, after / t.value - 1, t.sigma,
                    t.model_noise, t.logarithm, t.residual(after)});
  }
  return rows;
}

CalibrationAnswer answer_of(const FitModel& model, const FitCourse& course, const Inference& in,
                            const std::vector<std::size_t>& profiled, const std::vector<Profile>& profiles,
                            double confidence) {
  const FitResult& end = course.end;
  const auto& parameters = model.problem().parameters;
  CalibrationAnswer answer;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    answer.parameters[parameters[i].path] = fitted_value(model, end, in, i);
  for (std::size_t k = 0; k < profiled.size(); ++k)
    answer.parameters[parameters[profiled[k]].path].profile =
        profile_answer(model.coordinates()[profiled[k]], profiles[k]);
  answer.cost = end.cost;
  answer.ended = end.ended;
  // Less than a tenth of a standard error to go, nothing that the tolerance would have seen, or what a rough cost
  // leaves: then the standard errors hold it.
  constexpr double rough = 1e-8;
  answer.converged = in.remaining < 0.1 || in.remaining_cost <= course.options.tolerance * end.cost ||
                     (end.at_rest && model.noise() > rough && in.remaining < 1);
  answer.remaining_standard_errors = in.remaining;
  answer.confidence = confidence;
  answer.degrees_of_freedom = in.freedom;
  answer.residual_variance = in.residual_variance;
  answer.error_scale = in.scale;
  answer.probability_of_residuals = in.unexplained;
  answer.noise = model.noise();
  answer.tolerance = course.options.tolerance;
  answer.points_asked = static_cast<std::int64_t>(model.points());
  for (std::size_t a = 0; a < parameters.size(); ++a)
    for (std::size_t b = 0; b < parameters.size(); ++b)
      answer.correlation[parameters[a].path][parameters[b].path] =
          in.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  answer.eigenvalues = in.eigenvalues;
  answer.weakest = weakest_direction(model, end, in);
  answer.screened = static_cast<std::int64_t>(course.screened);
  for (const FitResult& f : course.fits) answer.fits.push_back(fit_answer(model, f));
  answer.fits.push_back(fit_answer(model, course.end));
  answer.best_fit = static_cast<std::int64_t>(course.best);
  return answer;
}

}  // namespace beltlife
