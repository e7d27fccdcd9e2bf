// What differs between two heads of studies: see study_difference.h.
#include "results/journal/study_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace beltlife {
namespace {

std::string shortened(std::string_view text) {
  constexpr std::size_t most = 100;
  return std::string(text.substr(0, most)) + (text.size() > most ? "..." : "");
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Where line `at` of a TOML text belongs, as paths spell it: "belt." below [belt], "pulley.crank." below the
/// [[pulley]] of that name.
std::string place_of(const std::vector<std::string_view>& lines, std::size_t at) {
  std::size_t begin = std::min(at + 1, lines.size());
  while (begin > 0 && !lines[begin - 1].starts_with('[')) --begin;
  if (begin == 0) return "";
  std::string_view header = lines[begin - 1];
  const bool element = header.starts_with("[[");
  const std::size_t brackets = element ? 2 : 1;
  if (header.size() < 2 * brackets) return "";
  header = header.substr(brackets, header.size() - 2 * brackets);
  std::string place = std::string(header) + ".";
  for (std::size_t i = begin; element && i < lines.size() && !lines[i].starts_with('['); ++i)
    for (const std::string_view key : {"name = \"", "path = \""})
      if (lines[i].starts_with(key)) {
        const std::string_view rest = lines[i].substr(key.size());
        return place + std::string(rest.substr(0, rest.find('"'))) + ".";
      }
  return place;
}

std::string difference_of_texts(const std::string& log, const std::string& now) {
  const auto a = lines_of(log), b = lines_of(now);
  const auto at = static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin()).first -
      a.begin());
  const auto line = [&](const std::vector<std::string_view>& lines) {
    if (at >= lines.size()) return std::string("nothing more");
    const bool entry = lines[at].find(" = ") != std::string_view::npos;
    return (entry ? place_of(lines, at) : "") + shortened(lines[at].empty() ? "an empty line" : lines[at]);
  };
  const std::string was = line(a), is = line(b);
  const std::size_t equals = was.find(" = ");
  if (equals != was.npos && is.starts_with(was.substr(0, equals + 3)))
    return fmt::format("the log was made with {}, now it is {}", was, is.substr(equals + 3));
  return fmt::format("the log was made with {}, where there is now {}", was, is);
}

std::optional<std::string> difference_of_lists(const char* what, const std::vector<std::string>& log,
                                               const std::vector<std::string>& now) {
  for (std::size_t i = 0; i < std::min(log.size(), now.size()); ++i)
    if (log[i] != now[i])
      return fmt::format("{} {} of the log is {}, now it is {}", what, i + 1, shortened(log[i]), shortened(now[i]));
  if (log.size() == now.size()) return {};
  const auto& more = log.size() > now.size() ? log : now;
  return fmt::format("the log has {} of each {}, now there are {}: {} is {}", log.size(), what, now.size(),
                     shortened(more[std::min(log.size(), now.size())]), &more == &now ? "new" : "missing");
}

}  // namespace

std::optional<std::string> first_difference(const StudyHead& log, const StudyHead& now) {
  const auto word = [](const char* what, const std::string& a, const std::string& b) {
    return fmt::format("the log was made {}{}, now it is {}", what, a, b);
  };
  if (log.driver != now.driver) return word("by ", log.driver, now.driver);
  if (log.version != now.version) return word("by version ", log.version, now.version);
  if (log.scene_text != now.scene_text) return "another scene: " + difference_of_texts(log.scene_text, now.scene_text);
  if (log.study_text != now.study_text) return "another study: " + difference_of_texts(log.study_text, now.study_text);
  if (log.lanes != now.lanes) return word("with lanes used for ", log.lanes, now.lanes);
  if (auto difference = difference_of_lists("parameter", log.parameters, now.parameters)) return difference;
  return difference_of_lists("quantity", log.quantities, now.quantities);
}

}  // namespace beltlife
