// Owns addressing: every value of a Spec by its path, read and set through it.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/scene/spec_shape.h"
#include "sim/scene/spec_value.h"

namespace beltlife {

/// Handed to the leaf function in place of a section that the Spec does not have.
struct AbsentSection {};

/// Calls leaf(path, value, rule) for every scalar and list of scalars in the Spec, in field order.
template <class Leaf>
class LeafVisitor {
 public:
  LeafVisitor(SpecPath path, Leaf& leaf) : path_(std::move(path)), leaf_(leaf) {}

  template <class T>
  void operator()(std::string_view key, T& value, const Rule& rule, std::string_view) {
    const SpecPath path = path_.child(key);
    if constexpr (LeafType<T>) {
      leaf_(path, value, rule);
    } else if constexpr (SpecList<T>) {
      for (std::size_t i = 0; i < value.size(); ++i) enter(path.element(i, element_name(value[i])), value[i]);
    } else if constexpr (OptionalSpec<T>) {
      AbsentSection absent;
      value ? enter(path, *value) : leaf_(path, absent, rule);
    } else {
      enter(path, value);
    }
  }

 private:
  template <class Spec>
  void enter(SpecPath path, Spec& spec) {
    LeafVisitor inner(std::move(path), leaf_);
    spec.visit(inner);
  }

  SpecPath path_;
  Leaf& leaf_;
};

template <SpecType Spec, class Leaf>
void for_each_leaf(Spec& spec, Leaf leaf) {
  LeafVisitor<Leaf> visitor({}, leaf);
  spec.visit(visitor);
}

/// Index of the list element that `path` names inside the list at `list_path` ("torque.t.speeds_rpm.2"), if it does.
inline std::optional<std::size_t> element_index(std::string_view path, std::string_view list_path) {
  if (!path.starts_with(list_path) || path.size() < list_path.size() + 2 || path[list_path.size()] != '.') return {};
  const std::string_view digits = path.substr(list_path.size() + 1);
  std::size_t index = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc{} || stop != digits.data() + digits.size()) return {};
  return index;
}

/// Calls act(value, rule, place) with the leaf that `path` names: a leaf of the Spec or one element of a list. False
/// where there is none.
template <SpecType Spec, class Act>
bool at_path(Spec& spec, std::string_view path, Act act) {
  bool found = false;
  for_each_leaf(spec, [&]<class T>(const SpecPath& leaf, T& value, const Rule& rule) {
    if constexpr (!std::same_as<T, AbsentSection>) {
      if (found) return;
      if (leaf.shown == path) {
        found = true;
        act(value, rule, leaf.place);
      } else if constexpr (ScalarList<T>) {
        const std::optional<std::size_t> index = element_index(path, leaf.shown);
        if (!index || *index >= value.size()) return;
        found = true;
        act(value[*index], rule, leaf.place);
      }
    }
  });
  return found;
}

/// All paths of the Spec; of lists, the list and each element. `absent` receives the sections it does not have.
template <SpecType Spec>
std::vector<std::string> all_paths(Spec& spec, std::vector<std::string>& absent) {
  std::vector<std::string> paths;
  for_each_leaf(spec, [&]<class T>(const SpecPath& leaf, T& value, const Rule&) {
    if constexpr (std::same_as<T, AbsentSection>) {
      absent.push_back(leaf.shown);
    } else {
      paths.push_back(leaf.shown);
      if constexpr (ScalarList<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) paths.push_back(leaf.element(i).shown);
      }
    }
  });
  return paths;
}

/// Why `path` names nothing: a misspelling, a table, or a field of an absent section.
Fault explain_unknown_path(std::string_view path, const std::vector<std::string>& paths,
                           const std::vector<std::string>& absent);

/// The node that the text of a --set stands for, where a field of type T wants it: text and choices need no quotes.
template <class T>
TomlNode node_for(const T&, std::string_view text) {
  if constexpr (OptionalType<T>) {
    return node_for(typename OptionalOf<T>::Inner{}, text);
  } else if constexpr (std::same_as<T, std::string> || EnumType<T>) {
    return text.starts_with('"') ? node_from_text(text) : TomlNode{0, std::string(text)};
  } else {
    return node_from_text(text);
  }
}

/// Sets the field at `path` from text; no text at all takes away an optional value. Returns the faults, and the
/// field's place in the file through `place`.
template <SpecType Spec>
Faults set_by_text(Spec& spec, std::string_view path, std::string_view text, std::string& place) {
  Faults faults;
  const auto set = [&]<class T>(T& value, const Rule& rule, const std::string& where) {
    place = where;
    if constexpr (OptionalType<T>) {
      if (text.empty()) return value.reset();
    }
    assign(value, node_for(value, text), rule, faults);
  };
  if (!at_path(spec, path, set)) {
    std::vector<std::string> absent;
    const std::vector<std::string> paths = all_paths(spec, absent);
    faults.push_back(explain_unknown_path(path, paths, absent));
  }
  return faults;
}

}  // namespace beltlife
