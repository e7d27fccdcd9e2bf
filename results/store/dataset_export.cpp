// Datasets as a list and as CSV: see dataset_export.h.
#include "results/store/dataset_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "results/text/csv.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/spec_value.h"

namespace beltlife {
namespace {

[[noreturn]] void refuse(const Hdf5Source& file, const std::string& path, const std::string& what,
                         const std::string& allowed) {
  throw BadInput({Problem{file.name(), 0, path, what, allowed}});
}

/// Without slashes at its ends.
std::string bare(const std::string& path) {
  const std::size_t first = path.find_first_not_of('/');
  return first == path.npos ? "" : path.substr(first, path.find_last_not_of('/') - first + 1);
}

std::string below(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

std::string attribute(const Hdf5Source& file, const std::string& path, const char* name) {
  return file.has("/" + path, name) ? file.text("/" + path, name) : "";
}

/// Calls act(path, kind) for everything below a group, itself first.
template <class Act>
void for_each_below(const Hdf5Source& file, const std::string& path, Act act) {
  const Hdf5Kind kind = file.kind("/" + path);
  act(path, kind);
  if (kind == Hdf5Kind::group)
    for (const std::string& name : file.children("/" + path)) for_each_below(file, below(path, name), act);
}

/// Says what is near to a path that names nothing, and what there is in the last group on its way.
[[noreturn]] void refuse_unknown(const Hdf5Source& file, const std::string& path) {
  std::vector<std::string> paths;
  for_each_below(file, "", [&](const std::string& p, Hdf5Kind) {
    if (!p.empty()) paths.push_back(p);
  });
  std::string group = path;
  do {
    const std::size_t slash = group.rfind('/');
    group = slash == group.npos ? "" : group.substr(0, slash);
  } while (!group.empty() && file.kind("/" + group) != Hdf5Kind::group);
  const auto names = file.children("/" + group);
  const std::string tail = path.substr(path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1);
  std::vector<std::string> near;
  if (const auto whole = nearest(path, paths); !whole.empty()) near.emplace_back(whole);
  for (const std::string& p : paths)  // the right name in another group
    if (near.size() < 3 && p.ends_with("/" + tail) && std::ranges::find(near, p) == near.end()) near.push_back(p);
  for (std::string& p : near) p = "'" + p + "'";
  const std::string question = near.empty() ? "" : "; did you mean " + joined(near, " or ") + "?";
  refuse(file, path, "no such dataset or group" + question,
         (group.empty() ? "in the file: " : "in " + group + ": ") + joined(names));
}

/// Every entry of the dataset as it stands in a CSV file.
std::vector<std::string> fields_of(const Hdf5Source& file, const std::string& path, Hdf5Kind kind) {
  std::vector<std::string> fields;
  if (kind == Hdf5Kind::text)
    for (const std::string& text : file.texts("/" + path)) fields.push_back(csv_field(text));
  else if (kind == Hdf5Kind::real)
    for (const double value : file.numbers("/" + path)) fields.push_back(csv_number(value));
  else
    for (const std::int64_t value : file.long_integers("/" + path)) fields.push_back(std::to_string(value));
  return fields;
}

/// The datasets that a name stands for.
std::vector<std::string> meant_by(const Hdf5Source& file, const std::string& path) {
  const Hdf5Kind kind = path.empty() ? Hdf5Kind::group : file.kind("/" + path);
  if (kind == Hdf5Kind::nothing) refuse_unknown(file, path);
  if (kind != Hdf5Kind::group) return {path};
  std::vector<std::string> sets;
  const auto names = file.children("/" + path);
  for (const std::string& name : names)
    if (file.kind("/" + below(path, name)) != Hdf5Kind::group) sets.push_back(below(path, name));
  if (sets.empty())
    refuse(file, path.empty() ? "/" : path, "is a group without datasets of its own",
           names.empty() ? "another group" : "one of its groups: " + joined(names));
  return sets;
}

/// How long a dataset is, for a refusal.
std::string size_words(const Hdf5Source& file, const std::string& path, std::size_t rows) {
  return fmt::format("{} has {} row{}{}", path, rows, rows == 1 ? "" : "s",
                     file.extents("/" + path).empty() ? " (a single value)" : "");
}

}  // namespace

std::vector<DatasetEntry> datasets_of(const Hdf5Source& file) {
  std::vector<DatasetEntry> list;
  for_each_below(file, "", [&](const std::string& path, Hdf5Kind kind) {
    if (kind == Hdf5Kind::group || kind == Hdf5Kind::nothing) return;
    const char* type = kind == Hdf5Kind::real      ? "number"
                       : kind == Hdf5Kind::integer ? "integer"
                       : kind == Hdf5Kind::truth   ? "yes or no"
                                                   : "text";
    list.push_back(
        {path, type, file.extents("/" + path), attribute(file, path, "unit"), attribute(file, path, "description")});
  });
  return list;
}

std::string datasets_csv(const Hdf5Source& file, const std::vector<std::string>& wanted) {
  std::vector<std::string> paths;
  for (const std::string& name : wanted)
    for (std::string& path : meant_by(file, bare(name))) paths.push_back(std::move(path));
  const auto last = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  std::set<std::string> names;
  for (const std::string& path : paths) names.insert(last(path));
  const bool repeat = names.size() < paths.size();

  std::vector<CsvColumn> columns;
  std::size_t rows = 0;
  for (const std::string& path : paths) {
    const auto sides = file.extents("/" + path);
    const std::size_t own = sides.empty() ? 1 : sides[0];
    if (path == paths.front()) rows = own;
    if (own != rows)
      refuse(file, path,
             "cannot stand beside the others: " + size_words(file, paths.front(), rows) + ", " +
                 size_words(file, path, own),
             "datasets of one length, each of the others by itself");
    std::size_t across = 1;
    for (std::size_t i = 1; i < sides.size(); ++i) across *= sides[i];
    const std::string unit = attribute(file, path, "unit"), heading = repeat ? path : last(path);
    const auto fields = fields_of(file, path, file.kind("/" + path));
    for (std::size_t k = 0; k < across; ++k) {
      CsvColumn column{
          heading + (sides.size() > 1 ? fmt::format("[{}]", k) : "") + (unit.empty() ? "" : " [" + unit + "]"), {}};
      for (std::size_t row = 0; row < rows; ++row) column.fields.push_back(fields.at(row * across + k));
      columns.push_back(std::move(column));
    }
  }
  return csv_text(columns);
}

}  // namespace beltlife
