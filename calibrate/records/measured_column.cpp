// The meaning of a CSV's header: see measured_column.h.
#include "calibrate/records/measured_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>

#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

struct Unit {
  std::string_view ending;   ///< of a name: "speed_rad_s"
  std::string_view compact;  ///< as people write it, lower case without blanks
  std::string_view shown;
  std::string_view channel_unit;  ///< what it is turned into
  double factor;
};

constexpr double rad_s = 30 / std::numbers::pi;
constexpr std::array<Unit, 12> units{{{"_rpm", "rpm", "rpm", "r/min", 1},
                                      {"_r_min", "r/min", "r/min", "r/min", 1},
                                      {"", "1/min", "1/min", "r/min", 1},
                                      {"_rad_s", "rad/s", "rad/s", "r/min", rad_s},
                                      {"_hz", "hz", "Hz", "r/min", 60},
                                      {"_rev_s", "rev/s", "rev/s", "r/min", 60},
                                      {"_n_m", "nm", "N m", "N m", 1},
                                      {"_nm", "n*m", "N m", "N m", 1},
                                      {"", "n\xc2\xb7m", "N m", "N m", 1},
                                      {"_kn_m", "knm", "kN m", "N m", 1000},
                                      {"_knm", "kn*m", "kN m", "N m", 1000},
                                      {"", "kn\xc2\xb7m", "kN m", "N m", 1000}}};
constexpr const char* all_units = "speeds in rpm, r/min, rad/s, Hz, rev/s; torques in N m, kN m";

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

const Unit* unit_named(std::string_view text) {
  std::string compact = lower(text);
  std::erase(compact, ' ');
  for (const Unit& unit : units)
    if (unit.compact == compact || (!unit.ending.empty() && unit.ending.substr(1) == compact)) return &unit;
  return nullptr;
}

/// "drive_shaft.speed [rad/s]" or "drive_shaft.speed_rad_s": what is measured, and in which unit.
struct Header {
  std::string stem;
  std::string stated;  ///< a unit in brackets, as it stands there
  const Unit* unit = nullptr;
};

Header parse(std::string_view name) {
  Header header;
  const auto open = name.find_first_of("[(");
  if (open != name.npos && (name.back() == ']' || name.back() == ')')) {
    header.stated = name.substr(open + 1, name.size() - open - 2);
    header.unit = unit_named(header.stated);
    name = name.substr(0, open);
  }
  header.stem = lower(name.substr(0, name.find_last_not_of(" _") + 1));
  for (const Unit& unit : units)
    if (!unit.ending.empty() && header.stem.ends_with(unit.ending)) {
      if (header.stated.empty()) header.unit = &unit;
      header.stem.resize(header.stem.size() - unit.ending.size());
      break;
    }
  return header;
}

void pick_abscissa(const CsvFile& csv, MeasuredColumns& picked, FileProblems& problems) {
  struct Known {
    std::string_view name;
    Abscissa kind;
    double factor;
  };
  constexpr std::array<Known, 10> known{{{"time_s", Abscissa::time, 1},
                                         {"t_s", Abscissa::time, 1},
                                         {"time[s]", Abscissa::time, 1},
                                         {"t[s]", Abscissa::time, 1},
                                         {"time_ms", Abscissa::time, 1e-3},
                                         {"t_ms", Abscissa::time, 1e-3},
                                         {"time[ms]", Abscissa::time, 1e-3},
                                         {"frequency_hz", Abscissa::frequency, 1},
                                         {"frequency[hz]", Abscissa::frequency, 1},
                                         {"order", Abscissa::order, 1}}};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < csv.names().size(); ++i) {
    std::string compact = lower(csv.names()[i]);
    std::erase(compact, ' ');
    for (const Known& k : known)
      if (k.name == compact) {
        picked.abscissa = k.kind;
        picked.abscissa_index = i;
        picked.abscissa_factor = k.factor;
        found.push_back(excerpt(csv.names()[i]));
      }
  }
  if (found.size() > 1)
    problems.add(csv.header_line(), "has the columns " + joined(found, " and ") + " to stand over",
                 "one of time_s, time_ms, frequency_hz, order; none with sample_rate_hz");
}

/// Indices of the columns that may be meant: by the whole name, else by its last part.
std::vector<std::size_t> candidates(const CsvFile& csv, const SpectrumSpec& spec) {
  std::vector<std::size_t> exact, last;
  const std::string whole = parse(spec.channel).stem;
  const std::string part = whole.substr(whole.rfind('.') == whole.npos ? 0 : whole.rfind('.') + 1);
  for (std::size_t i = 0; i < csv.names().size(); ++i) {
    if (spec.column) {
      if (csv.names()[i] == *spec.column) exact.push_back(i);
      continue;
    }
    const std::string stem = parse(csv.names()[i]).stem;
    if (stem == whole) exact.push_back(i);
    if (stem == part) last.push_back(i);
  }
  return exact.empty() ? last : exact;
}

}  // namespace

std::string unit_fault(const std::string& text, const std::string& channel) {
  const Unit* unit = unit_named(text);
  if (!unit) return "\"" + excerpt(text) + "\" is no unit that is known; " + all_units;
  const std::string own = unit_of_name(channel);
  if (unit->channel_unit == own) return "";
  return fmt::format("{} is no unit of the channel {}, which is in {}", unit->shown, channel, own);
}

MeasuredColumns pick_columns(const CsvFile& csv, const SpectrumSpec& spec, FileProblems& problems) {
  MeasuredColumns picked;
  pick_abscissa(csv, picked, problems);
  const int line = csv.header_line();
  std::vector<std::string> shown;
  for (const std::string& name : csv.names()) shown.push_back(excerpt(name));
  const std::vector<std::size_t> found = candidates(csv, spec);
  const std::string sought = spec.column.value_or(spec.channel);
  if (found.empty()) {
    problems.add(line, "has no column \"" + excerpt(sought) + "\"" + did_you_mean(sought, shown),
                 "of its columns, named by `column`: " + joined(shown));
    return picked;
  }
  if (found.size() > 1) {
    std::vector<std::string> names;
    for (const std::size_t i : found) names.push_back(shown[i]);
    problems.add(line, fmt::format("has {} columns for \"{}\": {}", found.size(), excerpt(sought), joined(names)),
                 "one, or its name in `column`");
    return picked;
  }
  picked.value_index = found[0];
  const std::string& name = shown[found[0]];
  const Header header = parse(csv.names()[found[0]]);
  const Unit* stated = spec.unit ? unit_named(*spec.unit) : nullptr;
  if (!header.stated.empty() && !header.unit) {
    problems.add(line, fmt::format("\"{}\", the unit of the column \"{}\", is not known", excerpt(header.stated), name),
                 all_units);
    return picked;
  }
  const Unit* unit = header.unit ? header.unit : stated;
  if (!unit) {
    problems.add(line, fmt::format("the column \"{}\" states no unit", name), "a `unit` in the study file");
    return picked;
  }
  if (header.unit && stated && header.unit->shown != stated->shown &&
      (header.unit->factor != stated->factor || header.unit->channel_unit != stated->channel_unit))
    problems.add(line,
                 fmt::format("the column \"{}\" is in {} by its header, in {} by the study file", name,
                             header.unit->shown, stated->shown),
                 "one unit");
  const std::string own = unit_of_name(spec.channel);
  if (unit->channel_unit != own)
    problems.add(line,
                 fmt::format("the column \"{}\" is in {}, the channel {} in {}", name, unit->shown, spec.channel, own),
                 "a column in a unit of the channel");
  picked.factor = unit->factor;
  return picked;
}

}  // namespace beltlife
