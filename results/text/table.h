// Owns plain-text tables whose columns line up.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// Rows of cells below a header; numbers are right-aligned (a cell that starts with a digit, sign or dot, "inf",
/// "nan", and every header of such a column), words left-aligned. Columns are two spaces apart.
class Table {
 public:
  explicit Table(std::vector<std::string> header);
  void row(std::vector<std::string> cells);
  std::string text(int indent = 0) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Fixed digits, and no sign on a number that rounds to zero.
std::string fixed_text(double value, int digits);

}  // namespace beltlife
