// Owns the tree that a TOML text becomes: plain nodes with line numbers, so that nobody else needs the TOML library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace beltlife {

struct TomlNode;
struct TomlEntry;

using TomlArray = std::vector<TomlNode>;

struct TomlTable {
  std::vector<TomlEntry> entries;  ///< sorted by key, as the library hands them over

  const TomlEntry* find(std::string_view key) const;
};

/// A kind of value that no field can hold: a date or a time. `kind` names it for messages.
struct TomlOther {
  std::string kind;
};

struct TomlNode {
  int line = 0;
  std::variant<bool, std::int64_t, double, std::string, TomlOther, TomlArray, TomlTable> value;

  const TomlTable* table() const { return std::get_if<TomlTable>(&value); }
  const TomlArray* array() const { return std::get_if<TomlArray>(&value); }
};

struct TomlEntry {
  std::string key;
  int line = 0;  ///< line of the key; of the header for a table
  TomlNode node;
};

/// Larger files are refused unread: an input is written by a person, and the whole of it stands in memory.
inline constexpr std::size_t max_toml_bytes = std::size_t{4} << 20;

/// The root table of `text`; `name` stands for the file in messages. Throws BadInput (scene_io.h) where the text is no
/// TOML, is too large or is nested absurdly deep. TOML's own errors come one at a time: after one the rest is
/// unreadable.
TomlNode parse_toml(std::string_view text, std::string_view name);

/// All bytes of a regular file, pipe or device up to max_toml_bytes. Throws BadInput where there are none to be had.
std::string read_text(const std::filesystem::path& path);

}  // namespace beltlife
