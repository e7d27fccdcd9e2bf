// The course of a calibration and its answer for people; see calibration.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/calibration.h"
#include "calibrate/calibration_answer.h"
#include "calibrate/pictures.h"
#include "results/text/table.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

/// Amplitude errors of the highest order of each measurement. The thesis reports 10 % at idle and 15 % elsewhere.
std::vector<MainFrequency> main_frequencies(const std::vector<Measurement>& measurements,
                                            const std::vector<ResidualAnswer>& residuals) {
  std::vector<MainFrequency> rows;
  for (const Measurement& m : measurements) {
    const std::string prefix = m.spec.range + "." + m.spec.channel + ".order_";
    const ResidualAnswer* main = nullptr;
    for (const ResidualAnswer& r : residuals)
      if (r.quantity.starts_with(prefix) && (!main || r.measured > main->measured)) main = &r;
    if (!main) continue;
    const double order = std::stod(main->quantity.substr(prefix.size()));
    rows.push_back({m.spec.range, m.spec.channel, order, order * m.crank_rpm / 60, main->measured, main->start,
                    main->calibrated, main->start_error, main->calibrated_error, m.spec.range == "idle" ? 0.10 : 0.15});
  }
  return rows;
}

/// Of the fits of a few iterations: how many led to the lowest cost.
std::string agreement_words(const CalibrationAnswer& answer) {
  std::size_t agreeing = 0, ended = 0;
  const double best = answer.fits[static_cast<std::size_t>(answer.best_fit)].cost;
  for (std::size_t k = 0; k + 1 < answer.fits.size(); ++k) {
    const FitAnswer& f = answer.fits[k];
    ended += f.ok;
    agreeing += f.ok && f.cost <= best * 1.05 + 1e-300;
  }
  if (ended < 2) return "";
  return fmt::format("{} of {} fits, of a few iterations each, led within 5 % of the lowest cost; the best went on.",
                     agreeing, ended);
}

/// What somebody who is to use the values should know first.
std::vector<std::string> remarks(const CalibrationAnswer& answer) {
  std::vector<std::string> words;
  const double left = answer.remaining_standard_errors;
  if (!answer.converged)
    words.push_back(
        fmt::format("Not converged: the minimum is some {:.2g} standard errors away. More iterations, a larger "
                    "budget, or another start.",
                    left));
  else if (left > 0.1)
    words.push_back(
        fmt::format("The cost is rough: the fit is at rest {:.2g} standard errors from where its slope says the "
                    "minimum is; the errors stated hold that.",
                    left));
  for (const auto& [name, p] : answer.parameters) {
    if (p.at_bound != "no")
      words.push_back(fmt::format("{} ended on its {} bound and would go beyond.", name, p.at_bound));
    if (p.identified == "no") words.push_back(fmt::format("The data say nothing about {}.", name));
    if (p.identified == "confounded")
      words.push_back(fmt::format("{} cannot be told apart from the others by these data.", name));
  }
  if (answer.probability_of_residuals < 1e-3)
    words.push_back(
        fmt::format("The model does not reach the data: residuals are {:.1f} times the stated deviations, more "
                    "than chance allows. Either these are too small, or the model lacks something, or a bound "
                    "is in the way.",
                    std::sqrt(answer.residual_variance)));
  if (std::string agreement = agreement_words(answer); !agreement.empty()) words.push_back(std::move(agreement));
  return words;
}

std::string number(double v, int digits = 4) { return std::isfinite(v) ? fmt::format("{:.{}g}", v, digits) : "-"; }
std::string percent(double v) { return std::isfinite(v) ? fmt::format("{:+.1f}", 100 * v) : "-"; }

std::string main_table(const std::vector<MainFrequency>& rows) {
  if (rows.empty()) return "";
  Table table({"range", "channel", "order", "Hz", "measured", "start", "calibrated", "error: start", "calibrated",
               "thesis within"});
  for (const MainFrequency& r : rows)
    table.row({r.range, r.channel, number(r.order), number(r.hz), number(r.measured), number(r.start),
               number(r.calibrated), percent(r.start_error), percent(r.calibrated_error),
               fmt::format("{:.0f}", 100 * r.thesis_error)});
  return "\nAmplitude at the main frequency of each range; error in per cent of the measured\n\n" + table.text();
}

