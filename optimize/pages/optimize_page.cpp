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
using nlohmann::json;

constexpr double sure = 0.95;  ///< probability from which one finalist is called better than another

std::string range_text(const Bounds& b, int digits = 5) {
  return std::isnan(b.lower) && std::isnan(b.upper)
             ? "-"
             : digits_text(b.lower, digits) + " to " + digits_text(b.upper, digits);
}

std::string signed_text(double v, int digits = 4) { return std::isnan(v) ? "-" : fmt::format("{:+.{}g}", v, digits); }

std::string point_text(const json& j, const char* key = "point") {
  const double v = number_in(j, key);
  return std::isnan(v) ? "-" : fmt::format("{:.0f}", v);
}

std::string single_chart(const std::string& svg) {
  return svg.empty() ? "" : "<div style=\"max-width:600px\">" + svg + "</div>\n";
}

std::string objective_of(const json& answer) { return text_in(part_of(answer, "objective"), "quantity"); }

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

double mean_or_value(const json& design) {
  const double mean = number_in(design, "mean");
  return std::isnan(mean) ? number_in(design, "objective") : mean;
}

/// How much better than the start, and how sure that is.
std::string gain_words(const json& answer) {
  const std::string name = objective_of(answer);
  const json &best = part_of(answer, "best"), &start = part_of(answer, "start");
  const double to = mean_or_value(best), from = mean_or_value(start);
  if (!best.is_object() || std::isnan(to)) return "";
  const std::string unit = unit_of_name(name), in_unit = unit.empty() ? "" : " " + html_escaped(unit);
  std::string words =
      fmt::format("{} is <strong>{}</strong>{} in the best layout", html_escaped(name), number_text(to), in_unit);
  if (std::isnan(from)) return words + "; the start did not run to its end. ";
  if (number_in(best, "point") == number_in(start, "point"))
    return words + ": <strong>nothing better than the start</strong> was found. ";
  words += fmt::format(" and {} at the start", number_text(from));
  const auto comparisons = rows_of(answer, "comparison");
  const auto gain =
      std::find_if(comparisons.begin(), comparisons.end(), [](const json& c) { return flag_in(c, "against_start"); });
  if (gain == comparisons.end()) {
    const auto broken = texts_in(start, "violated");
    return words + (broken.empty() ? ". " : ", which breaks limits: " + list_words(broken, 3) + ". ");
  }
  const double mean = number_in(*gain, "mean"), low = number_in(*gain, "low"), high = number_in(*gain, "high");
  words += fmt::format(": better by <strong>{}</strong>", number_text(mean, 4));
  if (!std::isnan(low)) words += fmt::format(" ({} to {} at 95 %)", number_text(low, 4), number_text(high, 4));
  if (is_logarithm(name) && std::abs(mean) < 30) {
    words += fmt::format(", a factor of <strong>{}</strong>", html_rounded(std::pow(10, std::abs(mean)), 3));
    if (std::abs(low) < 30 && std::abs(high) < 30)
      words += fmt::format(" ({} to {})", html_rounded(std::pow(10, low), 3), html_rounded(std::pow(10, high), 3));
  }
  if (const std::string sureness = text_in(*gain, "words"); !sureness.empty())
    words += fmt::format("; {}", html_escaped(sureness));
  return words + ". ";
}

std::string doubts(const json& answer) {
  std::string words;
  const double best = number_in(part_of(answer, "best"), "point");
  for (const json& f : rows_of(answer, "finalists"))
    if (number_in(f, "point") == best && number_in(f, "constraints_hold_in") < number_in(f, "replicates"))
      words += fmt::format("<strong class=\"alarm\">Its limits hold in {:g} of {:g} replicates only.</strong> ",
                           number_in(f, "constraints_hold_in"), number_in(f, "replicates"));
  std::size_t alike = 0;
  for (const json& c : rows_of(answer, "comparison"))
    alike += !flag_in(c, "against_start") && number_in(c, "probability_better") < sure;
  if (alike > 0)
    words += fmt::format("Of the other <a href=\"#finalists\">finalists</a>, {} cannot be told apart from it. ", alike);
  const json& fidelity = part_of(answer, "fidelity");
  if (text_in(fidelity, "search") == "fine")
    words += fmt::format(
        "<strong class=\"alarm\">The coarse model was not trusted</strong> (rank correlation {}), so that the search "
        "ran the fine one. ",
        digits_text(number_in(fidelity, "rank_correlation")));
  return words;
}

