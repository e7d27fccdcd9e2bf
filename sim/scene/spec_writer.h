// Owns writing: any Spec as TOML that reads back to the same bits, and the table of its fields for people.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "sim/scene/spec_shape.h"
#include "sim/scene/spec_value.h"

namespace beltlife {

/// Writes one table. TOML wants a table's own keys before its sub-tables, so the list of fields is run over twice.
class SpecWriter {
 public:
  SpecWriter(std::string header, std::string& out) : header_(std::move(header)), out_(out) {}

  template <class Spec>
  void write(Spec& spec) {
    tables_ = false;
    spec.visit(*this);
    tables_ = true;
    spec.visit(*this);
  }

  template <class T>
  void operator()(std::string_view key, T& value, const Rule&, std::string_view) {
    if constexpr (LeafType<T>) {
      if (!tables_) leaf(key, value);
    } else if (!tables_) {
      return;
    } else if constexpr (SpecList<T>) {
      for (auto& element : value) table(key, element, "[[", "]]");
    } else if constexpr (OptionalSpec<T>) {
      if (value) table(key, *value, "[", "]");
    } else {
      table(key, value, "[", "]");
    }
  }

 private:
  template <class T>
  void leaf(std::string_view key, const T& value) {
    if constexpr (OptionalType<T>) {
      if (value) leaf(key, *value);
    } else {
      out_ += std::string(key) + " = " + spell(value) + "\n";
    }
  }

  template <class Spec>
  void table(std::string_view key, Spec& spec, std::string_view open, std::string_view close) {
    const std::string name = header_.empty() ? std::string(key) : header_ + "." + std::string(key);
    out_ += "\n" + std::string(open) + name + std::string(close) + "\n";
    SpecWriter(name, out_).write(spec);
  }

  std::string header_;
  std::string& out_;
  bool tables_ = false;
};

/// Takes the Spec by value because visit() hands out references that could be written through.
template <SpecType Spec>
std::string write_spec(Spec spec) {
  std::string out;
  SpecWriter("", out).write(spec);
  return out;
}

/// Writes the table of fields of one Spec, then those of the Specs in it, as Markdown.
class ReferenceWriter {
 public:
  ReferenceWriter(std::string header, std::string& out) : header_(std::move(header)), out_(out) {}

  /// `heading` as the file spells it: [belt], [[pulley]].
  template <SpecType Spec>
  void write(const std::string& heading, std::string_view description) {
    if (!heading.empty()) out_ += "\n## `" + heading + "`\n\n" + std::string(description) + "\n";
    out_ += "\n| key | type | default | limits | meaning |\n|---|---|---|---|---|\n";
    Spec defaults;
    defaults.visit(*this);
    out_ += tables_;
  }

  template <class T>
  void operator()(std::string_view key, T& value, const Rule& rule, std::string_view description) {
    if constexpr (LeafType<T>) {
      out_ += "| `" + std::string(key) + "` | " + type_words<T>() + " | " + default_text(value, rule) + " | " +
              limits_text(rule) + " | " + std::string(description) + " |\n";
    } else {
      const std::string name = header_.empty() ? std::string(key) : header_ + "." + std::string(key);
      const std::string times = std::string(description) + (rule.required ? " (required)" : "");
      ReferenceWriter inner(name, tables_);
      if constexpr (SpecList<T>) {
        inner.write<typename VectorOf<T>::Inner>("[[" + name + "]]", times + " (any number)");
      } else if constexpr (OptionalSpec<T>) {
        inner.write<typename OptionalOf<T>::Inner>("[" + name + "]", times + " (may be absent)");
      } else {
        inner.write<T>("[" + name + "]", times);
      }
    }
  }

 private:
  template <class T>
  static std::string default_text(const T& value, const Rule& rule) {
    if (rule.required) return "required";
    if constexpr (OptionalType<T>) {
      return value ? spell(*value) : "absent";
    } else {
      return spell(value);
    }
  }

  std::string header_;
  std::string& out_;
  std::string tables_;  ///< sections of the Specs inside, which follow the table of this one
};

template <SpecType Spec>
std::string reference_of() {
  std::string out;
  ReferenceWriter("", out).write<Spec>("", "");
  return out;
}

}  // namespace beltlife
