// Owns what results/README.md documents: the names in a result file with their units, and its spelling of a real path.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace beltlife {

/// Unit by name, read off the table below this heading of the README.
inline std::map<std::string, std::string> documented_units(const std::string& heading = "## Format 1") {
  std::map<std::string, std::string> documented;
  std::ifstream readme(std::filesystem::path(BELTLIFE_SOURCE) / "results/README.md");
  bool below = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("## ")) below = line == heading;
    if (!below || !line.starts_with("| `/")) continue;  // rows are | `name` | unit | meaning |
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
