// The part of a page that is of calibration: values and how far they are known, fits, residuals; see study_parts.h.
#include "calibrate/pages/calibrate_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/pages/calibrate_charts.h"
#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"
#include "sim/eval/student_t.h"

namespace beltlife {
namespace {

using nlohmann::json;

constexpr double alarming_residual = 3, alarming_correlation = 0.9;

FittedParameter parameter_of(const std::string& name, const json& j) {
  FittedParameter p{name, text_in(j, "identified"), text_in(j, "at_bound")};
  p.value = number_in(j, "value");
  p.standard_error = number_in(j, "standard_error");
  p.low = number_in(j, "low");
  p.high = number_in(j, "high");
  p.start = number_in(j, "start");
  p.lower = number_in(j, "lower");
  p.upper = number_in(j, "upper");
  const json& profile = part_of(j, "profile");
  p.profile_low = number_in(profile, "low");
  p.profile_high = number_in(profile, "high");
  p.profile_value = numbers_of_list(part_of(profile, "value"));
  p.profile_cost = numbers_of_list(part_of(profile, "cost"));
  return p;
}

/// In the study's order; the answer has them by name.
std::vector<FittedParameter> parameters_of(const StudyRecord& record) {
  std::vector<FittedParameter> all;
  const json& given = part_of(record.answer, "parameters");
  for (const std::string& name : record.head.parameters)
    if (const json& j = part_of(given, name); j.is_object()) all.push_back(parameter_of(name, j));
  return all;
}

std::string confidence_text(const json& answer) {
  const double confidence = number_in(answer, "confidence");
  return confidence > 0 ? digits_text(100 * confidence) + " %" : "interval";
}

std::string percent_change(double share) { return std::isfinite(share) ? fmt::format("{:+.1f}", 100 * share) : "-"; }

std::string range_text(double low, double high) {
  return std::isnan(low) && std::isnan(high) ? "-" : digits_text(low) + " to " + digits_text(high);
}

/// A word of the answer that alarms unless it is the good one.
Cell flag_cell(const std::string& word, const char* good) {
  return word.empty() ? Cell("-") : Cell(word, word != good);
}

/// A chart that stands alone would be as wide as the page.
std::string single_chart(const std::string& svg) {
  return svg.empty() ? "" : "<div style=\"max-width:600px\">" + svg + "</div>\n";
}

bool beyond_thesis(const json& row) {
  return std::abs(number_in(row, "calibrated_error")) > number_in(row, "thesis_error");
}

/// The remark without which no other number is to be read.
bool is_alarm(const std::string& remark) { return remark.starts_with("Not converged"); }

std::string lead_of(const json& answer, const std::vector<FittedParameter>& parameters) {
  std::string words = error_words(answer);
  const std::vector<std::string> remarks = texts_in(answer, "remarks");
  const bool told = std::any_of(remarks.begin(), remarks.end(), is_alarm);
  if (words.empty() && part_of(answer, "converged").is_boolean() && !told)
    words += flag_in(answer, "converged") ? "The fit has <strong>converged</strong>. "
                                          : "<strong class=\"alarm\">The fit has not converged.</strong> ";
  for (const std::string& remark : remarks)
    if (is_alarm(remark)) words += "<strong class=\"alarm\">" + html_escaped(remark) + "</strong> ";
  const auto settled =
      std::count_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.identified == "yes"; });
  if (!parameters.empty())
    words += fmt::format("The data settle <strong>{} of {}</strong> parameters. ", settled, parameters.size());
  const auto rows = rows_of(answer, "main_frequencies");
  if (!rows.empty())
    words += fmt::format(
        "At <a href=\"#main\">main frequencies</a>, <strong>{} of {}</strong> amplitudes are as near to "
        "the measured ones as the thesis came. ",
        rows.size() - static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), beyond_thesis)), rows.size());
  for (const std::string& remark : remarks)
    if (!is_alarm(remark)) words += html_escaped(remark) + " ";
  return words;
}

std::vector<Row> key_numbers_of(const json& answer) {
  std::vector<Row> rows;
  const auto add = [&](const char* words, const char* key, int digits, double factor = 1) {
    if (const double v = number_in(answer, key); !std::isnan(v))
      rows.push_back({words, digits_text(factor * v, digits)});
  };
  add("cost at the start", "start_cost", 4);
  add("cost of the calibrated", "cost", 4);
  add("degrees of freedom", "degrees_of_freedom", 6);
  add("residual variance (1: as stated)", "residual_variance", 3);
  add("probability of such residuals", "probability_of_residuals", 2);
  add("confidence of intervals, %", "confidence", 4, 100);
  add("standard errors to the minimum", "remaining_standard_errors", 2);
  add("noise of the model, relative", "noise", 2);
  return rows;
}

