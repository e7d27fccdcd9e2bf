// Owns the checks and the spelling of single values, and the search for what a misspelt word may have meant.
#include "sim/scene/spec_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 60;  // a message must stay a line
  if (text.size() <= longest) return std::string(text);
  return std::string(text.substr(0, longest)) + "...";
}

struct Describe {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("integer {}", value); }
  std::string operator()(double value) const { return fmt::format("number {:#}", value); }
  std::string operator()(const std::string& value) const { return "text " + spell(shortened(value)); }
  std::string operator()(const TomlOther& value) const { return value.kind; }
  std::string operator()(const TomlArray&) const { return "an array"; }
  std::string operator()(const TomlTable&) const { return "a table"; }
};

/// Levenshtein's distance: how many letters to insert, delete or replace.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string limits_text(const Rule& rule) {
  const bool low = std::isfinite(rule.lower);
  const bool high = std::isfinite(rule.upper);
  if (low && high && rule.lower == rule.upper) return fmt::format("{}", rule.lower);
  if (low && high && !rule.open) return fmt::format("from {} to {}", rule.lower, rule.upper);
  std::string text;
  if (low) text = fmt::format("{} {}", rule.open ? "above" : "at least", rule.lower);
  if (high) text += fmt::format("{}at most {}", low ? ", " : "", rule.upper);
  return text;
}

std::string_view nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 200;  // the search is quadratic; nobody means a longer word
  if (word.size() > longest) return {};
  std::string_view best;
  std::size_t smallest = longest;
  for (const std::string& candidate : candidates) {
    const std::size_t d = distance(word, candidate);
    if (d < smallest && 2 * d <= std::max(word.size(), candidate.size())) {
      smallest = d;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string_view best = nearest(word, candidates);
  return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

void wrong_type(const TomlNode& node, std::string_view wanted, std::string_view allowed, Faults& faults) {
  faults.push_back(
      {"", fmt::format("found {}, wanted {}", std::visit(Describe{}, node.value), wanted), std::string(allowed)});
}

void check_number(double value, const Rule& rule, Faults& faults) {
  if (!std::isfinite(value)) {
    faults.push_back({"", fmt::format("{} is not a finite number", value), limits_text(rule)});
  } else if (value < rule.lower || value > rule.upper || (rule.open && value == rule.lower)) {
    faults.push_back({"", fmt::format("{} is out of limits", value), limits_text(rule)});
  }
}

void assign(double& value, const TomlNode& node, const Rule& rule, Faults& faults) {
  double number = 0;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    number = static_cast<double>(*integer);
  } else if (const auto* floating = std::get_if<double>(&node.value)) {
    number = *floating;
  } else {
    return wrong_type(node, "a number", limits_text(rule), faults);
  }
  const std::size_t before = faults.size();
  check_number(number, rule, faults);
  if (faults.size() == before) value = number;
}

void assign_integer(std::int64_t& value, const TomlNode& node, const Rule& rule, Faults& faults) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  if (!integer) return wrong_type(node, "an integer", limits_text(rule), faults);
  const std::size_t before = faults.size();
  check_number(static_cast<double>(*integer), rule, faults);
  if (faults.size() == before) value = *integer;
}

void assign(bool& value, const TomlNode& node, const Rule&, Faults& faults) {
  const auto* truth = std::get_if<bool>(&node.value);
  if (!truth) return wrong_type(node, "true or false", "true, false", faults);
  value = *truth;
}

void assign(std::string& value, const TomlNode& node, const Rule& rule, Faults& faults) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) return wrong_type(node, "text in quotes", "", faults);
  if (rule.required && text->empty()) {
    faults.push_back({"", "is empty", "at least one letter"});
  } else {
    value = *text;
  }
}

int assign_choice(std::span<const std::string_view> names, const TomlNode& node, Faults& faults) {
  const std::vector<std::string> choices(names.begin(), names.end());
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) {
    wrong_type(node, "one of the choices, in quotes", joined(choices), faults);
    return -1;
  }
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  faults.push_back({"", spell(shortened(*text)) + " is no choice" + did_you_mean(*text, choices), joined(choices)});
  return -1;
}

std::string spell(double value) {
  if (value == 0 && std::signbit(value)) return "-0.0";  // "-0" would be an integer, which has no sign
  return fmt::format("{}", value);
}

std::string spell(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

TomlNode node_from_text(std::string_view text) {
  double number = 0;  // first, because TOML refuses .5, 5. and 007, which people type
  const std::string_view digits = text.starts_with('+') && !text.starts_with("+-") ? text.substr(1) : text;
  const char* end = digits.data() + digits.size();
  std::int64_t integer = 0;
  if (const auto [stop, error] = std::from_chars(digits.data(), end, integer); error == std::errc{} && stop == end) {
    return {0, integer};
  }
  if (const auto [stop, error] = std::from_chars(digits.data(), end, number); error == std::errc{} && stop == end) {
    return {0, number};
  }
  try {
    const TomlNode root = parse_toml(fmt::format("value = {}", text), "--set");
    const TomlTable* table = root.table();
    if (table->entries.size() == 1 && table->entries[0].key == "value") return table->entries[0].node;
  } catch (const BadInput&) {
    // Not TOML: the text itself is the value, and a field that wants another type will say what it found.
  }
  return {0, std::string(text)};
}

}  // namespace beltlife
