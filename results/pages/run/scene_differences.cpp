// The comparison of scenes: see scene_differences.h.
#include "results/pages/run/scene_differences.h"

#include <algorithm>
#include <map>

#include "sim/scene/spec_path.h"

namespace beltlife {
namespace {

constexpr const char* absent = "-";

template <class T>
std::string spelled(const T& value) {
  if constexpr (OptionalType<T>)
    return value ? spelled(*value) : absent;
  else
    return spell(value);
}

}  // namespace

std::vector<SceneDifference> scene_differences(const std::vector<const SceneSpec*>& scenes) {
  std::vector<SceneDifference> fields;
  std::map<std::string, std::size_t> at;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SceneSpec scene = *scenes[i];
    std::size_t place = 0;  // behind the field before it, so that what only a later scene has stands among its like
    for_each_leaf(scene, [&]<class T>(const SpecPath& leaf, T& value, const Rule&) {
      if constexpr (!std::same_as<T, AbsentSection>) {
        auto known = at.find(leaf.shown);
        if (known == at.end()) {
          for (auto& [path, index] : at) index += index >= place;
          fields.insert(fields.begin() + static_cast<std::ptrdiff_t>(place),
                        {leaf.shown, std::vector<std::string>(scenes.size(), absent)});
          known = at.emplace(leaf.shown, place).first;
        }
        fields[known->second].values[i] = spelled(value);
        place = known->second + 1;
      }
    });
  }
  std::erase_if(fields, [](const SceneDifference& field) {
    return std::ranges::all_of(field.values, [&](const std::string& v) { return v == field.values.front(); });
  });
  return fields;
}

}  // namespace beltlife
