// Owns the lines of a study's log: head, points and answer as JSON, read plain or compressed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "results/journal/study_record.h"

namespace beltlife {

/// What of a log is whole.
struct JournalText {
  std::optional<StudyHead> head;  ///< none if the writer was killed before its first line was whole
  std::vector<StudyPoint> points;
  nlohmann::json answer;    ///< the last one; null if there is none
  std::uint64_t bytes = 0;  ///< length of the whole lines, uncompressed
  bool cut_short = false;   ///< something follows them
  bool compressed = false;
};

/// Reads a log. Throws BadInput naming file and line where anything but its end is damaged.
JournalText read_journal_text(const std::filesystem::path& path);

/// Whether the file begins as a log does; false for an empty file. Throws BadInput if it cannot be read.
bool begins_as_journal(const std::filesystem::path& path);

/// One line each, newline included.
std::string head_line(const StudyHead& head);
std::string point_line(const StudyPoint& point);
std::string answer_line(const nlohmann::json& answer);

/// The text with what JSON or HDF5 could not keep replaced (bytes that are no UTF-8, zeros).
std::string storable(const std::string& text);

}  // namespace beltlife
