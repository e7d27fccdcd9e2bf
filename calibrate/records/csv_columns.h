// Owns CSV files with a header line: their column names, and any column as numbers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/scene_io.h"

namespace beltlife {

/// Problems of one file, of which a person wants to see the first few.
class FileProblems {
 public:
  static constexpr std::size_t most = 20;
  /// `key` is what the messages name beside file and line: the field of the study file that named this file.
  FileProblems(std::string file, std::string key) : file_(std::move(file)), key_(std::move(key)) {}

  void add(int line, std::string what, std::string allowed) {
    if (!full()) list_.push_back({file_, line, key_, std::move(what), std::move(allowed)});
  }
  bool full() const { return list_.size() >= most; }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }

 private:
  std::string file_, key_;
  std::vector<Problem> list_;
};

/// A CSV file in memory. Cells are separated by tab, semicolon or comma, whichever of them the header has first in this
/// order; lines that begin with # and empty lines are passed over, as is a byte order mark. A cell may stand in double
/// quotes, but may not hold the separator.
class CsvFile {
 public:
  static constexpr std::size_t max_bytes = std::size_t{512} << 20;

  /// Problems: not readable, too large, no header, no rows, more cells in a row than names.
  static CsvFile read(const std::filesystem::path& path, FileProblems& problems);

  const std::vector<std::string>& names() const { return names_; }
  int header_line() const { return header_line_; }
  std::size_t rows() const { return rows_.size(); }
  int line(std::size_t row) const { return rows_[row].line; }
  /// One number a row. Problems: cells that are missing, empty, text or not finite.
  std::vector<double> column(std::size_t index, FileProblems& problems) const;

 private:
  struct Row {
    std::size_t begin, length;
    int line;
  };
  std::string_view row(std::size_t i) const { return std::string_view(text_).substr(rows_[i].begin, rows_[i].length); }

  std::string text_;
  char separator_ = ',';
  std::vector<std::string> names_;
  int header_line_ = 0;
  std::vector<Row> rows_;
};

/// The beginning of a text, fit for a terminal even if it is none.
std::string excerpt(std::string_view text);

}  // namespace beltlife
