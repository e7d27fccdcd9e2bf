// Owns the list of sections of a report page; each is empty where the file has nothing to say about it.
#pragma once

#include <array>
#include <string>

#include "results/pages/run/report_subject.h"

namespace beltlife {

/// The energies in words, in the order of Energy.
inline constexpr std::array<const char*, energy_names.size()> energy_words{"put in by the driver",
                                                                           "put in by torque tables",
                                                                           "lost in the belt, axial damping",
                                                                           "lost in the belt, bending damping",
                                                                           "lost in contact, normal damping",
                                                                           "lost in friction between belt and pulleys",
                                                                           "lost in shafts",
                                                                           "lost in gears",
                                                                           "lost in the tensioner, damping",
                                                                           "lost in the tensioner, dry friction",
                                                                           "stored, kinetic and elastic"};

std::string summary_section(const Subject& subject);
std::string layout_section(const Subject& subject);
std::string life_section(const Subject& subject);
std::string statics_section(const Subject& subject);
std::string modes_section(const Subject& subject);
std::string sweep_section(const Subject& subject);
std::string event_section(const Subject& subject);
std::string losses_section(const Subject& subject);
std::string ranges_section(const Subject& subject);
std::string warnings_section(const Subject& subject);
std::string provenance_section(const Subject& subject);

}  // namespace beltlife