Section parameters_section(const json& answer, const std::vector<FittedParameter>& parameters) {
  if (parameters.empty()) return {"parameters", "", ""};
  std::vector<Row> values, intervals;
  for (const FittedParameter& p : parameters) {
    values.push_back({p.name, digits_text(p.start, 4), digits_text(p.value, 5), digits_text(p.standard_error, 2),
                      unit_of_name(p.name), flag_cell(p.identified, "yes"), flag_cell(p.at_bound, "no")});
    intervals.push_back({p.name, range_text(p.low, p.high), range_text(p.profile_low, p.profile_high),
                         range_text(p.lower, p.upper), unit_of_name(p.name)});
  }
  std::string html =
      "<section id=\"parameters\"><h2>Parameters</h2>\n" +
      html_table("study-parameters", {"parameter", "start", "value", "±", "unit", "settled", "on a bound"}, values) +
      "<p>±: standard error, from the curvature of the cost and the residuals themselves. Confounded: it would be "
      "settled were the others known.</p>\n" +
      html_table("study-intervals", {"parameter", confidence_text(answer), "by profile", "bounds", "unit"}, intervals);
  html += single_chart(interval_chart("intervals", parameters)) + "</section>\n";
  return {"parameters", "Parameters", html};
}

Section main_section(const json& answer) {
  std::vector<Row> rows;
  for (const json& r : rows_of(answer, "main_frequencies")) {
    const std::string channel = text_in(r, "channel");
    rows.push_back({text_in(r, "range") + "." + channel, digits_text(number_in(r, "order")),
                    digits_text(number_in(r, "hz"), 4),
                    Cell(percent_change(number_in(r, "calibrated_error")), beyond_thesis(r)),
                    percent_change(number_in(r, "start_error")), digits_text(100 * number_in(r, "thesis_error")),
                    digits_text(number_in(r, "measured"), 4), digits_text(number_in(r, "calibrated"), 4),
                    digits_text(number_in(r, "start"), 4), unit_of_name(channel)});
  }
  if (rows.empty()) return {"main", "", ""};
  return {"main", "Main frequencies",
          "<section id=\"main\"><h2>Amplitudes at main frequencies</h2>\n<p>The order that is largest in each measured "
          "file. The thesis came as near as 10 % at idle and 15 % elsewhere, on measurements of its own.</p>\n" +
              html_table("study-main",
                         {"range and channel", "order", "Hz", "error, %", "at the start, %", "thesis within, %",
                          "measured", "calibrated", "start", "unit"},
                         rows) +
              "</section>\n"};
}

std::string picture_html(const json& picture, std::size_t index) {
  std::string html = fmt::format("<h3>{}, {}</h3>\n<p>{}", html_escaped(text_in(picture, "range")),
                                 html_escaped(text_in(picture, "channel")), html_escaped(text_in(picture, "file")));
  const std::string unit = unit_of_name(text_in(picture, "channel"));
  if (const double rpm = number_in(picture, "crank_rpm"); rpm > 0)
    html += fmt::format(": crank at {} r/min", digits_text(rpm, 5));
  if (const double windows = number_in(picture, "windows"); windows > 0) html += fmt::format(", {:g} windows", windows);
  if (const double noise = number_in(picture, "noise"); noise > 0)
    html += fmt::format(", an order's amplitude uncertain by {}{}{} of noise", digits_text(noise),
                        unit.empty() ? "" : " ", html_escaped(unit));
  html += ".</p>\n";
  const std::string charts =
      spectrum_chart(fmt::format("spectrum-{}", index), picture) + trace_chart(fmt::format("trace-{}", index), picture);
  if (!charts.empty()) html += "<div class=\"charts\">" + charts + "</div>\n";
  std::string list;
  for (const std::string& words : texts_in(picture, "left_out")) list += "<li>" + html_escaped(words) + "</li>\n";
  if (!list.empty()) html += "<details><summary>Left out of this file</summary><ul>\n" + list + "</ul></details>\n";
  return html;
}

