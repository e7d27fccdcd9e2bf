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

constexpr double alarming_residual = 3, alarming_correlation = 0.9;

FittedParameter parameter_of(const std::string& name, const FittedValue& v) {
  FittedParameter p{name, v.identified, v.at_bound};
  p.value = v.value;
  p.standard_error = v.standard_error;
  p.low = v.low;
  p.high = v.high;
  p.start = v.start;
  p.lower = v.lower.value_or(not_known);
  p.upper = v.upper.value_or(not_known);
  if (!v.profile) return p;
  p.profile_low = v.profile->low;
  p.profile_high = v.profile->high;
  p.profile_value = v.profile->value;
  p.profile_cost = v.profile->cost;
  return p;
}

/// In the study's order; the answer has them by name.
std::vector<FittedParameter> parameters_of(const StudyRecord& record, const CalibrationAnswer& answer) {
  std::vector<FittedParameter> all;
  for (const std::string& name : record.head.parameters)
    if (const auto at = answer.parameters.find(name); at != answer.parameters.end())
      all.push_back(parameter_of(name, at->second));
  return all;
}

std::string confidence_text(const CalibrationAnswer& answer) {
  return answer.confidence > 0 ? digits_text(100 * answer.confidence) + " %" : "interval";
}

std::string percent_change(double share) {
  return std::isfinite(share) ? fmt::format("{:+.1f}", 100 * share) : "not known";
}

/// "0.1 to 0.3"; `none` says why there is no interval.
std::string range_text(double low, double high, const char* none) {
  if (std::isnan(low) && std::isnan(high)) return none;
  const auto end = [](double v) { return std::isnan(v) ? std::string("not reached") : digits_text(v); };
  return end(low) + " to " + end(high);
}

/// A word of the answer that alarms unless it is the good one.
Cell flag_cell(const std::string& word, const char* good) {
  return word.empty() ? Cell("not in this log") : Cell(word, word != good);
}

/// A chart that stands alone would be as wide as the page.
std::string single_chart(const std::string& svg) {
  return svg.empty() ? "" : "<div style=\"max-width:600px\">" + svg + "</div>\n";
}

bool beyond_thesis(const MainFrequency& row) { return std::abs(row.calibrated_error) > row.thesis_error; }

/// The remark without which no other number is to be read.
bool is_alarm(const std::string& remark) { return remark.starts_with("Not converged"); }

std::string lead_of(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  std::string words = error_words(answer);
  const std::vector<std::string>& remarks = answer.remarks;
  const bool told = std::any_of(remarks.begin(), remarks.end(), is_alarm);
  if (words.empty() && !answer.fits.empty() && !told)
    words += answer.converged ? "The fit has <strong>converged</strong>. "
                              : "<strong class=\"alarm\">The fit has not converged.</strong> ";
  for (const std::string& remark : remarks)
    if (is_alarm(remark)) words += "<strong class=\"alarm\">" + html_escaped(remark) + "</strong> ";
  const auto settled =
      std::count_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.identified == "yes"; });
  if (!parameters.empty())
    words += fmt::format("The data settle <strong>{} of {}</strong> parameters. ", settled, parameters.size());
  const std::vector<MainFrequency>& rows = answer.main_frequencies;
  if (!rows.empty())
    words += fmt::format(
        "At <a href=\"#main\">main frequencies</a>, <strong>{} of {}</strong> amplitudes are as near to "
        "the measured ones as the thesis came. ",
        rows.size() - static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), beyond_thesis)), rows.size());
  for (const std::string& remark : remarks)
    if (!is_alarm(remark)) words += html_escaped(remark) + " ";
  return words;
}

std::vector<Row> key_numbers_of(const CalibrationAnswer& answer) {
  std::vector<Row> rows;
  const auto add = [&](const char* words, double v, int digits) {
    if (!std::isnan(v)) rows.push_back({words, digits_text(v, digits)});
  };
  add("cost at the start", answer.start_cost, 4);
  add("cost of the calibrated", answer.cost, 4);
  add("degrees of freedom", answer.degrees_of_freedom, 6);
  add("residual variance (1: as stated)", answer.residual_variance, 3);
  add("probability of such residuals", answer.probability_of_residuals, 2);
  add("confidence of intervals, %", 100 * answer.confidence, 4);
  add("standard errors to the minimum", answer.remaining_standard_errors, 2);
  add("noise of the model, relative", answer.noise, 2);
  return rows;
}

