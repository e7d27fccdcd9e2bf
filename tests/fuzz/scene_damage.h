// Owns the damages that scene files suffer in tests and in fuzzing: of bytes, and of whole lines and values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace beltlife::scene_damage {

using Random = std::mt19937;

inline std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

/// What mistakes are made of.
inline const std::string& piece(Random& random) {
  static const std::vector<std::string> pieces{
      "-",    "nan",          "inf",      "1e308", "1e-308",   "\"",     "]",  "[[pulley]]\n", "=", "\n",      "0",
      "true", "name = \"x\"", "99999999", "\0",    "[belt]\n", "1e5000", "# ", "'''\n",        ".", "\xff\xfe"};
  return pieces[below(pieces.size(), random)];
}

/// A byte changed, a stretch cut out, doubled or swapped for a piece.
inline void damage_bytes(std::string& text, Random& random) {
  const std::size_t at = below(text.size(), random);
  const std::size_t length = std::min(text.size() - at, 1 + below(60, random));
  switch (below(4, random)) {
    case 0:
      text[at] = static_cast<char>(below(256, random));
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(at, length));
      break;
    default:
      text.replace(at, std::min<std::size_t>(length, 6), piece(random));
  }
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Another value for a line "key = value": of a wrong type, beyond a limit, near the old one, or another line's.
inline std::string other_value(const std::string& old, const std::vector<std::string>& lines, Random& random) {
  static const std::vector<std::string> values{
      "0",     "-1",   "1",        "-0.0",       "1e-300", "1e300", "1e5",           "1e6",       "nan",  "-inf",
      "2.5e3", "true", "\"text\"", "1979-05-27", "[]",     "[1]",   "[1, 2, \"a\"]", "{ a = 1 }", "\"\"", "[[1], [2]]"};
  switch (below(3, random)) {
    case 0:
      return values[below(values.size(), random)];
    case 1: {
      const std::string& line = lines[below(lines.size(), random)];
      const std::size_t equals = line.find('=');
      return equals == line.npos ? old : line.substr(equals + 1);
    }
    default: {
      const double factors[] = {-1, 0.5, 0.9, 1.1, 2, 10, 1000, 1e-3};
      try {
        return std::to_string(std::stod(old) * factors[below(8, random)]);
      } catch (const std::exception&) {
        return old.substr(0, old.size() / 2);
      }
    }
  }
}

/// One line's value changed, its key misspelt, the line left out, doubled, or put elsewhere.
inline void damage_line(std::string& text, Random& random) {
  auto lines = lines_of(text);
  const std::size_t at = below(lines.size(), random), to = below(lines.size(), random);
  std::string& line = lines[at];
  const std::size_t equals = line.find('=');
  switch (below(8, random)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(to), std::string(line));
      break;
    case 2:
      std::swap(lines[at], lines[to]);
      break;
    case 3:
      if (!line.empty()) line.erase(below(line.size(), random), 1);
      break;
    default:
      if (equals != line.npos)
        line = line.substr(0, equals + 1) + " " + other_value(line.substr(equals + 1), lines, random);
  }
  text = joined(lines);
}

/// One to four damages, of bytes or of lines.
inline std::string damaged(std::string text, Random& random) {
  const bool bytes = below(2, random) == 0;
  for (std::size_t k = 1 + below(4, random); k > 0 && !text.empty(); --k)
    bytes ? damage_bytes(text, random) : damage_line(text, random);
  return text;
}

}  // namespace beltlife::scene_damage