std::string lead_of(const json& answer) {
  std::string words = error_words(answer);
  words += gain_words(answer);
  std::vector<std::string> active;
  for (const json& a : rows_of(answer, "active")) {
    const std::string kind = text_in(a, "kind"), name = text_in(a, "name");
    active.push_back(kind.ends_with("bound") ? name + " (" + kind + ")" : name);
  }
  if (!active.empty())
    words += fmt::format("{} <a href=\"#active\">{}</a>: {}. ", active.size(),
                         active.size() == 1 ? "limit holds it back" : "limits and bounds hold it back",
                         list_words(active, 5));
  else if (part_of(answer, "active").is_array())
    words += "No limit holds it back. ";
  const json& governing = part_of(part_of(answer, "governing"), "best");
  if (governing.is_object())
    words +=
        fmt::format("Range <strong>{}</strong> does {} % of the damage, and pulley <strong>{}</strong> {} %. ",
                    html_escaped(text_in(governing, "range")), percent_text(number_in(governing, "range_share"), 3),
                    html_escaped(text_in(governing, "pulley")), percent_text(number_in(governing, "pulley_share"), 3));
  return words + doubts(answer);
}

std::vector<Row> key_numbers_of(const json& answer) {
  std::vector<Row> rows;
  if (const std::string name = objective_of(answer); !name.empty())
    rows.push_back(
        {"objective", name + (flag_in(part_of(answer, "objective"), "maximize") ? ", the larger the better"
                                                                                : ", the smaller the better")});
  const auto add_text = [&](const char* words, const char* key) {
    if (const std::string text = text_in(answer, key); !text.empty()) rows.push_back({words, text});
  };
  const auto add = [&](const char* words, const char* key) {
    if (const double v = number_in(answer, key); !std::isnan(v)) rows.push_back({words, fmt::format("{:g}", v)});
  };
  add_text("algorithm", "algorithm");
  add_text("ended because", "ended");
  add("seed", "seed");
  add("simulations of the search", "search_simulations");
  add("of the check of a coarse model", "check_simulations");
  add("of replicates", "replicate_simulations");
  const json& robust = part_of(answer, "robust");
  if (robust.is_object())
    rows.push_back({"a layout counts by", fmt::format("percentile {:g} from the bad end of {:g} draws",
                                                      number_in(robust, "percentile"), number_in(robust, "samples"))});
  return rows;
}

Section parameters_section(const StudyRecord& record, const Asked& asked) {
  const json &start = part_of(record.answer, "start"), &found = found_of(record.answer);
  std::vector<Row> rows;
  for (const std::string& name : record.head.parameters) {
    const json &from = part_of(part_of(start, "parameters"), name), &to = part_of(part_of(found, "parameters"), name);
    if (from.is_number() || to.is_number()) {
      const double a = from.is_number() ? from.get<double>() : none, b = to.is_number() ? to.get<double>() : none;
      const auto known = asked.parameters.find(name);
      const Bounds bounds = known == asked.parameters.end() ? Bounds{} : known->second;
      const double near = 0.01 * (bounds.upper - bounds.lower);  // as the answer calls a bound active
      const char* on = b - bounds.lower < near ? "lower" : bounds.upper - b < near ? "upper" : "";
      rows.push_back({name, number_text(a), number_text(b), signed_text(b - a), unit_of_name(name), range_text(bounds),
                      Cell(on, *on != '\0')});
      continue;
    }
    const std::string a = text_in(part_of(start, "choices"), name), b = text_in(part_of(found, "choices"), name);
    if (!a.empty() || !b.empty()) rows.push_back({name, a, b, a == b ? "" : "changed", "", "", ""});
  }
  if (rows.empty()) return {"parameters", "", ""};
  const bool best = part_of(record.answer, "best").is_object();
  std::string html = html_table(
      "study-parameters",
      {"parameter", "start", best ? "best" : "breaks least", "change", "unit", "bounds", "on a bound"}, rows);
  return section_of("parameters", "Parameters", "Parameters", html);
}

