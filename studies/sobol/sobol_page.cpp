// The parts of pages that are of shares of the variance, sampled or by a surrogate; see study_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"
#include "studies/pages.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr std::size_t most_bars = 30, most_charts = 12, told_quantities = 4;
constexpr double usable_q2 = 0.9;

/// A share, with an interval or as a mere number.
struct Share {
  double value = NAN, low = NAN, high = NAN;
};

Share share_of(const json& shares, const std::string& name) {
  const json& j = part_of(shares, name);
  if (j.is_number()) return {j.get<double>()};
  return {number_in(j, "value"), number_in(j, "low"), number_in(j, "high")};
}

struct Indices {
  std::string name;
  Share first, total;
};

/// Largest total first.
std::vector<Indices> indices_of(const StudyRecord& record, const json& quantity) {
  std::vector<Indices> all;
  for (const std::string& name : record.head.parameters) {
    Indices i{name, share_of(part_of(quantity, "first"), name), share_of(part_of(quantity, "total"), name)};
    if (std::isfinite(i.first.value) || std::isfinite(i.total.value)) all.push_back(std::move(i));
  }
  const auto size = [](const Indices& i) { return std::isfinite(i.total.value) ? i.total.value : -1e9; };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
  return all;
}

const json& quantity_in(const StudyRecord& record, const std::string& name) {
  return part_of(part_of(record.answer, "quantities"), name);
}

/// Which parameter has the largest share of what, for the first quantities.
std::string shares_in_words(const StudyRecord& record) {
  std::string words;
  std::size_t told = 0;
  for (const std::string& q : record.head.quantities) {
    const std::vector<Indices> all = indices_of(record, quantity_in(record, q));
    if (all.empty() || !(all[0].total.value > 0)) continue;
    if (told++ == told_quantities) break;
    words += fmt::format("Of the variance of {} <strong>{} %</strong> goes with <strong>{}</strong>", html_escaped(q),
                         percent_text(all[0].total.value), html_escaped(all[0].name));
    if (all.size() > 1 && all[1].total.value > 0)
      words += fmt::format(", {} % with {}", percent_text(all[1].total.value), html_escaped(all[1].name));
    words += ". ";
  }
  return words;
}

std::string bars_of(const std::string& id, std::vector<Indices> all) {
  if (all.size() > most_bars) all.resize(most_bars);
  Bars chart{id, "share of the variance", {}, {{"alone", {}}, {"with interactions", {}}}, false, 0.0};
  for (const Indices& i : all) {
    chart.rows.push_back(i.name);
    for (const auto& [layer, share] : {std::pair{&chart.layers[0], &i.first}, std::pair{&chart.layers[1], &i.total}}) {
      layer->values.push_back(share->value);
      layer->low.push_back(share->low);
      layer->high.push_back(share->high);
    }
  }
  const std::string svg = svg_of(chart);
  return svg.empty() ? "" : "<div style=\"max-width:600px\">" + svg + "</div>\n";
}

std::string table_of(const std::string& id, const std::vector<Indices>& all, const Share& sum) {
  const bool intervals =
      std::any_of(all.begin(), all.end(), [](const Indices& i) { return std::isfinite(i.total.low); });
  const auto ends = [](const Share& s) {
    return std::isfinite(s.low) ? fmt::format("{:.3f} to {:.3f}", s.low, s.high) : std::string("-");
  };
  const auto number = [](double v) { return html_number(v, 3); };
  Row header = intervals ? Row{"parameter", "alone", "interval", "with interactions", "interval"}
                         : Row{"parameter", "alone", "with interactions"};
  std::vector<Row> rows;
  for (const Indices& i : all)
    rows.push_back(intervals ? Row{i.name, number(i.first.value), ends(i.first), number(i.total.value), ends(i.total)}
                             : Row{i.name, number(i.first.value), number(i.total.value)});
  if (std::isfinite(sum.value))
    rows.push_back(intervals ? Row{"sum", number(sum.value), ends(sum), "-", "-"} : Row{"sum", number(sum.value), "-"});
  return html_table(id, header, rows);
}

std::string convergence_of(const StudyRecord& record, const json& q) {
  const double width = number_in(q, "widest_interval"), wanted = number_in(record.answer, "convergence_width"),
               needed = number_in(q, "samples_needed");
  if (!std::isfinite(width)) return "";
  const bool converged = flag_in(q, "converged");
  std::string words =
      fmt::format("{}: the widest interval of a share with interactions, that of {}, is {} wide; {} is asked for.",
                  converged ? "Converged" : "<span class=\"alarm\">Not converged</span>",
                  html_escaped(text_in(q, "widest_parameter")), digits_text(width, 2), digits_text(wanted, 2));
  if (!converged && needed > 0)
    words += fmt::format(" About {:.0f} samples ({:.0f} points) would be needed: widths shrink with the root.", needed,
                         needed * static_cast<double>(record.head.parameters.size() + 2));
  return words;
}

constexpr const char* about_shares =
    "Alone: the share of the variance that goes with this parameter whatever the others are. With interactions: also "
    "what it does together with others; where the two differ, parameters interact.";

