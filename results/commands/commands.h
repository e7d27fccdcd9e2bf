// Owns the commands that belong to no driver: each says its own options, and what it does.
#pragma once

#include <vector>

#include "results/course/command_line.h"
#include "results/pages/study/study_page.h"

namespace beltlife {

void add_check_command(CommandLine& line);
void add_modes_command(CommandLine& line);
void add_simulate_command(CommandLine& line);
void add_life_command(CommandLine& line);
/// `pages`: of all kinds of study.
void add_report_command(CommandLine& line, std::vector<StudyPage> pages);
void add_export_command(CommandLine& line);
void add_replay_command(CommandLine& line);

}  // namespace beltlife
