// Owns the choice of what is compared: from reduced amplitudes to measured values with their standard deviations.
#pragma once

#include "calibrate/records/csv_columns.h"
#include "calibrate/records/measurement.h"
#include "calibrate/records/record_reduction.h"

namespace beltlife {

/// "5", "0.5, 1, 1.5": orders as quantities spell them.
std::string orders_text(const std::vector<double>& orders);

/// Fills in `values` and `left_out`. Problems: an order that was asked for and cannot be known, a mean of zero, no
/// order told apart, nothing left to compare.
void choose_values(Measurement& m, const Reduction& r, FileProblems& problems);

}  // namespace beltlife
