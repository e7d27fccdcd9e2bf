// Owns the kinds of C++ type that a field of a Spec may have, and how a path names a field.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/scene/field.h"

namespace beltlife {

/// Stands for any visitor, to ask whether a type has a visit() list.
struct AnyVisitor {
  template <class T>
  void operator()(std::string_view, T&, const Rule&, std::string_view) {}
};

template <class T>
concept SpecType = requires(T spec, AnyVisitor visitor) {
  spec.visit(visitor);
};

template <class T>
concept EnumType = std::is_enum_v<T>;

template <class T>
concept IntegerType = std::integral<T> && !std::same_as<T, bool>;

template <class T>
concept ScalarType = std::floating_point<T> || std::integral<T> || std::same_as<T, std::string> || EnumType<T>;

template <class T>
struct OptionalOf {
  static constexpr bool value = false;
};
template <class T>
struct OptionalOf<std::optional<T>> {
  static constexpr bool value = true;
  using Inner = T;
};

template <class T>
struct VectorOf {
  static constexpr bool value = false;
};
template <class T>
struct VectorOf<std::vector<T>> {
  static constexpr bool value = true;
  using Inner = T;
};

template <class T>
concept OptionalType = OptionalOf<T>::value;
template <class T>
concept VectorType = VectorOf<T>::value;

/// std::optional of a Spec: a section that may be absent.
template <class T>
concept OptionalSpec = OptionalType<T> && SpecType<typename OptionalOf<T>::Inner>;
/// std::vector of Specs: an array of tables.
template <class T>
concept SpecList = VectorType<T> && SpecType<typename VectorOf<T>::Inner>;
template <class T>
concept ScalarList = VectorType<T> && ScalarType<typename VectorOf<T>::Inner>;
/// What stands behind one key: a scalar, a list of scalars, or either of them optionally.
template <class T>
concept LeafType = ScalarType<T> || ScalarList<T> ||(OptionalType<T> && !OptionalSpec<T>);

/// A field's two addresses: `shown` to people and --set (pulley.idler_2.x_mm: by name where the table has one, else by
/// index from 0), and `place` in the file (pulley[1].x_mm), which is unique even while names are not.
struct SpecPath {
  std::string shown;
  std::string place;

  SpecPath child(std::string_view key) const {
    const std::string dot = shown.empty() ? "" : ".";
    return {shown + dot + std::string(key), place + dot + std::string(key)};
  }
  SpecPath element(std::size_t index, std::string_view name = {}) const {
    const std::string number = std::to_string(index);
    return {shown + "." + (name.empty() ? number : std::string(name)), place + "[" + number + "]"};
  }
};

/// The name by which a list's element is addressed; empty where its Spec has none.
template <SpecType Spec>
std::string_view element_name(const Spec& spec) {
  if constexpr (requires { std::string_view(spec.name); }) return spec.name;
  return {};
}

}  // namespace beltlife
