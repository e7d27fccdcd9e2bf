// Text as comma-separated values: see csv.h.
#include "results/text/csv.h"

#include <fmt/format.h>

#include <cmath>

namespace beltlife {

std::string csv_field(const std::string& text) {
  const bool plain = !text.empty() && text.find_first_of(",\"\r\n") == text.npos && text.front() != ' ' &&
                     text.front() != '\t' && text.back() != ' ' && text.back() != '\t';
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_number(double value) {
  if (std::isnan(value)) return "nan";  // the sign of a NaN means nothing
  return fmt::format("{}", value);
}

std::string csv_text(const std::vector<CsvColumn>& columns) {
  std::string text;
  for (std::size_t c = 0; c < columns.size(); ++c) text += (c ? "," : "") + csv_field(columns[c].heading);
  text += '\n';
  const std::size_t rows = columns.empty() ? 0 : columns.front().fields.size();
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c) text += ',';
      text += columns[c].fields.at(row);
      if (c + 1 == columns.size()) text += '\n';
    }
  return text;
}

}  // namespace beltlife