/// Chart and table of every quantity, `words_of` before them.
template <class Words>
std::string quantities_html(const StudyRecord& record, const Words& words_of) {
  std::string html;
  std::size_t index = 0;
  for (const std::string& name : record.head.quantities) {
    const json& q = quantity_in(record, name);
    if (!q.is_object()) continue;
    html += fmt::format("<h3>{}</h3>\n<p>{}</p>\n", html_escaped(name), words_of(name, q));
    const std::vector<Indices> all = indices_of(record, q);
    if (all.empty()) {
      html += "<p>It does not vary, or too few points are ok: no shares.</p>\n";
      continue;
    }
    if (index < most_charts) html += bars_of(fmt::format("shares-{}", index), all);
    html += table_of(fmt::format("study-shares-{}", index++), all, share_of(q, "sum_first"));
  }
  return html;
}

}  // namespace

StudyPart sobol_part(const StudyRecord& record) {
  StudyPart part;
  part.lead = error_words(record.answer) + shares_in_words(record);
  std::size_t judged = 0, converged = 0;
  for (const std::string& name : record.head.quantities) {
    const json& q = quantity_in(record, name);
    if (!std::isfinite(number_in(q, "widest_interval"))) continue;
    ++judged;
    converged += flag_in(q, "converged");
  }
  if (judged > 0)
    part.lead +=
        converged == judged ? std::string(judged == 1 ? "It has converged. " : "All quantities have converged. ")
        : judged == 1       ? std::string("<a class=\"alarm\" href=\"#shares\">It has not converged</a>. ")
                      : fmt::format("<a class=\"alarm\" href=\"#shares\">{} of {} quantities {} not converged</a>. ",
                                    judged - converged, judged, judged - converged == 1 ? "has" : "have");
  const double rows = number_in(record.answer, "rows"), used = number_in(record.answer, "rows_used");
  part.key_numbers = {{"base rows", digits_text(rows, 9)},
                      {"of them used", Cell(digits_text(used, 9), used < rows)},
                      {"confidence, %", digits_text(100 * number_in(record.answer, "confidence"))}};
  const std::string html = quantities_html(record, [&](const std::string& name, const json& q) {
    const std::string unit = html_escaped(unit_of_name(name));
    return fmt::format("Mean {}, standard deviation {}{}. {}", digits_text(number_in(q, "mean"), 5),
                       digits_text(std::sqrt(number_in(q, "variance"))), unit.empty() ? "" : " " + unit,
                       convergence_of(record, q));
  });
  if (!html.empty())
    part.sections.push_back({"shares", "Shares of the variance",
                             "<section id=\"shares\"><h2>Shares of the variance</h2>\n<p>" + std::string(about_shares) +
                                 " Whiskers are intervals by the bootstrap.</p>\n" + html + "</section>\n"});
  return part;
}

StudyPart surrogate_part(const StudyRecord& record) {
  StudyPart part;
  std::vector<Row> rows;
  std::size_t judged = 0, poor = 0;
  for (const std::string& name : record.head.quantities) {
    const json& q = quantity_in(record, name);
    const double q2 = number_in(q, "q2"), predicted = number_in(part_of(q, "nominal"), "predicted"),
                 simulated = number_in(part_of(q, "nominal"), "simulated");
    if (!q.is_object()) continue;
    const bool bad = q2 < usable_q2;
    judged += std::isfinite(q2);
    poor += bad;
    rows.push_back({name, Cell(html_number(q2, 4), bad), digits_text(number_in(q, "terms"), 6),
                    digits_text(predicted, 6), digits_text(simulated, 6), digits_text(predicted - simulated, 2),
                    unit_of_name(name)});
  }
  part.lead = error_words(record.answer) + shares_in_words(record);
  if (poor > 0)
    part.lead += fmt::format(
        "<a class=\"alarm\" href=\"#surrogate\">The surrogate of {} foretells less than {} % of the variance</a>: do "
        "not rely on its shares. ",
        poor == 1 ? std::string("one quantity") : fmt::format("{} quantities", poor), 100 * usable_q2);
  else if (judged > 0)
    part.lead +=
        fmt::format("The surrogate foretells at least {} % of the variance of what it has not seen. ", 100 * usable_q2);
  const double samples = number_in(record.answer, "samples"), used = number_in(record.answer, "samples_used");
  part.key_numbers = {{"method", text_in(record.answer, "method")},
                      {"samples", digits_text(samples, 9)},
                      {"of them used", Cell(digits_text(used, 9), used < samples)}};
  if (!rows.empty())
    part.sections.push_back(
        {"surrogate", "Surrogate",
         "<section id=\"surrogate\"><h2>How good the surrogate is</h2>\n<p>Q&sup2; is the share of the variance that "
         "is foretold at points left out in turn; below 0.9 it is not usable. The nominal point was not learnt "
         "from.</p>\n" +
             html_table("study-surrogate",
                        {"quantity", "Q²", "coefficients", "nominal foretold", "simulated", "difference", "unit"},
                        rows) +
             "</section>\n"});
  const std::string html = quantities_html(record, [](const std::string&, const json& q) {
    const double q2 = number_in(q, "q2");
    return fmt::format("Q&sup2; = <span{}>{}</span>.", q2 < usable_q2 ? " class=\"alarm\"" : "", html_number(q2, 4));
  });
  if (!html.empty())
    part.sections.push_back({"shares", "Shares of the variance",
                             "<section id=\"shares\"><h2>Shares of the variance</h2>\n<p>" + std::string(about_shares) +
                                 " They are the surrogate's; its own error is not in them.</p>\n" + html +
                                 "</section>\n"});
  return part;
}

}  // namespace beltlife
