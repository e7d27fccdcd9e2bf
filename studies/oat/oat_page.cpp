// The part of a page that is of one change at a time: verdicts beside what was said, effects; see study_parts.h.
#include "studies/oat/oat_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr std::size_t most_bars = 24, most_charts = 8;
constexpr double least_db = -200;  // stands for a quantity that is gone or has changed its sign

using Changes = std::vector<ChangeAnswer>;
using Variants = std::vector<VariantAnswer>;

/// What a verdict is about: its name, the verdict, what was said of it, and whether both agree.
struct Aspect {
  const char* name;
  std::optional<std::string> ChangeAnswer::*verdict;
  std::optional<std::string> ChangeAnswer::*says;
  std::optional<bool> ChangeAnswer::*agrees;
};
constexpr Aspect aspects[] = {
    {"magnitude", &ChangeAnswer::magnitude, &ChangeAnswer::says_magnitude, &ChangeAnswer::agrees_magnitude},
    {"frequency", &ChangeAnswer::frequency, &ChangeAnswer::says_frequency, &ChangeAnswer::agrees_frequency}};

struct ShownEffect {
  double db = NAN, factor = NAN;  ///< of lives the factor, of all others dB
  double change = NAN;            ///< relative
  bool noise = false, responses = false;

  double size() const { return std::isfinite(factor) && factor > 0 ? std::abs(20 * std::log10(factor)) : std::abs(db); }
};

ShownEffect effect_of(const ChangeAnswer& row, const std::string& quantity) {
  const auto at = row.effects.find(quantity);
  if (at == row.effects.end()) return {};
  const ChangeEffect& e = at->second;
  const double db = e.db.value_or(NAN);
  return {db > least_db ? db : NAN, e.life_factor.value_or(NAN), e.change, !e.beyond_noise,
          e.responses_before > 1 || e.responses_after > 1};
}

bool failed(const ChangeAnswer& row) { return row.failure.has_value(); }

std::string effect_text(const ShownEffect& e) {
  std::string text = "none";
  if (std::isfinite(e.factor))
    text = digits_text(e.factor);
  else if (std::isfinite(e.db))
    text = std::abs(e.db) < 0.005 ? "0.00" : fmt::format("{:+.2f}", e.db);
  else if (std::isfinite(e.change) && e.change != 0)
    text = fmt::format("{:+.0f} %", 100 * e.change);
  return text == "none" ? text : text + (e.noise ? " n" : "") + (e.responses ? " c" : "");
}

/// Quantities of which some row has an effect, in the study's order.
std::vector<std::string> quantities_of(const StudyRecord& record, const Changes& changes) {
  std::vector<std::string> names;
  for (const std::string& q : record.head.quantities)
    if (std::any_of(changes.begin(), changes.end(), [&](const ChangeAnswer& row) { return row.effects.contains(q); }))
      names.push_back(q);
  return names;
}

bool is_life(const Changes& changes, const std::string& q) {
  return std::any_of(changes.begin(), changes.end(),
                     [&](const ChangeAnswer& row) { return std::isfinite(effect_of(row, q).factor); });
}

bool says(const Changes& changes, const Aspect& aspect) {
  return std::any_of(changes.begin(), changes.end(),
                     [&](const ChangeAnswer& row) { return (row.*aspect.says).has_value(); });
}

struct Largest {
  std::string change, quantity, variant;
  ShownEffect effect;
};

/// Among lives or among all others; noise moves nothing.
Largest largest(const StudyRecord& record, const Variants& variants, bool of_life) {
  Largest most;
  for (const VariantAnswer& variant : variants)
    for (const ChangeAnswer& row : variant.changes)
      for (const std::string& q : record.head.quantities)
        if (const ShownEffect e = effect_of(row, q);
            !e.noise && std::isfinite(e.factor) == of_life && e.size() > (most.change.empty() ? 0 : most.effect.size()))
          most = {row.name, q, variant.name, e};
  return most;
}