Section pictures_section(const json& answer) {
  const auto pictures = rows_of(answer, "pictures");
  if (pictures.empty()) return {"pictures", "", ""};
  std::string html =
      "<section id=\"pictures\"><h2>Measured and calculated</h2>\n<p>Spectra as far as order 9.5, cut off well below "
      "the "
      "noise. Traces are means over two crank revolutions; the calculated ones are turned to where they fit best, for "
      "a "
      "record does not say where the crank stood.</p>\n";
  for (std::size_t i = 0; i < pictures.size(); ++i) html += picture_html(pictures[i], i);
  return {"pictures", "Spectra and traces", html + "</section>\n"};
}

Section residuals_section(const json& answer) {
  std::vector<Row> rows;
  std::size_t far = 0;
  for (const json& r : rows_of(answer, "residuals")) {
    const std::string name = text_in(r, "quantity");
    const bool relative = flag_in(r, "logarithm");
    const double residual = number_in(r, "residual");
    const auto deviation = [&](const char* key) {
      return relative && !std::isnan(number_in(r, key)) ? percent_text(number_in(r, key)) + " %"
                                                        : digits_text(number_in(r, key), 2);
    };
    far += std::abs(residual) > alarming_residual;
    rows.push_back(
        {name,
         Cell(std::isnan(residual) ? "-" : fmt::format("{:+.2f}", residual), std::abs(residual) > alarming_residual),
         digits_text(number_in(r, "measured"), 4), digits_text(number_in(r, "calibrated"), 4), unit_of_name(name),
         percent_change(number_in(r, "calibrated_error")), percent_change(number_in(r, "start_error")),
         deviation("sigma"), deviation("model_noise")});
  }
  if (rows.empty()) return {"residuals", "", ""};
  const std::string chart = residual_chart("residuals-by-order", part_of(answer, "residuals"));
  return {"residuals", "Residuals",
          fmt::format(
              "<section id=\"residuals\"><h2>Residuals</h2>\n<p>Calculated less measured, in standard deviations: the "
              "stated one and the model's own noise, added in squares. {} of {} exceed {:g}.</p>\n",
              far, rows.size(), alarming_residual) +
              single_chart(chart) +
              html_table("study-residuals",
                         {"quantity", "residual", "measured", "calibrated", "unit", "error, %", "at the start, %",
                          "stated ±", "model's ±"},
                         rows) +
              "</section>\n"};
}

/// A cell as blue as the correlation is high, as orange as it is low.
std::string shaded_cell(double r) {
  if (std::isnan(r)) return "<td>-</td>";
  return fmt::format("<td{} style=\"background:rgba({},{:.2f})\">{:+.2f}</td>",
                     std::abs(r) > alarming_correlation && std::abs(r) < 1 - 1e-9 ? " class=\"alarm\"" : "",
                     r > 0 ? "86,180,233" : "230,159,0", 0.5 * std::min(std::abs(r), 1.0), r);
}

