// Owns the parts of reading that do not depend on the Spec's type.
#include "sim/scene/spec_reader.h"

#include <algorithm>

namespace beltlife {

namespace {

/// pulley[1].x_mm -> pulley[1] -> pulley -> "", the root
std::string around(const std::string& place) {
  const std::size_t cut = place.find_last_of(".[");
  return cut == place.npos ? std::string{} : place.substr(0, cut);
}

}  // namespace

int ReadLog::line(std::string place) const {
  while (true) {
    const auto found = lines.find(place);
    if (found != lines.end()) return found->second;
    if (place.empty()) return 0;
    place = around(place);
  }
}

bool ReadLog::is_faulty(std::string place) const {
  for (; !place.empty(); place = around(place)) {
    if (faulty.contains(place)) return true;
  }
  return false;
}

void SpecReader::refuse_unknown_keys() {
  for (const TomlEntry& entry : table_.entries) {
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) continue;
    const SpecPath path = path_.child(entry.key.empty() ? "\"\"" : entry.key);  // TOML allows an empty key
    log_.add(path, entry.line, "unknown key" + did_you_mean(entry.key, keys_), joined(keys_));
    // The key that was probably meant is as good as faulty: without it, later checks would find it missing once more.
    const std::string_view meant = nearest(entry.key, keys_);
    if (!meant.empty()) log_.faulty.insert(path_.child(meant).place);
  }
}

bool SpecReader::is_table(const TomlNode& node, const TomlEntry& entry, const SpecPath& path, std::string_view wanted) {
  if (node.table()) return true;
  Faults faults;
  wrong_type(node, wanted, "", faults);
  log_.add(path, entry.line, faults);
  return false;
}

void throw_problems(std::vector<Problem> problems) {
  if (problems.empty()) return;
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem& a, const Problem& b) { return a.line < b.line; });
  throw BadInput(std::move(problems));
}

}  // namespace beltlife
