// The part of a page that is of elementary effects: their sizes, and sizes against scatter; see study_parts.h.
#include "studies/morris/morris_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr std::size_t most_charts = 12, told_quantities = 4;
constexpr double worth_a_name = 0.03;  // of the largest: names of lesser ones would lie upon each other

/// What a parameter does, with its name.
struct Effects : ParameterEffects {
  std::string name;

  bool is_noise() const { return within_noise.value_or(false); }
};

/// Largest first; what has no number comes last.
std::vector<Effects> effects_of(const StudyRecord& record, const MorrisAnswer& answer, const std::string& quantity) {
  std::vector<Effects> all;
  const auto found = answer.quantities.find(quantity);
  if (found == answer.quantities.end()) return all;
  for (const std::string& name : record.head.parameters)
    if (const auto e = found->second.find(name); e != found->second.end()) all.push_back({e->second, name});
  const auto size = [](const Effects& e) { return std::isfinite(e.mu_star) ? e.mu_star : -1; };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
  return all;
}

std::string lead_of(const StudyRecord& record, const MorrisAnswer& answer) {
  std::string words = error_words(answer);
  std::size_t told = 0;
  for (const std::string& q : record.head.quantities) {
    const std::vector<Effects> all = effects_of(record, answer, q);
    if (all.empty() || !(all[0].mu_star > 0)) continue;
    if (told++ == told_quantities) break;
    const std::string unit = unit_of_name(q);
    words += fmt::format("To {} <strong>{}</strong> matters most: &mu;* = {}{}", html_escaped(q),
                         html_escaped(all[0].name), digits_text(all[0].mu_star), unit.empty() ? "" : " " + unit);
    if (all.size() > 1 && all[1].mu_star > 0)
      words += fmt::format(", then {} ({})", html_escaped(all[1].name), digits_text(all[1].mu_star));
    const auto noise = std::count_if(all.begin(), all.end(), [](const Effects& e) { return e.is_noise(); });
    if (noise > 0) words += fmt::format("; {} of {} do no more than noise", noise, all.size());
    words += ". ";
  }
  return words.empty() ? "No parameter has an effect. " : words;
}

std::string table_of(const std::string& id, const std::string& quantity, const std::vector<Effects>& all,
                     int trajectories) {
  const std::string unit = unit_of_name(quantity).empty() ? "" : ", " + unit_of_name(quantity);
  const bool floor = std::any_of(all.begin(), all.end(), [](const Effects& e) { return e.noise_floor.has_value(); });
  Row header{"parameter", "μ*" + unit, "its error", "μ" + unit, "σ" + unit, "σ/μ*", "effects"};
  if (floor) header.insert(header.end(), {"of noise", "verdict"});
  std::vector<Row> rows;
  for (const Effects& e : all) {
    Row row{e.name,
            digits_text(e.mu_star, 4),
            digits_text(e.mu_star_error, 2),
            digits_text(e.mu, 4),
            digits_text(e.sigma, 4),
            e.mu_star > 0 ? digits_text(e.sigma / e.mu_star, 2) : "no effect",
            Cell(std::to_string(e.effects), e.effects < trajectories)};
    if (floor) {
      row.push_back(e.noise_floor ? digits_text(*e.noise_floor, 2) : "no effect is left");
      row.push_back(!e.noise_floor ? "none" : e.is_noise() ? "no more than noise" : "above noise");
    }
    rows.push_back(std::move(row));
  }
  return html_table(id, header, rows);
}

/// Names where no name of a larger effect stands already.
std::vector<std::string> names_of(const std::vector<Effects>& all) {
  double x = 0, y = 0;
  for (const Effects& e : all) x = e.mu_star > x ? e.mu_star : x, y = e.sigma > y ? e.sigma : y;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto near = [&](std::size_t k) {
      return !names[k].empty() && std::abs(all[k].mu_star - all[i].mu_star) < 0.35 * x &&
             std::abs(all[k].sigma - all[i].sigma) < 0.05 * y;
    };
    bool free = all[i].mu_star > worth_a_name * x || all[i].sigma > worth_a_name * y;
    for (std::size_t k = 0; k < i; ++k) free = free && !near(k);
    names.push_back(free ? all[i].name : "");
  }
  return names;
}

std::string plane_of(const std::string& id, const std::string& quantity, const std::vector<Effects>& all) {
  const std::string unit = unit_of_name(quantity).empty() ? "" : ", " + unit_of_name(quantity);
  MarkedChart chart{id, "", "μ*" + unit, "σ" + unit};
  MarkedChart::Series marks, noise, equal;
  const bool marked = std::any_of(all.begin(), all.end(), [](const Effects& e) { return e.is_noise(); });
  if (marked) marks.label = "above noise", noise.label = "no more than noise";
  marks.colour = safe_colour(0), noise.colour = "#888888", equal.colour = "#666666";
  noise.mark = 6;
  marks.dash = noise.dash = 0, marks.size = noise.size = 1.4;
  const std::vector<std::string> names = names_of(all);
  double x = 0, y = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    MarkedChart::Series& s = all[i].is_noise() ? noise : marks;
    s.x.push_back(all[i].mu_star);
    s.y.push_back(all[i].sigma);
    s.names.push_back(names[i]);
    x = all[i].mu_star > x ? all[i].mu_star : x, y = all[i].sigma > y ? all[i].sigma : y;
  }
  chart.series = {std::move(marks), std::move(noise)};
  if (const double end = std::min(x, y); end > 0) {
    equal.label = "σ = μ*", equal.mark = 0, equal.dash = 2;
    equal.x = equal.y = {0, end};
    chart.series.push_back(std::move(equal));
  }
  return svg_of(chart);
}

}  // namespace

StudyPart morris_part(const StudyRecord& record, const MorrisAnswer& answer) {
  StudyPart part;
  part.lead = lead_of(record, answer);
  const int trajectories = answer.trajectories;
  part.key_numbers = {{"parameters", std::to_string(record.head.parameters.size())},
                      {"trajectories", std::to_string(trajectories)},
                      {"levels", std::to_string(answer.levels)}};
  std::string html;
  std::size_t index = 0;
  for (const std::string& q : record.head.quantities) {
    const std::vector<Effects> all = effects_of(record, answer, q);
    if (all.empty()) continue;
    html += fmt::format("<h3>{}</h3>\n", html_escaped(q));
    if (index < most_charts)
      html += "<div style=\"max-width:600px\">" + plane_of(fmt::format("plane-{}", index), q, all) + "</div>\n";
    html += table_of(fmt::format("study-effects-{}", index++), q, all, trajectories);
  }
  if (html.empty()) return part;
  part.sections.push_back(
      {"effects", "Effects",
       "<section id=\"effects\"><h2>Elementary effects</h2>\n<p>Each is for the whole range of its parameter. &mu;* is "
       "the mean of their magnitudes: how much a parameter matters. &mu; is their mean: where it is much less than "
       "&mu;*, effects have both signs. &sigma; is their scatter: above the dashed line, curvature or other "
       "parameters decide what this one does. Names of small effects are in the table alone.</p>\n" +
           html + "</section>\n"});
  return part;
}

}  // namespace beltlife
