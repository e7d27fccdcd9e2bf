// CSV with a header: see csv_columns.h.
#include "calibrate/records/csv_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace beltlife {
namespace {

constexpr const char* wanted = "one header line, then one finite number a column and line, with a decimal point";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  text = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

/// The cell at `index`, and false where the row ends before it.
bool cell_at(std::string_view row, char separator, std::size_t index, std::string_view& cell) {
  for (; index > 0; --index) {
    const auto next = row.find(separator);
    if (next == row.npos) return false;
    row.remove_prefix(next + 1);
  }
  cell = trimmed(row.substr(0, row.find(separator)));
  return true;
}

bool number(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

std::string excerpt(std::string_view text) {
  std::string shown(text.substr(0, 60));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

CsvFile CsvFile::read(const std::filesystem::path& path, FileProblems& problems) {
  CsvFile csv;
  std::error_code error;
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path, error)) {
    problems.add(0, "cannot be read", "an existing CSV file, relative to the study file");
    return csv;
  }
  if (const auto bytes = std::filesystem::file_size(path, error); error || bytes > max_bytes) {
    problems.add(0, fmt::format("is larger than {} MB", max_bytes >> 20), "a shorter record");
    return csv;
  }
  csv.text_.assign(std::istreambuf_iterator<char>(in), {});
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // byte order mark that spreadsheets write
  std::size_t at = csv.text_.starts_with(mark) ? mark.size() : 0;
  std::size_t cells = 0;
  for (int line = 1; at < csv.text_.size(); ++line) {
    const std::size_t end = std::min(csv.text_.find('\n', at), csv.text_.size());
    const std::string_view text = std::string_view(csv.text_).substr(at, end - at);
    const Row row{at, text.size(), line};
    at = end + 1;
    const std::string_view content = trimmed(text);
    if (content.empty() || content[0] == '#') continue;
    if (csv.header_line_ == 0) {
      csv.header_line_ = line;
      for (const char c : {'\t', ';', ','})
        if (text.find(c) != text.npos) {
          csv.separator_ = c;
          break;
        }
      cells = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), csv.separator_));
      std::string_view name;
      for (std::size_t i = 0; i < cells && cell_at(text, csv.separator_, i, name); ++i) csv.names_.emplace_back(name);
      continue;
    }
    std::string_view extra;
    if (cell_at(text, csv.separator_, cells, extra) && !extra.empty())
      problems.add(line, fmt::format("\"{}\" has more cells than the header's {}", excerpt(content), cells), wanted);
    csv.rows_.push_back(row);
  }
  if (csv.header_line_ == 0)
    problems.add(0, "is empty", wanted);
  else if (csv.rows_.empty())
    problems.add(0, "has a header but no numbers", wanted);
  return csv;
}

std::vector<double> CsvFile::column(std::size_t index, FileProblems& problems) const {
  std::vector<double> values;
  values.reserve(rows());
  for (std::size_t i = 0; i < rows() && !problems.full(); ++i) {
    std::string_view cell;
    double value = 0;
    if (!cell_at(row(i), separator_, index, cell) || cell.empty())
      problems.add(line(i), fmt::format("has no cell in the column \"{}\"", excerpt(names_[index])), wanted);
    else if (!number(cell, value))
      problems.add(
          line(i),
          fmt::format("\"{}\" in the column \"{}\" is no finite number", excerpt(cell), excerpt(names_[index])),
          wanted);
    values.push_back(value);
  }
  return values;
}

}  // namespace beltlife
