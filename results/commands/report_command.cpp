// The command report: from result files or a study to a page.
#include <fmt/format.h>

#include <filesystem>

#include "results/commands/commands.h"
#include "results/pages/run/report.h"
#include "results/pages/run/report_compare.h"
#include "results/pages/study/study_page.h"
#include "results/store/study_file.h"
#include "results/store/whole_file.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  std::string out;  ///< --out, empty: beside the first file
  bool quiet = false;
  std::vector<StudyPage> pages;  ///< of all kinds of study
};

/// NAME.html beside NAME.h5, NAME.jsonl or NAME.jsonl.gz.
std::string page_beside(const std::string& input) {
  std::filesystem::path path = input;
  if (path.extension() == ".gz") path.replace_extension();
  return path.replace_extension(".html").string();
}

void check_output(const ReportOptions& o, const std::string& output) {
  std::error_code ignored;
  for (const std::string& input : o.files)
    if (std::filesystem::equivalent(input, output, ignored))
      throw BadInput({Problem{output, 0, "--out", "is the file that the page is about", "another name"}});
  check_writable(output);
}

/// Reads all files before it complains, and of all that are wrong.
std::string comparison_of(const std::vector<std::string>& inputs) {
  constexpr std::size_t most = 12;  // as many as curves have colours
  if (inputs.size() > most)
    throw BadInput({Problem{"report", 0, "", fmt::format("{} files cannot be told apart on a page", inputs.size()),
                            fmt::format("up to {} result files", most)}});
  std::vector<ComparedFile> files;
  std::vector<Problem> problems;
  for (const std::string& input : inputs) try {
      if (is_study(input))
        problems.push_back({input, 0, "", "is of a study, and those are not compared",
                            "result files of simulate, life or replay; a study by itself"});
      else
        files.push_back({input, read_results(input)});
    } catch (const BadInput& bad) {
      problems.insert(problems.end(), bad.problems().begin(), bad.problems().end());
    }
  if (!problems.empty()) throw BadInput(problems);
  return comparison_html(files);
}

int run_report(const ReportOptions& o) {
  const std::string& input = o.files.at(0);
  const bool several = o.files.size() > 1;
  const std::string beside = several ? comparison_page_beside(o.files) : page_beside(input);
  const std::string output = o.out.empty() ? beside : o.out;
  check_output(o, output);
  const std::string page = several           ? comparison_of(o.files)
                           : is_study(input) ? study_html(read_study_record(input), input, o.pages)
                                             : report_html(read_results(input), input);
  write_whole_file(output, page);
  if (!o.quiet) fmt::print("wrote {}\n", output);
  return 0;
}

}  // namespace

void add_report_command(CommandLine& line, std::vector<StudyPage> pages) {
  auto o = std::make_shared<ReportOptions>();
  o->pages = std::move(pages);
  line.command("report",
               "write one HTML page about a result file or a study, or about several result files side by side")
      .inputs("files", o->files,
              "HDF5 result file (--out of simulate, life, study), or a study's log (.jsonl, .jsonl.gz); several result "
              "files of simulate and life are compared")
      .text("--out", o->out, "FILE.html", "the page; by default beside the (first) file, ending in .html")
      .flag("--quiet", o->quiet, "do not say what was written")
      .footer(
          "Examples:\n"
          "  beltlife simulate sim/scenes/two_pulley.toml --each-range --out two.h5 && beltlife report two.h5\n"
          "  beltlife report baseline.h5 alternative_1.h5    (writes baseline_vs_alternative_1.html)")
      .runs(o, run_report);
}

}  // namespace beltlife
