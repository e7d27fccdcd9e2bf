// Owns paths inside a result file: joining them, and names that are legal and unique below one parent.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>

#include "results/store/hdf5_image.h"
#include "results/store/names.h"

namespace beltlife {

inline std::string join(std::string_view parent, std::string_view name) {
  return std::string(parent) + "/" + std::string(name);
}

/// Hands out components that are unique below one parent, so that no result is lost to a repeated name. A '/' would
/// separate groups and "." means "here".
class UniqueNames {
 public:
  std::string take(std::string name) {
    for (char& c : name)
      if (c == '/') c = '_';
    if (name.empty() || name == ".") name = "_";
    std::string unique = name;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    return unique;
  }

 private:
  std::set<std::string> taken_;
};

inline void put(Hdf5Image& file, const std::string& parent, const names::Dataset& as, std::span<const double> values) {
  file.dataset(join(parent, as.name), values, as.unit, as.about);
}

inline void put(Hdf5Image& file, const std::string& parent, const names::Dataset& as,
                std::span<const std::string> values) {
  file.dataset(join(parent, as.name), values, as.about);
}

}  // namespace beltlife
