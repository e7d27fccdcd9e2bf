// Owns the HDF5 result file of a run: its names, written to a temporary name and renamed when whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/eval/solved_drive.h"
#include "sim/eval/sweep.h"
#include "sim/life/life.h"
#include "sim/record.h"

namespace beltlife {

/// How the numbers came about; stored as attributes of the file's root.
struct Provenance {
  std::string version;
  std::string command_line;
  std::string scene_path;
  std::string scene_text;  ///< the scene as it was run, settings applied
  std::string compiler;
  std::string revision;
  std::string scheme;
  int elements = 0;
};

/// What is recorded beside ranges; either may be missing. Where one is given, its run has no windows.
struct RunExtras {
  const Sweep* sweep = nullptr;
  const WindowRecord* event = nullptr;
};

/// Writes runs (one per simulated run: the whole profile, or one per range), the life and what is solved of the drive
/// without running it to `path`; the latter two may be missing.
/// Failed runs are written too, marked by their status. Throws BadInput if the file cannot be written; leaves
/// nothing behind then.
void write_results(const std::filesystem::path& path, const Provenance& provenance, const std::vector<RunRecord>& runs,
                   const Life* life, const SolvedDrive* solved = nullptr, const RunExtras& extras = {});

}  // namespace beltlife
