// The part of a page that is of a layout search: gain, layouts, finalists, lives, what limits them; see study_parts.h.
#include "optimize/pages/optimize_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimize/pages/optimize_charts.h"
#include "optimize/pages/optimize_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

using namespace optimize_page;

constexpr double sure = 0.95;  ///< probability from which one finalist is called better than another

std::string range_text(const Bounds& b, int digits = 5) {
  return std::isnan(b.lower) && std::isnan(b.upper)
             ? "not in this log"
             : digits_text(b.lower, digits) + " to " + digits_text(b.upper, digits);
}

std::string signed_text(double v, int digits = 4) { return std::isnan(v) ? "" : fmt::format("{:+.{}g}", v, digits); }

/// An interval, or why there is none.
std::string interval_cell(const ReplicateMean& m, int digits) {
  return std::isnan(m.low) && std::isnan(m.high) ? "one replicate" : interval_text(m.low, m.high, digits);
}

std::string single_chart(const std::string& svg) {
  return svg.empty() ? "" : "<div style=\"max-width:600px\">" + svg + "</div>\n";
}

/// Whether differences of it are factors of what it is the logarithm of.
bool is_logarithm(const std::string& quantity) {
  const std::size_t dot = quantity.rfind(".log10_");
  return quantity.starts_with("log10_") || dot != quantity.npos;
}

std::string list_words(const std::vector<std::string>& all, std::size_t most) {
  std::string words;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) words += (i ? "; " : "") + html_escaped(all[i]);
  if (all.size() > most) words += fmt::format("; and {} more", all.size() - most);
  return words;
}

double mean_of_best(const SearchAnswer& answer) {
  if (!answer.best) return not_known;
  return std::isnan(answer.best->replicates.mean) ? answer.best->objective : answer.best->replicates.mean;
}

/// By how much the best is better than the start, with its interval, and as a factor of what a logarithm is of.
std::string difference_words(const ComparisonAnswer& gain, bool logarithm) {
  std::string words = fmt::format(": better by <strong>{}</strong>", number_text(gain.mean, 4));
  if (!std::isnan(gain.low))
    words += fmt::format(" ({} to {} at 95 %)", number_text(gain.low, 4), number_text(gain.high, 4));
  if (logarithm && std::abs(gain.mean) < 30) {
    words += fmt::format(", a factor of <strong>{}</strong>", html_rounded(std::pow(10, std::abs(gain.mean)), 3));
    if (std::abs(gain.low) < 30 && std::abs(gain.high) < 30)
      words +=
          fmt::format(" ({} to {})", html_rounded(std::pow(10, gain.low), 3), html_rounded(std::pow(10, gain.high), 3));
  }
  if (!gain.words.empty()) words += fmt::format("; {}", html_escaped(gain.words));
  return words + ". ";
}

/// How much better than the start, and how sure that is.
std::string gain_words(const SearchAnswer& answer) {
  const std::string& name = answer.objective.quantity;
  const double to = mean_of_best(answer), from = answer.start.mean.value_or(answer.start.objective);
  if (std::isnan(to)) return "";
  const std::string unit = unit_of_name(name), in_unit = unit.empty() ? "" : " " + html_escaped(unit);
  std::string words =
      fmt::format("{} is <strong>{}</strong>{} in the best layout", html_escaped(name), number_text(to), in_unit);
  if (std::isnan(from)) return words + "; the start did not run to its end. ";
  if (answer.best->point == answer.start.point)
    return words + ": <strong>nothing better than the start</strong> was found. ";
  words += fmt::format(" and {} at the start", number_text(from));
  const auto gain = std::find_if(answer.comparison.begin(), answer.comparison.end(),
                                 [](const ComparisonAnswer& c) { return c.against_start; });
  if (gain != answer.comparison.end()) return words + difference_words(*gain, is_logarithm(name));
  return words +
         (answer.start.violated ? ", which breaks limits: " + list_words(*answer.start.violated, 3) + ". " : ". ");
}

std::string doubts(const SearchAnswer& answer) {
  std::string words;
  for (const FinalistAnswer& f : answer.finalists)
    if (answer.best && f.point == answer.best->point && f.constraints_hold_in < f.replicates)
      words += fmt::format("<strong class=\"alarm\">Its limits hold in {} of {} replicates only.</strong> ",
                           f.constraints_hold_in, f.replicates);
  std::size_t alike = 0;
  for (const ComparisonAnswer& c : answer.comparison) alike += !c.against_start && c.probability_better < sure;
  if (alike > 0)
    words += fmt::format("Of the other <a href=\"#finalists\">finalists</a>, {} cannot be told apart from it. ", alike);
  if (answer.fidelity && answer.fidelity->search == "fine")
    words += fmt::format(
        "<strong class=\"alarm\">The coarse model was not trusted</strong> (rank correlation {}), so that the search "
        "ran the fine one. ",
        digits_text(answer.fidelity->rank_correlation));
  return words;
}

