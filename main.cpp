// The beltlife command: hands the command line to the commands and turns bad input into exit code 2.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>

#include "calibrate/commands.h"
#include "calibrate/pages/calibrate_page.h"
#include "optimize/commands.h"
#include "optimize/pages/optimize_page.h"
#include "results/commands/commands.h"
#include "results/journal/ranks.h"
#include "results/server/serve_command.h"
#include "sim/scene/scene_io.h"
#include "studies/commands.h"
#include "studies/pages.h"

namespace {

using namespace beltlife;

std::vector<StudyPage> all_pages() {
  std::vector<StudyPage> pages(study_pages().begin(), study_pages().end());
  pages.push_back(calibration_page());
  pages.push_back(layout_search_page());
  return pages;
}

int run(int argc, char** argv, Ranks* ranks) {
  Program program{BELTLIFE_VERSION, BELTLIFE_REVISION, BELTLIFE_COMPILER, "", ranks};
  for (int i = 0; i < argc; ++i) program.command_line += (i ? " " : "") + std::string(argv[i]);
  CommandLine line(program, "beltlife: simulates poly-V belt drives in time and predicts how long the belt lives",
                   "Examples:\n"
                   "  beltlife check sim/scenes/baseline.toml\n"
                   "  beltlife simulate sim/scenes/two_pulley.toml --each-range --out two_pulley.h5\n"
                   "  beltlife life sim/scenes/baseline.toml --set belt.friction_front=0.5\n"
                   "  beltlife optimize optimize/examples/small.toml\n"
                   "Exit codes: 0 done, 1 usage, 2 bad input, 3 ran but failed, 4 a bug of ours.");
  line.top().prints("--fields", field_reference, "print the reference of all scene fields as Markdown and exit");
  add_check_command(line);
  add_modes_command(line);
  add_simulate_command(line);
  add_life_command(line);
  add_report_command(line, all_pages());
  add_export_command(line);
  add_study_command(line);
  add_calibrate_command(line);
  add_optimize_command(line);
  add_twin_command(line);
  add_replay_command(line);
  add_serve_command(line);
  return line.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<beltlife::Ranks> ranks;
  const auto failed = [&](const std::string& words, int code) {
    if (ranks && !ranks->leads())
      ranks->decline(words);
    else
      std::fprintf(stderr, "%s\n", words.c_str());
    return code;
  };
  try {
    ranks = beltlife::Ranks::join();
    const int code = run(argc, argv, ranks.get());
    if (std::fflush(stdout) == 0 && std::cout.flush()) return code;
    return failed(std::string("beltlife: the answer cannot be written to standard output: ") + std::strerror(errno), 3);
  } catch (const beltlife::BadInput& bad) {
    return failed(bad.what(), 2);
  } catch (const std::exception& bug) {
    return failed(
        std::string("beltlife: a bug: ") + bug.what() + "\nplease report it with the command and the scene file", 4);
  }
}
