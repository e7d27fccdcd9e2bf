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

template <class T>
void take_part(T& part, const nlohmann::json& from) {
  if constexpr (AnswerType<T>) {
    if (!from.is_object()) return;
    AnswerFromJson visitor{from};
    part.visit(visitor);
  } else if constexpr (OptionalType<T>) {
    if (from.is_null()) return;
    typename OptionalOf<T>::Inner inner{};
    take_part(inner, from);
    part = std::move(inner);
  } else if constexpr (MapType<T>) {
    if (!from.is_object()) return;
    for (const auto& [name, inner] : from.items()) take_part(part[name], inner);
  } else if constexpr (VectorType<T>) {
    if (!from.is_array()) return;
    for (const nlohmann::json& inner : from) {
      typename T::value_type value{};
      take_part(value, inner);
      part.push_back(std::move(value));
    }
  } else if constexpr (ArrayType<T>) {
    if (!from.is_array()) return;
    for (std::size_t i = 0; i < std::min(part.size(), from.size()); ++i) take_part(part[i], from[i]);
  } else if constexpr (EnumType<T>) {
    const auto& names = EnumNames<T>::names;
    if (!from.is_string()) return;
    const auto at = std::find(names.begin(), names.end(), from.template get_ref<const std::string&>());
    if (at != names.end()) part = static_cast<T>(at - names.begin());
  } else if constexpr (std::same_as<T, bool>) {
    if (from.is_boolean()) part = from.get<bool>();
  } else if constexpr (std::same_as<T, std::string>) {
    if (from.is_string()) part = from.get<std::string>();
  } else if (from.is_number()) {
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
