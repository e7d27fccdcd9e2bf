// The answer, with what it means in words: see calibration_answer.h.
#include "calibrate/calibration_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/text/print.h"

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

nlohmann::json parameter_json(const FitModel& model, const FitResult& end, const Inference& in, std::size_t i) {
  const ParameterSpec& spec = model.problem().parameters[i];
  const Coordinate& c = model.coordinates()[i];
  const double u = end.u[i], half = in.quantile * in.standard_error[i];
  nlohmann::json j{{"value", c.value(u)},
                   {"standard_error", finite(c.slope(u) * in.standard_error[i])},
                   {"low", finite(c.value(std::max(u - half, c.lower())))},
                   {"high", finite(c.value(std::min(u + half, c.upper())))},
                   {"start", *spec.start},
                   {"at_bound", in.at_bound[i] < 0   ? "lower"
                                : in.at_bound[i] > 0 ? "upper"
                                                     : "no"}};
  if (spec.lower) j["lower"] = *spec.lower;
  if (spec.upper) j["upper"] = *spec.upper;
  switch (known(model, end, in, i)) {
    case Known::settled:
      j["identified"] = "yes";
      break;
    case Known::confounded:
      j["identified"] = "confounded";
      break;
    case Known::silent:
      j["identified"] = "no";
      break;
  }
  return j;
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

nlohmann::json weakest_json(const FitModel& model, const FitResult& end, const Inference& in) {
  if (in.eigenvalues.empty()) return nullptr;
  nlohmann::json j{{"eigenvalue", in.eigenvalues.front()}};
  std::string names;
  int count = 0;
  for (std::size_t i = 0; i < end.u.size(); ++i) {
    const double share = in.share(static_cast<Eigen::Index>(i));
    j["direction"][model.problem().parameters[i].path] = share;
    if (std::abs(share) < 0.3) continue;
    names += (count++ > 0 ? ", " : "") + model.problem().parameters[i].path;
  }
  if (count < 2 || in.eigenvalues.front() > 0.5) {
    j["words"] = "No two parameters stand in for each other in these data.";
    return j;
  }
  j["words"] = fmt::format(
      "{} trade off: {} together costs no more than one residual's variance. Data in which they act differently would "
      "separate them: another range, amplitude or channel.",
      names, moves_of(model, end, in, 0.3));
  return j;
}

}  // namespace

nlohmann::json residuals_of(const std::vector<Target>& targets, const Answer& start, const Answer& end) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Target& t : targets) {
    const double before = start.ok() ? start.values[t.column] : std::nan(""), after = end.values[t.column];
    rows.push_back({{"quantity", t.quantity},
                    {"measured", t.value},
                    {"start", finite(before)},
                    {"calibrated", after},
                    {"start_error", finite(before / t.value - 1)},
                    {"calibrated_error", finite(after / t.value - 1)},
                    {"sigma", t.sigma},
                    {"model_noise", t.model_noise},
                    {"logarithm", t.logarithm},
                    {"residual", t.residual(after)}});
  }
  return rows;
}

nlohmann::json answer_of(const FitModel& model, const FitCourse& course, const Inference& in,
                         const std::vector<std::size_t>& profiled, const std::vector<Profile>& profiles,
                         double confidence) {
  const FitResult& end = course.end;
  const auto& parameters = model.problem().parameters;
  nlohmann::json j;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    j["parameters"][parameters[i].path] = parameter_json(model, end, in, i);
  for (std::size_t k = 0; k < profiled.size(); ++k) {
    const Coordinate& c = model.coordinates()[profiled[k]];
    nlohmann::json& p = j["parameters"][parameters[profiled[k]].path]["profile"];
    p["low"] = std::isnan(profiles[k].low) ? nlohmann::json() : nlohmann::json(c.value(profiles[k].low));
    p["high"] = std::isnan(profiles[k].high) ? nlohmann::json() : nlohmann::json(c.value(profiles[k].high));
    for (const double u : profiles[k].u) p["value"].push_back(c.value(u));
    p["cost"] = profiles[k].cost;
  }
  j["cost"] = end.cost;
  j["ended"] = end.ended;
  // Less than a tenth of a standard error to go, nothing that the tolerance would have seen, or what a rough cost
  // leaves: then the standard errors hold it.
  constexpr double rough = 1e-8;
  j["converged"] = in.remaining < 0.1 || in.remaining_cost <= course.options.tolerance * end.cost ||
                   (end.at_rest && model.noise() > rough && in.remaining < 1);
  j["remaining_standard_errors"] = in.remaining;
  j["confidence"] = confidence;
  j["degrees_of_freedom"] = in.freedom;
  j["residual_variance"] = in.residual_variance;
  j["error_scale"] = in.scale;
  j["probability_of_residuals"] = in.unexplained;
  j["noise"] = model.noise();
  j["tolerance"] = course.options.tolerance;
  j["points_asked"] = model.points();
  for (std::size_t a = 0; a < parameters.size(); ++a)
    for (std::size_t b = 0; b < parameters.size(); ++b)
      j["correlation"][parameters[a].path][parameters[b].path] =
          in.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  j["eigenvalues"] = in.eigenvalues;
  j["weakest"] = weakest_json(model, end, in);
  j["screened"] = course.screened;
  std::vector<FitResult> all = course.fits;
  all.push_back(course.end);
  for (const FitResult& f : all) {
    nlohmann::json row{
        {"ok", f.ok}, {"ended", f.ended}, {"start_cost", f.start_cost}, {"cost", finite(f.ok ? f.cost : std::nan(""))}};
    for (std::size_t i = 0; i < parameters.size(); ++i)
      row["parameters"][parameters[i].path] = model.coordinates()[i].value(f.u[i]);
    for (const CostStep& s : f.steps) {
      row["points"].push_back(s.points);
      row["costs"].push_back(s.cost);
    }
    j["fits"].push_back(std::move(row));
  }
  j["best_fit"] = course.best;
  return j;
}

}  // namespace beltlife
