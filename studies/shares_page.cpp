// Shares of a variance on pages: see shares_page.h.
#include "studies/shares_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/pages/study/study_charts.h"

namespace beltlife {
namespace {

constexpr std::size_t most_bars = 30, most_charts = 12, told_quantities = 4;

std::string bars_of(const std::string& id, std::vector<ParameterShares> all) {
  if (all.size() > most_bars) all.resize(most_bars);
  Bars chart{id, "share of the variance", {}, {{"alone", {}}, {"with interactions", {}}}, false, 0.0};
  for (const ParameterShares& i : all) {
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

std::string table_of(const std::string& id, const std::vector<ParameterShares>& all, const Estimate& sum) {
  const bool intervals =
      std::any_of(all.begin(), all.end(), [](const ParameterShares& i) { return std::isfinite(i.total.low); });
  const auto ends = [](const Estimate& s) {
    return std::isfinite(s.low) ? fmt::format("{:.3f} to {:.3f}", s.low, s.high) : std::string("none");
  };
  const auto number = [](double v) { return html_number(v, 3); };
  Row header = intervals ? Row{"parameter", "alone", "interval", "with interactions", "interval"}
                         : Row{"parameter", "alone", "with interactions"};
  std::vector<Row> rows;
  for (const ParameterShares& i : all)
    rows.push_back(intervals ? Row{i.name, number(i.first.value), ends(i.first), number(i.total.value), ends(i.total)}
                             : Row{i.name, number(i.first.value), number(i.total.value)});
  if (std::isfinite(sum.value))
    rows.push_back(intervals ? Row{"sum", number(sum.value), ends(sum), "", ""} : Row{"sum", number(sum.value), ""});
  return html_table(id, header, rows);
}

}  // namespace

void sort_by_total(std::vector<ParameterShares>& all) {
  const auto size = [](const ParameterShares& s) { return std::isfinite(s.total.value) ? s.total.value : -1e9; };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
}

std::string shares_in_words(const std::vector<SharedQuantity>& quantities) {
  std::string words;
  std::size_t told = 0;
  for (const auto& [q, all, sum, about] : quantities) {
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

std::string shares_html(const std::vector<SharedQuantity>& quantities) {
  std::string html;
  std::size_t index = 0;
  for (const auto& [name, all, sum, about] : quantities) {
    html += fmt::format("<h3>{}</h3>\n<p>{}</p>\n", html_escaped(name), about);
    if (all.empty()) {
      html += "<p>It does not vary, or too few points are ok: no shares.</p>\n";
      continue;
    }
    if (index < most_charts) html += bars_of(fmt::format("shares-{}", index), all);
    html += table_of(fmt::format("study-shares-{}", index++), all, sum);
  }
  return html;
}

}  // namespace beltlife
