// The part of a page that is of noise: scatter by quantity, and steady responses that coexist; see study_parts.h.
#include "studies/noise/noise_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr std::size_t most_bars = 40;

struct Noise {
  std::string name;
  std::size_t column = 0;  ///< of the points' values
  const QuantityNoise* answer = nullptr;
  double replicates = not_known, range = not_known, hair = not_known, differences = not_known;  ///< shares of the value
  std::size_t responses() const { return answer->responses ? answer->responses->size() : 0; }
};

/// In the study's order; a quantity without an answer is left out.
std::vector<Noise> noises_of(const StudyRecord& record, const NoiseAnswer& answer) {
  std::vector<Noise> all;
  for (std::size_t q = 0; q < record.head.quantities.size(); ++q) {
    const auto at = answer.quantities.find(record.head.quantities[q]);
    if (at == answer.quantities.end()) continue;
    const QuantityNoise& found = at->second;
    Noise n{record.head.quantities[q], q, &found};
    if (found.replicates) {
      n.replicates = found.replicates->relative;
      n.range = found.value == 0 ? 0 : (found.replicates->max - found.replicates->min) / std::abs(found.value);
    }
    if (found.perturbation) n.hair = found.perturbation->relative;
    if (found.differences) n.differences = found.differences->relative;
    all.push_back(std::move(n));
  }
  return all;
}

const Noise* largest(const std::vector<Noise>& all, double Noise::*share) {
  const Noise* most = nullptr;
  for (const Noise& n : all)
    if (n.*share > 0 && (!most || n.*share > most->*share)) most = &n;
  return most;
}

std::string strong(double share, const Noise& n) {
  return fmt::format("<strong>{} %</strong> of its value ({})", percent_text(share), html_escaped(n.name));
}

/// What the study found, in sentences.
std::string lead_of(const NoiseAnswer& answer, const std::vector<Noise>& all) {
  if (answer.error) return error_words(answer);
  std::string words;
  if (const Noise* n = largest(all, &Noise::replicates))
    words += "Another crank phase or ramp time moves a quantity by up to " + strong(n->replicates, *n) +
             ", as standard deviation. ";
  if (const Noise* n = largest(all, &Noise::hair))
    words += "A hair's change of the parameters moves one by up to " + strong(n->hair, *n) + ". ";
  const Noise* widest = nullptr;
  const auto step_of = [](const Noise& n) { return n.answer->step_forward; };
  for (const Noise& n : all)
    if (step_of(n) > 0 && (!widest || step_of(n) > step_of(*widest))) widest = &n;
  if (widest)
    words += fmt::format("Forward differences in ln p need steps of up to <strong>{}</strong> ({}). ",
                         digits_text(step_of(*widest), 2), html_escaped(widest->name));
  const auto coexisting = std::count_if(all.begin(), all.end(), [](const Noise& n) { return n.responses() > 1; });
  if (coexisting > 0)
    words += fmt::format(
        "<a class=\"alarm\" href=\"#responses\">Steady responses coexist in {}</a>: which one is "
        "found depends on how the drive was run up. ",
        coexisting == 1 ? "one quantity" : fmt::format("{} quantities", coexisting));
  if (words.empty()) words = "No quantity scatters at all. ";
  return words;
}

std::string table_of(const std::vector<Noise>& all) {
  std::vector<Row> rows;
  for (const Noise& n : all) {
    const auto& line = n.answer->differences;
    rows.push_back({n.name, digits_text(n.answer->value, 5), unit_of_name(n.name), percent_text(n.replicates),
                    percent_text(n.range), percent_text(n.hair), percent_text(n.differences),
                    line ? std::to_string(line->order) : "-", digits_text(n.answer->step_forward, 2),
                    digits_text(n.answer->step_central, 2),
                    Cell(n.responses() > 0 ? std::to_string(n.responses()) : "-", n.responses() > 1)});
  }
  return html_table("study-noise-table",
                    {"quantity", "value", "unit", "replicates %", "their range %", "hair %", "differences %", "order",
                     "step forward", "step central", "responses"},
                    rows);
}

std::string bars_of(std::vector<Noise> all) {
  const auto most = [](const Noise& n) {
    double share = 0;  // not std::max, which may keep a NaN
    for (const double s : {n.replicates, n.hair, n.differences}) share = s > share ? s : share;
    return share;
  };
  std::stable_sort(all.begin(), all.end(), [&](const Noise& a, const Noise& b) { return most(a) > most(b); });
  if (all.size() > most_bars) all.resize(most_bars);
  Bars chart{
      "noise-bars", "scatter, % of the value", {}, {{"replicates", {}}, {"hair", {}}, {"differences", {}}}, true};
  for (const Noise& n : all) {
    chart.rows.push_back(n.name);
    chart.layers[0].values.push_back(100 * n.replicates);
    chart.layers[1].values.push_back(100 * n.hair);
    chart.layers[2].values.push_back(100 * n.differences);
  }
  return svg_of(chart);
}