std::string lead_of(const StudyRecord& record, const OatAnswer& answer) {
  const Variants& variants = answer.variants;
  std::string words = error_words(answer);
  std::int64_t said = 0, agreed = 0;
  std::size_t lost = 0;
  for (const VariantAnswer& variant : variants) {
    said += variant.said;
    agreed += variant.agreed;
    for (const ChangeAnswer& row : variant.changes) lost += failed(row);
  }
  if (said > 0) words += fmt::format("<strong>{} of {}</strong> verdicts agree with what was said. ", agreed, said);
  const auto where = [&](const Largest& l) {
    return html_escaped(variants.size() > 1 ? fmt::format(" ({}, {})", l.quantity, l.variant)
                                            : fmt::format(" ({})", l.quantity));
  };
  const Largest most = largest(record, variants, false), life = largest(record, variants, true);
  if (!most.change.empty())
    words += fmt::format("What moves most is <em>{}</em>: by <strong>{:+.1f} dB</strong>{}. ",
                         html_escaped(most.change), most.effect.db, where(most));
  if (!life.change.empty())
    words += fmt::format("Life changes most with <em>{}</em>: by a factor of <strong>{}</strong>{}. ",
                         html_escaped(life.change), digits_text(life.effect.factor), where(life));
  if (most.change.empty() && life.change.empty() && words.empty()) words = "No change does more than the noise. ";
  if (lost > 0)
    words += fmt::format("<span class=\"alarm\">{} could not be judged.</span> ", count_text(lost, "change"));
  return words;
}

std::string verdicts_of(const std::string& id, const Changes& changes) {
  const bool peaks =
      std::any_of(changes.begin(), changes.end(), [](const ChangeAnswer& r) { return r.peak.has_value(); });
  Row header{"change"};
  for (const Aspect& aspect : aspects) {
    header.push_back(aspect.name);
    if (says(changes, aspect)) header.insert(header.end(), {"said of it", "agrees"});
  }
  if (peaks) header.push_back("peak");
  std::vector<Row> rows;
  for (const ChangeAnswer& row : changes) {
    Row cells{row.name};
    const auto word = [&](const std::optional<std::string>& verdict) {
      return failed(row) ? Cell("failed", true) : Cell(verdict.value_or("not looked at"));
    };
    for (const Aspect& aspect : aspects) {
      cells.push_back(word(row.*aspect.verdict));
      if (!says(changes, aspect)) continue;
      const auto agrees = row.*aspect.agrees;
      cells.push_back((row.*aspect.says).value_or("nothing"));
      cells.push_back(agrees ? Cell(*agrees ? "yes" : "no", !*agrees) : Cell(""));
    }
    if (peaks) cells.push_back(word(row.peak));
    rows.push_back(std::move(cells));
  }
  return html_table(id, header, rows);
}

/// Names of quantities are long: numbers stand for them in the header.
std::string effects_of(const std::string& id, const Changes& changes, const std::vector<std::string>& quantities) {
  Row header{"change"};
  for (std::size_t i = 0; i < quantities.size(); ++i) header.push_back(fmt::format("({})", i + 1));
  std::vector<Row> rows;
  for (const ChangeAnswer& row : changes) {
    if (failed(row)) continue;
    Row cells{row.name};
    for (const std::string& q : quantities) cells.push_back(effect_text(effect_of(row, q)));
    rows.push_back(std::move(cells));
  }
  return html_table(id, header, rows);
}

std::string legend_of(const Changes& changes, const std::vector<std::string>& quantities) {
  std::string list;
  for (std::size_t i = 0; i < quantities.size(); ++i)
    list += fmt::format("{}({}) {}, {}", i > 0 ? "; " : "", i + 1, html_escaped(quantities[i]),
                        is_life(changes, quantities[i]) ? "factor on the life" : "dB");
  return list.empty() ? "" : "<p>" + list + ". n: within the noise; c: several steady responses coexist.</p>\n";
}

