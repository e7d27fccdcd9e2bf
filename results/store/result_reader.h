// Owns the way back from an HDF5 result file to the records that were written.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "results/store/results_file.h"
#include "sim/record.h"

namespace beltlife {

struct ResultFile {
  Provenance provenance;
  std::vector<RunRecord> runs;
  std::optional<DriveStatics> statics;
  std::optional<DriveModes> modes;
  std::optional<Sweep> sweep;
  std::optional<WindowRecord> event;  ///< of the first run; without contact forces
};

/// Reads what write_results wrote; what is derived from the runs (summaries, life) is worked out again from them.
/// Throws BadInput for a file that is not one of ours, of another format, or damaged.
ResultFile read_results(const std::filesystem::path& path);

}  // namespace beltlife