/// Points that differ from the nominal one at most in crank phase and ramp time.
std::vector<const StudyPoint*> replicates_of(const StudyRecord& record, const NoiseAnswer& answer, std::size_t wanted) {
  const auto nominal =
      std::find_if(record.points.begin(), record.points.end(), [](const StudyPoint& p) { return p.number == 0; });
  if (nominal == record.points.end()) return {};
  std::vector<std::size_t> fixed;
  for (const std::string& name : answer.parameters)
    for (std::size_t i = 0; i < record.head.parameters.size(); ++i)
      if (record.head.parameters[i] == name) fixed.push_back(i);
  std::vector<const StudyPoint*> found;
  for (const StudyPoint& p : record.points)
    if (p.answer.ok() &&
        std::all_of(fixed.begin(), fixed.end(), [&](std::size_t i) { return p.settings[i] == nominal->settings[i]; }))
      found.push_back(&p);
  // The nominal point is a replicate only if its own ramp time is among the factors.
  if (found.size() == wanted + 1 && found.front()->number == 0) found.erase(found.begin());
  return found;
}

/// Replicates over crank phase, a mark for each ramp time, the responses as lines across.
std::string strip_of(const StudyRecord& record, const NoiseAnswer& answer, const Noise& n, std::size_t index) {
  const std::int64_t count = n.answer->replicates ? n.answer->replicates->points : 0;
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(record.head.parameters.begin(), record.head.parameters.end(), name) -
                                    record.head.parameters.begin());
  };
  const std::size_t phase = column("driver.phase_rad"), ramp = column("profile.ramp_s");
  const auto is_number = [](const StudyPoint& p, std::size_t i) {
    return i < p.settings.size() && std::holds_alternative<double>(p.settings[i]);
  };
  std::map<double, MarkedChart::Series> by_ramp;
  for (const StudyPoint* p : replicates_of(record, answer, static_cast<std::size_t>(count))) {
    if (!is_number(*p, phase) || !is_number(*p, ramp) || n.column >= p->answer.values.size()) continue;
    MarkedChart::Series& s = by_ramp[number_of(p->settings[ramp])];
    s.x.push_back(number_of(p->settings[phase]) * 180 / std::numbers::pi);
    s.y.push_back(p->answer.values[n.column]);
  }
  MarkedChart chart{fmt::format("replicates-{}", index), n.name, "crank phase at the start, deg", unit_of_name(n.name)};
  constexpr int marks[] = {7, 5, 9, 11, 13, 6, 4};
  std::size_t i = 0;
  for (auto& [seconds, s] : by_ramp) {
    s.label = fmt::format("ramp {:.3g} s", seconds);
    s.dash = 0;
    s.colour = safe_colour(i);
    s.mark = marks[i++ % std::size(marks)];
    chart.series.push_back(std::move(s));
  }
  int dash = 2;
  for (const SteadyResponse& r : *n.answer->responses) chart.levels.push_back({r.name, r.mean, dash++});
  return svg_of(chart);
}

std::string responses_of(const StudyRecord& record, const NoiseAnswer& answer, const std::vector<Noise>& all) {
  std::string charts, words;
  std::size_t index = 0;
  for (const Noise& n : all) {
    if (n.responses() < 2) continue;
    words += "<li>" + html_escaped(n.name) + ": ";
    std::string list;
    for (const SteadyResponse& r : *n.answer->responses)
      list +=
          fmt::format("{}<strong>{}</strong> near {} {} ({} replicates)", list.empty() ? "" : "; ",
                      html_escaped(r.name), digits_text(r.mean, 5), html_escaped(unit_of_name(n.name)), r.replicates);
    words += list + "</li>\n";
    charts += strip_of(record, answer, n, index++);
  }
  if (words.empty()) return "";
  return "<section id=\"responses\"><h2>Steady responses that coexist</h2>\n"
         "<p>Replicates fall into groups that lie much further apart than each is wide. They differ in nothing but "
         "crank phase and ramp time.</p>\n<ul>" +
         words + "</ul>\n<div class=\"charts\">" + charts + "</div></section>\n";
}

}  // namespace

StudyPart noise_part(const StudyRecord& record, const NoiseAnswer& answer) {
  const std::vector<Noise> all = noises_of(record, answer);
  StudyPart part;
  part.lead = lead_of(answer, all);
  if (!answer.parameters.empty()) {
    std::string list;
    for (const std::string& name : answer.parameters) list += (list.empty() ? "" : ", ") + name;
    part.key_numbers.push_back({"perturbed by a hair", list});
  }
  part.key_numbers.push_back({"quantities", std::to_string(all.size())});
  if (all.empty()) return part;
  std::string html =
      "<section id=\"noise\"><h2>Scatter by quantity</h2>\n<p>Replicates differ in crank phase and ramp time; hairs in "
      "the last digits of the parameters; differences are the noise along a short line, by the order of the "
      "difference table (order 0: none is reliable, and the number is no more than a bound). Steps are relative "
      "changes of a parameter for forward and central differences. All shares are standard deviations.</p>\n";
  const std::string bars = bars_of(all);
  html += bars.empty() ? "<p>No scatter is above zero.</p>\n" : bars;
  if (!bars.empty() && all.size() > most_bars)
    html += fmt::format("<p>The {} quantities that scatter most; the table has all.</p>\n", most_bars);
  part.sections.push_back({"noise", "Scatter", html + table_of(all) + "</section>\n"});
  part.sections.push_back({"responses", "Responses", responses_of(record, answer, all)});
  return part;
}

}  // namespace beltlife
