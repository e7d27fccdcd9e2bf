// Units read off names: see quantity_unit.h.
#include "sim/eval/quantity_unit.h"

#include <algorithm>
#include <array>

#include "sim/record.h"
#include "sim/scene/scene.h"

namespace beltlife {
namespace {

struct Ending {
  std::string_view name, unit;
};

/// Longer endings come first, so that a torque is not taken for a length.
constexpr std::array<Ending, 28> endings{{{"_n_m_s_per_rad", "N m s/rad"},
                                          {"_n_m_per_rad", "N m/rad"},
                                          {"_n_s_per_m3", "N s/m3"},
                                          {"_kg_per_m", "kg/m"},
                                          {"_n_per_m3", "N/m3"},
                                          {"_n_s_per_m", "N s/m"},
                                          {"_n_per_m", "N/m"},
                                          {"_percent", "%"},
                                          {"_n_m2_s", "N m2 s"},
                                          {"_kg_m2", "kg m2"},
                                          {"_rad_s", "rad/s"},
                                          {"_n_m2", "N m2"},
                                          {"_rpm", "r/min"},
                                          {"_mpa", "MPa"},
                                          {"_deg", "deg"},
                                          {"_rad", "rad"},
                                          {"_n_m", "N m"},
                                          {"_n_s", "N s"},
                                          {"_m_s", "m/s"},
                                          {"_hz", "Hz"},
                                          {"_mm", "mm"},
                                          {"_kg", "kg"},
                                          {"_n", "N"},
                                          {"_h", "h"},
                                          {"_s", "s"},
                                          {"_w", "W"},
                                          {"_m", "m"},
                                          {"_j", "J"}}};

/// Whether a part of a name qualifies what stands before it.
bool qualifies(std::string_view part) {
  constexpr std::array<std::string_view, 3> statistics{"mean", "min", "max"};
  const auto among = [&](const auto& words) { return std::find(words.begin(), words.end(), part) != words.end(); };
  return part.find_first_not_of("0123456789") == part.npos || part.starts_with("order_") || part.starts_with("band_") ||
         among(statistics) || among(energy_names) || among(EnumNames<PassForce>::names);
}

std::string unit_of_part(std::string_view part) {
  constexpr std::string_view logarithm = "log10_";
  for (const Ending& ending : endings)
    if (part.ends_with(ending.name)) return (part.starts_with(logarithm) ? "log10 " : "") + std::string(ending.unit);
  return "";
}

}  // namespace

std::string unit_of_name(std::string_view name) {
  while (true) {
    const std::size_t dot = name.rfind('.');
    const std::string_view part = dot == name.npos ? name : name.substr(dot + 1);
    if (dot == name.npos || !qualifies(part)) return unit_of_part(part);
    name = name.substr(0, dot);
  }
}

}  // namespace beltlife
