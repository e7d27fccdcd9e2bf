// Owns the HDF5 file of a study: head, table of points, and the answer as groups and tables.
#pragma once

#include <filesystem>
#include <vector>

#include "results/answer/answer_note.h"
#include "results/journal/study_record.h"

namespace beltlife {

/// Folds a study into an HDF5 file, by a temporary name; `notes` say units and meanings of the answer's parts. Throws
/// BadInput if it cannot be written.
void write_study(const std::filesystem::path& path, const StudyRecord& record,
                 const std::vector<AnswerNote>& notes = {});

/// Reads what write_study wrote, the answer as it was. Throws BadInput.
StudyRecord read_study_file(const std::filesystem::path& path);

/// A study from either kind of file: a log (plain or gzip) or HDF5.
StudyRecord read_study_record(const std::filesystem::path& path);

/// Whether the file holds a study (else it may be a result file of simulate or life).
bool is_study(const std::filesystem::path& path);

}  // namespace beltlife
