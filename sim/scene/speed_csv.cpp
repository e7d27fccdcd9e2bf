// Measured speed from CSV: see speed_csv.h.
#include "sim/scene/speed_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

constexpr const char* allowed =
    "a header line \"time_s,speed_rpm\", then two numbers a line, time increasing, speed from 0 to 1e5";
constexpr double fastest_rpm = 1e5;  // as of a range

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// The beginning of a line, fit for a terminal even if the file is no text.
std::string excerpt(const std::string& line) {
  std::string text = line.substr(0, 60);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

bool number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

}  // namespace

MeasuredSpeed read_speed_csv(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    throw BadInput({Problem{path.string(), 0, "driver.speed_csv", "cannot be read",
                            "an existing CSV file, relative to the scene"}});
  constexpr std::size_t most = 20;  // problems listed before giving up on the file
  std::vector<Problem> problems;
  MeasuredSpeed out;
  std::string text;
  bool header = false;
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // byte order mark that spreadsheets write
  for (int line = 1; std::getline(in, text) && problems.size() < most; ++line) {
    if (line == 1 && text.starts_with(mark)) text.erase(0, mark.size());
    text = trimmed(text);
    if (text.empty() || text[0] == '#') continue;
    const auto comma = text.find(',');
    const std::string first = trimmed(text.substr(0, comma)),
                      second = comma == std::string::npos ? "" : trimmed(text.substr(comma + 1));
    const auto bad = [&](std::string what) {
      problems.push_back({path.string(), line, "driver.speed_csv", std::move(what), allowed});
    };
    if (!header) {
      if (first != "time_s" || second != "speed_rpm") bad(fmt::format("the first line is \"{}\"", excerpt(text)));
      header = true;
      continue;
    }
    double time = 0, speed = 0;
    if (!number(first, time) || !number(second, speed))
      bad(fmt::format("\"{}\" is not two finite numbers", excerpt(text)));
    else if (speed < 0 || speed > fastest_rpm)
      bad(fmt::format("speed {} is out of limits", second));
    else if (!out.time_s.empty() && time <= out.time_s.back())
      bad(fmt::format("time {} does not come after {}", first, out.time_s.back()));
    else {
      out.time_s.push_back(time);
      out.speed_rpm.push_back(speed);
    }
  }
  if (problems.empty() && out.time_s.size() < 2)
    problems.push_back({path.string(), 0, "driver.speed_csv", "holds fewer than two samples", allowed});
  if (!problems.empty()) throw BadInput(std::move(problems));
  return out;
}

}  // namespace beltlife
