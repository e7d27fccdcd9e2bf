// Answers of studies as words: see study_parts.h.
#include "results/pages/study/study_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "sim/eval/quantity_unit.h"

namespace beltlife {

using nlohmann::json;

const json& part_of(const json& answer, std::string_view key) {
  static const json nothing;
  if (!answer.is_object()) return nothing;
  const auto at = answer.find(std::string(key));
  return at == answer.end() ? nothing : *at;
}

std::vector<json> rows_of(const json& answer, std::string_view key) {
  std::vector<json> rows;
  const json& list = part_of(answer, key);
  if (list.is_array())
    std::copy_if(list.begin(), list.end(), std::back_inserter(rows), [](const json& j) { return j.is_object(); });
  return rows;
}

double number_in(const json& answer, std::string_view key) {
  const json& j = part_of(answer, key);
  return j.is_number() ? j.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

bool flag_in(const json& answer, std::string_view key) {
  const json& j = part_of(answer, key);
  return j.is_boolean() ? j.get<bool>() : j.is_number() && j.get<double>() != 0;
}

std::string text_in(const json& answer, std::string_view key) {
  const json& j = part_of(answer, key);
  return j.is_string() ? j.get<std::string>() : std::string();
}

std::vector<std::string> texts_in(const json& answer, std::string_view key) {
  std::vector<std::string> texts;
  const json& list = part_of(answer, key);
  if (list.is_array())
    for (const json& j : list)
      if (j.is_string()) texts.push_back(j.get<std::string>());
  return texts;
}

std::string error_words(const json& answer) {
  const std::string error = text_in(answer, "error");
  if (error.empty()) return "";
  return "<span class=\"alarm\">There is no answer: " + html_escaped(error) + "</span>. ";
}

std::string error_words(const DriverAnswer& answer) {
  if (!answer.error) return "";
  return "<span class=\"alarm\">There is no answer: " + html_escaped(*answer.error) + "</span>. ";
}

std::string digits_text(double value, int digits) {
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "no end" : fmt::format("{:.{}g}", value, digits);
}

std::string percent_text(double share, int digits) {
  // Written out where that is short: 1100 rather than 1.1e+03.
  const double percent = 100 * share;
  return std::abs(percent) >= 1 && std::abs(percent) < 1e6 ? html_rounded(percent, digits)
                                                           : digits_text(percent, digits);
}

std::string duration_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

std::string interval_text(const json& interval, int digits) {
  return interval_text(number_in(interval, "low"), number_in(interval, "high"), digits);
}

std::string interval_text(double low, double high, int digits) {
  if (std::isnan(low) && std::isnan(high)) return "-";
  return digits_text(low, digits) + " to " + digits_text(high, digits);
}

std::string with_unit(const std::string& name) {
  const std::string unit = unit_of_name(name);
  return unit.empty() ? name : name + ", " + unit;
}

std::string setting_text(const Setting& setting) {
  if (std::holds_alternative<double>(setting)) return fmt::format("{}", std::get<double>(setting));
  std::string text = std::get<std::string>(setting);
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2) text.replace(at, 1, "; ");
  return text;
}

std::string count_text(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace beltlife
