// Parts of the answer: see layout_answer.h.
#include "optimize/layout_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

using nlohmann::json;

std::optional<double> value_of(const DesignProblem& design, const std::vector<double>& values,
                               const std::string& name) {
  const auto& names = design.problem().spec.quantities;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end() || values.empty()) return std::nullopt;
  return values[static_cast<std::size_t>(at - names.begin())];
}

json active_line(const char* kind, const std::string& name, double left, const std::string& unit) {
  return {{"kind", kind}, {"name", name}, {"left", left}, {"unit", unit}};
}

}  // namespace

json json_of(const MeanOf& m) {
  const auto or_null = [](std::optional<double> v) { return v ? json(*v) : json(); };
  return {{"mean", m.mean},
          {"standard_deviation", or_null(m.deviation)},
          {"low", or_null(m.low)},
          {"high", or_null(m.high)}};
}

std::vector<std::string> violated(const DesignRuns& runs, const Candidate& c, const Outcome& outcome) {
  std::vector<std::string> words;
  for (const Clearance& limit : runs.design().limits(c))
    if (limit.value < 0) words.push_back(limit.words);
  if (!outcome.ok()) return words;
  for (std::size_t i = 0; i < runs.bounds().size(); ++i) {
    const BoundLine& b = runs.bounds()[i];
    if (outcome.constraints[i] >= 0) continue;
    const double value = b.upper ? b.bound - outcome.constraints[i] : b.bound + outcome.constraints[i];
    words.push_back(fmt::format("{} is {:.5g}, {} {:g}", b.name, value, b.upper ? "above" : "below", b.bound));
  }
  for (const Clearance& limit : runs.design().running_limits(c))
    if (limit.value < 0) words.push_back(limit.words);
  return words;
}

json json_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome) {
  const DesignProblem& design = runs.design();
  json j;
  const auto& parameters = design.problem().spec.parameter;
  const std::vector<double> values = design.values(c.x);
  for (std::size_t i = 0; i < values.size(); ++i) j["parameters"][parameters[i].path] = values[i];
  const auto& choices = design.spec().choice;
  for (std::size_t i = 0; i < choices.size(); ++i) j["choices"][choices[i].path] = design.choices(c.combination)[i];
  j["feasible"] = runs.feasible(c, outcome);
  j["point"] = runs.number_of(outcome.point);
  if (const auto words = violated(runs, c, outcome); !words.empty()) j["violated"] = words;
  j["quantities"] = nullptr;
  j["objective"] = nullptr;
  if (!outcome.ok()) {
    j["state"] = to_string(outcome.state);
    j["reason"] = outcome.reason;
    return j;
  }
  for (std::size_t q = 0; q < outcome.values.size(); ++q)
    j["quantities"][design.problem().spec.quantities[q]] = outcome.values[q];
  j["objective"] = outcome.objective;
  return j;
}

json active_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome) {
  constexpr double near_mm_or_deg = 1, near_share = 0.05, near_bound = 0.01;
  const DesignProblem& design = runs.design();
  json lines = json::array();
  const auto limit_lines = [&](const std::vector<Clearance>& limits) {
    for (const Clearance& limit : limits) {
      if (limit.name == "arm at rest") continue;  // 0 wherever it is kept
      const bool length = limit.unit == "mm" || limit.unit == "deg";
      const double near = length ? near_mm_or_deg : near_share * design.scale_of(limit);
      if (limit.value < near) lines.push_back(active_line("limit", limit.name, limit.value, limit.unit));
    }
  };
  limit_lines(design.limits(c));
  for (std::size_t i = 0; i < runs.bounds().size() && outcome.ok(); ++i) {
    const BoundLine& b = runs.bounds()[i];
    const double near = near_share * (b.bound == 0 ? b.scale : std::abs(b.bound));
    if (outcome.constraints[i] < near)
      lines.push_back(active_line("constraint", b.name, outcome.constraints[i], unit_of_name(b.quantity)));
  }
  limit_lines(design.running_limits(c));
  const auto& parameters = design.problem().spec.parameter;
  const std::vector<double> values = design.values(c.x);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool low = c.x[i] < near_bound;
    if (!low && c.x[i] <= 1 - near_bound) continue;
    const double left = low ? values[i] - *parameters[i].lower : *parameters[i].upper - values[i];
    lines.push_back(
        active_line(low ? "lower bound" : "upper bound", parameters[i].path, left, unit_of_name(parameters[i].path)));
  }
  return lines;
}

json governing_of(const DesignProblem& design, const std::vector<double>& values) {
  if (!design.has_layout()) return nullptr;
  const SceneSpec& scene = design.problem().scene->file.scene;
  std::vector<double> of_pulley(scene.pulley.size(), 0);
  double all = 0, most_of_range = -1;
  std::string worst_range;
  double shares = 0;
  for (const RangeSpec& range : scene.range)
    if (value_of(design, values, range.name + ".log10_life_h")) shares += range.duty_share;
  for (const RangeSpec& range : scene.range) {
    const auto life = value_of(design, values, range.name + ".log10_life_h");
    if (!life) continue;
    std::vector<double> part;
    double sum = 0;
    for (const PulleySpec& p : scene.pulley) {
      const auto m = value_of(design, values, range.name + ".pulley." + p.name + ".sigma_m_mpa");
      const auto a = value_of(design, values, range.name + ".pulley." + p.name + ".sigma_a_mpa");
      if (!m || !a) return nullptr;
      part.push_back(std::pow(*a / (scene.fatigue.strength_mpa - *m), -1 / scene.fatigue.exponent));
      sum += part.back();
    }
    const double damage = (shares > 0 ? range.duty_share : 1) / std::pow(10, *life);
    all += damage;
    for (std::size_t i = 0; i < part.size() && sum > 0; ++i) of_pulley[i] += damage * part[i] / sum;
    if (damage > most_of_range) {
      most_of_range = damage;
      worst_range = range.name;
    }
  }
  if (!(all > 0)) return nullptr;
  const auto worst = static_cast<std::size_t>(std::max_element(of_pulley.begin(), of_pulley.end()) - of_pulley.begin());
  return {{"range", worst_range},
          {"range_share", most_of_range / all},
          {"pulley", scene.pulley[worst].name},
          {"pulley_share", of_pulley[worst] / all}};
}

json lives_of(const DesignProblem& design, const std::vector<Outcome>& replicates) {
  if (!design.has_layout()) return nullptr;
  json lives;
  for (const RangeSpec& range : design.problem().scene->file.scene.range) {
    std::vector<double> all;
    for (const Outcome& o : replicates)
      if (const auto life = value_of(design, o.values, range.name + ".log10_life_h")) all.push_back(*life);
    if (!all.empty()) lives[range.name] = json_of(mean_of(all));
  }
  return lives;
}

}  // namespace beltlife