Section layouts_section(const json& answer) {
  const json &layouts = part_of(answer, "layouts"), &start = part_of(layouts, "start"),
             &best = part_of(layouts, "best");
  const auto caption = [&](const char* which, const json& layout) {
    std::string words = which;
    const auto add = [&](const char* name, const char* key, const char* unit) {
      if (const double v = number_in(layout, key); !std::isnan(v))
        words += fmt::format("{} {} {} {}", words == which ? ":" : ",", name, digits_text(v, 5), unit);
    };
    add("belt", "path_length_mm", "mm along its path");
    add("unstretched", "unstretched_length_mm", "mm");
    add("tension at rest", "tension_n", "N");
    return words + ".";
  };
  const std::string pictures = layout_drawing("layout-start", caption("Start", start), start, best, false) +
                               layout_drawing("layout-best", caption("Best", best), best, start, true);
  if (pictures.empty()) return {"layouts", "", ""};
  const json* const shown[] = {&start, &best};
  const bool surrounded = std::any_of(std::begin(shown), std::end(shown), [](const json* l) {
    return part_of(*l, "box").is_object() || part_of(*l, "keep_outs").is_array();
  });
  return section_of(
      "layouts", "Layouts", "Layouts before and after",
      fmt::format("<p>At rest, to one scale. Ribs run on the grey pulleys, the back on the beige ones.{}{}</p>\n"
                  "<div class=\"charts\">{}</div>\n",
                  start.is_object() && best.is_object() ? " Dashed beneath the best: the start." : "",
                  surrounded ? " Orange: where belt and pulleys may not be, paler its margin, and the box." : "",
                  pictures));
}

Section history_section(const StudyRecord& record) {
  const std::string chart = history_chart("history-chart", record);
  if (chart.empty()) return {"history", "", ""};
  return section_of("history", "Course", "Course of the search",
                    "<p>The line holds the best layout so far that keeps all limits, as the search saw it; the mean of "
                    "its replicates may be another. Marks on the better side of it break a limit. Those further off "
                    "than the line is long are left out.</p>\n" +
                        single_chart(chart));
}

Section finalists_section(const json& answer) {
  std::vector<Row> rows, pairs;
  const double best = number_in(part_of(answer, "best"), "point");
  for (const json& f : rows_of(answer, "finalists")) {
    std::string remark = number_in(f, "point") == best ? "best" : "";
    if (flag_in(f, "start")) remark += remark.empty() ? "start" : ", start";
    const double holds = number_in(f, "constraints_hold_in"), of = number_in(f, "replicates");
    rows.push_back({point_text(f), remark, number_text(number_in(f, "mean")), interval_text(f, 5),
                    digits_text(number_in(f, "standard_deviation"), 2), digits_text(of),
                    Cell(digits_text(holds), holds < of)});
  }
  for (const json& c : rows_of(answer, "comparison")) {
    const double p = number_in(c, "probability_better");
    pairs.push_back({point_text(c, "of"),
                     point_text(c, "against") + std::string(flag_in(c, "against_start") ? ", the start" : ""),
                     signed_text(number_in(c, "mean")), interval_text(c, 4),
                     std::isnan(p) ? std::string("-")
                     : p > 0.9999  ? std::string("> 0.9999")
                                   : digits_text(p, 4),
                     text_in(c, "words")});
  }
  if (rows.empty() && pairs.empty()) return {"finalists", "", ""};
  std::string html =
      "<p>The best layouts that differ, and the start, run by the fine model at several crank phases. "
      "Intervals are of 95 %.";
  if (const std::string name = objective_of(answer); !name.empty()) html += " Values: " + html_escaped(with_unit(name));
  html += ".</p>\n";
  if (!rows.empty())
    html += html_table("study-finalists",
                       {"point", "", "mean", "interval", "standard deviation", "replicates", "limits hold in"}, rows);
  if (!pairs.empty())
    html += "<h3>In pairs, at the same crank phases</h3>\n" +
            html_table("study-comparison", {"point", "against", "better by", "interval", "probability", ""}, pairs);
  return section_of("finalists", "Finalists", "Finalists", html);
}

Section lives_section(const json& answer) {
  const json &lives = part_of(answer, "lives"), &best = part_of(lives, "best"), &start = part_of(lives, "start");
  std::vector<Row> rows, governing;
  if (best.is_object())
    for (const auto& [range, life] : best.items()) {
      const json& before = part_of(start, range);
      const auto hours = [](double log) { return std::abs(log) < 100 ? html_rounded(std::pow(10, log), 3) : "-"; };
      const double from = number_in(before, "mean"), to = number_in(life, "mean");
      rows.push_back({range, hours(from), hours(to), hours(to - from), number_text(from, 4), interval_text(before, 4),
                      number_text(to, 4), interval_text(life, 4)});
    }
  for (const char* which : {"start", "best"})
    if (const json& g = part_of(part_of(answer, "governing"), which); g.is_object())
      governing.push_back({which, text_in(g, "range"), percent_text(number_in(g, "range_share"), 3),
                           text_in(g, "pulley"), percent_text(number_in(g, "pulley_share"), 3)});
  std::string html;
  if (!rows.empty())
    html += single_chart(lives_chart("lives-chart", lives)) +
            html_table(
                "study-lives",
                {"range", "start, h", "best, h", "factor", "start, log10 h", "interval", "best, log10 h", "interval"},
                rows);
  if (!governing.empty())
    html += "<h3>What governs</h3>\n<p>Who takes most of the damage in the ranges that were run.</p>\n" +
            html_table("study-governing", {"", "range", "share, %", "pulley", "share, %"}, governing);
  return section_of("lives", "Lives", "Lives by range", html);
}

