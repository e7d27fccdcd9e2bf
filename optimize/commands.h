// Owns the entry of the command optimize.
#pragma once

#include <string>

#include "results/commands/commands.h"

namespace beltlife {

/// Looks for the best layout as the file options.scenes[0] says. Exit code as of the other commands; 3 also where no
/// layout keeps all limits.
int run_optimize(const CommandOptions& options);

/// Reference of the file's fields, as Markdown.
std::string optimize_fields();

}  // namespace beltlife
