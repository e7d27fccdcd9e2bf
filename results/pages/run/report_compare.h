// Owns the page that compares result files side by side.
#pragma once

#include <string>
#include <vector>

#include "results/store/result_reader.h"

namespace beltlife {

struct ComparedFile {
  std::string path;
  ResultFile file;
};

/// The page; the first file is what the others are compared with. Sections have the ids summary, layout, life, scenes,
/// ranges (with range-NAME), warnings, provenance; what no file has is left out, what some lack is "-". Throws BadInput
/// if the scene of a file cannot be read or gnuplot is missing.
std::string comparison_html(const std::vector<ComparedFile>& files);

/// NAME1_vs_NAME2.html beside the first, of more files NAME1_vs_NAME2_and_N_more.html.
std::string comparison_page_beside(const std::vector<std::string>& files);

}  // namespace beltlife
