// Owns the words about a path that names nothing.
#include "sim/scene/spec_path.h"

#include <algorithm>

namespace beltlife {
namespace {

/// The part of `path` up to the dot after `from`.
std::string_view component(std::string_view path, std::size_t from) {
  return path.substr(from, path.find('.', from) - from);
}

/// What may follow `prefix` (empty, or ending in a dot), each once, in field order.
std::vector<std::string> continuations(const std::vector<std::string>& paths, std::string_view prefix) {
  std::vector<std::string> words;
  for (const std::string& path : paths) {
    if (!path.starts_with(prefix)) continue;
    const std::string word(component(path, prefix.size()));
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return words;
}

}  // namespace

Fault explain_unknown_path(std::string_view path, const std::vector<std::string>& paths,
                           const std::vector<std::string>& absent) {
  for (const std::string& section : absent) {
    if (path == section || path.starts_with(section + ".")) {
      return {"", "there is no table [" + section + "], and a setting cannot create it", ""};
    }
  }
  // The longest beginning of the path that exists tells where it goes astray.
  std::string prefix;
  std::size_t start = 0;
  while (start < path.size()) {
    const std::string longer = prefix + std::string(component(path, start)) + ".";
    if (continuations(paths, longer).empty()) break;
    prefix = longer;
    start = prefix.size();
  }
  std::vector<std::string> words = continuations(paths, prefix);
  for (std::string& word : words) word.insert(0, prefix);
  if (start >= path.size()) return {"", "is a table or a name, not a value", joined(words)};
  return {"", "no such field" + did_you_mean(path, paths), joined(words)};
}

}  // namespace beltlife
