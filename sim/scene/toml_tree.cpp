// Owns the only contact with toml++: text to our own tree, and every way in which a file can fail to be TOML.
#include "sim/scene/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "sim/scene/scene_io.h"

// toml++ 3.3 asserts on some texts instead of refusing them ("[ = 1"), and without assertions takes what they say for
// granted. Assertions throw here, in every kind of build, and count as syntax errors. That takes the parser's source:
// Debian's CMake target asks for the shared library, whose assertions were settled when it was built.
namespace {
struct ParserGaveUp {};
constexpr void demand(bool holds) {
  if (!holds) throw ParserGaveUp{};
}
}  // namespace
#undef NDEBUG
#undef TOML_SHARED_LIB
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(expr) demand(static_cast<bool>(expr))
#define TOML_FLOAT_CHARCONV 1  // GCC 12 has it; free of the locale and correctly rounded
#include <toml++/toml.h>

namespace beltlife {
namespace {

[[noreturn]] void fail(std::string_view file, int line, std::string what, std::string allowed = {}) {
  throw BadInput({Problem{std::string(file), line, "", std::move(what), std::move(allowed)}});
}

/// Line of the first place where dotted keys nest more than `limit` deep, or 0. toml++ bounds nested brackets but not
/// a.b.c.d..., whose tables are destroyed recursively: a long enough key overflows the stack. Counts the dots of a
/// line since the last comma or equals sign outside quotes, which no honest key, number list or comment brings to 32.
int too_deep_line(std::string_view text, int limit) {
  int line = 1;
  int dots = 0;
  char quote = 0;  // the quotation mark that is open
  char previous = ' ';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line;
      dots = 0;
      quote = 0;
    } else if (quote == '"' && c == '\\') {
      ++i;  // an escaped quotation mark closes nothing
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == ',' || c == '=') {
      dots = 0;
    }
    if (c == '.' && previous != '.' && ++dots > limit) return line;  // "....." in prose is no nesting
    if (c != ' ' && c != '\t') previous = c;
  }
  return 0;
}

std::string kind_name(toml::node_type type) {
  switch (type) {
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time";
    default:
      return "a date and time";
  }
}

constexpr int deepest = 32;  // our own formats nest four deep
struct TooDeep {
  int line;
};

TomlNode convert(const toml::node& node, int fallback_line, int depth) {
  TomlNode result;
  const int line = static_cast<int>(node.source().begin.line);
  result.line = line > 0 ? line : fallback_line;  // tables that stand only implicitly, in [a.b], have no place
  if (depth > deepest) throw TooDeep{result.line};
  if (const auto* table = node.as_table()) {
    TomlTable ours;
    for (const auto& [key, value] : *table) {
      const int key_line = static_cast<int>(key.source().begin.line);
      ours.entries.push_back(
          {std::string(key.str()), key_line > 0 ? key_line : result.line, convert(value, key_line, depth + 1)});
    }
    result.value = std::move(ours);
  } else if (const auto* array = node.as_array()) {
    TomlArray ours;
    for (const auto& element : *array) ours.push_back(convert(element, result.line, depth + 1));
    result.value = std::move(ours);
  } else if (const auto* truth = node.as_boolean()) {
    result.value = truth->get();
  } else if (const auto* integer = node.as_integer()) {
    result.value = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.value = number->get();
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else {
    result.value = TomlOther{kind_name(node.type())};
  }
  return result;
}

/// The line at which the parser gives up: the fewest lines that make it do so.
int line_of_giving_up(std::string_view text) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n' || i + 1 == text.size()) ends.push_back(i + 1);
  }
  const auto survives = [&](std::size_t end) {
    try {
      (void)toml::parse(text.substr(0, end));
    } catch (const ParserGaveUp&) {
      return false;
    } catch (const toml::parse_error&) {
      // A beginning of a text may well be incomplete.
    }
    return true;
  };
  return static_cast<int>(std::partition_point(ends.begin(), ends.end(), survives) - ends.begin()) + 1;
}

}  // namespace

const TomlEntry* TomlTable::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

TomlNode parse_toml(std::string_view text, std::string_view name) {
  if (text.size() > max_toml_bytes) {
    fail(name, 0, fmt::format("{} bytes are too many", text.size()), fmt::format("at most {} bytes", max_toml_bytes));
  }
  try {
    if (const int line = too_deep_line(text, deepest)) throw TooDeep{line};
    const toml::table root = toml::parse(text, name);
    return convert(root, 1, 0);
  } catch (const toml::parse_error& error) {
    fail(name, static_cast<int>(error.source().begin.line), fmt::format("not TOML: {}", error.description()));
  } catch (const TooDeep& place) {
    fail(name, place.line, "is nested too deep", fmt::format("at most {} levels", deepest));
  } catch (const ParserGaveUp&) {
    fail(name, line_of_giving_up(text), "not TOML: a key or value is malformed");
  }
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) fail(path.string(), 0, "no such file");
  if (failure) fail(path.string(), 0, fmt::format("cannot be read: {}", failure.message()));
  if (std::filesystem::is_directory(status)) fail(path.string(), 0, "is a directory", "a TOML file");

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(path.string(), 0, fmt::format("cannot be read: {}", std::generic_category().message(errno)));
  std::string text(max_toml_bytes + 1, '\0');  // one byte more, so that a file that is too large shows
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (std::ferror(file.get())) {
    fail(path.string(), 0, fmt::format("cannot be read: {}", std::generic_category().message(errno)));
  }
  if (text.size() > max_toml_bytes) {
    fail(path.string(), 0, "the file is too large", fmt::format("at most {} bytes", max_toml_bytes));
  }
  return text;
}

}  // namespace beltlife
