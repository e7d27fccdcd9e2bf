// Owns the entry of the command study.
#pragma once

#include <string>
#include <vector>

#include "results/commands/commands.h"

namespace beltlife {

/// Runs the study `options.kind` described by the file options.scenes[0]. Exit code as of the other commands.
int run_study(const CommandOptions& options);

/// Kinds with a line about each, in the order in which --help shows them.
struct StudyKind {
  std::string name, about;
  int (*run)(const CommandOptions&);
  bool seeded;              ///< draws numbers, so that --seed means something
  std::string (*fields)();  ///< reference of its study file, as Markdown
};
const std::vector<StudyKind>& study_kinds();

}  // namespace beltlife
