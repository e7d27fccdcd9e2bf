// Owns the command study and its kinds.
#pragma once

#include <string>
#include <vector>

#include "results/course/command_line.h"

namespace beltlife {

void add_study_command(CommandLine& line);

/// Kinds with a line about each, in the order in which --help shows them.
struct StudyKind {
  std::string name, about;
  int (*run)(const DriverOptions&);
  bool seeded;              ///< draws numbers, so that --seed means something
  std::string (*fields)();  ///< reference of its study file, as Markdown
  std::string (*answer)();  ///< reference of its answer, as Markdown
};
const std::vector<StudyKind>& study_kinds();

}  // namespace beltlife
