// Owns what is said about the parts of an answer where its type is not known any more: in files and in the reference.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// One part of an answer. What it holds is itself, a list or a map of such; `parts` are those of the answer inside.
struct AnswerNote {
  std::string name, unit, meaning;
  std::string type;       ///< in words: "number", "list of text", "map of number"
  bool may_miss = false;  ///< an optional
  int named = 0;          ///< how many maps by name, one in another, lie between it and what it holds
  std::vector<AnswerNote> parts;
};

/// The reference of an answer as Markdown: a row a part, by its path in JSON and in files; NAME is a name of a map.
std::string answer_reference(const std::vector<AnswerNote>& notes);

template <AnswerType Answer>
std::vector<AnswerNote> notes_of();

/// What a part holds under its lists and maps, and the words for these.
template <class T>
void describe_part(AnswerNote& note) {
  if constexpr (OptionalType<T>) {
    note.may_miss = true;
    describe_part<typename OptionalOf<T>::Inner>(note);
  } else if constexpr (OrNullOf<T>::value) {
    note.type += "null or ";
    describe_part<typename OrNullOf<T>::Inner>(note);
  } else if constexpr (MapType<T>) {
    note.type += "map by name of ";
    ++note.named;
    describe_part<typename MapOf<T>::Inner>(note);
  } else if constexpr (VectorType<T> || ArrayType<T>) {
    note.type += "list of ";
    describe_part<typename T::value_type>(note);
  } else if constexpr (AnswerType<T>) {
    note.type += "object";
    note.parts = notes_of<T>();
  } else if constexpr (EnumType<T>) {
    std::string words;
    for (const std::string_view name : EnumNames<T>::names) words += (words.empty() ? "" : " or ") + std::string(name);
    note.type += words;
  } else if constexpr (std::same_as<T, bool>) {
    note.type += "true or false";
  } else if constexpr (std::same_as<T, std::string>) {
    note.type += "text";
  } else {
    note.type += std::integral<T> ? "integer" : "number";
  }
}

struct NoteTaker {
  std::vector<AnswerNote>& notes;

  template <class T>
  void operator()(std::string_view name, T&, std::string_view unit, std::string_view meaning) {
    AnswerNote note;
    note.name = name;
    note.unit = unit;
    note.meaning = meaning;
    describe_part<T>(note);
    notes.push_back(std::move(note));
  }
};

template <AnswerType Answer>
std::vector<AnswerNote> notes_of() {
  std::vector<AnswerNote> notes;
  NoteTaker visitor{notes};
  Answer answer;
  answer.visit(visitor);
  return notes;
}

/// The reference of a type.
template <AnswerType Answer>
std::string reference_of_answer() {
  return answer_reference(notes_of<Answer>());
}

}  // namespace beltlife
