// Owns the reading of a measured speed from a CSV file.
#pragma once

#include <filesystem>

#include "sim/plan.h"

namespace beltlife {

/// Reads columns time_s, speed_rpm (a header line with these names, then numbers, comma-separated; lines that begin
/// with # are comments). Time must increase, speed must be finite and not negative. Throws BadInput with file and line.
MeasuredSpeed read_speed_csv(const std::filesystem::path& path);

}  // namespace beltlife