Section fidelity_section(const StudyRecord& record) {
  const json& fidelity = part_of(record.answer, "fidelity");
  if (!fidelity.is_object()) return {"fidelity", "", ""};
  const bool fine = text_in(fidelity, "search") == "fine";
  std::string html = fmt::format(
      "<p>Of {} layouts asked for, {} ran by both models. Spearman's rank correlation of their objectives is "
      "<strong{}>{}</strong>; from {} on, the coarse model is trusted. The search ran the <strong>{}</strong> "
      "model.</p>\n",
      digits_text(number_in(fidelity, "asked"), 6), digits_text(number_in(fidelity, "compared"), 6),
      fine ? " class=\"alarm\"" : "", digits_text(number_in(fidelity, "rank_correlation")),
      digits_text(number_in(fidelity, "enough")), html_escaped(text_in(fidelity, "search")));
  return section_of("fidelity", "Coarse model", "Check of the coarse model",
                    html + single_chart(fidelity_chart("fidelity-chart", record)));
}

Section pareto_section(const StudyRecord& record) {
  const json& pareto = part_of(record.answer, "pareto");
  const auto front = rows_of(pareto, "front");
  if (front.empty()) return {"pareto", "", ""};
  const std::string first = objective_of(record.answer), second = text_in(pareto, "quantity");
  Row header{"point", with_unit(first), with_unit(second)};
  std::vector<std::string> columns;
  for (const std::string& name : record.head.parameters)
    if (std::any_of(front.begin(), front.end(), [&](const json& j) {
          return part_of(part_of(j, "parameters"), name).is_number() || !text_in(part_of(j, "choices"), name).empty();
        }))
      columns.push_back(name);
  for (const std::string& name : columns) header.push_back(with_unit(name));
  std::vector<Row> rows;
  for (const json& j : front) {
    Row row{point_text(j), number_text(number_in(j, "objective")), number_text(number_in(j, "second"))};
    for (const std::string& name : columns) {
      const std::string choice = text_in(part_of(j, "choices"), name);
      row.push_back(choice.empty() ? number_text(number_in(part_of(j, "parameters"), name)) : choice);
    }
    rows.push_back(std::move(row));
  }
  const auto direction = [](const json& j) { return flag_in(j, "maximize") ? "large" : "small"; };
  std::string html =
      fmt::format("<p>{} wants to be {}, {} {}. By the {} model, one run of each.{}</p>\n", html_escaped(first),
                  direction(part_of(record.answer, "objective")), html_escaped(second), direction(pareto),
                  html_escaped(text_in(pareto, "model")),
                  front.size() == 1 ? " One layout is the best in both: there is nothing to trade." : "");
  return section_of("pareto", "Front", "Trade between two objectives",
                    html + single_chart(front_chart("pareto-chart", record)) + html_table("study-front", header, rows));
}

Section combinations_section(const json& answer) {
  std::vector<Row> rows;
  for (const json& c : rows_of(answer, "combinations")) {
    const std::string why = text_in(c, "why");
    rows.push_back({text_in(c, "choices"), digits_text(number_in(c, "budget"), 9), Cell(why, !why.empty())});
  }
  if (rows.empty()) return {"combinations", "", ""};
  return section_of("combinations", "Choices", "Combinations of choices",
                    html_table("study-combinations", {"choices", "simulations allowed", ""}, rows));
}

}  // namespace

StudyPart optimize_part(const StudyRecord& record) {
  const json& answer = record.answer;
  const Asked asked = asked_of(record.head);
  StudyPart part;
  part.lead = lead_of(answer);
  part.key_numbers = key_numbers_of(answer);
  part.sections = {layouts_section(answer),     parameters_section(record, asked),
                   history_section(record),     finalists_section(answer),
                   lives_section(answer),       active_section(answer, asked),
                   fidelity_section(record),    pareto_section(record),
                   combinations_section(answer)};
  return part;
}

const StudyPage& layout_search_page() {
  static constexpr StudyPage page{
      "optimize",
      "Layout search",
      "which layout is the best within its limits",
      optimize_part,
      false,
      "A layout that fails counts as one that breaks its limits, and the search goes on elsewhere."};
  return page;
}

}  // namespace beltlife