/// Rows and columns in the order of the parameters, numbered: names side by side would not fit.
std::string correlation_table(const json& answer, const std::vector<FittedParameter>& parameters) {
  const json &given = part_of(answer, "correlation"), &direction = part_of(part_of(answer, "weakest"), "direction");
  if (!given.is_object() || parameters.empty()) return "";
  std::string html = "<div class=\"scroll\"><table id=\"study-correlation\"><thead><tr><th class=\"w\"></th>";
  for (std::size_t i = 0; i < parameters.size(); ++i) html += fmt::format("<th>({})</th>", i + 1);
  html += direction.is_object() ? "<th>weakest direction</th></tr></thead><tbody>\n" : "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    html += fmt::format("<tr><td class=\"w\">({}) {}</td>", i + 1, html_escaped(parameters[i].name));
    for (const FittedParameter& other : parameters)
      html += other.name == parameters[i].name ? "<td>1</td>"
                                               : shaded_cell(number_in(part_of(given, parameters[i].name), other.name));
    if (direction.is_object()) {
      const double share = number_in(direction, parameters[i].name);
      html += "<td>" + (std::isnan(share) ? std::string("-") : fmt::format("{:+.2f}", share)) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

Section correlation_section(const json& answer, const std::vector<FittedParameter>& parameters) {
  std::string html = correlation_table(answer, parameters);
  std::string list;
  for (const double v : numbers_of_list(part_of(answer, "eigenvalues")))
    list += (list.empty() ? "" : ", ") + digits_text(v);
  if (!list.empty())
    html += "<p>Eigenvalues of the curvature, every parameter scaled to 1: " + list +
            ". The nearer to 0 the first, the less the data say about its direction.</p>\n";
  if (const std::string words = text_in(part_of(answer, "weakest"), "words"); !words.empty())
    html += "<p>" + html_escaped(words) + "</p>\n";
  if (html.empty()) return {"correlation", "", ""};
  return {
      "correlation", "What stands in for what",
      "<section id=\"correlation\"><h2>What stands in for what</h2>\n<p>Correlations of the estimates; beyond 0.9 two "
      "parameters can hardly be told apart.</p>\n" +
          html + "</section>\n"};
}

Section profiles_section(const json& answer, const std::vector<FittedParameter>& parameters) {
  const double confidence = number_in(answer, "confidence"), freedom = number_in(answer, "degrees_of_freedom");
  double level = NAN;
  if (confidence > 0 && confidence < 1 && freedom > 0) {
    const double t = student_t_quantile(confidence, freedom), scale = number_in(answer, "error_scale");
    level = number_in(answer, "cost") + 0.5 * t * t * scale * scale;
  }
  std::string charts;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    charts += profile_chart(fmt::format("profile-{}", i), parameters[i], level);
  if (charts.empty()) return {"profiles", "", ""};
  return {"profiles", "Profiles",
          "<section id=\"profiles\"><h2>Profiles of the cost</h2>\n<p>The cost over one parameter, all others fitted "
          "again. "
          "The interval by profile is where it stays below what the confidence allows. Where it differs much from that "
          "by curvature, believe the profile.</p>\n<div class=\"charts\">" +
              charts + "</div></section>\n"};
}

Section fits_section(const json& answer, const std::vector<FittedParameter>& parameters) {
  const auto fits = rows_of(answer, "fits");
  if (fits.empty()) return {"fits", "", ""};
  Row header{"fit", "cost at its start", "cost", "ended"};
  for (std::size_t i = 0; i < parameters.size(); ++i) header.push_back(fmt::format("({})", i + 1));
  const double best = number_in(answer, "best_fit");
  std::vector<Row> rows;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const bool last = k + 1 == fits.size() && k > 0,
               failed = part_of(fits[k], "ok").is_boolean() && !flag_in(fits[k], "ok");
    Row row{last ? "final" : fmt::format("{}{}", k + 1, static_cast<double>(k) == best ? ", the best" : ""),
            digits_text(number_in(fits[k], "start_cost"), 4), digits_text(number_in(fits[k], "cost"), 4),
            Cell(text_in(fits[k], "ended"), failed)};
    for (const FittedParameter& p : parameters)
      row.push_back(digits_text(number_in(part_of(fits[k], "parameters"), p.name), 4));
    rows.push_back(std::move(row));
  }
  std::string legend;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    legend += fmt::format("{}({}) {}", i > 0 ? "; " : "", i + 1, html_escaped(with_unit(parameters[i].name)));
  return {
      "fits", "Fits",
      "<section id=\"fits\"><h2>Fits</h2>\n<p>Each from a start of its own, by least squares; the final one goes on "
      "from the best with robust losses and central differences, so that its cost may be another.</p>\n" +
          single_chart(cost_chart("cost", answer)) + html_table("study-fits", header, rows) +
          (legend.empty() ? "" : "<p>" + legend + ".</p>\n") + "</section>\n"};
}

}  // namespace

StudyPart calibrate_part(const StudyRecord& record) {
  const json& answer = record.answer;
  const std::vector<FittedParameter> parameters = parameters_of(record);
  StudyPart part;
  part.lead = lead_of(answer, parameters);
  part.key_numbers = key_numbers_of(answer);
  part.sections = {parameters_section(answer, parameters),
                   main_section(answer),
                   pictures_section(answer),
                   residuals_section(answer),
                   correlation_section(answer, parameters),
                   profiles_section(answer, parameters),
                   fits_section(answer, parameters)};
  return part;
}

const StudyPage& calibration_page() {
  static constexpr StudyPage page{
      "calibrate",    "Calibration", "with which parameters the model answers as was measured",
      calibrate_part, false,         "A step that fails is shortened, and a start that fails is passed over."};
  return page;
}

}  // namespace beltlife
