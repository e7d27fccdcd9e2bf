// Parts of the answer: see layout_answer.h.
#include "optimize/layout_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

std::optional<double> value_of(const DesignProblem& design, const std::vector<double>& values,
                               const std::string& name) {
  const auto& names = design.problem().spec.quantities;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end() || values.empty()) return std::nullopt;
  return values[static_cast<std::size_t>(at - names.begin())];
}

/// Takes whatever is recorded of the designs' lives and stresses.
struct Damage {
  std::vector<double> of_pulley;
  double all = 0, of_worst_range = -1;
  std::string worst_range;
};

/// Shares of the pulleys in the damage of one range, by Basquin's rule; empty where a stress is not recorded.
std::vector<double> pulley_damage(const DesignProblem& design, const std::vector<double>& values,
                                  const RangeSpec& range) {
  const SceneSpec& scene = design.problem().scene->file.scene;
  std::vector<double> part;
  for (const PulleySpec& p : scene.pulley) {
    const auto m = value_of(design, values, range.name + ".pulley." + p.name + ".sigma_m_mpa");
    const auto a = value_of(design, values, range.name + ".pulley." + p.name + ".sigma_a_mpa");
    if (!m || !a) return {};
    part.push_back(std::pow(*a / (scene.fatigue.strength_mpa - *m), -1 / scene.fatigue.exponent));
  }
  return part;
}

}  // namespace

ReplicateMean answer_of(const MeanOf& m) {
  return {m.mean, m.deviation.value_or(not_known), m.low.value_or(not_known), m.high.value_or(not_known)};
}

std::vector<std::string> violated(const DesignRuns& runs, const Candidate& c, const Outcome& outcome) {
  std::vector<std::string> words;
  for (const LayoutLimit& limit : runs.design().limits(c))
    if (limit.value < 0) words.push_back(limit.words);
  if (!outcome.ok()) return words;
  for (std::size_t i = 0; i < runs.bounds().size(); ++i) {
    const BoundLine& b = runs.bounds()[i];
    if (outcome.constraints[i] >= 0) continue;
    const double value = b.upper ? b.bound - outcome.constraints[i] : b.bound + outcome.constraints[i];
    words.push_back(fmt::format("{} is {:.5g}, {} {:g}", b.name, value, b.upper ? "above" : "below", b.bound));
  }
  for (const LayoutLimit& limit : runs.design().running_limits(c))
    if (limit.value < 0) words.push_back(limit.words);
  return words;
}

DesignAnswer answer_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome) {
  const DesignProblem& design = runs.design();
  DesignAnswer answer;
  const auto& parameters = design.problem().spec.parameter;
  const std::vector<double> values = design.values(c.x);
  for (std::size_t i = 0; i < values.size(); ++i) answer.parameters[parameters[i].path] = values[i];
  const auto& choices = design.spec().choice;
  if (!choices.empty()) answer.choices.emplace();
  for (std::size_t i = 0; i < choices.size(); ++i)
    (*answer.choices)[choices[i].path] = design.choices(c.combination)[i];
  answer.feasible = runs.feasible(c, outcome);
  answer.point = static_cast<std::int64_t>(runs.number_of(outcome.point));
  if (auto words = violated(runs, c, outcome); !words.empty()) answer.violated = std::move(words);
  if (!outcome.ok()) {
    answer.state = to_string(outcome.state);
    answer.reason = outcome.reason;
    return answer;
  }
  answer.quantities.value.emplace();
  for (std::size_t q = 0; q < outcome.values.size(); ++q)
    (*answer.quantities.value)[design.problem().spec.quantities[q]] = outcome.values[q];
  answer.objective = outcome.objective;
  return answer;
}

std::vector<ActiveLimit> active_limits(const DesignProblem& design, const std::vector<BoundLine>& bounds,
                                       const Candidate& c, const Outcome& outcome) {
  constexpr double near_mm_or_deg = 1, near_share = 0.05, near_bound = 0.01;
  std::vector<ActiveLimit> lines;
  const auto limit_lines = [&](const std::vector<LayoutLimit>& limits) {
    for (const LayoutLimit& limit : limits) {
      if (limit.name == "arm at rest") continue;  // 0 wherever it is kept
      const bool length = limit.unit == "mm" || limit.unit == "deg";
      const double near = length ? near_mm_or_deg : near_share * design.scale_of(limit);
      if (limit.value < near)
        lines.push_back({"limit", limit.name, limit.measured(), limit.bound, limit.at_most, limit.value, limit.unit});
    }
  };
  limit_lines(design.limits(c));
  for (std::size_t i = 0; i < bounds.size() && outcome.ok(); ++i) {
    const BoundLine& b = bounds[i];
    const double near = near_share * (b.bound == 0 ? b.scale : std::abs(b.bound)), left = outcome.constraints[i];
    if (left < near)
      lines.push_back({"constraint", b.name, b.upper ? b.bound - left : b.bound + left, b.bound, b.upper, left,
                       unit_of_name(b.quantity)});
  }
  limit_lines(design.running_limits(c));
  const auto& parameters = design.problem().spec.parameter;
  const std::vector<double> values = design.values(c.x);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool low = c.x[i] < near_bound;
    if (!low && c.x[i] <= 1 - near_bound) continue;
    const double bound = low ? *parameters[i].lower : *parameters[i].upper;
    lines.push_back({low ? "lower bound" : "upper bound", parameters[i].path, values[i], bound, !low,
                     low ? values[i] - bound : bound - values[i], unit_of_name(parameters[i].path)});
  }
  return lines;
}

OrNull<GoverningPart> governing_of(const DesignProblem& design, const std::vector<double>& values) {
  if (!design.has_layout()) return {};
  const SceneSpec& scene = design.problem().scene->file.scene;
  Damage damage{std::vector<double>(scene.pulley.size(), 0)};
  double shares = 0;
  for (const RangeSpec& range : scene.range)
    if (value_of(design, values, range.name + ".log10_life_h")) shares += range.duty_share;
  for (const RangeSpec& range : scene.range) {
    const auto life = value_of(design, values, range.name + ".log10_life_h");
    if (!life) continue;
    const std::vector<double> part = pulley_damage(design, values, range);
    if (part.empty()) return {};
    double sum = 0;
    for (const double p : part) sum += p;
    const double of_range = (shares > 0 ? range.duty_share : 1) / std::pow(10, *life);
    damage.all += of_range;
    for (std::size_t i = 0; i < part.size() && sum > 0; ++i) damage.of_pulley[i] += of_range * part[i] / sum;
    if (of_range > damage.of_worst_range) {
      damage.of_worst_range = of_range;
      damage.worst_range = range.name;
    }
  }
  if (!(damage.all > 0)) return {};
  const auto worst = std::max_element(damage.of_pulley.begin(), damage.of_pulley.end());
  return {GoverningPart{damage.worst_range,
                        scene.pulley[static_cast<std::size_t>(worst - damage.of_pulley.begin())].name,
                        damage.of_worst_range / damage.all, *worst / damage.all}};
}

OrNull<RangeLives> lives_of(const DesignProblem& design, const std::vector<Outcome>& replicates) {
  if (!design.has_layout()) return {};
  RangeLives lives;
  for (const RangeSpec& range : design.problem().scene->file.scene.range) {
    std::vector<double> all;
    for (const Outcome& o : replicates)
      if (const auto life = value_of(design, o.values, range.name + ".log10_life_h")) all.push_back(*life);
    if (!all.empty()) lives[range.name] = answer_of(mean_of(all));
  }
  if (lives.empty()) return {};
  return {std::move(lives)};
}

}  // namespace beltlife