std::string lead_of(const SearchAnswer& answer) {
  std::string words = error_words(answer) + gain_words(answer);
  std::vector<std::string> active;
  for (const ActiveLimit& a : answer.active)
    active.push_back(a.kind.ends_with("bound") ? a.name + " (" + a.kind + ")" : a.name);
  if (!active.empty())
    words += fmt::format("{} <a href=\"#active\">{}</a>: {}. ", active.size(),
                         active.size() == 1 ? "limit holds it back" : "limits and bounds hold it back",
                         list_words(active, 5));
  else if (answer.best)
    words += "No limit holds it back. ";
  if (const GoverningPart* g = answer.governing.of_best())
    words += fmt::format("Range <strong>{}</strong> does {} % of the damage, and pulley <strong>{}</strong> {} %. ",
                         html_escaped(g->range), percent_text(g->range_share, 3), html_escaped(g->pulley),
                         percent_text(g->pulley_share, 3));
  return words + doubts(answer);
}

std::vector<Row> key_numbers_of(const SearchAnswer& answer) {
  std::vector<Row> rows;
  if (const std::string& name = answer.objective.quantity; !name.empty())
    rows.push_back(
        {"objective", name + (answer.objective.maximize ? ", the larger the better" : ", the smaller the better")});
  if (!answer.algorithm.empty()) rows.push_back({"algorithm", answer.algorithm});
  if (!answer.ended.empty()) rows.push_back({"ended because", answer.ended});
  rows.push_back({"seed", std::to_string(answer.seed)});
  rows.push_back({"simulations of the search", std::to_string(answer.search_simulations)});
  rows.push_back({"of the check of a coarse model", std::to_string(answer.check_simulations)});
  rows.push_back({"of replicates", std::to_string(answer.replicate_simulations)});
  if (answer.robust)
    rows.push_back({"a layout counts by", fmt::format("percentile {:g} from the bad end of {} draws",
                                                      answer.robust->percentile, answer.robust->samples)});
  return rows;
}

double value_in(const std::map<std::string, double>& values, const std::string& name) {
  const auto at = values.find(name);
  return at == values.end() ? not_known : at->second;
}

std::string choice_in(const std::optional<std::map<std::string, std::string>>& choices, const std::string& name) {
  if (!choices) return "";
  const auto at = choices->find(name);
  return at == choices->end() ? "" : at->second;
}

Section parameters_section(const StudyRecord& record, const SearchAnswer& answer, const Asked& asked) {
  const DesignAnswer nothing;
  const DesignAnswer* const given = found_of(answer);
  const DesignAnswer &start = answer.start, &found = given ? *given : nothing;
  std::vector<Row> rows;
  for (const std::string& name : record.head.parameters) {
    const double a = value_in(start.parameters, name), b = value_in(found.parameters, name);
    if (!std::isnan(a) || !std::isnan(b)) {
      const auto known = asked.parameters.find(name);
      const Bounds bounds = known == asked.parameters.end() ? Bounds{} : known->second;
      const double near = 0.01 * (bounds.upper - bounds.lower);  // as the answer calls a bound active
      const char* on = b - bounds.lower < near ? "lower" : bounds.upper - b < near ? "upper" : "";
      rows.push_back({name, number_text(a), number_text(b), signed_text(b - a), unit_of_name(name), range_text(bounds),
                      Cell(on, *on != '\0')});
      continue;
    }
    const std::string from = choice_in(start.choices, name), to = choice_in(found.choices, name);
    if (!from.empty() || !to.empty()) rows.push_back({name, from, to, from == to ? "" : "changed", "", "", ""});
  }
  if (rows.empty()) return {"parameters", "", ""};
  std::string html = html_table(
      "study-parameters",
      {"parameter", "start", answer.best ? "best" : "breaks least", "change", "unit", "bounds", "on a bound"}, rows);
  return section_of("parameters", "Parameters", "Parameters", html);
}

std::string layout_caption(const char* which, const DrawnLayout* layout) {
  std::string words = which;
  const auto add = [&](const char* name, double v, const char* unit) {
    if (!std::isnan(v)) words += fmt::format("{} {} {} {}", words == which ? ":" : ",", name, digits_text(v, 5), unit);
  };
  if (layout) {
    add("belt", layout->path_length_mm, "mm along its path");
    add("unstretched", layout->unstretched_length_mm, "mm");
    add("tension at rest", layout->tension_n, "N");
  }
  return words + ".";
}

