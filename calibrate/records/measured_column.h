// Owns the meaning of a CSV's header: which column is the channel, in which unit, and over what it stands.
#pragma once

#include <cstddef>
#include <string>

#include "calibrate/records/csv_columns.h"
#include "calibrate/records/measurement.h"

namespace beltlife {

enum class Abscissa { samples, time, frequency, order };

/// Where a file has what is wanted. `factor` leads to r/min or N m, `abscissa_factor` to s (Hz, order).
struct MeasuredColumns {
  Abscissa abscissa = Abscissa::samples;
  std::size_t abscissa_index = 0;
  double abscissa_factor = 1;
  std::size_t value_index = 0;
  double factor = 1;
};

/// Finds spec.column, or the column named like spec.channel: whole or by its last part, in any unit of its kind
/// ("drive_shaft.speed_rad_s", "speed [rpm]"). Problems: no such column or several, no unit or an unknown one, a unit
/// that does not belong to the channel, two abscissas.
MeasuredColumns pick_columns(const CsvFile& csv, const SpectrumSpec& spec, FileProblems& problems);

/// Why this is no unit of the channel, in words; empty if it is one.
std::string unit_fault(const std::string& unit, const std::string& channel);

}  // namespace beltlife
