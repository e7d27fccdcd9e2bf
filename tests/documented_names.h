// Owns what is documented of files: the names in them with their units, and the spelling of a real path.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace beltlife {

/// Unit by name, read off the table of a document in results/store.
inline std::map<std::string, std::string> documented_units(const std::string& document = "result_files.md") {
  std::map<std::string, std::string> documented;
  std::ifstream text(std::filesystem::path(BELTLIFE_SOURCE) / "results/store" / document);
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("| `/")) continue;  // rows are | `name` | unit | meaning |
    const std::size_t end = line.find('`', 3), bar = line.find('|', end), next = line.find('|', bar + 1);
    const std::string cell = line.substr(bar + 2, next - bar - 2);
    documented[line.substr(3, end - 3)] = cell.empty() ? "" : cell.substr(0, cell.size() - 1);
  }
  return documented;
}

/// A path in a file as the documentation spells it: the scene's names replaced by what they are names of.
inline std::string documented_spelling(const std::string& path) {
  std::istringstream parts(path);
  std::string spelling, parent;
  for (std::string part; std::getline(parts, part, '/'); parent = part) {
    if (parent == "runs") part = "RUN";
    if (parent == "ranges" || parent == "life") part = "RANGE";
    if (parent == "passes") part = "PULLEY";
    if (parent == "energy_share" || parent == "shape") part = "BODY";
    if (parent == "map" && part != "crank_rpm") part = "CURVE";
    if (part.find('.') != std::string::npos) part = "CHANNEL";
    spelling += part.empty() ? "" : "/" + part;
  }
  return spelling.empty() ? "/" : spelling;
}

}  // namespace beltlife