/// One quantity over the changes, largest first.
std::string tornado_of(const std::string& id, const Changes& changes, const std::string& quantity) {
  const bool life = is_life(changes, quantity);
  std::vector<std::pair<std::string, ShownEffect>> bars;
  for (const ChangeAnswer& row : changes)
    if (const ShownEffect e = effect_of(row, quantity); life ? e.factor > 0 : std::isfinite(e.db))
      bars.emplace_back(row.name, e);
  std::stable_sort(bars.begin(), bars.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  if (bars.size() > most_bars) bars.resize(most_bars);
  Bars chart{id, life ? "factor on the life" : "change, dB", {}, {{"", {}}}, life, life ? 1.0 : 0.0};
  for (const auto& [name, e] : bars) {
    chart.rows.push_back(name);
    chart.layers[0].values.push_back(life ? e.factor : e.db);
    chart.layers[0].pale.push_back(e.noise);
  }
  const std::string svg = svg_of(chart);
  return svg.empty() ? "" : "<div><h3>" + html_escaped(quantity) + "</h3>\n" + svg + "</div>\n";
}

std::string failures_of(const Changes& changes) {
  std::string list;
  for (const ChangeAnswer& row : changes)
    if (failed(row)) list += "<li>" + html_escaped(row.name) + ": " + html_escaped(*row.failure) + "</li>\n";
  return list.empty() ? "" : "<p>Not judged, because a side has no point that is ok:</p>\n<ul>" + list + "</ul>\n";
}

Section variant_section(const StudyRecord& record, const VariantAnswer& variant, std::size_t index) {
  const Changes& changes = variant.changes;
  const std::string id = fmt::format("changes-{}", index);
  if (changes.empty()) return {id, "", ""};
  const std::vector<std::string> quantities = quantities_of(record, changes);
  std::string name = variant.name;
  if (name.empty()) name = fmt::format("Variant {}", index + 1);
  std::string html = fmt::format("<section id=\"{}\"><h2>{}</h2>\n", id, html_escaped(name));
  if (variant.said > 0)
    html += fmt::format("<p>{} of {} verdicts agree with what was said.</p>\n", variant.agreed, variant.said);
  html += verdicts_of(fmt::format("study-verdicts-{}", index), changes) + failures_of(changes);
  if (!quantities.empty())
    html += effects_of(fmt::format("study-effects-{}", index), changes, quantities) + legend_of(changes, quantities);
  std::string charts;
  // The first of them, but lives in any case: they are what the other quantities are looked at for.
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (i < most_charts || is_life(changes, quantities[i]))
      charts += tornado_of(fmt::format("tornado-{}-{}", index, i), changes, quantities[i]);
  if (!charts.empty())
    html += fmt::format(
        "<details{}><summary>Charts: effects by size</summary>\n<p>Grey: within the noise.{}{}</p>\n<div "
        "class=\"charts\">{}</div></details>\n",
        index == 0 ? " open" : "",
        quantities.size() > most_charts ? fmt::format(" The first {} quantities, and lives.", most_charts) : "",
        changes.size() > most_bars ? fmt::format(" The {} changes that move most.", most_bars) : "", charts);
  return {id, name, html + "</section>\n"};
}

std::string variants_section(const StudyRecord& record, const Variants& variants) {
  std::vector<Row> rows;
  for (const VariantAnswer& variant : variants) {
    const Largest most = largest(record, {variant}, false);
    rows.push_back({variant.name, std::to_string(variant.agreed), std::to_string(variant.said),
                    variant.said > 0
                        ? percent_text(static_cast<double>(variant.agreed) / static_cast<double>(variant.said), 3)
                        : "nothing was said",
                    most.change.empty() ? "none beyond noise" : fmt::format("{:+.2f}", most.effect.db), most.change});
  }
  return "<section id=\"variants\"><h2>Variants</h2>\n" +
         html_table("study-variants", {"variant", "agree", "of", "%", "largest dB", "by"}, rows) + "</section>\n";
}

}  // namespace

StudyPart oat_part(const StudyRecord& record, const OatAnswer& answer) {
  StudyPart part;
  part.lead = lead_of(record, answer);
  part.key_numbers = {{"crank phases a side", std::to_string(answer.replicates)},
                      {"visible from, %", percent_text(answer.visible)}};
  if (answer.variants.size() > 1)
    part.sections.push_back({"variants", "Variants", variants_section(record, answer.variants)});
  for (std::size_t i = 0; i < answer.variants.size(); ++i)
    part.sections.push_back(variant_section(record, answer.variants[i], i));
  return part;
}

}  // namespace beltlife
