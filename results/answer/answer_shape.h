// Owns what the parts of an answer may be, and how an answer lists them: once, with name, unit and meaning.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/scene/spec_shape.h"

namespace beltlife {

/// A number that is not there: null in JSON, NaN in files, "-" on a page.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// The unit of a number that has the unit of the quantity or parameter by whose name it, or a part around it, is found.
inline constexpr std::string_view unit_of_its_name = "its own";

/// Stands for any visitor, to ask whether a type lists its parts: visit(v) calls v(name, part, unit, meaning) for each.
/// A part is a number (not_known where there is none), a whole number, a truth, a text, an enumerator, another answer,
/// or a list, a map by name or an optional of these. An optional that is empty is left out of JSON and files.
struct AnyAnswerVisitor {
  template <class T>
  void operator()(std::string_view, T&, std::string_view, std::string_view) {}
};

template <class T>
concept AnswerType = requires(T answer, AnyAnswerVisitor visitor) {
  answer.visit(visitor);
};

/// An optional that is null where it is empty, and not left out: for the values of a map.
template <class T>
struct OrNull {
  std::optional<T> value;
};

template <class T>
struct OrNullOf {
  static constexpr bool value = false;
};
template <class T>
struct OrNullOf<OrNull<T>> {
  static constexpr bool value = true;
  using Inner = T;
};

template <class T>
struct MapOf {
  static constexpr bool value = false;
};
template <class T>
struct MapOf<std::map<std::string, T>> {
  static constexpr bool value = true;
  using Inner = T;
};
template <class T>
concept MapType = MapOf<T>::value;

template <class T>
struct ArrayOf {
  static constexpr bool value = false;
};
template <class T, std::size_t n>
struct ArrayOf<std::array<T, n>> {
  static constexpr bool value = true;
  using Inner = T;
};
template <class T>
concept ArrayType = ArrayOf<T>::value;

/// What every driver's answer has. `error`: there is no answer, and why.
struct DriverAnswer {
  std::int64_t evaluations = 0;
  std::int64_t failed = 0;
  std::optional<std::string> error;

  template <class V>
  void visit(V& v) {
    v("evaluations", evaluations, "", "points in the log");
    v("failed", failed, "", "points of them that are not ok");
    v("error", error, "", "why there is no answer; absent where there is one");
  }
};

}  // namespace beltlife
