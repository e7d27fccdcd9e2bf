// The answer of an optimisation for people; see layout_search.h.
#include <fmt/format.h>

#include <cmath>

#include "optimize/layout_search.h"
#include "results/text/table.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

using nlohmann::json;

std::string number(const json& v, int digits = 5) {
  return v.is_number() ? fmt::format("{:.{}g}", v.get<double>(), digits) : "-";
}

/// "3.21 +- 0.02" with half the interval, or the mean alone.
std::string with_interval(const json& m) {
  if (!m.is_object() || !m.contains("mean")) return "-";
  if (!m["low"].is_number()) return number(m["mean"]);
  return fmt::format("{:.5g} +- {:.2g}", m["mean"].get<double>(),
                     0.5 * (m["high"].get<double>() - m["low"].get<double>()));
}

std::string in_unit(const std::string& name) {
  const std::string unit = unit_of_name(name);
  return unit.empty() ? "" : " " + unit;
}

std::string parameter_table(const json& answer) {
  const json &start = answer["start"], &best = answer["best"];
  Table table({"parameter", "unit", "start", "best", "change"});
  if (best.contains("choices"))
    for (const auto& [path, value] : best["choices"].items())
      table.row({path, "", start["choices"][path], value, start["choices"][path] == value ? "" : "changed"});
  for (const auto& [path, value] : best["parameters"].items()) {
    const double from = start["parameters"][path], to = value;
    table.row({path, unit_of_name(path), fmt::format("{:.6g}", from), fmt::format("{:.6g}", to),
               from == to ? "0" : fmt::format("{:+.4g}", to - from)});
  }
  return table.text();
}

std::string objective_words(const json& answer) {
  const json& best = answer["best"];
  const std::string name = answer["objective"]["quantity"];
  std::string words =
      fmt::format("{} {} (point {})", name, number(best["objective"]), best["point"].get<std::size_t>());
  if (best["low"].is_number())
    words += fmt::format("; mean over replicates {}{}, interval of 95 %", with_interval(best), in_unit(name));
  const json& start = answer["start"];
  if (!start["objective"].is_number())
    return words + fmt::format(".\nThe start is no design to compare with ({}): {}.\n",
                               start["state"].get<std::string>(), start["reason"].get<std::string>());
  words += fmt::format(".\nAt the start {}", number(start["objective"]));
  if (start.contains("violated")) {
    words += ", which breaks limits: ";
    for (std::size_t i = 0; i < start["violated"].size(); ++i)
      words += (i ? "; " : "") + start["violated"][i].get<std::string>();
  }
  return words + ".\n";
}

std::string lives_table(const json& lives) {
  if (!lives.is_object() || !lives.contains("best") || !lives["best"].is_object()) return "";
  Table table({"range", "log10 life start", "log10 life best"});
  for (const auto& [range, best] : lives["best"].items()) {
    const bool known = lives.contains("start") && lives["start"].is_object() && lives["start"].contains(range);
    table.row({range, known ? with_interval(lives["start"][range]) : "-", with_interval(best)});
  }
  return "\nLife by range, log10 of hours\n\n" + table.text();
}

std::string governing_words(const json& governing) {
  std::string words;
  for (const char* which : {"start", "best"}) {
    if (!governing.contains(which) || !governing[which].is_object()) continue;
    const json& g = governing[which];
    words += fmt::format("{}: of the damage in the ranges run, range {} does {:.0f} %, pulley {} {:.0f} %.\n", which,
                         g["range"].get<std::string>(), 100 * g["range_share"].get<double>(),
                         g["pulley"].get<std::string>(), 100 * g["pulley_share"].get<double>());
  }
  return words.empty() ? "" : "\n" + words;
}

std::string comparison_words(const json& answer) {
  std::string words;
  for (const json& c : answer["comparison"])
    words += fmt::format(
        "Against {}point {}: better by {}; {}{}.\n", c["against_start"].get<bool>() ? "the start, " : "",
        c["against"].get<std::size_t>(), with_interval(c), c["words"].get<std::string>(),
        c["probability_better"].is_number() ? " (probability " + number(c["probability_better"], 3) + ")" : "");
  return words.empty() ? "" : "\n" + words;
}

std::string active_table(const json& active) {
  if (active.empty()) return "\nNo limit is active.\n";
  Table table({"active", "name", "left", "unit"});
  for (const json& a : active) table.row({a["kind"], a["name"], number(a["left"], 3), a["unit"]});
  return "\n" + table.text();
}

std::string front_table(const json& answer) {
  const json& pareto = answer["pareto"];
  const std::string first = answer["objective"]["quantity"], second = pareto["quantity"];
  Table table({"point", first, second});
  for (const json& f : pareto["front"])
    table.row({fmt::format("{}", f["point"].get<std::size_t>()), number(f["objective"]), number(f["second"])});
  return fmt::format("\nFront by the {} model\n\n", pareto["model"].get<std::string>()) + table.text();
}

std::string account(const json& answer) {
  std::string words =
      fmt::format("\n{}, ended: {}.\n", answer["algorithm"].get<std::string>(), answer["ended"].get<std::string>());
  if (answer.contains("combinations"))
    for (const json& c : answer["combinations"])
      words += fmt::format("{}: {} simulations{}\n", c["choices"].get<std::string>(), c["budget"].get<std::size_t>(),
                           c.contains("why") ? ", " + c["why"].get<std::string>() : "");
  words +=
      fmt::format("{} simulations: {} of the search, {} of replicates, {} of the check of a coarse model.",
                  answer["evaluations"].get<std::size_t>(), answer["search_simulations"].get<std::size_t>(),
                  answer["replicate_simulations"].get<std::size_t>(), answer["check_simulations"].get<std::size_t>());
  for (const auto& [state, count] : answer["failures"].items())
    words += fmt::format(" {} {}.", count.get<std::size_t>(), state);
  words += "\n";
  if (answer.contains("fidelity")) {
    const json& f = answer["fidelity"];
    words += fmt::format("Rank correlation of coarse and fine over {} layouts: {:.3f}, so the search ran {}.\n",
                         f["compared"].get<std::size_t>(), f["rank_correlation"].get<double>(),
                         f["search"].get<std::string>());
  }
  return words;
}

}  // namespace

std::string LayoutSearch::text(const json& answer) {
  if (answer.contains("error")) return answer["error"].get<std::string>() + "\n" + account(answer);
  std::string words;
  if (answer.contains("robust"))
    words = fmt::format("Objective: percentile {:g} from the bad end of {} draws a layout.\n",
                        answer["robust"]["percentile"].get<double>(), answer["robust"]["samples"].get<int>());
  words += objective_words(answer) + "\n" + parameter_table(answer) + lives_table(answer["lives"]) +
           governing_words(answer["governing"]) + comparison_words(answer) + active_table(answer["active"]);
  if (answer.contains("pareto")) words += front_table(answer);
  return words + account(answer);
}

}  // namespace beltlife