Section layouts_section(const SearchAnswer& answer) {
  const DrawnLayout *start = answer.layouts.of_start(), *best = answer.layouts.of_best();
  const std::string pictures = layout_drawing("layout-start", layout_caption("Start", start), start, best, false) +
                               layout_drawing("layout-best", layout_caption("Best", best), best, start, true);
  if (pictures.empty()) return {"layouts", "", ""};
  const auto bounded = [](const DrawnLayout* l) { return l && (l->box || l->keep_outs); };
  return section_of(
      "layouts", "Layouts", "Layouts before and after",
      fmt::format("<p>At rest, to one scale. Ribs run on the grey pulleys, the back on the beige ones.{}{}</p>\n"
                  "<div class=\"charts\">{}</div>\n",
                  start && best ? " Dashed beneath the best: the start." : "",
                  bounded(start) || bounded(best)
                      ? " Orange: where belt and pulleys may not be, paler its margin, and the box."
                      : "",
                  pictures));
}

Section history_section(const StudyRecord& record, const SearchAnswer& answer) {
  const std::string chart = history_chart("history-chart", record, answer);
  if (chart.empty()) return {"history", "", ""};
  return section_of("history", "Course", "Course of the search",
                    "<p>The line holds the best layout so far that keeps all limits, as the search saw it; the mean of "
                    "its replicates may be another. Marks on the better side of it break a limit. Those further off "
                    "than the line is long are left out.</p>\n" +
                        single_chart(chart));
}

Row finalist_row(const FinalistAnswer& f, bool best) {
  std::string remark = best ? "best" : "";
  if (f.start) remark += remark.empty() ? "start" : ", start";
  const double deviation = f.mean.standard_deviation;
  return {std::to_string(f.point),
          remark,
          number_text(f.mean.mean),
          interval_cell(f.mean, 5),
          std::isnan(deviation) ? "one replicate" : digits_text(deviation, 2),
          std::to_string(f.replicates),
          Cell(std::to_string(f.constraints_hold_in), f.constraints_hold_in < f.replicates)};
}

Row comparison_row(const ComparisonAnswer& c) {
  const double p = c.probability_better;
  return {std::to_string(c.of),
          std::to_string(c.against) + (c.against_start ? ", the start" : ""),
          signed_text(c.mean),
          interval_cell(c, 4),
          std::isnan(p) ? "one replicate"
          : p > 0.9999  ? "> 0.9999"
                        : digits_text(p, 4),
          c.words};
}

Section finalists_section(const SearchAnswer& answer) {
  std::vector<Row> rows, pairs;
  for (const FinalistAnswer& f : answer.finalists)
    rows.push_back(finalist_row(f, answer.best && f.point == answer.best->point));
  for (const ComparisonAnswer& c : answer.comparison) pairs.push_back(comparison_row(c));
  if (rows.empty() && pairs.empty()) return {"finalists", "", ""};
  std::string html =
      "<p>The best layouts that differ, and the start, run by the fine model at several crank phases. "
      "Intervals are of 95 %.";
  if (const std::string& name = answer.objective.quantity; !name.empty())
    html += " Values: " + html_escaped(with_unit(name));
  html += ".</p>\n";
  if (!rows.empty())
    html += html_table("study-finalists",
                       {"point", "", "mean", "interval", "standard deviation", "replicates", "limits hold in"}, rows);
  if (!pairs.empty())
    html += "<h3>In pairs, at the same crank phases</h3>\n" +
            html_table("study-comparison", {"point", "against", "better by", "interval", "probability", ""}, pairs);
  return section_of("finalists", "Finalists", "Finalists", html);
}

std::string lives_html(const LivesAnswer& lives) {
  if (!lives.best.value) return "";
  const RangeLives* start = lives.start && lives.start->value ? &*lives.start->value : nullptr;
  const auto hours = [](double log) { return html_rounded(std::pow(10, log), 3); };
  const std::string no_start = "start no finalist";
  std::vector<Row> rows;
  for (const auto& [range, life] : *lives.best.value) {
    if (!start || !start->contains(range)) {
      rows.push_back({range, no_start, hours(life.mean), no_start, no_start, "", number_text(life.mean, 4),
                      interval_cell(life, 4)});
      continue;
    }
    const ReplicateMean& before = start->at(range);
    rows.push_back({range, hours(before.mean), hours(life.mean), hours(life.mean - before.mean),
                    number_text(before.mean, 4), interval_cell(before, 4), number_text(life.mean, 4),
                    interval_cell(life, 4)});
  }
  return single_chart(lives_chart("lives-chart", lives)) +
         html_table(
             "study-lives",
             {"range", "start, h", "best, h", "factor", "start, log10 h", "interval", "best, log10 h", "interval"},
             rows);
}