Section parameters_section(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  if (parameters.empty()) return {"parameters", "", ""};
  std::vector<Row> values, intervals;
  for (const FittedParameter& p : parameters) {
    values.push_back({p.name, digits_text(p.start, 4), digits_text(p.value, 5),
                      std::isfinite(p.standard_error) ? digits_text(p.standard_error, 2) : "the data say nothing",
                      unit_of_name(p.name), flag_cell(p.identified, "yes"), flag_cell(p.at_bound, "no")});
    intervals.push_back(
        {p.name, range_text(p.low, p.high, "the data say nothing"),
         range_text(p.profile_low, p.profile_high, p.profile_value.empty() ? "no profile" : "not reached"),
         range_text(p.lower, p.upper, "none"), unit_of_name(p.name)});
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

constexpr const char* failed_start = "failed";  ///< of what the model gives where it did not run

std::string start_change(double share) { return std::isnan(share) ? failed_start : percent_change(share); }

Section main_section(const CalibrationAnswer& answer) {
  std::vector<Row> rows;
  for (const MainFrequency& r : answer.main_frequencies)
    rows.push_back({r.range + "." + r.channel, digits_text(r.order), digits_text(r.hz, 4),
                    Cell(percent_change(r.calibrated_error), beyond_thesis(r)), start_change(r.start_error),
                    digits_text(100 * r.thesis_error), digits_text(r.measured, 4), digits_text(r.calibrated, 4),
                    std::isnan(r.start) ? failed_start : digits_text(r.start, 4), unit_of_name(r.channel)});
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

std::string picture_html(const RecordPicture& picture, std::size_t index) {
  std::string html = fmt::format("<h3>{}, {}</h3>\n<p>{}", html_escaped(picture.range), html_escaped(picture.channel),
                                 html_escaped(picture.file));
  const std::string unit = unit_of_name(picture.channel);
  if (picture.crank_rpm > 0) html += fmt::format(": crank at {} r/min", digits_text(picture.crank_rpm, 5));
  if (picture.windows > 0) html += fmt::format(", {} windows", picture.windows);
  if (picture.noise > 0)
    html += fmt::format(", an order's amplitude uncertain by {}{}{} of noise", digits_text(picture.noise),
                        unit.empty() ? "" : " ", html_escaped(unit));
  html += ".</p>\n";
  const std::string charts =
      spectrum_chart(fmt::format("spectrum-{}", index), picture) + trace_chart(fmt::format("trace-{}", index), picture);
  if (!charts.empty()) html += "<div class=\"charts\">" + charts + "</div>\n";
  std::string list;
  for (const std::string& words : picture.left_out) list += "<li>" + html_escaped(words) + "</li>\n";
  if (!list.empty()) html += "<details><summary>Left out of this file</summary><ul>\n" + list + "</ul></details>\n";
  return html;
}

Section pictures_section(const CalibrationAnswer& answer) {
  if (!answer.pictures || answer.pictures->empty()) return {"pictures", "", ""};
  const std::vector<RecordPicture>& pictures = *answer.pictures;
  std::string html =
      "<section id=\"pictures\"><h2>Measured and calculated</h2>\n<p>Spectra as far as order 9.5, cut off well below "
      "the "
      "noise. Traces are means over two crank revolutions; the calculated ones are turned to where they fit best, for "
      "a "
      "record does not say where the crank stood.</p>\n";
  for (std::size_t i = 0; i < pictures.size(); ++i) html += picture_html(pictures[i], i);
  return {"pictures", "Spectra and traces", html + "</section>\n"};
}

Row residual_row(const ResidualAnswer& r) {
  const auto deviation = [&](double v) { return r.logarithm ? percent_text(v) + " %" : digits_text(v, 2); };
  return {r.quantity,
          Cell(std::isnan(r.residual) ? "not known" : fmt::format("{:+.2f}", r.residual),
               std::abs(r.residual) > alarming_residual),
          digits_text(r.measured, 4),
          digits_text(r.calibrated, 4),
          unit_of_name(r.quantity),
          percent_change(r.calibrated_error),
          start_change(r.start_error),
          deviation(r.sigma),
          deviation(r.model_noise)};
}

Section residuals_section(const CalibrationAnswer& answer) {
  if (answer.residuals.empty()) return {"residuals", "", ""};
  std::vector<Row> rows;
  std::size_t far = 0;
  for (const ResidualAnswer& r : answer.residuals) {
    far += std::abs(r.residual) > alarming_residual;
    rows.push_back(residual_row(r));
  }
  return {"residuals", "Residuals",
          fmt::format(
              "<section id=\"residuals\"><h2>Residuals</h2>\n<p>Calculated less measured, in standard deviations: the "
              "stated one and the model's own noise, added in squares. {} of {} exceed {:g}.</p>\n",
              far, rows.size(), alarming_residual) +
              single_chart(residual_chart("residuals-by-order", answer.residuals)) +
              html_table("study-residuals",
                         {"quantity", "residual", "measured", "calibrated", "unit", "error, %", "at the start, %",
                          "stated ±", "model's ±"},
                         rows) +
              "</section>\n"};
}

/// A cell as blue as the correlation is high, as orange as it is low.
std::string shaded_cell(double r) {
  if (std::isnan(r)) return "<td>none</td>";
  return fmt::format("<td{} style=\"background:rgba({},{:.2f})\">{:+.2f}</td>",
                     std::abs(r) > alarming_correlation && std::abs(r) < 1 - 1e-9 ? " class=\"alarm\"" : "",
                     r > 0 ? "86,180,233" : "230,159,0", 0.5 * std::min(std::abs(r), 1.0), r);
}

double correlation_in(const CalibrationAnswer& answer, const std::string& a, const std::string& b) {
  const auto row = answer.correlation.find(a);
  if (row == answer.correlation.end()) return not_known;
  const auto at = row->second.find(b);
  return at == row->second.end() ? not_known : at->second;
}

/// Rows and columns in the order of the parameters, numbered: names side by side would not fit.
std::string correlation_table(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  if (answer.correlation.empty() || parameters.empty()) return "";
  const auto& weakest = answer.weakest.value;
  std::string html = "<div class=\"scroll\"><table id=\"study-correlation\"><thead><tr><th class=\"w\"></th>";
  for (std::size_t i = 0; i < parameters.size(); ++i) html += fmt::format("<th>({})</th>", i + 1);
  html += weakest ? "<th>weakest direction</th></tr></thead><tbody>\n" : "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = parameters[i].name;
    html += fmt::format("<tr><td class=\"w\">({}) {}</td>", i + 1, html_escaped(name));
    for (const FittedParameter& other : parameters)
      html += other.name == name ? "<td>1</td>" : shaded_cell(correlation_in(answer, name, other.name));
    if (weakest) {
      const auto share = weakest->direction.find(name);
      html += share == weakest->direction.end() ? std::string("<td>none</td>")
                                                : fmt::format("<td>{:+.2f}</td>", share->second);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

Section correlation_section(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  std::string html = correlation_table(answer, parameters);
  std::string list;
  for (const double v : answer.eigenvalues) list += (list.empty() ? "" : ", ") + digits_text(v);
  if (!list.empty())
    html += "<p>Eigenvalues of the curvature, every parameter scaled to 1: " + list +
            ". The nearer to 0 the first, the less the data say about its direction.</p>\n";
  if (answer.weakest.value && !answer.weakest.value->words.empty())
    html += "<p>" + html_escaped(answer.weakest.value->words) + "</p>\n";
  if (html.empty()) return {"correlation", "", ""};
  return {
      "correlation", "What stands in for what",
      "<section id=\"correlation\"><h2>What stands in for what</h2>\n<p>Correlations of the estimates; beyond 0.9 two "
      "parameters can hardly be told apart. Of a parameter that the data say nothing about there are none.</p>\n" +
          html + "</section>\n"};
}

Section profiles_section(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  const double confidence = answer.confidence, freedom = answer.degrees_of_freedom;
  double level = NAN;
  if (confidence > 0 && confidence < 1 && freedom > 0) {
    const double t = student_t_quantile(confidence, freedom), scale = answer.error_scale;
    level = answer.cost + 0.5 * t * t * scale * scale;
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

Section fits_section(const CalibrationAnswer& answer, const std::vector<FittedParameter>& parameters) {
  const std::vector<FitAnswer>& fits = answer.fits;
  if (fits.empty()) return {"fits", "", ""};
  Row header{"fit", "cost at its start", "cost", "ended"};
  for (std::size_t i = 0; i < parameters.size(); ++i) header.push_back(fmt::format("({})", i + 1));
  std::vector<Row> rows;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const FitAnswer& f = fits[k];
    const bool last = k + 1 == fits.size() && k > 0;
    Row row{last ? "final"
                 : fmt::format("{}{}", k + 1, static_cast<std::int64_t>(k) == answer.best_fit ? ", the best" : ""),
            digits_text(f.start_cost, 4), std::isnan(f.cost) ? "failed" : digits_text(f.cost, 4), Cell(f.ended, !f.ok)};
    for (const FittedParameter& p : parameters) {
      const auto at = f.parameters.find(p.name);
      row.push_back(at == f.parameters.end() ? "not in this log" : digits_text(at->second, 4));
    }
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

StudyPart calibrate_part(const StudyRecord& record, const CalibrationAnswer& answer) {
  const std::vector<FittedParameter> parameters = parameters_of(record, answer);
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
  static constexpr StudyPage page{"calibrate",
                                  "Calibration",
                                  "with which parameters the model answers as was measured",
                                  typed_part<CalibrationAnswer, calibrate_part>,
                                  false,
                                  "A step that fails is shortened, and a start that fails is passed over."};
  return page;
}

}  // namespace beltlife
