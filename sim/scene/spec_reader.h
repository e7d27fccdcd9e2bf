// Owns reading: any Spec with a visit() list from a TOML tree, with every problem found and located.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/scene/scene_io.h"
#include "sim/scene/spec_shape.h"
#include "sim/scene/spec_value.h"
#include "sim/scene/toml_tree.h"

namespace beltlife {

/// What reading leaves behind beside the Spec: problems, and where each field stands, for checks that come later.
struct ReadLog {
  std::string file;
  std::vector<Problem> problems;
  std::map<std::string, int> lines;  ///< by SpecPath::place
  std::set<std::string> faulty;  ///< places whose value was not taken: later checks must not complain of those again

  /// Line of the field, else of the table it would stand in; 0 where nothing was read.
  int line(std::string place) const;
  /// True where this field, or a table around it, was not taken.
  bool is_faulty(std::string place) const;

  void add(const SpecPath& path, int line, std::string what, std::string allowed) {
    problems.push_back({file, line, path.shown, std::move(what), std::move(allowed)});
    faulty.insert(path.place);
  }
  void add(const SpecPath& path, int line, const Faults& faults) {
    for (const Fault& fault : faults) {
      problems.push_back({file, line, path.shown + fault.suffix, fault.what, fault.allowed});
      faulty.insert(path.place);
    }
  }
};

/// The visitor that fills one Spec from one table.
class SpecReader {
 public:
  SpecReader(const TomlNode& node, SpecPath path, ReadLog& log)
      : table_(*node.table()), line_(node.line), path_(std::move(path)), log_(log) {}

  template <class T>
  void operator()(std::string_view key, T& value, const Rule& rule, std::string_view) {
    keys_.emplace_back(key);
    const SpecPath path = path_.child(key);
    const TomlEntry* entry = table_.find(key);
    if (entry) {
      log_.lines[path.place] = entry->line;
      take(*entry, value, rule, path);
    } else if (rule.required) {
      log_.add(path, line_, missing<T>(key), allowed<T>(rule));
    }
  }

  /// Complains of every key that no field claimed.
  void refuse_unknown_keys();

 private:
  template <class T>
  static std::string missing(std::string_view key) {
    if constexpr (SpecType<T> || OptionalSpec<T>) return "missing table [" + std::string(key) + "]";
    if constexpr (SpecList<T>) return "missing table [[" + std::string(key) + "]]";
    return "missing key";
  }

  template <class T>
  static std::string allowed(const Rule& rule) {
    if constexpr (LeafType<T>) {
      const std::string limits = limits_text(rule);
      return type_words<T>() + (limits.empty() ? "" : " " + limits);
    }
    return {};
  }

  template <LeafType T>
  void take(const TomlEntry& entry, T& value, const Rule& rule, const SpecPath& path) {
    Faults faults;
    assign(value, entry.node, rule, faults);
    log_.add(path, entry.line, faults);
  }

  template <SpecType T>
  void take(const TomlEntry& entry, T& value, const Rule&, const SpecPath& path) {
    if (is_table(entry.node, entry, path, "a table [...]")) read_table(entry.node, value, path, log_);
  }

  template <OptionalSpec T>
  void take(const TomlEntry& entry, T& value, const Rule& rule, const SpecPath& path) {
    take(entry, value.emplace(), rule, path);
  }

  template <SpecList T>
  void take(const TomlEntry& entry, T& list, const Rule&, const SpecPath& path) {
    const TomlArray* array = entry.node.array();
    if (!array) {
      Faults faults;
      wrong_type(entry.node, "an array of tables [[...]]", "[[" + entry.key + "]]", faults);
      return log_.add(path, entry.line, faults);
    }
    list.clear();
    for (std::size_t i = 0; i < array->size(); ++i) {
      const TomlNode& node = (*array)[i];
      auto& element = list.emplace_back();
      const SpecPath element_path = path.element(i, name_of(element, node));
      log_.lines[element_path.place] = node.line;
      if (is_table(node, entry, element_path, "a table [[...]]")) read_table(node, element, element_path, log_);
    }
  }

  /// The name by which the messages call an element, if its Spec has names and the file gives one.
  template <class Spec>
  static std::string_view name_of(const Spec&, const TomlNode& node) {
    if constexpr (requires(Spec spec) { std::string_view(spec.name); }) {
      const TomlEntry* entry = node.table() ? node.table()->find("name") : nullptr;
      if (const auto* text = entry ? std::get_if<std::string>(&entry->node.value) : nullptr) return *text;
    }
    return {};
  }

  template <SpecType T>
  static void read_table(const TomlNode& node, T& value, const SpecPath& path, ReadLog& log) {
    SpecReader reader(node, path, log);
    value.visit(reader);
    reader.refuse_unknown_keys();
  }

  bool is_table(const TomlNode& node, const TomlEntry& entry, const SpecPath& path, std::string_view wanted);

  const TomlTable& table_;
  int line_;
  SpecPath path_;
  ReadLog& log_;
  std::vector<std::string> keys_;
};

/// Reads a Spec from a root table (parse_toml). Look at log.problems before using the Spec.
template <SpecType Spec>
Spec read_spec(const TomlNode& root, ReadLog& log) {
  Spec spec;
  log.lines[""] = root.line;
  SpecReader reader(root, {}, log);
  spec.visit(reader);
  reader.refuse_unknown_keys();
  return spec;
}

/// Sorts the problems by line, for people who go through a file from the top, and throws them if there are any.
void throw_problems(std::vector<Problem> problems);

}  // namespace beltlife
