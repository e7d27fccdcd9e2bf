// Owns the entry of the command calibrate.
#pragma once

#include <string>

#include "results/commands/commands.h"

namespace beltlife {

/// Fits a model to measurements as the file options.scenes[0] says. Exit code as of the other commands.
int run_calibrate(const CommandOptions& options);

/// Reference of the file's fields, as Markdown.
std::string calibrate_fields();

}  // namespace beltlife
