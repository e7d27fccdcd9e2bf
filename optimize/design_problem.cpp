// Designs and what they stand for: see design_problem.h.
#include "optimize/design_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/scene/spec_path.h"

namespace beltlife {
namespace {

double in_unit(const ParameterSpec& p, double value) {
  const double low = *p.lower, high = *p.upper;
  const double x = p.log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(x, 0.0, 1.0);
}

double from_unit(const ParameterSpec& p, double x) {
  const double low = *p.lower, high = *p.upper;
  return std::clamp(p.log ? low * std::pow(high / low, x) : low + x * (high - low), low, high);
}

/// All combinations, the first list slowest.
std::vector<std::vector<std::string>> products(const std::vector<ChoiceSpec>& choices) {
  std::vector<std::vector<std::string>> all{{}};
  for (const ChoiceSpec& choice : choices) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& begun : all)
      for (const std::string& value : choice.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

SceneSpec with_choices(SceneSpec scene, const std::vector<ChoiceSpec>& choices,
                       const std::vector<std::string>& values) {
  for (std::size_t i = 0; i < choices.size(); ++i) set_field(scene, choices[i].path + "=" + values[i]);
  return scene;
}

double* place_of(SceneSpec& scene, const std::string& path) {
  double* place = nullptr;
  at_path(scene, path, [&]<class T>(T& value, const Rule&, const std::string&) {
    if constexpr (std::same_as<T, double>) place = &value;
    if constexpr (std::same_as<T, std::optional<double>>) {
      if (value) place = &*value;
    }
  });
  return place;
}

}  // namespace

double apart(const Candidate& a, const Candidate& b) {
  if (a.combination != b.combination) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < a.x.size(); ++i) sum += (a.x[i] - b.x[i]) * (a.x[i] - b.x[i]);
  return std::sqrt(sum / static_cast<double>(a.x.size()));
}

DesignProblem::DesignProblem(const LoadedProblem& problem, const OptimizationSpec& spec)
    : problem_(problem),
      spec_(spec),
      free_limits_(spec.layout ? spec.layout->limits : LayoutLimitsSpec{}),
      parameters_(problem.spec.parameter),
      combinations_(products(spec.choice)) {
  free_limits_.travel_deg.reset();
  free_limits_.min_slip_safety.reset();
  free_limits_.max_hub_load_n.reset();
  free_limits_.modes.reset();
  for (const ParameterSpec& p : parameters_) start_x_.push_back(in_unit(p, *p.start));
  if (!problem_.scene) return;
  const SceneSpec& base = problem_.scene->file.scene;
  const std::string own = write_scene(base);
  const auto first = std::find_if(combinations_.begin(), combinations_.end(), [&](const auto& values) {
    return write_scene(with_choices(base, spec_.choice, values)) == own;
  });
  if (first != combinations_.end()) std::rotate(combinations_.begin(), first, first + 1);
  for (const auto& values : combinations_) {
    auto piece = std::make_unique<Workpiece>(Workpiece{with_choices(base, spec_.choice, values), {}});
    for (const ParameterSpec& p : parameters_) piece->places.push_back(place_of(piece->scene, p.path));
    workpieces_.push_back(std::move(piece));
  }
}

Candidate DesignProblem::start() const { return {0, start_x_}; }

std::vector<double> DesignProblem::values(const Design& x) const {
  std::vector<double> v;
  for (std::size_t i = 0; i < x.size(); ++i)
    v.push_back(x[i] == start_x_[i] ? *parameters_[i].start : from_unit(parameters_[i], x[i]));
  return v;
}

std::vector<std::string> DesignProblem::columns() const {
  std::vector<std::string> names;
  if (problem_.scene) names.emplace_back(settings_column);
  for (const ChoiceSpec& c : spec_.choice) names.push_back(c.path);
  for (const ParameterSpec& p : parameters_) names.push_back(p.path);
  return names;
}

Point DesignProblem::point(const Candidate& c, const std::string& settings) const {
  Point p;
  if (problem_.scene) p.emplace_back(settings);
  for (const std::string& value : combinations_[c.combination]) p.emplace_back(value);
  for (const double v : values(c.x)) p.emplace_back(v);
  return p;
}

const SceneSpec& DesignProblem::placed(const Candidate& c) const {
  Workpiece& piece = *workpieces_[c.combination];
  const std::vector<double> v = values(c.x);
  for (std::size_t i = 0; i < v.size(); ++i)
    if (piece.places[i])
      *piece.places[i] = v[i];
    else
      set_number(piece.scene, parameters_[i].path, v[i]);
  return piece.scene;
}

SceneSpec DesignProblem::scene(const Candidate& c) const { return placed(c); }

std::vector<LayoutLimit> DesignProblem::limits(const Candidate& c) const {
  if (!problem_.scene) return {};
  return layout_limits(placed(c), free_limits_);
}

std::vector<LayoutLimit> DesignProblem::running_limits(const Candidate& c) const {
  if (!problem_.scene || !spec_.layout || !spec_.layout->limits.of_running()) return {};
  const SceneSpec& scene = placed(c);
  const std::size_t free = layout_limits(scene, free_limits_).size();
  std::vector<LayoutLimit> all = layout_limits(scene, spec_.layout->limits, RunningDetail::with_bending_loss);
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(free));  // they come last
  return all;
}

double DesignProblem::scale_of(const LayoutLimit& limit) const {
  constexpr double much_mm = 20, much_deg = 20, much_percent = 20;
  if (limit.unit == "mm") return much_mm;
  if (limit.unit == "deg") return much_deg;
  if (limit.unit == "%") return much_percent;
  if (limit.unit == "N") return *spec_.layout->limits.max_hub_load_n;
  return 1;
}

std::vector<double> DesignProblem::geometry(const Candidate& c) const {
  std::vector<double> scaled;
  for (const LayoutLimit& limit : limits(c)) scaled.push_back(limit.value / scale_of(limit));
  return scaled;
}

}  // namespace beltlife
