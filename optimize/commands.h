// Owns the command optimize.
#pragma once

#include "results/course/command_line.h"

namespace beltlife {

/// Looks for the best layout. Exit code 3 also where no layout keeps all limits.
void add_optimize_command(CommandLine& line);

}  // namespace beltlife
