// Owns single values: from a TOML node into a field with its checks, and from a field to its TOML spelling.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/scene/field.h"
#include "sim/scene/spec_shape.h"
#include "sim/scene/toml_tree.h"

namespace beltlife {

/// What is wrong with a value. `suffix` continues the field's path where one element of a list is meant (".2").
struct Fault {
  std::string suffix;
  std::string what;
  std::string allowed;
};
using Faults = std::vector<Fault>;

/// "above 0, at most 10", "from 0 to 10", "at least 3"; empty where there are no limits.
std::string limits_text(const Rule& rule);

/// " did you mean 'x'?", or nothing where no candidate resembles the word. nearest() gives the candidate alone.
std::string_view nearest(std::string_view word, const std::vector<std::string>& candidates);
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Takes node's value into `value`, or appends to `faults` and leaves `value` alone.
void assign(double& value, const TomlNode& node, const Rule& rule, Faults& faults);
void assign(bool& value, const TomlNode& node, const Rule& rule, Faults& faults);
void assign(std::string& value, const TomlNode& node, const Rule& rule, Faults& faults);
void assign_integer(std::int64_t& value, const TomlNode& node, const Rule& rule, Faults& faults);
/// Index of the chosen name, or -1 after a fault.
int assign_choice(std::span<const std::string_view> names, const TomlNode& node, Faults& faults);
void wrong_type(const TomlNode& node, std::string_view wanted, std::string_view allowed, Faults& faults);

/// The limits alone, for values that never were text.
void check_number(double value, const Rule& rule, Faults& faults);

/// Shortest spelling that reads back to the same bits.
std::string spell(double value);
std::string spell(const std::string& text);
inline std::string spell(bool value) { return value ? "true" : "false"; }

/// A node from the text of --set: TOML where it is TOML, else plain text.
TomlNode node_from_text(std::string_view text);

template <IntegerType T>
void assign(T& value, const TomlNode& node, const Rule& rule, Faults& faults) {
  Rule bounds = rule;  // the type's own limits, so that nothing is cut off silently
  bounds.lower = std::max(bounds.lower, static_cast<double>(std::numeric_limits<T>::lowest()));
  bounds.upper = std::min(bounds.upper, static_cast<double>(std::numeric_limits<T>::max()));
  std::int64_t wide = 0;
  const std::size_t before = faults.size();
  assign_integer(wide, node, bounds, faults);
  if (faults.size() == before) value = static_cast<T>(wide);
}

template <EnumType E>
void assign(E& value, const TomlNode& node, const Rule&, Faults& faults) {
  const int index = assign_choice(EnumNames<E>::names, node, faults);
  if (index >= 0) value = static_cast<E>(index);
}

template <ScalarList T>
void assign(T& list, const TomlNode& node, const Rule& rule, Faults& faults) {
  const TomlArray* array = node.array();
  if (!array) return wrong_type(node, "an array", "[value, value, ...]", faults);
  T taken;
  const std::size_t before = faults.size();
  for (std::size_t i = 0; i < array->size(); ++i) {
    Faults own;
    typename T::value_type element{};
    assign(element, (*array)[i], rule, own);
    taken.push_back(element);
    for (Fault& fault : own) faults.push_back({std::string(".").append(std::to_string(i)), fault.what, fault.allowed});
  }
  if (faults.size() == before) list = std::move(taken);
}

template <class T>
void assign(std::optional<T>& value, const TomlNode& node, const Rule& rule, Faults& faults) {
  T inner{};
  const std::size_t before = faults.size();
  assign(inner, node, rule, faults);
  if (faults.size() == before) value = std::move(inner);
}

template <IntegerType T>
std::string spell(T value) {
  return std::to_string(value);
}
template <EnumType E>
std::string spell(E value) {
  return '"' + std::string(enum_name(value)) + '"';
}
template <ScalarList T>
std::string spell(const T& list) {
  std::vector<std::string> words;
  for (const auto& element : list) words.push_back(spell(element));
  return "[" + joined(words) + "]";
}

/// The type of a leaf in words: "number", "integer", "text", "true or false", the choices, "list of number".
template <LeafType T>
std::string type_words() {
  if constexpr (OptionalType<T>) {
    return type_words<typename OptionalOf<T>::Inner>();
  } else if constexpr (ScalarList<T>) {
    return "list of " + type_words<typename VectorOf<T>::Inner>();
  } else if constexpr (EnumType<T>) {
    return joined({EnumNames<T>::names.begin(), EnumNames<T>::names.end()}, " or ");
  } else if constexpr (std::same_as<T, bool>) {
    return "true or false";
  } else if constexpr (std::same_as<T, std::string>) {
    return "text";
  } else {
    return std::integral<T> ? "integer" : "number";
  }
}

}  // namespace beltlife
