// Owns the report: one self-contained HTML page about a result file.
#pragma once

#include <string>

#include "results/store/result_reader.h"

namespace beltlife {

/// The page. Sections have the ids summary, layout, life, statics, modes, sweep, event, losses, ranges (with
/// range-NAME), warnings, provenance; a section about which the file says nothing is left out. Throws BadInput if the
/// file's scene cannot be read or gnuplot is missing.
std::string report_html(const ResultFile& file, const std::string& name);

}  // namespace beltlife
