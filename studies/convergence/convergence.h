// Owns the arithmetic of error against run time: groups of quantities, errors, orders, the reference's own band.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace beltlife {

/// Quantities that are judged together, in the order of tables.
const std::vector<std::string>& quantity_groups();
/// The group of a quantity by its name; "other" if it is none of the usual ones.
std::string quantity_group(const std::string& quantity);

/// Whether a quantity is of one element, so that it goes with the element's length: forces per pass.
bool of_one_element(const std::string& quantity);

/// Errors of `values` against `reference`, by quantity: lives as a difference of log10; slips and friction forces, some
/// of which are next to nothing, relative to the largest of their group in the range; all else relative to itself.
std::vector<double> errors_of(const std::vector<std::string>& quantities, const std::vector<double>& reference,
                              const std::vector<double>& values);
/// Differences in each quantity's own unit as such errors.
std::vector<double> as_errors(const std::vector<std::string>& quantities, const std::vector<double>& reference,
                              const std::vector<double>& differences);

/// One numerical setting and what it gave over all ranges.
struct NumericalRun {
  std::string scheme;
  int elements = 0;
  double step_s = 0;
  double processor_s = 0;      ///< median of the repeats
  std::string failure;         ///< in words; empty if ok
  std::vector<double> values;  ///< one a quantity; empty after a failure

  bool ok() const { return failure.empty(); }
};

/// Index of the run that all others are measured against: of the explicit schemes' on the finest mesh the one with the
/// shortest step, the thesis' scheme first. None if there is none.
std::optional<std::size_t> reference_run(const std::vector<NumericalRun>& runs);

/// How far the reference itself may be off, by quantity, in its unit: the larger of what the next longer step and the
/// other explicit scheme change, plus what Richardson's extrapolation over the meshes leaves (order observed from three
/// meshes, held between 1/2 and 2, else 1).
std::vector<double> reference_band(const std::vector<NumericalRun>& runs, std::size_t reference);

/// Slope of log(error) over log(size) by least squares; none with fewer than two positive errors.
std::optional<double> observed_order(const std::vector<double>& sizes, const std::vector<double>& errors);

}  // namespace beltlife
