// From noise to the best fit: see fit_many.h.
#include "calibrate/fit_many.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/spread.h"

namespace beltlife {
namespace {

/// Largest distance of two points in one coordinate, of the width between its bounds.
double distance(const FitModel& model, const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / model.coordinates()[i].width());
  return largest;
}

/// The best of the spread, each at least `apart` from those before it.
std::vector<std::vector<double>> starts_of(FitModel& model, const CalibrationSettings& settings, FitCourse& course) {
  constexpr double apart = 0.15;
  const auto& coordinates = model.coordinates();
  std::vector<double> first;
  for (const Coordinate& c : coordinates) first.push_back(c.start());
  std::vector<std::vector<double>> starts{first};
  const bool boxed =
      std::all_of(coordinates.begin(), coordinates.end(), [](const Coordinate& c) { return c.bounded(); });
  if (settings.starts < 2 || settings.screen < 1 || !boxed) return starts;

  auto points = spread(static_cast<std::size_t>(settings.screen), coordinates.size());
  for (auto& u : points)
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = coordinates[i].lower() + u[i] * coordinates[i].width();
  const auto residuals = model.residuals_at(points, "screening");
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (residuals[k].size() > 0)
      order.emplace_back(cost_of(residuals[k], model.problem().targets, settings.loss_scale), k);
  course.screened = points.size();
  course.screened_ok = order.size();
  std::sort(order.begin(), order.end());
  for (const auto& [cost, k] : order) {
    if (starts.size() >= static_cast<std::size_t>(settings.starts)) break;
    if (std::all_of(starts.begin(), starts.end(),
                    [&, k = k](const auto& s) { return distance(model, s, points[k]) > apart; }))
      starts.push_back(points[k]);
  }
  return starts;
}

}  // namespace

FitCourse fit_many(FitModel& model, const CalibrationSettings& settings) {
  FitCourse course;
  const auto starts = starts_of(model, settings, course);
  const auto settle = [&](const std::vector<double>& u) {
    if (settings.noise)
      model.set_noise(*settings.noise);
    else
      model.measure_noise(u);
    // Changes of the cost that the noise makes by itself say nothing, nor those that move the end by a third of a
    // standard error.
    const double freedom =
        std::max(1.0, static_cast<double>(model.problem().targets.size()) - static_cast<double>(u.size()));
    course.options.tolerance = settings.tolerance.value_or(std::clamp(100 * model.noise(), 1e-14, 0.05 / freedom));
  };
  course.options.iterations = settings.iterations;
  course.options.budget = static_cast<std::size_t>(settings.budget);
  course.options.loss_scale = settings.loss_scale;
  settle(starts.front());
  // Of several, a few iterations show which leads to the lowest cost; that one goes on.
  constexpr int heat = 8;
  FitOptions first = course.options;
  if (starts.size() > 1) first.iterations = std::min(first.iterations, heat);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    course.fits.push_back(fit(model, starts[k], Differences::one_sided, false, first,
                              starts.size() == 1 ? "fit" : fmt::format("fit {} of {}", k + 1, starts.size())));
    const FitResult &now = course.fits.back(), &best = course.fits[course.best];
    if (now.ok && (!best.ok || now.cost < best.cost)) course.best = k;
  }
  if (!course.fits[course.best].ok) return course;
  settle(course.fits[course.best].u);
  course.end = fit(model, course.fits[course.best].u, Differences::central, true, course.options, "end");
  return course;
}

}  // namespace beltlife
