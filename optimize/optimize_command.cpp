// The command optimize: see commands.h.
#include "optimize/commands.h"
#include "optimize/layout_search.h"
#include "results/course/run_driver.h"
#include "results/course/shared_options.h"

namespace beltlife {

void add_optimize_command(CommandLine& line) {
  auto o = std::make_shared<DriverOptions>();
  Command command = line.command("optimize", "search layouts for the longest life, within named clearances");
  driver_flags(command, *o, "search file (TOML)", true);
  command.prints("--fields", reference_of<OptimizationSpec>, "print the reference of the file's fields as Markdown")
      .prints("--answer", reference_of_answer<SearchAnswer>, "print the reference of the answer's parts as Markdown")
      .footer(
          "Examples:\n"
          "  beltlife optimize optimize/examples/small.toml\n"
          "  beltlife optimize optimize/examples/thesis_quick.toml --out quick.h5 && beltlife report quick.h5\n"
          "A run that is stopped goes on with the same command. Fields of the file: --fields, or optimize/README.md.")
      .spreads_over_processes()
      .runs(
          o, +[](const DriverOptions& options) { return run_driver<LayoutSearch>(options, "optimize"); });
}

}  // namespace beltlife
