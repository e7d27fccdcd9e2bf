// The command report: from a result file to a page.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "results/commands.h"
#include "results/report.h"
#include "results/results_file.h"
#include "sim/scene/scene_io.h"

namespace beltlife {

int run_report(const CommandOptions& o) {
  const std::string& input = o.scenes.at(0);
  const std::string output = o.out.empty() ? std::filesystem::path(input).replace_extension(".html").string() : o.out;
  check_writable(output);
  const std::string page = report_html(read_results(input), input);
  if (!(std::ofstream(output) << page << std::flush))
    throw BadInput({Problem{output, 0, "", "cannot be written", "free space on the disk, or a path elsewhere"}});
  if (!o.quiet) fmt::print("wrote {}\n", output);
  return 0;
}

}  // namespace beltlife
