// The command report: from a result file or a study to a page.
#include <fmt/format.h>

#include <filesystem>

#include "results/commands.h"
#include "results/report.h"
#include "results/study_file.h"
#include "results/study_page.h"
#include "results/whole_file.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

/// NAME.html beside NAME.h5, NAME.jsonl or NAME.jsonl.gz.
std::string page_beside(const std::string& input) {
  std::filesystem::path path = input;
  if (path.extension() == ".gz") path.replace_extension();
  return path.replace_extension(".html").string();
}

}  // namespace

int run_report(const CommandOptions& o) {
  const std::string& input = o.scenes.at(0);
  const std::string output = o.out.empty() ? page_beside(input) : o.out;
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored))
    throw BadInput({Problem{output, 0, "--out", "is the file that the page is about", "another name"}});
  check_writable(output);
  const std::string page =
      is_study(input) ? study_html(read_study_record(input), input) : report_html(read_results(input), input);
  write_whole_file(output, page);
  if (!o.quiet) fmt::print("wrote {}\n", output);
  return 0;
}

}  // namespace beltlife
