// Owns the flags that commands share: how they are spelled, and what --help says of them.
#pragma once

#include <string>

#include "results/course/command_line.h"

namespace beltlife {

/// --set, --scheme, --step, --elements, --json, --quiet.
void common_flags(Command& command, CommonOptions& options);
void threads_flag(Command& command, int& threads, const std::string& over);
void frames_flag(Command& command, int& frames);
/// --range, --threads, --force, --out, --frames, and the common ones.
void range_flags(Command& command, RangeOptions& options);
/// The study file, --threads, --seed where numbers are drawn, --out, and the common ones.
void driver_flags(Command& command, DriverOptions& options, const std::string& file, bool seeded);

}  // namespace beltlife
