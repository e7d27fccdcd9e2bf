// Owns what one field of a Spec says about itself: its rule (required, limits) and its enumerators' spellings.
#pragma once

#include <array>
#include <limits>
#include <string_view>

namespace beltlife {

/// What a value of a field may be. Every struct lists its fields once, in visit(); reading, writing, --set,
/// parameter paths and the field reference all run over that list.
struct Rule {
  bool required = false;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool open = false;  ///< the lower limit itself is not allowed
};

inline constexpr Rule any_text{};
inline constexpr Rule required_text{.required = true};
constexpr Rule within(double lower, double upper) { return {.lower = lower, .upper = upper}; }
constexpr Rule above(double lower, double upper) { return {.lower = lower, .upper = upper, .open = true}; }
constexpr Rule required(Rule rule) {
  rule.required = true;
  return rule;
}

/// Spellings of an enumeration as they stand in the scene file, in the enumerators' order.
template <class E>
struct EnumNames;

template <class E>
constexpr std::string_view enum_name(E value) {
  return EnumNames<E>::names[static_cast<std::size_t>(value)];
}

}  // namespace beltlife
