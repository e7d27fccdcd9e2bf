// The answer of an optimisation for people; see layout_search.h.
#include <fmt/format.h>

#include <cmath>

#include "optimize/layout_search.h"
#include "results/text/table.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

std::string number(double v, int digits = 5) { return std::isfinite(v) ? fmt::format("{:.{}g}", v, digits) : "-"; }

/// "3.21 +- 0.02" with half the interval, or the mean alone.
std::string with_interval(const ReplicateMean& m) {
  if (!std::isfinite(m.low)) return number(m.mean);
  return fmt::format("{:.5g} +- {:.2g}", m.mean, 0.5 * (m.high - m.low));
}

std::string in_unit(const std::string& name) {
  const std::string unit = unit_of_name(name);
  return unit.empty() ? "" : " " + unit;
}

std::string parameter_table(const SearchAnswer& answer) {
  Table table({"parameter", "unit", "start", "best", "change"});
  if (answer.best->choices)
    for (const auto& [path, value] : *answer.best->choices) {
      const std::string& from = answer.start.choices->at(path);
      table.row({path, "", from, value, from == value ? "" : "changed"});
    }
  for (const auto& [path, to] : answer.best->parameters) {
    const double from = answer.start.parameters.at(path);
    table.row({path, unit_of_name(path), fmt::format("{:.6g}", from), fmt::format("{:.6g}", to),
               from == to ? "0" : fmt::format("{:+.4g}", to - from)});
  }
  return table.text();
}

std::string objective_words(const SearchAnswer& answer) {
  const BestDesign& best = *answer.best;
  const StartDesign& start = answer.start;
  const std::string& name = answer.objective.quantity;
  std::string words = fmt::format("{} {} (point {})", name, number(best.objective), best.point);
  if (std::isfinite(best.replicates.low))
    words +=
        fmt::format("; mean over replicates {}{}, interval of 95 %", with_interval(best.replicates), in_unit(name));
  if (!std::isfinite(start.objective))
    return words + fmt::format(".\nThe start is no design to compare with ({}): {}.\n", start.state.value_or(""),
                               start.reason.value_or(""));
  words += fmt::format(".\nAt the start {}", number(start.objective));
  if (start.violated) {
    words += ", which breaks limits: ";
    for (std::size_t i = 0; i < start.violated->size(); ++i) words += (i ? "; " : "") + (*start.violated)[i];
  }
  return words + ".\n";
}

std::string lives_table(const SearchAnswer& answer) {
  if (!answer.lives || !answer.lives->best.value) return "";
  const RangeLives* start = answer.lives->start && answer.lives->start->value ? &*answer.lives->start->value : nullptr;
  Table table({"range", "log10 life start", "log10 life best"});
  for (const auto& [range, best] : *answer.lives->best.value) {
    const bool known = start && start->contains(range);
    table.row({range, known ? with_interval(start->at(range)) : "-", with_interval(best)});
  }
  return "\nLife by range, log10 of hours\n\n" + table.text();
}

std::string governing_words(const StartAndBest<GoverningPart>& governing) {
  std::string words;
  for (const auto& [which, g] : {std::pair{"start", governing.of_start()}, {"best", governing.of_best()}})
    if (g)
      words += fmt::format("{}: of the damage in the ranges run, range {} does {:.0f} %, pulley {} {:.0f} %.\n", which,
                           g->range, 100 * g->range_share, g->pulley, 100 * g->pulley_share);
  return words.empty() ? "" : "\n" + words;
}

std::string comparison_words(const SearchAnswer& answer) {
  std::string words;
  for (const ComparisonAnswer& c : answer.comparison)
    words += fmt::format(
        "Against {}point {}: better by {}; {}{}.\n", c.against_start ? "the start, " : "", c.against, with_interval(c),
        c.words, std::isfinite(c.probability_better) ? " (probability " + number(c.probability_better, 3) + ")" : "");
  return words.empty() ? "" : "\n" + words;
}

std::string active_table(const std::vector<ActiveLimit>& active) {
  if (active.empty()) return "\nNo limit is active.\n";
  Table table({"active", "name", "value", "bound", "left", "unit"});
  for (const ActiveLimit& a : active)
    table.row({a.kind, a.name, number(a.value), (a.at_most ? "at most " : "at least ") + number(a.bound),
               number(a.left, 3), a.unit});
  return "\n" + table.text();
}

std::string front_table(const SearchAnswer& answer) {
  Table table({"point", answer.objective.quantity, answer.pareto->quantity});
  for (const FrontDesign& f : answer.pareto->front)
    table.row({fmt::format("{}", f.point), number(f.objective), number(f.second)});
  return fmt::format("\nFront by the {} model\n\n", answer.pareto->model) + table.text();
}

std::string account(const SearchAnswer& answer) {
  std::string words = fmt::format("\n{}, ended: {}.\n", answer.algorithm, answer.ended);
  if (answer.combinations)
    for (const CombinationAnswer& c : *answer.combinations)
      words += fmt::format("{}: {} simulations{}\n", c.choices, c.budget, c.why ? ", " + *c.why : "");
  words += fmt::format("{} simulations: {} of the search, {} of replicates, {} of the check of a coarse model.",
                       answer.evaluations, answer.search_simulations, answer.replicate_simulations,
                       answer.check_simulations);
  for (const auto& [state, count] : answer.failures) words += fmt::format(" {} {}.", count, state);
  words += "\n";
  if (const auto& f = answer.fidelity)
    words += fmt::format("Rank correlation of coarse and fine over {} layouts: {:.3f}, so the search ran {}.\n",
                         f->compared, f->rank_correlation, f->search);
  return words;
}

}  // namespace

std::string LayoutSearch::text(const SearchAnswer& answer) {
  if (answer.error) return *answer.error + "\n" + account(answer);
  std::string words;
  if (answer.robust)
    words = fmt::format("Objective: percentile {:g} from the bad end of {} draws a layout.\n",
                        answer.robust->percentile, answer.robust->samples);
  words += objective_words(answer) + "\n" + parameter_table(answer) + lives_table(answer) +
           governing_words(answer.governing) + comparison_words(answer) + active_table(answer.active);
  if (answer.pareto) words += front_table(answer);
  return words + account(answer);
}

}  // namespace beltlife
