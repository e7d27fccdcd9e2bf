// Owns the checks of what values stand over: time that runs evenly, frequencies fine enough for orders.
#pragma once

#include <vector>

#include "calibrate/records/measured_column.h"
#include "calibrate/records/record_reduction.h"

namespace beltlife {

/// Sampling rate (Hz) of a time series; 0 after a problem: times that do not increase, have gaps or are uneven (with
/// their lines), no rate at all, one that is too slow for the orders, a record shorter than the simulation's window.
double record_rate(const CsvFile& csv, const MeasuredColumns& columns, const std::vector<double>& abscissa,
                   const SpectrumSpec& spec, const ReductionSettings& settings, FileProblems& problems);

/// An amplitude spectrum over Hz. Problems: negative amplitudes, uneven frequencies, a resolution too coarse to tell
/// half orders apart, a mean that is asked for.
Spectrum spectrum_over_hz(const CsvFile& csv, const MeasuredColumns& columns, std::vector<double> abscissa,
                          std::vector<double> values, const SpectrumSpec& spec, const ReductionSettings& settings,
                          FileProblems& problems);

}  // namespace beltlife
