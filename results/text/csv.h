// Owns CSV text: fields quoted as RFC 4180 wants them, numbers that read back to the bit, columns as lines.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// The text as one field: in quotes, its own quotes doubled, where a comma, quote, line break or a blank at an end
/// would be taken for something else. An empty text has quotes too, so that a line of one empty field is not an empty
/// line.
std::string csv_field(const std::string& text);

/// The fewest digits, at most 17, that read back to the same bits; `nan`, `inf`, `-inf` where it is no number.
std::string csv_number(double value);

/// A column: its heading, and its fields as they are to stand in the file.
struct CsvColumn {
  std::string heading;
  std::vector<std::string> fields;
};

/// A header line and one line a row, each ended by a line feed. The columns are equally long.
std::string csv_text(const std::vector<CsvColumn>& columns);

}  // namespace beltlife
