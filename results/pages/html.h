// Owns the pieces of HTML that report pages are made of: escaped text, tables, numbers.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// A cell of a table; one that alarms is set off in colour and weight.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}
  Cell(const char* words) : text(words) {}
  Cell(std::string words, bool warns) : text(std::move(words)), alarming(warns) {}
  std::string text;
  bool alarming = false;
};
using Row = std::vector<Cell>;

std::string html_escaped(const std::string& text);

/// A column with a cell that is no number is left-aligned; a number may have words behind it.
std::string html_table(const std::string& id, const Row& header, const std::vector<Row>& rows);

/// Fixed digits; "no end" where infinite, "-" where there is none.
std::string html_number(double value, int digits = 0);
/// So many significant digits, written out: 14900 for 14867 to three.
std::string html_rounded(double value, int digits);

}  // namespace beltlife