std::string worst_table(std::vector<ResidualAnswer> worst) {
  std::stable_sort(worst.begin(), worst.end(), [](const ResidualAnswer& a, const ResidualAnswer& b) {
    return std::abs(a.residual) > std::abs(b.residual);
  });
  if (worst.size() > 5) worst.resize(5);
  Table table({"quantity", "unit", "measured", "calibrated", "residual"});
  for (const ResidualAnswer& r : worst)
    table.row({r.quantity, unit_of_name(r.quantity), number(r.measured), number(r.calibrated), number(r.residual, 3)});
  return "\nThe largest residuals, in stated standard deviations\n\n" + table.text();
}

}  // namespace

CalibrationAnswer Calibration::solve(StudyRun& run) const {
  FitProblem problem;
  problem.parameters = problem_.spec.parameter;
  problem.targets = targets_;
  problem.evaluate = [&](const std::vector<Point>& points, const std::string& what) {
    return run.evaluate(points, what);
  };
  problem.together = problem_.scene.has_value();
  FitModel model(std::move(problem));
  const FitCourse course = fit_many(model, settings_);
  const FitResult& end = course.end;
  if (!end.ok) {
    CalibrationAnswer answer;
    answer.error = "no fit: " + course.fits[0].ended;
    return answer;
  }
  const Inference inference = infer(model, end, settings_.confidence, settings_.loss_scale,
                                    std::any_of(measurements_.begin(), measurements_.end(),
                                                [](const Measurement& m) { return m.spec.model_error > 0; }));
  std::vector<std::size_t> profiled;
  constexpr std::size_t most_profiled = 6;
  if (settings_.profiles && problem_.spec.parameter.size() <= most_profiled)
    for (std::size_t i = 0; i < problem_.spec.parameter.size(); ++i)
      if (std::isfinite(inference.standard_error[i])) profiled.push_back(i);
  const auto lines = profiles(model, end, inference, profiled, settings_.loss_scale);

  CalibrationAnswer answer = answer_of(model, course, inference, profiled, lines, settings_.confidence);
  std::vector<double> first;
  for (const Coordinate& c : model.coordinates()) first.push_back(c.start());
  const std::vector<Point> ends{point_at(model.coordinates(), first), point_at(model.coordinates(), end.u)};
  const auto answers = run.evaluate(ends, "ends");
  answer.residuals = residuals_of(model.problem().targets, answers[0], answers[1]);
  if (const auto first_residuals = model.residuals_at({first}, "ends")[0]; first_residuals.size() > 0)
    answer.start_cost = cost_of(first_residuals, model.problem().targets, settings_.loss_scale);
  answer.main_frequencies = main_frequencies(measurements_, answer.residuals);
  answer.remarks = remarks(answer);
  if (problem_.scene) answer.pictures = pictures_of(problem_, measurements_, ends[0], ends[1], run.threads());
  return answer;
}

std::string Calibration::text(const CalibrationAnswer& answer) {
  if (answer.error) return *answer.error + "\n";
  std::string words = fmt::format(
      "Cost {} from {} after {} points ({} failed); intervals of {:g} % (Student's t, {:g} degrees of freedom, "
      "residual\n"
      "variance {}).\n\n",
      number(answer.cost), number(answer.start_cost), answer.evaluations, answer.failed, 100 * answer.confidence,
      answer.degrees_of_freedom, number(answer.residual_variance, 3));
  Table values({"parameter", "start", "value", "+-", "low", "high", "profile", "identified", "on a bound"});
  for (const auto& [name, p] : answer.parameters)
    values.row({name, number(p.start), number(p.value, 5), number(p.standard_error, 2), number(p.low), number(p.high),
                p.profile ? number(p.profile->low, 3) + " .. " + number(p.profile->high, 3) : "-", p.identified,
                p.at_bound});
  words += values.text() + "\n";
  for (const std::string& remark : answer.remarks) words += remark + "\n";
  if (answer.weakest.value) words += answer.weakest.value->words + "\n";
  return words + main_table(answer.main_frequencies) + worst_table(answer.residuals);
}

}  // namespace beltlife
