// Owns the groups /sweep and /event of a result file, both ways.
#pragma once

#include <optional>

#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"
#include "sim/eval/sweep.h"
#include "sim/record.h"

namespace beltlife {

void put_sweep(Hdf5Image& file, const Sweep& sweep);
/// Nothing from a file without the group.
std::optional<Sweep> read_sweep(const Hdf5Source& file);

/// The stretch of the first run in which the event happened; what it was is in the run's trace.
void put_event(Hdf5Image& file, const WindowRecord& event);
std::optional<WindowRecord> read_event(const Hdf5Source& file);

}  // namespace beltlife
