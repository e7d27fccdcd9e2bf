// Owns the unit that a name states: names of quantities and parameters end in theirs.
#pragma once

#include <string>
#include <string_view>

namespace beltlife {

/// The unit in a name, in the spelling of tables and files ("N m", "r/min"); empty if there is none. What a name says
/// after its unit is passed over: statistics (".mean", ".order_3", ".band_10_20_hz"), the mechanism of a power
/// (".lost_friction"), the index in a list. "B100.drive_shaft.torque_n_m.order_3" is in N m, "log10_life_h" in log10 h.
std::string unit_of_name(std::string_view name);

}  // namespace beltlife
