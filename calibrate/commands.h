// Owns the commands calibrate and twin.
#pragma once

#include "results/course/command_line.h"

namespace beltlife {

/// Fits a model to measurements.
void add_calibrate_command(CommandLine& line);
/// Makes records out of the model, to try a calibration on.
void add_twin_command(CommandLine& line);

}  // namespace beltlife
