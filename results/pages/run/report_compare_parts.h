// Owns what the sections of a comparison share: the sides, and a number of each beside its change.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "results/pages/html.h"
#include "results/pages/run/report_subject.h"

namespace beltlife::compare_page {

struct Contender {
  std::string label;  ///< of its columns and curves: the file's name without ending, or enough of its path
  Subject subject;
};
using Contenders = std::vector<Contender>;

/// Names of all sides' parts in the order of the first that has them: those of the first side, then what others add.
using NamesOf = std::function<std::vector<std::string>(const Contender&)>;
std::vector<std::string> all_names(const Contenders& sides, const NamesOf& names_of);

/// The side's range of that name, null if it was not evaluated.
const Subject::Range* range_of(const Contender& side, const std::string& name);

/// "+3.1" for 103.1 beside 100, in per cent; "-" where one of them is none or the first is 0.
std::string change_text(double value, double first);

/// A header `first`, then a column a side, all but the first followed by one of the change in per cent.
Row compared_header(const std::string& first, const Contenders& sides);
/// A value a side, NaN for none, in the columns of that header.
Row compared_row(const std::string& name, const std::vector<double>& values, int digits);

std::string ranges_section(const Contenders& sides);

}  // namespace beltlife::compare_page
