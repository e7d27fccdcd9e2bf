// Pieces of HTML: see html.h.
#include "results/pages/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/text/table.h"

namespace beltlife {
namespace {

bool is_words(const std::string& text) {
  if (text.empty() || text == "-" || text == "no end") return false;
  const std::size_t first = text.find_first_not_of("+-.");
  return first == text.npos || text[first] < '0' || text[first] > '9';
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string out;
  for (char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string html_table(const std::string& id, const Row& header, const std::vector<Row>& rows) {
  std::vector<bool> words(header.size(), false);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) words[i] = words[i] || is_words(row[i].text);
  std::string s = fmt::format("<div class=\"scroll\"><table id=\"{}\"><thead><tr>", html_escaped(id));
  for (std::size_t i = 0; i < header.size(); ++i)
    s += fmt::format("<th{}>{}</th>", words[i] ? " class=\"w\"" : "", html_escaped(header[i].text));
  s += "</tr></thead><tbody>\n";
  for (const Row& row : rows) {
    s += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      s += fmt::format("<td{}>{}</td>",
                       row[i].alarming ? " class=\"alarm\""
                       : words[i]      ? " class=\"w\""
                                       : "",
                       html_escaped(row[i].text));
    s += "</tr>\n";
  }
  return s + "</tbody></table></div>\n";
}

std::string html_number(double value, int digits) {
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "no end" : fixed_text(value, digits);
}

std::string html_rounded(double value, int digits) {
  if (!std::isfinite(value) || value == 0) return html_number(value);
  const int places = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double unit = std::pow(10.0, -places);
  return html_number(std::round(value / unit) * unit, std::max(places, 0));
}

}  // namespace beltlife
