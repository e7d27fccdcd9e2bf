// Owns the options of every command, and the commands that belong to no driver. main.cpp fills the options.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace beltlife {

class Ranks;
struct StudyPage;

/// What every command understands; the comments are the flags.
struct CommandOptions {
  std::vector<std::string> scenes;    ///< positional; all but `life` take one
  std::vector<std::string> settings;  ///< --set, and what --scheme, --step, --elements stand for
  std::vector<std::string> ranges;    ///< --range
  std::string out;                    ///< --out, empty: no file; of several scenes each gets NAME_SCENE.h5
  int threads = 0;                    ///< --threads, 0: all
  bool json = false;
  bool quiet = false;
  bool force = false;                 ///< --force: run with a step beyond the predicted limit
  bool each_range = false;            ///< --each-range of simulate
  bool profile = false;               ///< --profile: time by kernel
  int frames = 96;                    ///< --frames of what is written to --out: of the moving drive, a range; 0: none
  std::string sweep;                  ///< --sweep of simulate, FROM:TO:SECONDS; empty: none
  std::string details;                ///< --details of life: text file for what simulate prints, empty: none
  std::string map;                    ///< --map of modes: SVG file, empty: none
  double flank_for_life_h = 0;        ///< --flank-for of life, 0: not asked
  std::string kind;                   ///< KIND of study
  std::optional<std::uint64_t> seed;  ///< --seed, in place of the study file's
  std::size_t point = 0;              ///< --point of replay
  std::optional<int> port;            ///< --port of serve, in place of the study file's
  std::string address;                ///< --address of serve, empty: the study file's
  std::string command_line, version, revision, compiler;
  Ranks* ranks = nullptr;             ///< the processes that share a driver's points; null: this one alone
  std::vector<std::string> datasets;  ///< DATASET of export
};

/// Return the process exit code: 0 done, 3 ran but failed. Throw BadInput (exit 2).
int run_check(const CommandOptions& options);
int run_modes(const CommandOptions& options);
int run_simulate(const CommandOptions& options);
int run_life(const CommandOptions& options);
/// simulate with --sweep.
int run_sweep(const CommandOptions& options);
/// Reads a result file (`scenes` holds its name) and writes a page beside it, or to --out. Of several result files it
/// writes one page that compares them. `pages`: of the kinds of study.
int run_report(const CommandOptions& options, std::span<const StudyPage> pages);
/// Prints the datasets of an HDF5 file (`scenes` holds its name), or those in `datasets` as CSV, there or to --out.
int run_export(const CommandOptions& options);
/// Runs one point of a study (`scenes` holds its log or result file) again, with full output.
int run_replay(const CommandOptions& options);
/// Serves the model of a study file (`scenes` holds its name) over UM-Bridge until SIGINT or SIGTERM. Prints its URL.
int run_serve(const CommandOptions& options);
/// Reference of the fields of such a file, as Markdown.
std::string serve_fields();

}  // namespace beltlife
