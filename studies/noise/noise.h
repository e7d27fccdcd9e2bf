// Owns what replicates show: their spread, and responses that coexist.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// One of several steady responses.
struct Response {
  double mean = 0;
  std::vector<std::size_t> members;  ///< indices of the values that belong to it
};
/// Splits values where a gap stands out: wider than four times the scatter within the responses on either side of it
/// (24 times of four values, 6 of eight) and than `resolution` of the largest value, with two values or more on either
/// side. One response, or several from low to high.
std::vector<Response> responses_of(const std::vector<double>& values, double resolution = 5e-3);

struct Spread {
  double mean = 0, standard_deviation = 0, low = 0, high = 0;
};
Spread spread_of(const std::vector<double>& values);

}  // namespace beltlife
