// The command export: datasets of a result or study file as a list or as CSV.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "results/commands/commands.h"
#include "results/store/dataset_export.h"
#include "results/store/whole_file.h"
#include "results/text/table.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

std::string shape_text(const std::vector<std::size_t>& shape) {
  return shape.empty() ? "1" : fmt::format("{}", fmt::join(shape, " x "));
}

std::string list_text(const std::vector<DatasetEntry>& list) {
  Table table({"dataset", "shape", "type", "unit", "description"});
  for (const DatasetEntry& e : list)
    table.row({e.path, shape_text(e.shape), e.type, e.unit.empty() ? "-" : e.unit, e.description});
  return table.text();
}

std::string list_json(const std::vector<DatasetEntry>& list) {
  nlohmann::json j = nlohmann::json::array();
  for (const DatasetEntry& e : list)
    j.push_back(
        {{"dataset", e.path}, {"shape", e.shape}, {"type", e.type}, {"unit", e.unit}, {"description", e.description}});
  return nlohmann::json{{"datasets", j}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

struct ExportOptions {
  std::string file;
  std::vector<std::string> datasets;  ///< DATASET
  std::string out;                    ///< --out, empty: standard output
  bool json = false, quiet = false;
};

int run_export(const ExportOptions& o) {
  if (o.datasets.empty() && !o.out.empty())
    throw BadInput({Problem{"--out", 0, "", "there is nothing to write without a DATASET",
                            "names of datasets or groups; without them and --out they are listed"}});
  if (!o.datasets.empty() && o.json)
    throw BadInput({Problem{"--json", 0, "", "datasets come out as CSV", "--json without DATASET, for the list"}});
  std::error_code ignored;
  if (!o.out.empty() && std::filesystem::equivalent(o.file, o.out, ignored))
    throw BadInput({Problem{o.out, 0, "--out", "is the file that is read", "another name"}});
  const Hdf5Source file(o.file);
  if (o.datasets.empty()) {
    const auto list = datasets_of(file);
    print(o.json ? list_json(list) : list_text(list));
    return 0;
  }
  if (!o.out.empty()) check_writable(o.out);
  const std::string csv = datasets_csv(file, o.datasets);
  if (o.out.empty())
    print(csv);
  else
    write_whole_file(o.out, csv);
  if (!o.out.empty() && !o.quiet) fmt::print("wrote {}\n", o.out);
  return 0;
}

}  // namespace

void add_export_command(CommandLine& line) {
  auto o = std::make_shared<ExportOptions>();
  line.command("export", "list the datasets of a result or study file, or write them as CSV")
      .input("file", o->file, "HDF5 file (--out of simulate, life, study, ...)")
      .inputs_or_none("datasets", o->datasets,
                      "datasets, or groups whose datasets are equally long, to stand side by side; without any they "
                      "are listed",
                      "DATASET")
      .text("--out", o->out, "FILE.csv", "write there instead of to standard output")
      .flag("--json", o->json, "the list as one JSON object")
      .flag("--quiet", o->quiet, "do not say what was written")
      .footer(
          "Examples:\n"
          "  beltlife export two.h5\n"
          "  beltlife export two.h5 runs/0/trace --out trace.csv\n"
          "  beltlife export two.h5 ranges/fast/spectra/frequency_hz ranges/fast/spectra/driven.speed_rpm")
      .runs(o, run_export);
}

}  // namespace beltlife
