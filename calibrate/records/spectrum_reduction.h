// Owns the reduction of a measured amplitude spectrum to order amplitudes, bands and noise.
#pragma once

#include "calibrate/records/measurement.h"
#include "calibrate/records/record_reduction.h"

namespace beltlife {

/// How a window spreads a line: over `reach` bins to either side, with squares that sum to `noise_bins` A^2.
struct LineShape {
  double reach = 0;
  double noise_bins = 0;
};
LineShape line_shape(SpectrumWindow window);

/// The spectrum is evenly spaced in Hz, and fine enough that orders half a crank frequency apart do not overlap.
/// `crank_hz`: as known, else within 2 % of the nominal one as the lines lie. An order's amplitude is the root of the
/// squares about it; without a window (rectangular) the highest bin. Noise is the median of the bins away from all
/// orders. Bands are known above the highest order alone, with whatever noise is in them.
Reduction reduce_spectrum(const Spectrum& spectrum, SpectrumWindow window, const ReductionSettings& settings);

}  // namespace beltlife
