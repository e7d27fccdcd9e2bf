// Owns the list of sections of a report page; each is empty where the file has nothing to say about it.
#pragma once

#include <string>

#include "results/report_subject.h"

namespace beltlife {

std::string summary_section(const Subject& subject);
std::string layout_section(const Subject& subject);
std::string life_section(const Subject& subject);
std::string statics_section(const Subject& subject);
std::string modes_section(const Subject& subject);
std::string losses_section(const Subject& subject);
std::string ranges_section(const Subject& subject);
std::string warnings_section(const Subject& subject);
std::string provenance_section(const Subject& subject);

}  // namespace beltlife
