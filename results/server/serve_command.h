// Owns the command serve: the model of a study file over UM-Bridge until SIGINT or SIGTERM.
#pragma once

#include "results/course/command_line.h"

namespace beltlife {

void add_serve_command(CommandLine& line);

}  // namespace beltlife
