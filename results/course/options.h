// Owns the options that several commands share. What one command alone understands stands beside that command.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace beltlife {

class Ranks;

/// The program as it was started: what files and logs say of where they come from.
struct Program {
  std::string version, revision, compiler, command_line;
  Ranks* ranks = nullptr;  ///< the processes that share a driver's points; null: this one alone
};

/// Of every command that reads a scene; the comments are the flags.
struct CommonOptions {
  Program program;
  std::vector<std::string> settings;  ///< --set, and what --scheme, --step, --elements stand for
  bool json = false;                  ///< --json: one JSON object instead of tables
  bool quiet = false;                 ///< --quiet: no progress
  int threads = 0;                    ///< --threads, 0: all
};

/// Of the commands that run ranges of scenes.
struct RangeOptions : CommonOptions {
  std::vector<std::string> ranges;  ///< --range; none: all
  std::string out;                  ///< --out, empty: no file
  bool force = false;               ///< --force: run with a step beyond the predicted limit
  bool profile = false;             ///< --profile: time by kernel
  int frames = 96;                  ///< --frames of what is written to --out: of the moving drive, a range; 0: none
};

/// Of the drivers: study, calibrate, optimize.
struct DriverOptions : CommonOptions {
  std::string file;                   ///< the study file
  std::string out;                    ///< --out; empty: named after the file, in the working folder
  std::optional<std::uint64_t> seed;  ///< --seed, in place of the file's
};

}  // namespace beltlife
