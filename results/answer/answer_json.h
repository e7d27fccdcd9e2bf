// Owns answers as JSON, both ways, over their lists of parts.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "results/answer/answer_shape.h"

namespace beltlife {

template <class T>
nlohmann::json json_of_part(const T& part);

/// Writes every part of one answer under its name.
struct AnswerToJson {
  nlohmann::json& out;

  template <class T>
  void operator()(std::string_view name, T& part, std::string_view, std::string_view) {
    if constexpr (OptionalType<T>) {
      if (part) out[std::string(name)] = json_of_part(*part);
    } else {
      out[std::string(name)] = json_of_part(part);
    }
  }
};

/// null for a number that is not there, or has no end, which JSON cannot say.
template <class T>
nlohmann::json json_of_part(const T& part) {
  if constexpr (AnswerType<T>) {
    nlohmann::json object = nlohmann::json::object();
    AnswerToJson visitor{object};
    const_cast<T&>(part).visit(visitor);  // the list serves reading, too; nothing is written here
    return object;
  } else if constexpr (OrNullOf<T>::value) {
    return part.value ? json_of_part(*part.value) : nlohmann::json();
  } else if constexpr (MapType<T>) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [name, inner] : part) object[name] = json_of_part(inner);
    return object;
  } else if constexpr (VectorType<T> || ArrayType<T>) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& inner : part) list.push_back(json_of_part(static_cast<const typename T::value_type&>(inner)));
    return list;
  } else if constexpr (EnumType<T>) {
    return std::string(enum_name(part));
  } else if constexpr (std::floating_point<T>) {
    return std::isfinite(part) ? nlohmann::json(part) : nlohmann::json();
  } else {
    return part;
  }
}

/// Takes a part from JSON. What is not there, or of another type, stays as it is: logs of older versions still read.
template <class T>
void take_part(T& part, const nlohmann::json& from);

struct AnswerFromJson {
  const nlohmann::json& from;

  template <class T>
  void operator()(std::string_view name, T& part, std::string_view, std::string_view) {
    const auto at = from.find(std::string(name));
    if (at != from.end()) take_part(part, *at);
  }
};

/// Whether a value is of the type that a part has in JSON.
template <class T>
bool fits_part(const nlohmann::json& from) {
  if constexpr (OptionalType<T>)
    return fits_part<typename OptionalOf<T>::Inner>(from);
  else if constexpr (OrNullOf<T>::value)
    return from.is_null() || fits_part<typename OrNullOf<T>::Inner>(from);
  else if constexpr (AnswerType<T> || MapType<T>)
    return from.is_object();
  else if constexpr (VectorType<T> || ArrayType<T>)
    return from.is_array();
  else if constexpr (EnumType<T> || std::same_as<T, std::string>)
    return from.is_string();
  else if constexpr (std::same_as<T, bool>)
    return from.is_boolean();
  else
    return from.is_number();
}

/// A part before anything is taken: a number in a list or map that turns out to be null is not known, not 0.
template <class T>
T untaken_part() {
  if constexpr (std::floating_point<T>) return not_known;
  return T{};
}

template <class T>
void take_part(T& part, const nlohmann::json& from) {
  if (!fits_part<T>(from)) return;
  if constexpr (AnswerType<T>) {
    AnswerFromJson visitor{from};
    part.visit(visitor);
  } else if constexpr (OrNullOf<T>::value) {
    if (!from.is_null()) take_part(part.value, from);
  } else if constexpr (OptionalType<T>) {
    part.emplace(untaken_part<typename OptionalOf<T>::Inner>());
    take_part(*part, from);
  } else if constexpr (MapType<T>) {
    for (const auto& [name, inner] : from.items())
      take_part(part.try_emplace(name, untaken_part<typename MapOf<T>::Inner>()).first->second, inner);
  } else if constexpr (VectorType<T>) {
    for (const nlohmann::json& inner : from) {
      auto value = untaken_part<typename T::value_type>();
      take_part(value, inner);
      part.push_back(std::move(value));
    }
  } else if constexpr (ArrayType<T>) {
    for (std::size_t i = 0; i < std::min(part.size(), from.size()); ++i) take_part(part[i], from[i]);
  } else if constexpr (EnumType<T>) {
    const auto& names = EnumNames<T>::names;
    const auto at = std::find(names.begin(), names.end(), from.template get_ref<const std::string&>());
    if (at != names.end()) part = static_cast<T>(at - names.begin());
  } else {
    part = from.get<T>();
  }
}

/// An answer as its log and standard output have it. Beside an error, parts without content are left out.
template <AnswerType Answer>
nlohmann::json json_of_answer(const Answer& answer) {
  nlohmann::json out = json_of_part(answer);
  if constexpr (requires { answer.error; }) {
    if (answer.error)
      for (auto part = out.begin(); part != out.end();)
        part = part->is_null() || (part->is_structured() && part->empty()) ? out.erase(part) : std::next(part);
  }
  return out;
}

template <AnswerType Answer>
Answer answer_of_json(const nlohmann::json& from) {
  Answer answer;
  take_part(answer, from);
  return answer;
}

}  // namespace beltlife