Section lives_section(const SearchAnswer& answer) {
  std::vector<Row> governing;
  for (const auto& [which, g] : {std::pair{"start", answer.governing.of_start()}, {"best", answer.governing.of_best()}})
    if (g)
      governing.push_back(
          {which, g->range, percent_text(g->range_share, 3), g->pulley, percent_text(g->pulley_share, 3)});
  std::string html = answer.lives ? lives_html(*answer.lives) : "";
  if (!governing.empty())
    html += "<h3>What governs</h3>\n<p>Who takes most of the damage in the ranges that were run.</p>\n" +
            html_table("study-governing", {"", "range", "share, %", "pulley", "share, %"}, governing);
  return section_of("lives", "Lives", "Lives by range", html);
}

Section fidelity_section(const StudyRecord& record, const SearchAnswer& answer) {
  if (!answer.fidelity) return {"fidelity", "", ""};
  const FidelityAnswer& f = *answer.fidelity;
  std::string html = fmt::format(
      "<p>Of {} layouts asked for, {} ran by both models. Spearman's rank correlation of their objectives is "
      "<strong{}>{}</strong>; from {} on, the coarse model is trusted. The search ran the <strong>{}</strong> "
      "model.</p>\n",
      f.asked, f.compared, f.search == "fine" ? " class=\"alarm\"" : "", digits_text(f.rank_correlation),
      digits_text(f.enough), html_escaped(f.search));
  return section_of("fidelity", "Coarse model", "Check of the coarse model",
                    html + single_chart(fidelity_chart("fidelity-chart", record, answer)));
}

Section pareto_section(const StudyRecord& record, const SearchAnswer& answer) {
  if (!answer.pareto || answer.pareto->front.empty()) return {"pareto", "", ""};
  const std::vector<FrontDesign>& front = answer.pareto->front;
  const std::string first = answer.objective.quantity, second = answer.pareto->quantity;
  Row header{"point", with_unit(first), with_unit(second)};
  std::vector<std::string> columns;
  for (const std::string& name : record.head.parameters)
    if (std::any_of(front.begin(), front.end(), [&](const FrontDesign& d) {
          return d.parameters.contains(name) || !choice_in(d.choices, name).empty();
        }))
      columns.push_back(name);
  for (const std::string& name : columns) header.push_back(with_unit(name));
  std::vector<Row> rows;
  for (const FrontDesign& d : front) {
    Row row{std::to_string(d.point), number_text(d.objective), number_text(d.second)};
    for (const std::string& name : columns) {
      const std::string choice = choice_in(d.choices, name);
      row.push_back(choice.empty() ? number_text(value_in(d.parameters, name)) : choice);
    }
    rows.push_back(std::move(row));
  }
  const auto direction = [](bool maximize) { return maximize ? "large" : "small"; };
  std::string html =
      fmt::format("<p>{} wants to be {}, {} {}. By the {} model, one run of each.{}</p>\n", html_escaped(first),
                  direction(answer.objective.maximize), html_escaped(second), direction(answer.pareto->maximize),
                  html_escaped(answer.pareto->model),
                  front.size() == 1 ? " One layout is the best in both: there is nothing to trade." : "");
  return section_of(
      "pareto", "Front", "Trade between two objectives",
      html + single_chart(front_chart("pareto-chart", record, answer)) + html_table("study-front", header, rows));
}

Section combinations_section(const SearchAnswer& answer) {
  if (!answer.combinations || answer.combinations->empty()) return {"combinations", "", ""};
  std::vector<Row> rows;
  for (const CombinationAnswer& c : *answer.combinations)
    rows.push_back({c.choices, std::to_string(c.budget), Cell(c.why.value_or(""), c.why.has_value())});
  return section_of("combinations", "Choices", "Combinations of choices",
                    html_table("study-combinations", {"choices", "simulations allowed", ""}, rows));
}

}  // namespace

StudyPart optimize_part(const StudyRecord& record, const SearchAnswer& answer) {
  const Asked asked = asked_of(record.head);
  StudyPart part;
  part.lead = lead_of(answer);
  part.key_numbers = key_numbers_of(answer);
  part.sections = {layouts_section(answer),
                   parameters_section(record, answer, asked),
                   history_section(record, answer),
                   finalists_section(answer),
                   lives_section(answer),
                   active_section(answer, asked),
                   fidelity_section(record, answer),
                   pareto_section(record, answer),
                   combinations_section(answer)};
  return part;
}

const StudyPage& layout_search_page() {
  static constexpr StudyPage page{
      "optimize",
      "Layout search",
      "which layout is the best within its limits",
      typed_part<SearchAnswer, optimize_part>,
      false,
      "A layout that fails counts as one that breaks its limits, and the search goes on elsewhere."};
  return page;
}

}  // namespace beltlife
