// Owns the log of a study: one JSON line a point, on disk before the point is used; a killed run goes on from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "results/journal/study_record.h"

namespace beltlife {

/// Reads a log, plain or compressed by gzip. A last line cut short by a kill is left out. Throws BadInput naming file
/// and line.
StudyRecord read_journal(const std::filesystem::path& path);

/// The log of a running study, locked against a second writer. A line is handed to the system by one call: it outlives
/// the process whatever ends that, but not a machine that loses its power before it has written its caches.
class Journal {
 public:
  /// Opens the log, or begins it if there is none; the head of a log that is there is kept. Warns on standard error of
  /// another revision or compiler. Throws BadInput, in words, if it is not a log, belongs to another
  /// driver, scene, study or version (naming the first difference), is being written by another process, or cannot be
  /// written.
  Journal(std::filesystem::path path, const StudyHead& head);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const StudyRecord& record() const { return record_; }
  const std::filesystem::path& path() const { return path_; }
  /// Writes the point before it returns. Throws BadInput if the disk does not take it; what was written before is safe,
  /// and a later point may be tried.
  void append(StudyPoint point);
  /// Writes the answer, unless the log ends with the same already. What JSON cannot hold (NaN, infinity) becomes null.
  void finish(const nlohmann::json& answer);

 private:
  void open(const StudyHead& head);
  void write(const std::string& line, const std::string& what);

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t whole_ = 0;  ///< bytes of whole lines
  bool torn_ = false;        ///< part of a line follows them, which could not be cut off
  StudyRecord record_;
};

/// A model with a journal and a memory: a point that the journal has, or that was asked before, is not evaluated again.
/// Numbers are given in the order of asking, so that they are the same whoever finished first. A driver that asks for a
/// point of the log under another number has taken another course: evaluate() throws BadInput.
class JournaledModel {
 public:
  JournaledModel(PointModel model, Journal& journal);
  /// `on_answer` hears of every point of the batch, remembered ones first.
  std::vector<Answer> evaluate(const std::vector<Point>& points, const OnAnswer& on_answer = {});
  std::size_t evaluated() const { return evaluated_; }    ///< points really evaluated by this process
  std::size_t remembered() const { return remembered_; }  ///< points taken from the journal or memory

 private:
  struct Known {
    std::size_t number = 0;
    bool asked = false;            ///< by this process; else the journal alone has it
    std::optional<Answer> answer;  ///< none while it is being evaluated, or after that was interrupted
  };
  Known& ask(const std::string& key);

  PointModel model_;
  Journal& journal_;
  std::unordered_map<std::string, Known> known_;  ///< by settings to the bit
  std::size_t asked_ = 0, evaluated_ = 0, remembered_ = 0;
};

}  // namespace beltlife
